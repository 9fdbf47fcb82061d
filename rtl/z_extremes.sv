// The least and the greatest code that is stored in each part of a tile behind a burst, for hi_z.
//
// Four registers: the codes of the tile, and three stages of comparisons. A new tile can come in every cycle.
//
// Two more codes count in each part: what a late draw may still write.

module z_extremes
  import raster_pkg::*;
(
  input  logic                                      clk_i,
  input  logic                                      rst_ni,

  // The last beat of a burst is tested: the parts of which anything is to be said, and the tile as it leaves it.
  input  logic                                      valid_i,
  input  logic [ZParts-1:0]                         parts_i,
  input  logic [TileQuads-1:0] [3:0] [CodeBits-1:0] codes_i,
  input  logic [CodeBits-1:0]                       least_i, // all ones: none
  input  logic [CodeBits-1:0]                       most_i,  // 0: none

  // Four cycles later. Parts of which nothing is to be said are 0.
  output logic                                      update_valid_o,
  output hi_z_update_t                              update_o
);

  localparam int unsigned Samples = MaskBits / ZParts;
  localparam int unsigned Levels = $clog2(Samples);
  localparam int unsigned FirstLevels = (Levels + 2) / 3;
  localparam int unsigned SecondLevels = (Levels - FirstLevels + 1) / 2;
  localparam int unsigned First = Samples >> FirstLevels;
  localparam int unsigned Second = First >> SecondLevels;

  // Bit and element i: in register i.
  logic [4:1]              valid_q;
  logic [4:1] [ZParts-1:0] parts_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q <= '0;
    end else begin
      valid_q <= {valid_q[3:1], valid_i};
    end
  end

  always_ff @(posedge clk_i) begin
    parts_q <= {parts_q[3:1], valid_i ? parts_i : '0};
  end

  logic [3:1] [CodeBits-1:0] least_q, most_q;

  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      least_q[1] <= least_i;
      most_q[1]  <= most_i;
    end
    least_q[3:2] <= least_q[2:1];
    most_q[3:2]  <= most_q[2:1];
  end

  assign update_valid_o   = valid_q[4];
  assign update_o.touched = parts_q[4];

  for (genvar p = 0; p < ZParts; p++) begin : gen_part
    logic [Samples-1:0] [CodeBits-1:0] codes_q;
    logic [First-1:0] [CodeBits-1:0]   least1, most1;
    logic [Second-1:0] [CodeBits-1:0]  least2, most2;
    logic [CodeBits-1:0]               least, most;

    always_ff @(posedge clk_i) begin
      if (valid_i && parts_i[p]) begin
        codes_q <= codes_i[p*(Samples/4)+:Samples/4];
      end
    end

    z_extremes_stage #(
      .Inputs  (Samples),
      .Outputs (First)
    ) u_first (
      .clk_i   (clk_i),
      .valid_i (parts_q[1][p]),
      .least_i (codes_q),
      .most_i  (codes_q),
      .least_o (least1),
      .most_o  (most1)
    );

    z_extremes_stage #(
      .Inputs  (First),
      .Outputs (Second)
    ) u_second (
      .clk_i   (clk_i),
      .valid_i (parts_q[2][p]),
      .least_i (least1),
      .most_i  (most1),
      .least_o (least2),
      .most_o  (most2)
    );

    z_extremes_stage #(
      .Inputs  (2 * Second),
      .Outputs (1)
    ) u_third (
      .clk_i   (clk_i),
      .valid_i (parts_q[3][p]),
      .least_i ({{Second{least_q[3]}}, least2}),
      .most_i  ({{Second{most_q[3]}}, most2}),
      .least_o (least),
      .most_o  (most)
    );

    assign update_o.least[p] = parts_q[4][p] ? least : '0;
    assign update_o.most[p]  = parts_q[4][p] ? most : '0;
  end

endmodule
