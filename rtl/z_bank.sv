// The codes of one quad position of the tile, for every line of the z cache: a memory of one read and one write port.
// A read in the cycle of a write to the same line gives the new codes. With Late, samples are written one by one, and the
// line that was read last is seen as it is written meanwhile, where held_i says that it is the one.

module z_bank
  import raster_pkg::*;
#(
  /// Lines of its part of the cache, 1 or more.
  parameter int unsigned Lines = 128,
  /// 1: for late writes. 0: the bits of write_i are equal, and held_i is 0.
  parameter bit Late = 1'b0,
  localparam int unsigned LineIndexBits = Lines > 1 ? $clog2(Lines) : 1
) (
  input  logic                       clk_i,
  input  logic                       read_i,
  input  logic [LineIndexBits-1:0]   read_line_i,
  output logic [3:0] [CodeBits-1:0]  codes_o,
  input  logic [3:0]                 write_i,
  input  logic                       held_i,
  input  logic [LineIndexBits-1:0]   write_line_i,
  input  logic [3:0] [CodeBits-1:0]  codes_i
);

  // What the memory gives for a line that is written in the same cycle is not used, so synthesis need not care.
  (* no_rw_check *)
  logic [3:0] [CodeBits-1:0] memory_q [Lines];
  logic [3:0] [CodeBits-1:0] codes_q, written_q;

  always_ff @(posedge clk_i) begin
    if (read_i) begin
      codes_q <= memory_q[read_line_i];
    end
  end

  if (Late) begin : gen_samples
    logic [3:0] forward_q;

    for (genvar s = 0; s < 4; s++) begin : gen_sample
      always_ff @(posedge clk_i) begin
        if (write_i[s]) begin
          memory_q[write_line_i][s] <= codes_i[s];
        end
        if (read_i) begin
          forward_q[s] <= write_i[s] && write_line_i == read_line_i;
        end else if (held_i && write_i[s]) begin
          forward_q[s] <= 1'b1;
        end
        if ((read_i || held_i) && write_i[s]) begin
          written_q[s] <= codes_i[s];
        end
      end

      assign codes_o[s] = forward_q[s] ? written_q[s] : codes_q[s];
    end
  end else begin : gen_quad
    logic forward_q;

    always_ff @(posedge clk_i) begin
      if (write_i[0]) begin
        memory_q[write_line_i] <= codes_i;
      end
      if (read_i) begin
        forward_q <= write_i[0] && write_line_i == read_line_i;
      end
      if (read_i && write_i[0]) begin
        written_q <= codes_i;
      end
    end

    assign codes_o = forward_q ? written_q : codes_q;

    logic unused_late;
    assign unused_late = ^{write_i, held_i};
  end

endmodule
