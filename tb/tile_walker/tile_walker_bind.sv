// Puts the handshake law on both links of tile_walker.

bind tile_walker handshake_checker #(
  .Width ($bits(raster_pkg::setup_triangle_t) + $bits(raster_pkg::depth_equation_t)
          + $bits(raster_pkg::draw_state_t))
) u_triangle_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (triangle_valid_i),
  .ready_i   (triangle_ready_o),
  .payload_i ({triangle_i, equation_i, state_i})
);

bind tile_walker handshake_checker #(
  .Width ($bits(raster_pkg::tile_job_t))
) u_job_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (job_valid_o),
  .ready_i   (job_ready_i),
  .payload_i (job_o)
);
