// Depth at one pixel of a square of 16 x 16 by the plane in words of fixed point: the word at the square's first pixel
// and multiples of the two steps, rounded to a code of 24 bits and kept in a range. depth_plane and plane_sample of the
// machine do the same for a whole tile, and for all formats.

module depth_word_sample #(
  /// Of a depth below 1: 24 or more.
  parameter int unsigned Bits = 31
) (
  input  logic          clk_i,
  input  logic [Bits:0] origin_i,
  input  logic [Bits:0] dx_i,
  input  logic [Bits:0] dy_i,
  input  logic [3:0]    x_i,
  input  logic [3:0]    y_i,
  input  logic [23:0]   least_i,
  input  logic [23:0]   most_i,
  output logic [23:0]   code_o
);

  localparam int unsigned Below = Bits - 24;

  typedef logic [Bits:0] word_t;

  word_t       origin_q, dx_q, dy_q, word;
  logic [3:0]  x_q, y_q;
  logic [23:0] least_q, most_q;

  always_ff @(posedge clk_i) begin
    origin_q <= origin_i;
    dx_q     <= dx_i;
    dy_q     <= dy_i;
    x_q      <= x_i;
    y_q      <= y_i;
    least_q  <= least_i;
    most_q   <= most_i;
  end

  assign word = origin_q + word_t'(x_q) * dx_q + word_t'(y_q) * dy_q;

  // The sign and a code of 24 bits, halves upwards; half a code has no place where there is nothing below one.
  typedef logic signed [Bits+1:0] sum_t;

  sum_t               sum;
  logic signed [25:0] code;

  if (Below > 0) begin : gen_round
    assign sum  = $signed({word[Bits], word}) + (sum_t'(1) << (Below - 1));
    assign code = sum[Bits+1:Below];
    logic unused_low;
    assign unused_low = ^sum[Below-1:0];
  end else begin : gen_whole
    assign sum  = $signed({word[Bits], word});
    assign code = sum;
  end

  always_ff @(posedge clk_i) begin
    code_o <= code < $signed({2'b0, least_q}) ? least_q
              : code > $signed({2'b0, most_q}) ? most_q : code[23:0];
  end

endmodule
