// Puts the handshake law on both links of quad_generator.

bind quad_generator handshake_checker #(
  .Width ($bits(raster_pkg::coverage_t))
) u_coverage_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (coverage_valid_i),
  .ready_i   (coverage_ready_o),
  .payload_i (coverage_i)
);

bind quad_generator handshake_checker #(
  .Width ($bits(raster_pkg::quad_beat_t))
) u_beat_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (beat_valid_o),
  .ready_i   (beat_ready_i),
  .payload_i (beat_o)
);
