// Puts the handshake law on both links of hi_z.

bind hi_z handshake_checker #(
  .Width ($bits(raster_pkg::block_job_t))
) u_block_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (block_valid_i),
  .ready_i   (block_ready_o),
  .payload_i (block_i)
);

bind hi_z handshake_checker #(
  .Width ($bits(raster_pkg::block_job_t))
) u_left_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (block_valid_o),
  .ready_i   (block_ready_i),
  .payload_i (block_o)
);
