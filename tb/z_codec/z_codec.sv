// z_encoder and z_decoder beside each other, as the bench has them.

module z_codec
  import raster_pkg::*;
  import z_codec_pkg::*;
(
  input  logic         clk_i,
  input  logic         rst_ni,

  input  logic         line_valid_i,
  input  logic         line_half_i,
  input  quads_t       line_codes_i,
  output logic         coded_valid_o,
  output coded_shift_t coded_shift_o,
  output data_t        coded_data_o,

  input  logic         coded_valid_i,
  input  logic         coded_half_i,
  input  coded_shift_t coded_shift_i,
  input  data_t        coded_data_i,
  output logic         line_valid_o,
  output quads_t       line_codes_o
);

  z_encoder u_encoder (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (line_valid_i),
    .half_i  (line_half_i),
    .codes_i (line_codes_i),
    .valid_o (coded_valid_o),
    .shift_o (coded_shift_o),
    .data_o  (coded_data_o)
  );

  z_decoder u_decoder (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (coded_valid_i),
    .half_i  (coded_half_i),
    .shift_i (coded_shift_i),
    .data_i  (coded_data_i),
    .valid_o (line_valid_o),
    .codes_o (line_codes_o)
  );

endmodule
