// Puts the handshake law on both links of edge_evaluator.

bind edge_evaluator handshake_checker #(
  .Width ($bits(raster_pkg::tile_job_t))
) u_job_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (job_valid_i),
  .ready_i   (job_ready_o),
  .payload_i (job_i)
);

bind edge_evaluator handshake_checker #(
  .Width ($bits(raster_pkg::coverage_t))
) u_coverage_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (coverage_valid_o),
  .ready_i   (coverage_ready_i),
  .payload_i (coverage_o)
);
