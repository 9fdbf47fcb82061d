// The codes of one quad position of the tile, for every line of the z cache: a memory of one read and one write port,
// written by sample. A read in the cycle of a write to the same line gives the new codes.

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
  input  logic [3:0]                 write_i,
  input  logic [LineIndexBits-1:0]   write_line_i,
  input  logic [3:0] [CodeBits-1:0]  codes_i
);

  // What the memory gives for a code that is written in the same cycle is not used, so synthesis need not care.
  (* no_rw_check *)
  logic [3:0] [CodeBits-1:0] memory_q [Lines];
  logic [3:0] [CodeBits-1:0] codes_q, written_q;
  logic [3:0]                forward_q;

  always_ff @(posedge clk_i) begin
    for (int unsigned i = 0; i < 4; i++) begin
      if (write_i[i]) begin
        memory_q[write_line_i][i] <= codes_i[i];
      end
    end
    if (read_i) begin
      codes_q   <= memory_q[read_line_i];
      forward_q <= write_line_i == read_line_i ? write_i : '0;
      written_q <= codes_i;
    end
  end

  for (genvar i = 0; i < 4; i++) begin : gen_forward
    assign codes_o[i] = forward_q[i] ? written_q[i] : codes_q[i];
  end

endmodule
