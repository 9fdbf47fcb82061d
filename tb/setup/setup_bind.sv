// Puts the handshake law on both links of setup.

bind setup handshake_checker #(
  .Width ($bits(raster_pkg::screen_triangle_t) + $bits(raster_pkg::draw_state_t))
) u_in_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (triangle_valid_i),
  .ready_i   (triangle_ready_o),
  .payload_i ({triangle_i, state_i})
);

bind setup handshake_checker #(
  .Width ($bits(raster_pkg::setup_triangle_t) + $bits(raster_pkg::depth_equation_t) +
          $bits(raster_pkg::draw_state_t))
) u_out_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (triangle_valid_o),
  .ready_i   (triangle_ready_i),
  .payload_i ({triangle_o, equation_o, state_o})
);
