// The plane of a line of depth, and how far its samples are above it.

module z_encode_plane
  import raster_pkg::*;
  import z_codec_pkg::*;
(
  input  logic                    clk_i,

  // Bit i: a line is in register i of z_encoder, 0 at its input.
  input  logic [4:0]              valid_i,
  // The line at the input, in register 1, and of that in register 5 the first sample.
  input  logic                    half_i,
  input  rows_t                   rows_i,
  input  logic                    half1_i,
  input  rows_t                   rows1_i,
  input  logic                    half5_i,
  input  code_t                   first5_i,

  // Behind register 5.
  output logic [MostCodedShift:1] fits_o, // with a shift
  output code_t                   base_o,
  output code_t                   dx_o,
  output code_t                   dy_o,
  output logic [Samples-1:0] [MostPlaneBits-1:0] offset_o
);

  // How far a sample is above the plane through the first one, which is itself a sample: where all offsets from the
  // lowest fit, this is less than 2^MostPlaneBits either way. With its sign inverted, for unsigned comparisons.
  localparam int unsigned AboveBits = MostPlaneBits + 1;
  typedef logic [AboveBits-1:0] above_t;

  localparam int unsigned Levels = $clog2(Samples);
  localparam int unsigned FirstLevels = (Levels + 2) / 3;
  localparam int unsigned SecondLevels = (Levels - FirstLevels + 1) / 2;
  localparam int unsigned First = Samples >> FirstLevels;
  localparam int unsigned Second = First >> SecondLevels;

  // Register 1: the rises.
  code_t dx, dy;
  code_t [TileSize-1:0] rise_x1_q;
  code_t [Height-1:0]   rise_y1_q;

  assign dx = extended(rows_i[TileSize/2] - rows_i[0], half_i);
  assign dy = extended(rows_i[Height/2*TileSize] - rows_i[0], half_i);

  for (genvar x = 0; x < TileSize; x++) begin : gen_x
    always_ff @(posedge clk_i) begin
      if (valid_i[0]) begin
        rise_x1_q[x] <= rise(dx, x, HalfWidthLog2);
      end
    end
  end
  for (genvar y = 0; y < Height; y++) begin : gen_y
    always_ff @(posedge clk_i) begin
      if (valid_i[0]) begin
        rise_y1_q[y] <= rise(dy, y, HalfHeightLog2);
      end
    end
  end

  // Register 2: the samples above the plane, or that one is too far from it.
  above_t [Samples-1:0] above_d;
  logic   [Samples-1:0] far_d, far2_q;
  above_t [Samples-1:0] above_q [2:5];
  logic   [5:3]         far_q;
  code_t                dx_q [2:5], dy_q [2:5];

  for (genvar i = 0; i < Samples; i++) begin : gen_sample
    code_t above;
    assign above = extended(rows1_i[i] - rows1_i[0] - rise_x1_q[i%TileSize]
                                - rise_y1_q[i/TileSize], half1_i);
    assign above_d[i] = {~above[MostPlaneBits], above[MostPlaneBits-1:0]};
    assign far_d[i]   = above[CodeBits-1:MostPlaneBits] != '0
                        && above[CodeBits-1:MostPlaneBits] != '1;
  end

  always_ff @(posedge clk_i) begin
    if (valid_i[1]) begin
      above_q[2] <= above_d;
      far2_q     <= far_d;
      dx_q[2]    <= rise_x1_q[TileSize/2];
      dy_q[2]    <= rise_y1_q[Height/2];
    end
    for (int unsigned i = 2; i < 5; i++) begin
      if (valid_i[i]) begin
        above_q[i+1] <= above_q[i];
        dx_q[i+1]    <= dx_q[i];
        dy_q[i+1]    <= dy_q[i];
      end
    end
    if (valid_i[2]) begin
      far_q[3] <= |far2_q;
    end
    if (valid_i[3]) begin
      far_q[4] <= far_q[3];
    end
    if (valid_i[4]) begin
      far_q[5] <= far_q[4];
    end
  end

  // Registers 3 to 5: the lowest and the highest.
  above_t [First-1:0]  lowest3, highest3;
  above_t [Second-1:0] lowest4, highest4;
  above_t              lowest5, highest5;

  z_extremes_stage #(
    .Width   (AboveBits),
    .Inputs  (Samples),
    .Outputs (First)
  ) u_first (
    .clk_i   (clk_i),
    .valid_i (valid_i[2]),
    .least_i (above_q[2]),
    .most_i  (above_q[2]),
    .least_o (lowest3),
    .most_o  (highest3)
  );
  z_extremes_stage #(
    .Width   (AboveBits),
    .Inputs  (First),
    .Outputs (Second)
  ) u_second (
    .clk_i   (clk_i),
    .valid_i (valid_i[3]),
    .least_i (lowest3),
    .most_i  (highest3),
    .least_o (lowest4),
    .most_o  (highest4)
  );
  z_extremes_stage #(
    .Width   (AboveBits),
    .Inputs  (Second),
    .Outputs (1)
  ) u_third (
    .clk_i   (clk_i),
    .valid_i (valid_i[4]),
    .least_i (lowest4),
    .most_i  (highest4),
    .least_o (lowest5),
    .most_o  (highest5)
  );

  // Behind register 5: offsets from the lowest.
  above_t range;
  assign range  = highest5 - lowest5;
  assign base_o = first5_i + code_t'(signed'({~lowest5[MostPlaneBits],
                                             lowest5[MostPlaneBits-1:0]}));
  assign dx_o   = dx_q[5];
  assign dy_o   = dy_q[5];

  for (genvar i = 0; i < Samples; i++) begin : gen_offset
    assign offset_o[i] = MostPlaneBits'(above_q[5][i] - lowest5);
  end
  for (genvar s = 1; s <= MostCodedShift; s++) begin : gen_fits
    logic [1:0] holds; // by format
    for (genvar h = 0; h < 2; h++) begin : gen_format
      assign holds[h] = is_coded(h, s) && 32'(range) >> plane_bits(h, s) == '0;
    end
    assign fits_o[s] = !far_q[5] && holds[half5_i];
  end

endmodule
