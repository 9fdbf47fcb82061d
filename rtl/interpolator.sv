// The values of an attribute at the four pixels of a quad, helpers included, from those at the vertices: a quad and an
// attribute of four components a cycle.
//
// The weights of the vertices at each pixel (perspective_weights) take Bits / 2 + 13 cycles, in which what the quad brought
// waits in a memory; then each component is v0 + w1 (v1 - v0) + w2 (v2 - v0), rounded, at a covered pixel kept between the
// three. Latency is Bits / 2 + 18 cycles from quad to values. A quad is accepted only with a slot of the output FIFO
// reserved for it, so nothing stalls in mid-pipe.

module interpolator
  import raster_pkg::*;
#(
  /// Bits of the mantissas that are multiplied, and of a weight below the point: even, 8 to 24.
  parameter int unsigned Bits = 24,
  /// Slots of the output FIFO, 2 or more, each as wide as shaded_quad_t. Below Bits / 2 + 19 the unit cannot take a quad in
  /// every cycle.
  parameter int unsigned FifoDepth = Bits / 2 + 19
) (
  input  logic            clk_i,
  input  logic            rst_ni,

  // early_z
  input  logic            quad_valid_i,
  output logic            quad_ready_o,
  input  attribute_quad_t quad_i,

  // fragment shader
  output logic            shaded_valid_o,
  input  logic            shaded_ready_i,
  output shaded_quad_t    shaded_o,

  // Nothing is left to do.
  output logic            idle_o
);

  localparam int unsigned WeightCycles = Bits / 2 + 13;
  localparam int unsigned WeightBits = Bits + 5;
  localparam int unsigned RiseBits = AttributeBits + 1;
  localparam int unsigned SumBits = RiseBits + WeightBits + 1;

  typedef logic signed [WeightBits-1:0] weight_t;
  typedef logic signed [RiseBits-1:0] rise_t;
  typedef logic signed [RiseBits+WeightBits-1:0] product_t;
  typedef logic signed [SumBits-1:0] sum_t;

  logic accepted;
  assign accepted = quad_valid_i & quad_ready_o;

  // What waits for the weights: the mask and the values at the vertices.
  typedef struct packed {
    logic [QuadMaskBits-1:0]       mask;
    attribute_t [VertexValues-1:0] value;
  } waiting_t;

  waiting_t waiting, vertices;
  assign waiting = '{mask: quad_i.mask, value: quad_i.value};

  delay_memory #(
    .Width  ($bits(waiting_t)),
    .Cycles (WeightCycles)
  ) u_waiting (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (accepted),
    .data_i  (waiting),
    .data_o  (vertices)
  );

  // The weights of vertices 1 and 2 at the pixels.
  function automatic edge_t of_pixel(step_t step);
    return edge_t'(step) <<< SubPixelBits;
  endfunction

  logic [QuadPixels-1:0]    weights_valid;
  weight_t [QuadPixels-1:0] weight1, weight2;

  for (genvar p = 0; p < QuadPixels; p++) begin : gen_pixel
    edge_t [1:0] step;
    for (genvar i = 0; i < 2; i++) begin : gen_edge
      assign step[i] = (p % 2 == 1 ? of_pixel(quad_i.a[i]) : '0)
                       + (p / 2 == 1 ? of_pixel(quad_i.b[i]) : '0);
    end

    perspective_weights #(
      .Bits (Bits)
    ) u_weights (
      .clk_i     (clk_i),
      .rst_ni    (rst_ni),
      .valid_i   (accepted),
      .corner_i  (quad_i.e),
      .step_i    (step),
      .area2_i   (quad_i.area2),
      .q_i       (quad_i.q),
      .valid_o   (weights_valid[p]),
      .weight1_o (weight1[p]),
      .weight2_o (weight2[p])
    );
  end

  // 1: rises, which all pixels share. 2: products. 3: their sum with v0, rounded. 4: kept in the range.
  logic [3:0]                    valid_q;
  logic [QuadMaskBits-1:0]       mask1_q, mask2_q, mask3_q;
  weight_t [QuadPixels-1:0]      weight1_q, weight2_q;
  rise_t [Components-1:0]        rise1_q, rise2_q;
  attribute_t [Components-1:0]   v0_1_q, v0_2_q;
  attribute_t [Components-1:0]   least1_q, least2_q, least3_q, most1_q, most2_q, most3_q;
  product_t [QuadValues-1:0]     product1_q, product2_q;
  sum_t [QuadValues-1:0]         sum_q;
  shaded_quad_t                  shaded_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q <= '0;
    end else begin
      valid_q <= {valid_q[2:0], weights_valid[0]};
    end
  end

  function automatic attribute_t lesser(attribute_t a, attribute_t b);
    return b < a ? b : a;
  endfunction
  function automatic attribute_t greater(attribute_t a, attribute_t b);
    return b > a ? b : a;
  endfunction

  always_ff @(posedge clk_i) begin
    if (weights_valid[0]) begin
      for (int unsigned c = 0; c < Components; c++) begin
        automatic attribute_t v0 = vertices.value[c];
        automatic attribute_t v1 = vertices.value[Components+c];
        automatic attribute_t v2 = vertices.value[2*Components+c];
        rise1_q[c]  <= rise_t'(v1) - rise_t'(v0);
        rise2_q[c]  <= rise_t'(v2) - rise_t'(v0);
        v0_1_q[c]   <= v0;
        least1_q[c] <= lesser(lesser(v0, v1), v2);
        most1_q[c]  <= greater(greater(v0, v1), v2);
      end
      weight1_q <= weight1;
      weight2_q <= weight2;
      mask1_q   <= vertices.mask;
    end
    if (valid_q[0]) begin
      for (int unsigned p = 0; p < QuadPixels; p++) begin
        for (int unsigned c = 0; c < Components; c++) begin
          product1_q[p*Components+c] <= product_t'(weight1_q[p]) * product_t'(rise1_q[c]);
          product2_q[p*Components+c] <= product_t'(weight2_q[p]) * product_t'(rise2_q[c]);
        end
      end
      v0_2_q   <= v0_1_q;
      least2_q <= least1_q;
      most2_q  <= most1_q;
      mask2_q  <= mask1_q;
    end
    if (valid_q[1]) begin
      for (int unsigned i = 0; i < QuadValues; i++) begin
        automatic sum_t base = sum_t'(v0_2_q[i%Components]) <<< Bits;
        automatic sum_t half = sum_t'(1) <<< (Bits - 1);
        sum_q[i] <= base + half + sum_t'(product1_q[i]) + sum_t'(product2_q[i]);
      end
      least3_q <= least2_q;
      most3_q  <= most2_q;
      mask3_q  <= mask2_q;
    end
  end

  function automatic attribute_t kept(sum_t sum, logic covered, attribute_t least,
                                      attribute_t most);
    localparam attribute_t Lowest = {1'b1, {(AttributeBits - 1) {1'b0}}};
    attribute_t low, high;
    sum_t       value;
    low   = covered ? least : Lowest;
    high  = covered ? most : ~Lowest;
    value = sum >>> Bits;
    return value < sum_t'(low) ? low : value > sum_t'(high) ? high : attribute_t'(value);
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid_q[2]) begin
      for (int unsigned i = 0; i < QuadValues; i++) begin
        shaded_q.value[i] <= kept(sum_q[i], mask3_q[i/Components], least3_q[i%Components],
                                  most3_q[i%Components]);
      end
      shaded_q.mask <= mask3_q;
    end
  end

  credit_fifo #(
    .Width    ($bits(shaded_quad_t)),
    .Depth    (FifoDepth),
    .InMemory (1'b1)
  ) u_fifo (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .reserve_ready_o (quad_ready_o),
    .reserve_i       (accepted),
    .push_i          (valid_q[3]),
    .data_i          (shaded_q),
    .pop_valid_o     (shaded_valid_o),
    .pop_ready_i     (shaded_ready_i),
    .data_o          (shaded_o),
    .empty_o         (idle_o)
  );

  logic unused_valid;
  assign unused_valid = ^weights_valid[QuadPixels-1:1];

endmodule
