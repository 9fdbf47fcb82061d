// What depth_word_sample needs once for a square of pixels: the word at its first pixel by two products, and the
// steps for a pixel.

module depth_word_anchor #(
  parameter int unsigned Bits = 31
) (
  input  logic               clk_i,
  input  logic [Bits:0]      z_i,
  input  logic [Bits+22:0]   dx_i,  // 22 bits below the word
  input  logic [Bits+22:0]   dy_i,
  input  logic signed [24:0] right_i,  // from vertex 0, in 1/256 pixel
  input  logic signed [24:0] down_i,
  output logic [Bits:0]      origin_o,
  output logic [Bits:0]      dx_o,
  output logic [Bits:0]      dy_o
);

  localparam int unsigned Fraction = 22;
  localparam int unsigned SubPixelBits = 8;

  typedef logic [Bits:0] word_t;
  typedef logic [Bits+Fraction:0] gradient_t;

  word_t              z_q;
  gradient_t          dx_q, dy_q, anchor;
  logic signed [24:0] right_q, down_q;

  always_ff @(posedge clk_i) begin
    z_q     <= z_i;
    dx_q    <= dx_i;
    dy_q    <= dy_i;
    right_q <= right_i;
    down_q  <= down_i;
  end

  assign anchor = {z_q, {Fraction{1'b0}}} + dx_q * gradient_t'(right_q)
                  + dy_q * gradient_t'(down_q);

  function automatic word_t step(gradient_t gradient);
    return word_t'(gradient >> (Fraction - SubPixelBits))
           + word_t'(gradient[Fraction-SubPixelBits-1]);
  endfunction

  always_ff @(posedge clk_i) begin
    origin_o <= word_t'(anchor >> Fraction) + word_t'(anchor[Fraction-1]);
    dx_o     <= step(dx_q);
    dy_o     <= step(dy_q);
  end

endmodule
