// The codes of one quad position of the tile, for every line of the z cache: a memory of one read and one write port.
// A read in the cycle of a write to the same line gives the new codes.

module z_bank
  import raster_pkg::*;
#(
  /// Lines of its part of the cache, 1 or more.
  parameter int unsigned Lines = 128,
  localparam int unsigned LineIndexBits = Lines > 1 ? $clog2(Lines) : 1
) (
  input  logic                       clk_i,
  input  logic                       read_i,
  input  logic [LineIndexBits-1:0]   read_line_i,
  output logic [3:0] [CodeBits-1:0]  codes_o,
  input  logic                       write_i,
  input  logic [LineIndexBits-1:0]   write_line_i,
  input  logic [3:0] [CodeBits-1:0]  codes_i
);

  // What the memory gives for a line that is written in the same cycle is not used, so synthesis need not care.
  (* no_rw_check *)
  logic [3:0] [CodeBits-1:0] memory_q [Lines];
  logic [3:0] [CodeBits-1:0] codes_q, written_q;
  logic                      forward_q;

  always_ff @(posedge clk_i) begin
    if (write_i) begin
      memory_q[write_line_i] <= codes_i;
    end
    if (read_i) begin
      codes_q <= memory_q[read_line_i];
    end
  end

  always_ff @(posedge clk_i) begin
    if (read_i) begin
      forward_q <= write_i && write_line_i == read_line_i;
    end
    if (read_i && write_i) begin
      written_q <= codes_i;
    end
  end

  assign codes_o = forward_q ? written_q : codes_q;

endmodule
