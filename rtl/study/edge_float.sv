// One edge at one pixel centre in floating point: A x + B y + C, or A (x - x0) + B (y - y0). The centre comes in as
// floating-point numbers; the tie rule comes in as a bit.

module edge_float #(
  parameter int unsigned ExponentBits = 8,
  parameter int unsigned FractionBits = 23,
  /// 1: relative to a vertex.
  parameter bit FromVertex = 1'b0,
  /// 1: all whose magnitude is at most this one count as ties.
  parameter bit HasEpsilon = 1'b0,
  parameter logic [ExponentBits+FractionBits:0] Epsilon = 'h3A83126F  // 0.001 in float32
) (
  input  logic                               clk_i,
  input  logic [ExponentBits+FractionBits:0] a_i,
  input  logic [ExponentBits+FractionBits:0] b_i,
  input  logic [ExponentBits+FractionBits:0] c_i,        // not with FromVertex
  input  logic [ExponentBits+FractionBits:0] vertex_x_i, // only with FromVertex
  input  logic [ExponentBits+FractionBits:0] vertex_y_i,
  input  logic [ExponentBits+FractionBits:0] x_i,
  input  logic [ExponentBits+FractionBits:0] y_i,
  input  logic                               owns_i,
  output logic                               inside_o
);

  localparam int unsigned Top = ExponentBits + FractionBits;

  typedef logic [Top:0] number_t;

  number_t a_q, b_q, x_q, y_q;
  logic    owns_q;

  always_ff @(posedge clk_i) begin
    a_q    <= a_i;
    b_q    <= b_i;
    x_q    <= x_i;
    y_q    <= y_i;
    owns_q <= owns_i;
  end

  number_t x, y, across, down, both, value;

  if (FromVertex) begin : gen_vertex
    number_t vertex_x_q, vertex_y_q;
    always_ff @(posedge clk_i) begin
      vertex_x_q <= vertex_x_i;
      vertex_y_q <= vertex_y_i;
    end
    fp_add #(.ExponentBits (ExponentBits), .FractionBits (FractionBits)) u_x (
      .a_i (x_q), .b_i ({~vertex_x_q[Top], vertex_x_q[Top-1:0]}), .sum_o (x)
    );
    fp_add #(.ExponentBits (ExponentBits), .FractionBits (FractionBits)) u_y (
      .a_i (y_q), .b_i ({~vertex_y_q[Top], vertex_y_q[Top-1:0]}), .sum_o (y)
    );
    assign value = both;
    logic unused_c;
    assign unused_c = ^c_i;
  end else begin : gen_constant
    number_t c_q;
    always_ff @(posedge clk_i) begin
      c_q <= c_i;
    end
    assign x = x_q;
    assign y = y_q;
    fp_add #(.ExponentBits (ExponentBits), .FractionBits (FractionBits)) u_value (
      .a_i (both), .b_i (c_q), .sum_o (value)
    );
    logic unused_vertex;
    assign unused_vertex = ^{vertex_x_i, vertex_y_i};
  end

  fp_mul #(.ExponentBits (ExponentBits), .FractionBits (FractionBits)) u_across (
    .a_i (a_q), .b_i (x), .product_o (across)
  );
  fp_mul #(.ExponentBits (ExponentBits), .FractionBits (FractionBits)) u_down (
    .a_i (b_q), .b_i (y), .product_o (down)
  );
  fp_add #(.ExponentBits (ExponentBits), .FractionBits (FractionBits)) u_both (
    .a_i (across), .b_i (down), .sum_o (both)
  );

  logic tie;
  assign tie = HasEpsilon ? value[Top-1:0] <= Epsilon[Top-1:0] : value[Top-1:0] == '0;

  always_ff @(posedge clk_i) begin
    inside_o <= tie ? owns_q : !value[Top];
  end

endmodule
