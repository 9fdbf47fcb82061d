// From the coverage mask of a tile to the 2x2 quads that hold a covered sample, QuadWidth of them in a beat.
//
// Quads leave in row order of the tile, empty ones squeezed out. A coverage is taken in cycle g; beat i of its burst is
// made in g + 1 + i and may be taken in g + 2 + i. The next coverage is taken in the cycle in which the last beat is
// made, so beats follow each other without a gap; one without any quad takes a cycle of its own. A coverage is taken
// only with a credit for a whole burst, so nothing stalls in mid-pipe: whether it is empty, and uses none, shows only
// when it is there.

module quad_generator
  import raster_pkg::*;
#(
  /// Bursts in the output FIFO, 2 to 64. With 2, bursts of one beat cannot leave in every cycle. Costs memory: as many
  /// heads (slot, tile, E, parts), and TileQuads / QuadWidth times as many beats (index and mask of QuadWidth quads).
  parameter int unsigned FifoDepth = 4
) (
  input  logic       clk_i,
  input  logic       rst_ni,

  // edge_evaluator
  input  logic       coverage_valid_i,
  output logic       coverage_ready_o,
  input  coverage_t  coverage_i,

  // early_z
  output logic       beat_valid_o,
  input  logic       beat_ready_i,
  output quad_beat_t beat_o,

  // hi_z: a coverage was taken in the cycle before; whether it has a quad.
  output logic       job_taken_o,
  output logic       job_burst_o,

  // What the cycle is spent on; whether nothing is left to do.
  output quad_generator_activity_e activity_o,
  output logic       idle_o
);

  localparam int unsigned Beats = TileQuads / QuadWidth;
  localparam int unsigned CountBits = $clog2(TileQuads + 1);
  localparam int unsigned RowQuads = TileSize / 2;
  localparam int unsigned PartQuads = TileQuads / ZParts;

  typedef logic [CountBits-1:0] count_t;
  typedef logic [$clog2(Beats+1)-1:0] beats_t;
  typedef logic [TileQuads-1:0] quads_t;
  typedef logic [QuadMaskBits-1:0][TileQuads-1:0] samples_t;  // sample by sample, of all quads

  // What all beats of a burst share.
  typedef struct packed {
    logic [SlotBits-1:0]             slot;
    logic [TileColumnBits-1:0]       tile_x;
    logic [TileCoordBits-1:0]        tile_y;
    edge_t [1:0]                     e;
    logic [ZParts-1:0][FlagBits-1:0] parts;
    logic [ZParts-1:0][FlagBits-1:0] sure;
  } head_t;

  typedef struct packed {
    logic [QuadWidth-1:0][QuadIndexBits-1:0] index;
    logic [QuadWidth-1:0][QuadMaskBits-1:0]  mask;
  } beat_t;

  // The number of quads as a tree of adders; beats are rounded up.
  function automatic beats_t beats_of(quads_t quads);
    count_t [TileQuads-1:0] sum;
    for (int unsigned i = 0; i < TileQuads; i++) begin
      sum[i] = count_t'(quads[i]);
    end
    for (int unsigned step = 1; step < TileQuads; step *= 2) begin
      for (int unsigned i = 0; i < TileQuads; i += 2 * step) begin
        sum[i] = sum[i] + sum[i+step];
      end
    end
    return beats_t'((sum[0] + count_t'(QuadWidth - 1)) >> $clog2(QuadWidth));
  endfunction

  // The coverage as quads.
  samples_t coverage_samples;
  quads_t   coverage_quads, coverage_full;
  head_t    coverage_head;
  logic     accepted;

  for (genvar q = 0; q < TileQuads; q++) begin : gen_quad
    localparam int unsigned TopLeft = (q / RowQuads) * 2 * TileSize + (q % RowQuads) * 2;
    assign coverage_samples[0][q] = coverage_i.mask[TopLeft];
    assign coverage_samples[1][q] = coverage_i.mask[TopLeft+1];
    assign coverage_samples[2][q] = coverage_i.mask[TopLeft+TileSize];
    assign coverage_samples[3][q] = coverage_i.mask[TopLeft+TileSize+1];
  end

  always_comb begin
    coverage_quads = '0;
    coverage_full  = '1;
    for (int unsigned sample = 0; sample < QuadMaskBits; sample++) begin
      coverage_quads |= coverage_samples[sample];
      coverage_full  &= coverage_samples[sample];
    end
  end

  always_comb begin
    coverage_head.slot   = coverage_i.slot;
    coverage_head.tile_x = coverage_i.tile_x;
    coverage_head.tile_y = coverage_i.tile_y;
    coverage_head.e      = coverage_i.e;
    for (int unsigned part = 0; part < ZParts; part++) begin
      coverage_head.parts[part] = |coverage_quads[part*PartQuads+:PartQuads];
      coverage_head.sure[part]  = coverage_i.sure & (&coverage_full[part*PartQuads+:PartQuads]);
    end
  end

  assign accepted = coverage_valid_i & coverage_ready_o;

  // The burst in work: beats yet to be made and the quads in them.
  beats_t   beats_d, beats_q;
  logic     first_q, ready_q, credit_next;
  quads_t   quads_q, quads_rest;
  samples_t samples_q;
  head_t    head_q;

  always_comb begin
    beats_d = beats_q;
    if (accepted) begin
      beats_d = beats_of(coverage_quads);
    end else if (beats_q != '0) begin
      beats_d = beats_q - beats_t'(1);
    end
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      beats_q <= '0;
      first_q <= 1'b0;
      ready_q <= 1'b0;
    end else begin
      beats_q <= beats_d;
      first_q <= accepted;
      ready_q <= credit_next & (beats_d == '0 || beats_d == beats_t'(1));
    end
  end

  assign coverage_ready_o = ready_q;
  assign job_taken_o      = first_q;
  assign job_burst_o      = first_q && beats_q != '0;

  // Needs no reset: beats_q says whether it means anything. Without a burst in work no quads are left.
  always_ff @(posedge clk_i) begin
    if (accepted) begin
      quads_q   <= coverage_quads;
      samples_q <= coverage_samples;
      head_q    <= coverage_head;
    end else begin
      quads_q <= quads_rest;
    end
  end

  // A beat.
  logic [QuadWidth-1:0][TileQuads-1:0] pick;
  beat_t                               beat;

  next_quads #(
    .Size  (TileQuads),
    .Picks (QuadWidth)
  ) u_next (
    .set_i  (quads_q),
    .pick_o (pick),
    .rest_o (quads_rest)
  );

  // Of all quads of the tile, bit b of the index.
  function automatic quads_t index_bit(int unsigned b);
    quads_t bits;
    for (int unsigned q = 0; q < TileQuads; q++) begin
      bits[q] = ((q >> b) & 1) == 1;
    end
    return bits;
  endfunction

  // Quads beyond the last are picked nowhere: index and mask 0.
  for (genvar n = 0; n < QuadWidth; n++) begin : gen_place
    for (genvar b = 0; b < QuadIndexBits; b++) begin : gen_index
      localparam quads_t IndexBit = index_bit(b);
      assign beat.index[n][b] = |(pick[n] & IndexBit);
    end
    for (genvar sample = 0; sample < QuadMaskBits; sample++) begin : gen_mask
      assign beat.mask[n][sample] = |(pick[n] & samples_q[sample]);
    end
  end

  head_t out_head;
  beat_t out_beat;
  logic  out_last;

  burst_fifo #(
    .HeadWidth ($bits(head_t)),
    .BeatWidth ($bits(beat_t)),
    .Depth     (FifoDepth),
    .Beats     (Beats)
  ) u_fifo (
    .clk_i         (clk_i),
    .rst_ni        (rst_ni),
    .credit_next_o (credit_next),
    .reserve_i     (accepted & (|coverage_quads)),
    .push_i        (beats_q != '0),
    .first_i       (first_q),
    .last_i        (beats_q == beats_t'(1)),
    .head_i        (head_q),
    .beat_i        (beat),
    .pop_valid_o   (beat_valid_o),
    .pop_ready_i   (beat_ready_i),
    .last_o        (out_last),
    .head_o        (out_head),
    .beat_o        (out_beat),
    .empty_o       (idle_o)
  );

  // The cycle of a burst's last beat is already the next coverage's.
  logic beats_left;
  assign beats_left = beats_q != '0 && beats_q != beats_t'(1);
  assign activity_o = accepted || beats_left ? QuadGeneratorBusy
                      : coverage_valid_i     ? QuadGeneratorNoCredit : QuadGeneratorNoCoverage;

  always_comb begin
    beat_o.slot   = out_head.slot;
    beat_o.tile_x = out_head.tile_x;
    beat_o.tile_y = out_head.tile_y;
    beat_o.e      = out_head.e;
    beat_o.last   = out_last;
    beat_o.parts  = out_head.parts;
    beat_o.sure   = out_head.sure;
    beat_o.index  = out_beat.index;
    beat_o.mask   = out_beat.mask;
  end

endmodule
