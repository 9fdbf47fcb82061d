// Puts the handshake law on both links of block_walker.

bind block_walker handshake_checker #(
  .Width ($bits(raster_pkg::setup_triangle_t) + $bits(raster_pkg::depth_equation_t)
          + $bits(raster_pkg::draw_state_t))
) u_triangle_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (triangle_valid_i),
  .ready_i   (triangle_ready_o),
  .payload_i ({triangle_i, equation_i, state_i})
);

bind block_walker handshake_checker #(
  .Width ($bits(raster_pkg::block_job_t))
) u_block_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (block_valid_o),
  .ready_i   (block_ready_i),
  .payload_i (block_o)
);
