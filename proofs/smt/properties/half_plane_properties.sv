// half_plane: after its registers a sample is inside exactly where E is not negative there, over integers, for any E.

module half_plane_properties
  import raster_pkg::*;
(
  input logic  clk_i,
  input logic  rst_ni,
  input edge_t edge_i,
  input step_t a_i,
  input step_t b_i
);

  localparam int unsigned Latency = 2;

  typedef logic signed [EdgeBits+1:0] wide_t; // nothing below overflows

  typedef struct packed {
    edge_t e;
    step_t a;
    step_t b;
  } line_t;

  line_t [Latency:0] line;
  assign line[0] = '{e: edge_i, a: a_i, b: b_i};

  always_ff @(posedge clk_i) begin
    line[Latency:1] <= line[Latency-1:0];
  end

  logic [MaskBits-1:0] in_edge;

  half_plane u_dut (
    .clk_i             (clk_i),
    .saturated_valid_i (rst_ni),
    .steps_valid_i     (rst_ni),
    .edge_i            (edge_i),
    .a_i               (a_i),
    .b_i               (b_i),
    .inside_o          (in_edge)
  );

  wide_t e, a, b, pixel_e, limit, saturated;
  wide_t across [TileSize], down [TileSize];

  assign e       = wide_t'(line[Latency].e);
  assign a       = wide_t'(line[Latency].a);
  assign b       = wide_t'(line[Latency].b);
  assign pixel_e = e >>> SubPixelBits;

  // i times a and b, as the sum of their multiples by the bits of i.
  assign across[0] = '0;
  assign down[0]   = '0;
  for (genvar i = 1; i < TileSize; i++) begin : gen_steps
    localparam int unsigned Bit = $clog2(i + 1) - 1;
    assign across[i] = across[i-(1<<Bit)] + (a <<< Bit);
    assign down[i]   = down[i-(1<<Bit)] + (b <<< Bit);
  end

  // Beyond the limit the sign is that of E wherever in the tile: docs/units/edge_evaluator.md.
  assign limit     = wide_t'(TileSize) <<< StepBits;
  assign saturated = pixel_e < -limit ? -limit : pixel_e >= limit ? limit - 1 : pixel_e;

  for (genvar i = 0; i < TileSize; i++) begin : gen_registers
    always_comb begin
      Row: assert (wide_t'(u_dut.row_q[i]) == saturated + down[i]);
      Column: assert (wide_t'(u_dut.column_q[i]) == across[i]);
    end
  end

  for (genvar y = 0; y < TileSize; y++) begin : gen_row
    for (genvar x = 0; x < TileSize; x++) begin : gen_sample
      wide_t step;
      assign step = across[x] + down[y];
      always_comb begin
        FollowsInside: assert (in_edge[y*TileSize+x] == (e + (step <<< SubPixelBits) >= 0));
      end
    end
  end

  always_comb begin
    Busy: assume (rst_ni);
    Valid: assert (u_dut.signs_valid);

    AboveLimit: cover (pixel_e >= limit);
    BelowLimit: cover (pixel_e < -limit);
    Crossed: cover (in_edge != '0 && in_edge != '1);
  end

endmodule
