// Puts the handshake law on the links of raster_pipeline, those between its units too.

bind raster_pipeline handshake_checker #(
  .Width ($bits(raster_pkg::screen_triangle_t) + $bits(raster_pkg::draw_state_t))
) u_input_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (triangle_valid_i),
  .ready_i   (triangle_ready_o),
  .payload_i ({triangle_i, state_i})
);

bind raster_pipeline handshake_checker #(
  .Width ($bits(raster_pkg::setup_triangle_t) + $bits(raster_pkg::depth_equation_t)
          + $bits(raster_pkg::draw_state_t))
) u_triangle_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (triangle_valid),
  .ready_i   (triangle_ready),
  .payload_i ({triangle, equation, state})
);

bind raster_pipeline handshake_checker #(
  .Width ($bits(raster_pkg::block_job_t))
) u_walked_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (walked_valid),
  .ready_i   (walked_ready),
  .payload_i (walked_job)
);

bind raster_pipeline handshake_checker #(
  .Width ($bits(raster_pkg::block_job_t))
) u_block_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (block_valid),
  .ready_i   (block_ready),
  .payload_i (block_job)
);

bind raster_pipeline handshake_checker #(
  .Width ($bits(raster_pkg::tile_job_t))
) u_job_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (job_valid),
  .ready_i   (job_ready),
  .payload_i (job)
);

bind raster_pipeline handshake_checker #(
  .Width ($bits(raster_pkg::coverage_t))
) u_coverage_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (coverage_valid),
  .ready_i   (coverage_ready),
  .payload_i (coverage)
);

bind raster_pipeline handshake_checker #(
  .Width ($bits(raster_pkg::quad_beat_t))
) u_beat_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (beat_valid),
  .ready_i   (beat_ready),
  .payload_i (beat)
);

bind raster_pipeline handshake_checker #(
  .Width ($bits(raster_pkg::tested_beat_t))
) u_tested_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (beat_valid_o),
  .ready_i   (beat_ready_i),
  .payload_i (beat_o)
);

bind raster_pipeline handshake_checker #(
  .Width (raster_pkg::LineBits + 1 + $bits(z_codec_pkg::coded_shift_t))
) u_read_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (read_valid_o),
  .ready_i   (read_ready_i),
  .payload_i ({read_line_o, read_half_o, read_shift_o})
);

// Without the data: Verilator 5.006 writes C++ that does not compile when an assertion samples 2048 bits or more. The
// bench of early_z holds it to the law.
bind raster_pipeline handshake_checker #(
  .Width (raster_pkg::LineBits + 2 + $bits(z_codec_pkg::coded_shift_t))
) u_write_law (
  .clk_i     (clk_i),
  .rst_ni    (rst_ni),
  .valid_i   (write_valid_o),
  .ready_i   (write_ready_i),
  .payload_i ({write_line_o, write_half_o, write_shift_o, write_last_o})
);
