// Puts the handshake law on both links of interpolator.

bind interpolator handshake_checker #(
  .Width ($bits(raster_pkg::attribute_quad_t))
) u_quad_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (quad_valid_i),
  .ready_i   (quad_ready_o),
  .payload_i (quad_i)
);

bind interpolator handshake_checker #(
  .Width ($bits(raster_pkg::shaded_quad_t))
) u_shaded_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (shaded_valid_o),
  .ready_i   (shaded_ready_i),
  .payload_i (shaded_o)
);
