// quad_generator: the beats of a burst are its quads in row order, QuadWidth in each but the last, with the samples of each
// that are covered; as many beats as that takes, and none of a tile without a quad.

module quad_generator_properties
  import raster_pkg::*;
(
  input logic      clk_i,
  input logic      rst_ni,
  input logic      coverage_valid_i,
  input coverage_t coverage_i,
  input logic      beat_ready_i
);

  localparam int unsigned RowQuads = TileSize / 2;
  localparam int unsigned PartQuads = TileQuads / ZParts;
  typedef logic [TileQuads-1:0] quads_t;

  logic                     coverage_ready, beat_valid, job_taken, job_burst, idle;
  quad_beat_t               popped;
  quad_generator_activity_e activity;

  quad_generator u_dut (
    .clk_i            (clk_i),
    .rst_ni           (rst_ni),
    .coverage_valid_i (coverage_valid_i),
    .coverage_ready_o (coverage_ready),
    .coverage_i       (coverage_i),
    .beat_valid_o     (beat_valid),
    .beat_ready_i     (beat_ready_i),
    .beat_o           (popped),
    .job_taken_o      (job_taken),
    .job_burst_o      (job_burst),
    .activity_o       (activity),
    .idle_o           (idle)
  );

  // The coverage in work, and the quads of it that have not left.
  coverage_t work_q;
  quads_t    left_q, taken, left [QuadWidth+1];
  logic      any_q;

  // The four samples of a quad: (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1).
  function automatic logic [3:0] samples(logic [MaskBits-1:0] mask, int unsigned quad);
    int unsigned x = 2 * (quad % RowQuads);
    int unsigned y = 2 * (quad / RowQuads);
    return {mask[(y+1)*TileSize+x+1], mask[(y+1)*TileSize+x],
            mask[y*TileSize+x+1], mask[y*TileSize+x]};
  endfunction

  always_comb begin
    for (int unsigned q = 0; q < TileQuads; q++) begin
      taken[q] = |samples(coverage_i.mask, q);
    end
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      any_q  <= 1'b0;
      left_q <= '0;
    end else if (coverage_valid_i && coverage_ready) begin
      any_q  <= 1'b1;
      work_q <= coverage_i;
      left_q <= taken;
    end else begin
      left_q <= left[QuadWidth];
    end
  end

  // The quads of this beat are the lowest that are left.
  assign left[0] = left_q;
  for (genvar n = 0; n < QuadWidth; n++) begin : gen_quad
    quads_t                   lowest;
    logic [QuadIndexBits-1:0] index;
    logic [3:0]               mask;

    assign lowest    = left[n] & ~(left[n] - quads_t'(1));
    assign left[n+1] = left[n] & ~lowest;

    always_comb begin
      index = '0;
      mask  = '0;
      for (int unsigned q = 0; q < TileQuads; q++) begin
        if (lowest[q]) begin
          index = QuadIndexBits'(q);
          mask  = samples(work_q.mask, q);
        end
      end
      Index: assert (u_dut.beats_q == '0 || u_dut.beat.index[n] == index);
      Mask: assert (u_dut.beats_q == '0 || u_dut.beat.mask[n] == mask);
    end
  end

  int unsigned count;
  always_comb begin
    count = 0;
    for (int unsigned q = 0; q < TileQuads; q++) begin
      count += 32'(left_q[q]);
    end
  end

  for (genvar part = 0; part < ZParts; part++) begin : gen_part
    logic some, full;
    always_comb begin
      some = 1'b0;
      full = 1'b1;
      for (int unsigned q = part * PartQuads; q < (part + 1) * PartQuads; q++) begin
        some |= |samples(work_q.mask, q);
        full &= &samples(work_q.mask, q);
      end
      PartTouched: assert (!any_q || u_dut.head_q.parts[part] == some);
      PartSure: assert (!any_q || u_dut.head_q.sure[part] == (work_q.sure && full));
    end
  end

  for (genvar q = 0; q < TileQuads; q++) begin : gen_sample
    always_comb begin
      Samples: assert (!any_q || {u_dut.samples_q[3][q], u_dut.samples_q[2][q],
                                  u_dut.samples_q[1][q], u_dut.samples_q[0][q]}
                       == samples(work_q.mask, q));
    end
  end

  always_comb begin
    QuadsLeft: assert (u_dut.quads_q == left_q || (u_dut.beats_q == '0 && left_q == '0));
    NoneLeft: assert (u_dut.beats_q != '0 || left_q == '0);
    BeatsRoundedUp: assert (32'(u_dut.beats_q) == (count + QuadWidth - 1) / QuadWidth);
    TakenAfterLastBeat: assert (!coverage_ready || 32'(u_dut.beats_q) <= 1);
    InWork: assert (u_dut.beats_q == '0 || any_q);
    Head: assert (!any_q || (u_dut.head_q.slot == work_q.slot
                             && u_dut.head_q.tile_x == work_q.tile_x
                             && u_dut.head_q.tile_y == work_q.tile_y
                             && u_dut.head_q.e == work_q.e));

    WholeTile: cover (&work_q.mask && 32'(u_dut.beats_q) == TileQuads / QuadWidth);
    EmptyTile: cover (u_dut.first_q && u_dut.beats_q == '0);
    HelperSamples: cover (u_dut.beats_q != '0 && u_dut.beat.mask[0] == 4'b0110);
  end

endmodule
