// The golden model beside a design: random tile jobs into an edge evaluator, each coverage checked.
//
// edge_evaluator of rtl/ stands for anybody's design with these ports. Nothing here is of Verilator.
//   +packets=N  tile jobs to send (2000)     +seed=N  of the stimulus (1)
//   +fault=flip|drop|repeat ...   breaks the design's output: see link_fault

module edge_evaluator_tb;
  import raster_pkg::*;
  import halfspace_dpi::*;

  logic clk = 1'b0;
  logic rst_n = 1'b0;

  logic      job_valid, job_ready;
  tile_job_t job;
  logic      dut_valid, dut_ready;
  coverage_t dut_coverage;
  logic      coverage_valid, coverage_ready;
  coverage_t coverage;

  edge_evaluator u_dut (
    .clk_i            (clk),
    .rst_ni           (rst_n),
    .job_valid_i      (job_valid),
    .job_ready_o      (job_ready),
    .job_i            (job),
    .coverage_valid_o (dut_valid),
    .coverage_ready_i (dut_ready),
    .coverage_o       (dut_coverage)
  );

  link_fault #(
    .Width ($bits(coverage_t))
  ) u_fault (
    .clk_i   (clk),
    .rst_ni  (rst_n),
    .valid_i (dut_valid),
    .ready_o (dut_ready),
    .data_i  (dut_coverage),
    .valid_o (coverage_valid),
    .ready_i (coverage_ready),
    .data_o  (coverage)
  );

  // Edges through a pixel of the tile, or just beside it.
  function automatic tile_job_t random_job();
    tile_job_t next;
    next.slot   = SlotBits'($urandom);
    next.tile_x = TileCoordBits'($urandom);
    next.tile_y = TileCoordBits'($urandom);
    next.sure   = 1'($urandom);
    next.accept = $urandom_range(3) == 0 ? EdgeCount'($urandom) : '0;
    for (int i = 0; i < 3; i++) begin
      edge_t at_pixel;
      next.a[i] = step_t'($urandom) >>> $urandom_range(StepBits - 1);
      next.b[i] = step_t'($urandom) >>> $urandom_range(StepBits - 1);
      at_pixel = edge_t'(next.a[i]) * edge_t'($urandom_range(TileSize - 1)) +
                 edge_t'(next.b[i]) * edge_t'($urandom_range(TileSize - 1));
      next.e[i] = -(at_pixel <<< SubPixelBits) + edge_t'($urandom_range(512)) - edge_t'(256);
    end
    next.x_first = $urandom_range(1) == 0 ? '0 : TileLog2'($urandom);
    next.x_last  = $urandom_range(1) == 0 ? '1 : TileLog2'($urandom);
    next.y_first = $urandom_range(1) == 0 ? '0 : TileLog2'($urandom);
    next.y_last  = $urandom_range(1) == 0 ? '1 : TileLog2'($urandom);
    return next;
  endfunction

  int unsigned packets, sent;

  logic [1:0] idle;
  logic       send;
  assign send = (!job_valid || job_ready) && sent < packets && idle != 0;

  always_ff @(posedge clk) begin
    idle           <= 2'($urandom);
    coverage_ready <= 2'($urandom) != 0;
    if (!rst_n) begin
      job_valid <= 1'b0;
      sent      <= 0;
    end else begin
      job_valid <= send || (job_valid && !job_ready);
      if (send) begin
        job  <= random_job();
        sent <= sent + 1;
      end
    end
  end

  scoreboard board;

  // In one process, so that what goes in is put before what comes out is checked.
  always @(posedge clk) begin
    if (rst_n) begin
      if (job_valid && job_ready) begin
        board.put(LinkTileJob, wire_packet_t'(job), $bits(job));
      end
      if (coverage_valid && coverage_ready) begin
        board.check(LinkCoverage, wire_packet_t'(coverage), $bits(coverage));
      end
    end
  end

  initial forever #5 clk = !clk;

  int unsigned seed;

  initial begin
    if ($value$plusargs("packets=%d", packets) == 0) packets = 2000;
    if ($value$plusargs("seed=%d", seed) == 0) seed = 1;
    void'($urandom(seed));
    board = new();
    board.set($sformatf("tile_walker.tile_size=%0d", TileSize));
    board.set($sformatf("raster.sub_pixel_bits=%0d", SubPixelBits));
    board.watch(LinkCoverage, $bits(coverage_t));

    repeat (4) @(posedge clk);
    @(negedge clk) rst_n = 1'b1;
    while (sent < packets) @(posedge clk);
    repeat (100) @(posedge clk);
    if (!board.finish()) begin
      $fatal(1, "the design differs from the model");
    end
    $finish;
  end

endmodule
