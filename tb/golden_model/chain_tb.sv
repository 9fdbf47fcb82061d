// The golden model beside a chain of units: random triangles into setup, and every link behind it checked, from one model
// that is given the triangles alone. So the first link that is wrong is named, whatever comes of it further down.
//   +packets=N  triangles to send (500); the other arguments are those of edge_evaluator_tb, the fault is on quad beats

module chain_tb;
  import raster_pkg::*;
  import halfspace_dpi::*;

  localparam int unsigned Size = 256;  // pixels on a side of the target

  // Links that carry several structs.
  typedef struct packed {
    screen_triangle_t triangle;
    draw_state_t      state;
  } triangle_link_t;

  typedef struct packed {
    setup_triangle_t triangle;
    depth_equation_t equation;
    draw_state_t     state;
  } setup_link_t;

  typedef struct packed {
    logic [SlotBits-1:0] slot;
    depth_equation_t     equation;
    draw_state_t         state;
  } slot_link_t;

  logic clk = 1'b0;
  logic rst_n = 1'b0;

  logic           triangle_valid, triangle_ready;
  triangle_link_t triangle;
  logic           set_up_valid, set_up_ready;
  setup_link_t    set_up;
  logic           slot_valid;
  slot_link_t     slot;
  logic           block_valid, block_ready;
  block_job_t     block;
  logic           job_valid, job_ready;
  tile_job_t      job;
  logic           coverage_valid, coverage_ready;
  coverage_t      coverage;
  logic           dut_valid, dut_ready;
  quad_beat_t     dut_beat;
  logic           beat_valid, beat_ready;
  quad_beat_t     beat;

  setup u_setup (
    .clk_i            (clk),
    .rst_ni           (rst_n),
    .triangle_valid_i (triangle_valid),
    .triangle_ready_o (triangle_ready),
    .triangle_i       (triangle.triangle),
    .state_i          (triangle.state),
    .triangle_valid_o (set_up_valid),
    .triangle_ready_i (set_up_ready),
    .triangle_o       (set_up.triangle),
    .equation_o       (set_up.equation),
    .state_o          (set_up.state)
  );

  block_walker u_block_walker (
    .clk_i            (clk),
    .rst_ni           (rst_n),
    .triangle_valid_i (set_up_valid),
    .triangle_ready_o (set_up_ready),
    .triangle_i       (set_up.triangle),
    .equation_i       (set_up.equation),
    .state_i          (set_up.state),
    .slot_write_o     (slot_valid),
    .slot_o           (slot.slot),
    .slot_equation_o  (slot.equation),
    .slot_state_o     (slot.state),
    .block_valid_o    (block_valid),
    .block_ready_i    (block_ready),
    .block_o          (block)
  );

  tile_walker u_tile_walker (
    .clk_i         (clk),
    .rst_ni        (rst_n),
    .block_valid_i (block_valid),
    .block_ready_o (block_ready),
    .block_i       (block),
    .job_valid_o   (job_valid),
    .job_ready_i   (job_ready),
    .job_o         (job)
  );

  edge_evaluator u_edge_evaluator (
    .clk_i            (clk),
    .rst_ni           (rst_n),
    .job_valid_i      (job_valid),
    .job_ready_o      (job_ready),
    .job_i            (job),
    .coverage_valid_o (coverage_valid),
    .coverage_ready_i (coverage_ready),
    .coverage_o       (coverage)
  );

  quad_generator u_quad_generator (
    .clk_i            (clk),
    .rst_ni           (rst_n),
    .coverage_valid_i (coverage_valid),
    .coverage_ready_o (coverage_ready),
    .coverage_i       (coverage),
    .beat_valid_o     (dut_valid),
    .beat_ready_i     (dut_ready),
    .beat_o           (dut_beat)
  );

  link_fault #(
    .Width ($bits(quad_beat_t))
  ) u_fault (
    .clk_i   (clk),
    .rst_ni  (rst_n),
    .valid_i (dut_valid),
    .ready_o (dut_ready),
    .data_i  (dut_beat),
    .valid_o (beat_valid),
    .ready_i (beat_ready),
    .data_o  (beat)
  );

  // The stored code of depth 1.
  function automatic logic [CodeBits-1:0] largest_code(logic [FormatBits-1:0] format);
    return format == 1 ? 'hffff : format == 2 ? 'hff_ffff : format == 4 ? 'h3f80_0000 : '0;
  endfunction

  // Vertices around a point of the target; a draw tests depth, or has no depth.
  function automatic triangle_link_t random_triangle();
    triangle_link_t next;
    int x, y, reach;
    bit deep;
    next  = '0;
    deep  = 1'($urandom);
    reach = 1 << $urandom_range(15, 3);
    x     = int'($urandom_range(Size << SubPixelBits));
    y     = int'($urandom_range(Size << SubPixelBits));
    for (int i = 0; i < 3; i++) begin
      next.triangle.x[i] = coord_t'(x - reach + int'($urandom_range(2 * reach)));
      next.triangle.y[i] = coord_t'(y - reach + int'($urandom_range(2 * reach)));
      next.triangle.z[i] = vertex_depth_t'($urandom_range('h3f80_0000));
    end
    next.state.front_positive_area = FlagBits'($urandom);
    next.state.cull_back           = FlagBits'($urandom_range(3) == 0);
    next.state.fill_rule           = FillRuleBits'($urandom);
    next.state.x_last              = PixelBits'(Size - 1 - $urandom_range(40));
    next.state.y_last              = PixelBits'(Size - 1 - $urandom_range(40));
    next.state.format              = FormatBits'(1 << $urandom_range(2)) & {FormatBits{deep}};
    next.state.test                = deep;
    next.state.most_code           = largest_code(next.state.format);
    next.state.func                = FuncBits'($urandom);
    return next;
  endfunction

  int unsigned packets, sent;

  logic [1:0] idle;
  logic       send;
  assign send = (!triangle_valid || triangle_ready) && sent < packets && idle != 0;

  always_ff @(posedge clk) begin
    idle       <= 2'($urandom);
    beat_ready <= 2'($urandom) != 0;
    if (!rst_n) begin
      triangle_valid <= 1'b0;
      sent           <= 0;
    end else begin
      triangle_valid <= send || (triangle_valid && !triangle_ready);
      if (send) begin
        triangle <= random_triangle();
        sent     <= sent + 1;
      end
    end
  end

  scoreboard board;

  always @(posedge clk) begin
    if (rst_n) begin
      if (triangle_valid && triangle_ready) begin
        board.put(LinkTriangle, wire_packet_t'(triangle), $bits(triangle));
      end
      if (set_up_valid && set_up_ready) begin
        board.check(LinkSetupTriangle, wire_packet_t'(set_up), $bits(set_up));
      end
      if (slot_valid) begin
        board.check(LinkSlot, wire_packet_t'(slot), $bits(slot));
      end
      if (block_valid && block_ready) begin
        board.check(LinkBlockJob, wire_packet_t'(block), $bits(block));
      end
      if (job_valid && job_ready) begin
        board.check(LinkTileJob, wire_packet_t'(job), $bits(job));
      end
      if (coverage_valid && coverage_ready) begin
        board.check(LinkCoverage, wire_packet_t'(coverage), $bits(coverage));
      end
      if (beat_valid && beat_ready) begin
        board.check(LinkQuadBeat, wire_packet_t'(beat), $bits(beat));
      end
    end
  end

  initial forever #5 clk = !clk;

  logic moving;
  assign moving = triangle_valid || set_up_valid || block_valid || job_valid || coverage_valid ||
                  beat_valid;

  int unsigned seed, quiet;

  initial begin
    if ($value$plusargs("packets=%d", packets) == 0) packets = 500;
    if ($value$plusargs("seed=%d", seed) == 0) seed = 1;
    void'($urandom(seed));
    board = new();
    board.set($sformatf("block_walker.block_size=%0d", BlockSize));
    board.set($sformatf("tile_walker.tile_size=%0d", TileSize));
    board.set($sformatf("raster.sub_pixel_bits=%0d", SubPixelBits));
    board.set($sformatf("quad_generator.quads_per_cycle=%0d", QuadWidth));
    board.set($sformatf("early_z.quads_per_cycle=%0d", TestWidth));
    board.set($sformatf("z_cache.parts=%0d", ZParts));
    board.watch(LinkSetupTriangle, $bits(setup_link_t));
    board.watch(LinkSlot, $bits(slot_link_t));
    board.watch(LinkBlockJob, $bits(block_job_t));
    board.watch(LinkTileJob, $bits(tile_job_t));
    board.watch(LinkCoverage, $bits(coverage_t));
    board.watch(LinkQuadBeat, $bits(quad_beat_t));

    repeat (4) @(posedge clk);
    @(negedge clk) rst_n = 1'b1;
    // The end: nothing has moved for a while.
    quiet = 0;
    while (sent < packets || quiet < 200) begin
      @(posedge clk);
      quiet = moving ? 0 : quiet + 1;
    end
    if (!board.finish()) begin
      $fatal(1, "the design differs from the model");
    end
    $finish;
  end

endmodule
