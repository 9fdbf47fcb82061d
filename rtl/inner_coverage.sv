// Which covered pixels of a beat their triangle fills, as model/halfspace/units/inner_coverage.hpp has it: inner coverage
// of triangles that are drawn by outer squares. Of others, and of those without area, there are none. A beat a cycle; nothing
// stalls.

module inner_coverage
  import raster_pkg::*;
  import depth_pkg::*;
  import square_pkg::*;
#(
  /// Quads of a beat, 1 or more.
  parameter int unsigned Quads = TestWidth,
  /// Cycles to the pixels, 5 or more. Those above are registers at the end.
  parameter int unsigned Latency = 12,
  /// How much larger than the pixel its square is on each side, in sub-pixels.
  parameter int unsigned Uncertainty = 0
) (
  input  logic                                 clk_i,

  /// Without it the pixels mean nothing, and next to nothing toggles.
  input  logic                                 valid_i,
  input  depth_equation_t                      equation_i,
  input  edge_t [1:0]                          e_i,
  input  logic [Quads-1:0] [QuadIndexBits-1:0] index_i,
  input  logic [Quads-1:0] [QuadMaskBits-1:0]  mask_i,

  output logic [Quads-1:0] [QuadMaskBits-1:0]  inner_o
);

  // From E at the corner of a square that is largest to its centre, and on to the corner that is least: the same way.
  function automatic edge_t to_centre(step_t a, step_t b);
    return to_square(span_of(a, b), Outer, Uncertainty);
  endfunction

  // Drawn by squares: no edge has a bias (depth_barycentric). Of a line and of what has no depth 2A is 0, and of a point an
  // edge has no length.
  logic asked;
  assign asked = equation_i.bias == '0 && equation_i.area2 != '0
                 && (equation_i.a[0] != '0 || equation_i.b[0] != '0);

  // 1: how far the squares reach. 2: E at the centres of the first pixels of the quads. 3: at those of all. 4: edge 0 too.
  // 5: which are inner.
  logic                                              asked1_q, asked2_q, asked3_q, asked4_q;
  logic [3:0]                                        valid_q;
  edge_t                                             area1_q, area2_q, area3_q;
  edge_t [2:0]                                       square1_q, square2_q, square3_q, square4_q;
  edge_t [1:0]                                       e_q, a1_q, b1_q, a2_q, b2_q;
  logic [Quads-1:0] [QuadIndexBits-1:0]              index_q;
  edge_t [Quads-1:0] [1:0]                           corner_q;
  edge_t [Quads-1:0] [QuadMaskBits-1:0] [1:0]        two_q;
  edge_t [Quads-1:0] [QuadMaskBits-1:0] [2:0]        three_q;
  logic [Quads-1:0] [QuadMaskBits-1:0]               mask1_q, mask2_q, mask3_q, mask4_q;
  logic [Latency-5:0] [Quads-1:0] [QuadMaskBits-1:0] inner_q;

  always_ff @(posedge clk_i) begin
    valid_q <= {valid_q[2:0], valid_i};
    if (valid_i) begin
      asked1_q     <= asked;
      area1_q      <= equation_i.area2;
      mask1_q      <= mask_i;
      index_q      <= index_i;
      e_q          <= e_i;
      square1_q[0] <= to_centre(-equation_i.a[0] - equation_i.a[1],
                                -equation_i.b[0] - equation_i.b[1]);
      for (int unsigned i = 0; i < 2; i++) begin
        square1_q[i+1] <= to_centre(equation_i.a[i], equation_i.b[i]);
        a1_q[i]        <= of_pixel(equation_i.a[i]);
        b1_q[i]        <= of_pixel(equation_i.b[i]);
      end
    end
    if (valid_q[0]) begin
      asked2_q  <= asked1_q;
      area2_q   <= area1_q;
      mask2_q   <= mask1_q;
      square2_q <= square1_q;
      a2_q      <= a1_q;
      b2_q      <= b1_q;
      for (int unsigned q = 0; q < Quads; q++) begin
        for (int unsigned i = 0; i < 2; i++) begin
          corner_q[q][i] <= at_quad(e_q[i] - square1_q[i+1], a1_q[i], b1_q[i], index_q[q]);
        end
      end
    end
    if (valid_q[1]) begin
      asked3_q  <= asked2_q;
      area3_q   <= area2_q;
      mask3_q   <= mask2_q;
      square3_q <= square2_q;
      for (int unsigned q = 0; q < Quads; q++) begin
        for (int unsigned s = 0; s < QuadMaskBits; s++) begin
          for (int unsigned i = 0; i < 2; i++) begin
            two_q[q][s][i] <= corner_q[q][i] + (s % 2 == 1 ? a2_q[i] : '0)
                              + (s / 2 == 1 ? b2_q[i] : '0);
          end
        end
      end
    end
    if (valid_q[2]) begin
      asked4_q  <= asked3_q;
      mask4_q   <= mask3_q;
      square4_q <= square3_q;
      for (int unsigned q = 0; q < Quads; q++) begin
        for (int unsigned s = 0; s < QuadMaskBits; s++) begin
          three_q[q][s] <= {two_q[q][s], area3_q - two_q[q][s][0] - two_q[q][s][1]};
        end
      end
    end
    for (int unsigned i = 1; i <= Latency - 5; i++) begin
      inner_q[i] <= inner_q[i-1];
    end
    if (valid_q[3]) begin
      for (int unsigned q = 0; q < Quads; q++) begin
        for (int unsigned s = 0; s < QuadMaskBits; s++) begin
          inner_q[0][q][s] <= asked4_q & mask4_q[q][s]
                              & ($signed(three_q[q][s][0]) >= $signed(square4_q[0]))
                              & ($signed(three_q[q][s][1]) >= $signed(square4_q[1]))
                              & ($signed(three_q[q][s][2]) >= $signed(square4_q[2]));
        end
      end
    end
  end

  assign inner_o = inner_q[Latency-5];

  logic unused_equation;
  assign unused_equation = ^equation_i;

endmodule
