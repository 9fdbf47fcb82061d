// All arithmetic of the precision study that multiplies or rounds, side by side, for its bench. The floating-point
// units in float32 and in double.

module study_units #(
  parameter int unsigned PlaneBits = 31,
  parameter int unsigned Width = 32
) (
  input  logic                 clk_i,

  input  logic [31:0]          float_a_i,
  input  logic [31:0]          float_b_i,
  output logic [31:0]          float_product_o,
  output logic [31:0]          float_sum_o,
  input  logic [63:0]          double_a_i,
  input  logic [63:0]          double_b_i,
  output logic [63:0]          double_product_o,
  output logic [63:0]          double_sum_o,

  input  logic [24:0]          step_a_i,
  input  logic [24:0]          step_b_i,
  input  logic [42:0]          constant_i,
  input  logic [13:0]          x_i,
  input  logic [13:0]          y_i,
  input  logic                 first_i,
  output logic                 integer_o,
  output logic                 integer_step_o,

  input  logic [31:0]          line_a_i,
  input  logic [31:0]          line_b_i,
  input  logic [31:0]          line_c_i,
  input  logic [31:0]          vertex_x_i,
  input  logic [31:0]          vertex_y_i,
  input  logic [31:0]          centre_x_i,
  input  logic [31:0]          centre_y_i,
  input  logic                 owns_i,
  output logic                 line_o,
  output logic                 vertex_o,
  output logic                 epsilon_o,
  output logic                 line_step_o,
  output logic [31:0]          depth_o,

  input  logic [PlaneBits:0]    z_i,
  input  logic [PlaneBits+22:0] dx_i,
  input  logic [PlaneBits+22:0] dy_i,
  input  logic [24:0]           right_i,
  input  logic [24:0]           down_i,
  input  logic [3:0]            column_i,
  input  logic [3:0]            row_i,
  input  logic [23:0]           least_i,
  input  logic [23:0]           most_i,
  output logic [23:0]           plane_o,

  input  logic [Width-1:0]     e1_i,
  input  logic [Width-1:0]     e2_i,
  input  logic [Width-1:0]     reciprocal_i,
  input  logic [30:0]          z0_i,
  input  logic [31:0]          rise1_i,
  input  logic [31:0]          rise2_i,
  output logic [23:0]          weights_o
);

  fp_mul u_float_mul (.a_i (float_a_i), .b_i (float_b_i), .product_o (float_product_o));
  fp_add u_float_add (.a_i (float_a_i), .b_i (float_b_i), .sum_o (float_sum_o));
  fp_mul #(.ExponentBits (11), .FractionBits (52)) u_double_mul (
    .a_i (double_a_i), .b_i (double_b_i), .product_o (double_product_o)
  );
  fp_add #(.ExponentBits (11), .FractionBits (52)) u_double_add (
    .a_i (double_a_i), .b_i (double_b_i), .sum_o (double_sum_o)
  );

  edge_integer u_integer (
    .clk_i    (clk_i),
    .a_i      (step_a_i),
    .b_i      (step_b_i),
    .c_i      (constant_i),
    .x_i      (x_i),
    .y_i      (y_i),
    .inside_o (integer_o)
  );

  // By steps to the right, from the constants on.
  edge_integer_step u_integer_step (
    .clk_i    (clk_i),
    .first_i  (first_i),
    .a_i      (step_a_i),
    .row_i    (constant_i),
    .inside_o (integer_step_o)
  );
  edge_float_step u_float_step (
    .clk_i    (clk_i),
    .first_i  (first_i),
    .a_i      (line_a_i),
    .row_i    (line_c_i),
    .owns_i   (owns_i),
    .inside_o (line_step_o)
  );

  logic [2:0] found;

  for (genvar i = 0; i < 3; i++) begin : gen_edge
    edge_float #(.FromVertex (i == 1), .HasEpsilon (i == 2)) u_edge (
      .clk_i      (clk_i),
      .a_i        (line_a_i),
      .b_i        (line_b_i),
      .c_i        (line_c_i),
      .vertex_x_i (vertex_x_i),
      .vertex_y_i (vertex_y_i),
      .x_i        (centre_x_i),
      .y_i        (centre_y_i),
      .owns_i     (owns_i),
      .inside_o   (found[i])
    );
  end

  assign {epsilon_o, vertex_o, line_o} = found;

  depth_float u_depth (
    .clk_i      (clk_i),
    .z_i        (line_c_i),
    .dx_i       (line_a_i),
    .dy_i       (line_b_i),
    .vertex_x_i (vertex_x_i),
    .vertex_y_i (vertex_y_i),
    .x_i        (centre_x_i),
    .y_i        (centre_y_i),
    .depth_o    (depth_o)
  );

  logic [PlaneBits:0] origin, dx, dy;

  depth_word_anchor #(.Bits (PlaneBits)) u_anchor (
    .clk_i    (clk_i),
    .z_i      (z_i),
    .dx_i     (dx_i),
    .dy_i     (dy_i),
    .right_i  (right_i),
    .down_i   (down_i),
    .origin_o (origin),
    .dx_o     (dx),
    .dy_o     (dy)
  );
  depth_word_sample #(.Bits (PlaneBits)) u_sample (
    .clk_i    (clk_i),
    .origin_i (origin),
    .dx_i     (dx),
    .dy_i     (dy),
    .x_i      (column_i),
    .y_i      (row_i),
    .least_i  (least_i),
    .most_i   (most_i),
    .code_o   (plane_o)
  );

  depth_weights #(.Width (Width)) u_weights (
    .clk_i        (clk_i),
    .e1_i         (e1_i),
    .e2_i         (e2_i),
    .reciprocal_i (reciprocal_i),
    .z_i          (z0_i),
    .rise1_i      (rise1_i),
    .rise2_i      (rise2_i),
    .least_i      (least_i),
    .most_i       (most_i),
    .code_o       (weights_o)
  );

endmodule
