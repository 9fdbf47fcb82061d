// Puts the handshake law on both links of tile_walker.

bind tile_walker handshake_checker #(
  .Width ($bits(raster_pkg::block_job_t))
) u_block_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (block_valid_i),
  .ready_i   (block_ready_o),
  .payload_i (block_i)
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
