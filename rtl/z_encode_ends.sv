// The least and the greatest code of a line of depth, and how far its samples are from the nearer one.

module z_encode_ends
  import raster_pkg::*;
  import z_codec_pkg::*;
(
  input  logic                    clk_i,

  // Bit i: a line is in register i of z_encoder, 0 at its input.
  input  logic [4:0]              valid_i,
  // The line at the input, in register 3, and the format of that in register 4.
  input  rows_t                   rows_i,
  input  rows_t                   rows3_i,
  input  logic                    half4_i,

  // In register 5.
  output logic [MostCodedShift:1] fits_o,  // with a shift
  output code_t                   least_o,
  output code_t                   most_o,
  output logic [Samples-1:0] [MostEndsBits-1:0] offset_o,
  output logic [Samples-1:0]      high_o   // it is nearer to the greatest
);

  typedef logic [MostEndsBits-1:0] offset_t;

  localparam int unsigned Levels = $clog2(Samples);
  localparam int unsigned FirstLevels = (Levels + 2) / 3;
  localparam int unsigned SecondLevels = (Levels - FirstLevels + 1) / 2;
  localparam int unsigned First = Samples >> FirstLevels;
  localparam int unsigned Second = First >> SecondLevels;

  // Registers 1 to 3: the ends.
  code_t [First-1:0]  least1, most1;
  code_t [Second-1:0] least2, most2;
  code_t              least3, most3, least4_q, most4_q;

  z_extremes_stage #(
    .Inputs  (Samples),
    .Outputs (First)
  ) u_first (
    .clk_i   (clk_i),
    .valid_i (valid_i[0]),
    .least_i (rows_i),
    .most_i  (rows_i),
    .least_o (least1),
    .most_o  (most1)
  );
  z_extremes_stage #(
    .Inputs  (First),
    .Outputs (Second)
  ) u_second (
    .clk_i   (clk_i),
    .valid_i (valid_i[1]),
    .least_i (least1),
    .most_i  (most1),
    .least_o (least2),
    .most_o  (most2)
  );
  z_extremes_stage #(
    .Inputs  (Second),
    .Outputs (1)
  ) u_third (
    .clk_i   (clk_i),
    .valid_i (valid_i[2]),
    .least_i (least2),
    .most_i  (most2),
    .least_o (least3),
    .most_o  (most3)
  );

  // Register 4: how far from each of them, as far as an offset can tell.
  offset_t [Samples-1:0] up_q, down_q;
  logic    [Samples-1:0] near_least_q, near_most_q;

  for (genvar i = 0; i < Samples; i++) begin : gen_distance
    code_t up, down;
    assign up   = rows3_i[i] - least3;
    assign down = most3 - rows3_i[i];

    always_ff @(posedge clk_i) begin
      if (valid_i[3]) begin
        up_q[i]         <= up[MostEndsBits-1:0];
        down_q[i]       <= down[MostEndsBits-1:0];
        near_least_q[i] <= up[CodeBits-1:MostEndsBits] == '0;
        near_most_q[i]  <= down[CodeBits-1:MostEndsBits] == '0;
      end
    end
  end

  always_ff @(posedge clk_i) begin
    if (valid_i[3]) begin
      least4_q <= least3;
      most4_q  <= most3;
    end
    if (valid_i[4]) begin
      least_o <= least4_q;
      most_o  <= most4_q;
    end
  end

  // Register 5: the nearer one.
  logic [MostCodedShift:1] fits_d;

  for (genvar i = 0; i < Samples; i++) begin : gen_nearer
    logic high;
    assign high = near_most_q[i] && (!near_least_q[i] || down_q[i] < up_q[i]);

    always_ff @(posedge clk_i) begin
      if (valid_i[4]) begin
        high_o[i]   <= high;
        offset_o[i] <= high ? down_q[i] : up_q[i];
      end
    end
  end

  for (genvar s = 1; s <= MostCodedShift; s++) begin : gen_fits
    logic [1:0] holds; // by format
    for (genvar h = 0; h < 2; h++) begin : gen_format
      logic [Samples-1:0] held;
      for (genvar i = 0; i < Samples; i++) begin : gen_sample
        assign held[i] = near_least_q[i] && 32'(up_q[i]) >> ends_bits(h, s) == '0
                         || near_most_q[i] && 32'(down_q[i]) >> ends_bits(h, s) == '0;
      end
      assign holds[h] = is_coded(h, s) && held == '1;
    end
    assign fits_d[s] = holds[half4_i];
  end

  always_ff @(posedge clk_i) begin
    if (valid_i[4]) begin
      fits_o <= fits_d;
    end
  end

endmodule
