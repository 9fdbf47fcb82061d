// Puts the handshake law on the links of early_z.

bind early_z handshake_checker #(
  .Width ($bits(raster_pkg::quad_beat_t))
) u_beat_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (beat_valid_i),
  .ready_i   (beat_ready_o),
  .payload_i (beat_i)
);

bind early_z handshake_checker #(
  .Width ($bits(raster_pkg::tested_beat_t))
) u_tested_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (beat_valid_o),
  .ready_i   (beat_ready_i),
  .payload_i (beat_o)
);

bind early_z handshake_checker #(
  .Width (raster_pkg::LineBits + 1 + $bits(z_codec_pkg::coded_shift_t))
) u_read_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (read_valid_o),
  .ready_i   (read_ready_i),
  .payload_i ({read_line_o, read_half_o, read_shift_o})
);

bind early_z handshake_checker #(
  .Width (raster_pkg::LineBits + WriteBits + 2 + $bits(z_codec_pkg::coded_shift_t))
) u_write_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (write_valid_o),
  .ready_i   (write_ready_i),
  .payload_i ({write_line_o, write_half_o, write_shift_o, write_last_o, write_data_o})
);
