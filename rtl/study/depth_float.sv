// Depth at one pixel by the plane in floating point: z0 + dx (x - x0) + dy (y - y0). The result is not yet a code.

module depth_float #(
  parameter int unsigned ExponentBits = 8,
  parameter int unsigned FractionBits = 23
) (
  input  logic                               clk_i,
  input  logic [ExponentBits+FractionBits:0] z_i,
  input  logic [ExponentBits+FractionBits:0] dx_i,
  input  logic [ExponentBits+FractionBits:0] dy_i,
  input  logic [ExponentBits+FractionBits:0] vertex_x_i,
  input  logic [ExponentBits+FractionBits:0] vertex_y_i,
  input  logic [ExponentBits+FractionBits:0] x_i,
  input  logic [ExponentBits+FractionBits:0] y_i,
  output logic [ExponentBits+FractionBits:0] depth_o
);

  localparam int unsigned Top = ExponentBits + FractionBits;

  typedef logic [Top:0] number_t;

  number_t z_q, dx_q, dy_q, vertex_x_q, vertex_y_q, x_q, y_q;
  number_t right, down, across, along, first, depth;

  always_ff @(posedge clk_i) begin
    z_q        <= z_i;
    dx_q       <= dx_i;
    dy_q       <= dy_i;
    vertex_x_q <= vertex_x_i;
    vertex_y_q <= vertex_y_i;
    x_q        <= x_i;
    y_q        <= y_i;
    depth_o    <= depth;
  end

  fp_add #(.ExponentBits (ExponentBits), .FractionBits (FractionBits)) u_right (
    .a_i (x_q), .b_i ({~vertex_x_q[Top], vertex_x_q[Top-1:0]}), .sum_o (right)
  );
  fp_add #(.ExponentBits (ExponentBits), .FractionBits (FractionBits)) u_down (
    .a_i (y_q), .b_i ({~vertex_y_q[Top], vertex_y_q[Top-1:0]}), .sum_o (down)
  );
  fp_mul #(.ExponentBits (ExponentBits), .FractionBits (FractionBits)) u_across (
    .a_i (dx_q), .b_i (right), .product_o (across)
  );
  fp_mul #(.ExponentBits (ExponentBits), .FractionBits (FractionBits)) u_along (
    .a_i (dy_q), .b_i (down), .product_o (along)
  );
  fp_add #(.ExponentBits (ExponentBits), .FractionBits (FractionBits)) u_first (
    .a_i (z_q), .b_i (across), .sum_o (first)
  );
  fp_add #(.ExponentBits (ExponentBits), .FractionBits (FractionBits)) u_depth (
    .a_i (first), .b_i (along), .sum_o (depth)
  );

endmodule
