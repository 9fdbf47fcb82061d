// Depth at one pixel of a unorm24 surface by barycentric weights and a reciprocal of the area; barycentric_sample of
// the machine does the same with 32 bits, and for all formats.

module depth_weights #(
  /// Of the scaled edge values and of the reciprocal.
  parameter int unsigned Width = 32
) (
  input  logic               clk_i,
  input  logic [Width-1:0]   e1_i,
  input  logic [Width-1:0]   e2_i,
  input  logic [Width-1:0]   reciprocal_i,
  input  logic [30:0]        z_i,  // of vertex 0: a code and 7 bits below
  input  logic signed [31:0] rise1_i,
  input  logic signed [31:0] rise2_i,
  input  logic [23:0]        least_i,
  input  logic [23:0]        most_i,
  output logic [23:0]        code_o
);

  localparam int unsigned WeightBits = Width - 2;
  localparam int unsigned Below = 7;
  localparam int unsigned SumBits = WeightBits + 34;

  typedef logic signed [SumBits-1:0] sum_t;

  logic [Width-1:0]   e1_q, e2_q, reciprocal_q;
  logic [30:0]        z_q;
  logic signed [31:0] rise1_q, rise2_q;
  logic [23:0]        least_q, most_q;

  always_ff @(posedge clk_i) begin
    e1_q         <= e1_i;
    e2_q         <= e2_i;
    reciprocal_q <= reciprocal_i;
    z_q          <= z_i;
    rise1_q      <= rise1_i;
    rise2_q      <= rise2_i;
    least_q      <= least_i;
    most_q       <= most_i;
  end

  // Below 2, so the product of the two has a bit less than it could have.
  logic [2*Width-1:0]        product1, product2;
  logic signed [Width-1:0]   weight1, weight2;
  sum_t                      sum;
  logic signed [25:0]        code;

  assign product1 = (2 * Width)'(e1_q) * (2 * Width)'(reciprocal_q);
  assign product2 = (2 * Width)'(e2_q) * (2 * Width)'(reciprocal_q);
  assign weight1  = {1'b0, product1[2*Width-1-:Width-1]};
  assign weight2  = {1'b0, product2[2*Width-1-:Width-1]};
  assign sum = sum_t'({3'b0, z_q, {WeightBits{1'b0}}}) + sum_t'(weight1) * sum_t'(rise1_q)
               + sum_t'(weight2) * sum_t'(rise2_q) + sum_t'(128'sd1 << (WeightBits + Below - 1));
  assign code = sum[WeightBits+Below+:26];

  always_ff @(posedge clk_i) begin
    code_o <= code < $signed({2'b0, least_q}) ? least_q
              : code > $signed({2'b0, most_q}) ? most_q : code[23:0];
  end

  logic unused_low;
  assign unused_low = ^{product1[Width:0], product2[Width:0], sum[SumBits-1],
                        sum[WeightBits+Below-1:0]};

endmodule
