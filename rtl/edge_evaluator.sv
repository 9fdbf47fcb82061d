// From a tile job to the coverage mask of the tile: one tile a cycle.
//
// A sample is covered when it is in the bounds of the job and, for each edge without its accept bit, the edge value
// there is not negative. Latency is PipeStages + 1 cycles from job to coverage. A job is accepted only with a slot
// of the output FIFO reserved for it, so nothing stalls in mid-pipe.

module edge_evaluator
  import raster_pkg::*;
#(
  /// Registers between job and output FIFO, 1 to 3: after the row and column adders, then also after saturation,
  /// then also after the mask.
  parameter int unsigned PipeStages = 2,
  /// Slots of the output FIFO, 2 or more. Below PipeStages + 2 the unit cannot take a job in every cycle.
  parameter int unsigned FifoDepth = PipeStages + 2
) (
  input  logic      clk_i,
  input  logic      rst_ni,

  // tile_walker
  input  logic      job_valid_i,
  output logic      job_ready_o,
  input  tile_job_t job_i,

  // quad_generator
  output logic      coverage_valid_o,
  input  logic      coverage_ready_i,
  output coverage_t coverage_o,

  // What the cycle is spent on; whether nothing is left to do.
  output edge_evaluator_activity_e activity_o,
  output logic      idle_o
);

  localparam bit CutSaturated = PipeStages >= 2;
  localparam bit CutSteps     = PipeStages >= 1;
  localparam bit CutMask      = PipeStages >= 3;

  // What a tile carries past the adders.
  typedef struct packed {
    logic [SlotBits-1:0]      slot;
    logic                     sure;
    logic [TileColumnBits-1:0] tile_x;
    logic [TileCoordBits-1:0] tile_y;
    edge_t [1:0]              e;
    logic [EdgeCount-1:0]     accept;
    logic [TileLog2-1:0]      x_first;
    logic [TileLog2-1:0]      x_last;
    logic [TileLog2-1:0]      y_first;
    logic [TileLog2-1:0]      y_last;
  } tile_t;

  // Validity and payload of each stage; half_plane keeps the edges in step with them.
  tile_t job_tile, saturated_tile, steps_tile;
  logic  job_accepted, saturated_valid, steps_valid;

  assign job_accepted = job_valid_i & job_ready_o;
  assign job_tile = '{
    slot:     job_i.slot,
    sure:     job_i.sure,
    tile_x:   job_i.tile_x,
    tile_y:   job_i.tile_y,
    e:        job_i.e[2:1],
    accept:   job_i.accept,
    x_first:  job_i.x_first,
    x_last:   job_i.x_last,
    y_first:  job_i.y_first,
    y_last:   job_i.y_last
  };

  pipe_register #(
    .Width ($bits(tile_t)),
    .Cut   (CutSaturated)
  ) u_saturated (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (job_accepted),
    .data_i  (job_tile),
    .valid_o (saturated_valid),
    .data_o  (saturated_tile)
  );

  pipe_register #(
    .Width ($bits(tile_t)),
    .Cut   (CutSteps)
  ) u_steps (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (saturated_valid),
    .data_i  (saturated_tile),
    .valid_o (steps_valid),
    .data_o  (steps_tile)
  );

  logic [MaskBits-1:0] in_edge [EdgeCount];

  for (genvar i = 0; i < EdgeCount; i++) begin : gen_edge
    half_plane #(
      .CutSaturated (CutSaturated),
      .CutSteps     (CutSteps)
    ) u_half_plane (
      .clk_i             (clk_i),
      .saturated_valid_i (job_accepted),
      .steps_valid_i     (saturated_valid),
      .edge_i            (job_i.e[i]),
      .a_i               (job_i.a[i]),
      .b_i               (job_i.b[i]),
      .inside_o          (in_edge[i])
    );
  end

  // Bounds: columns and rows from first to last; TileSize - 1 - last is ~last.
  localparam logic [TileSize-1:0] All = '1;

  logic [TileSize-1:0] columns, rows;
  logic [MaskBits-1:0] in_bounds;
  assign columns = (All << steps_tile.x_first) & (All >> ~steps_tile.x_last);
  assign rows    = (All << steps_tile.y_first) & (All >> ~steps_tile.y_last);

  for (genvar y = 0; y < TileSize; y++) begin : gen_bounds
    assign in_bounds[y*TileSize+:TileSize] = columns & {TileSize{rows[y]}};
  end

  coverage_t coverage_d, coverage_q;
  logic      coverage_valid;

  always_comb begin
    coverage_d.slot     = steps_tile.slot;
    coverage_d.sure     = steps_tile.sure;
    coverage_d.tile_x   = steps_tile.tile_x;
    coverage_d.tile_y   = steps_tile.tile_y;
    coverage_d.e        = steps_tile.e;
    coverage_d.mask     = in_bounds;
    for (int unsigned i = 0; i < EdgeCount; i++) begin
      coverage_d.mask &= in_edge[i] | {MaskBits{steps_tile.accept[i]}};
    end
  end

  pipe_register #(
    .Width ($bits(coverage_t)),
    .Cut   (CutMask)
  ) u_mask (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (steps_valid),
    .data_i  (coverage_d),
    .valid_o (coverage_valid),
    .data_o  (coverage_q)
  );

  credit_fifo #(
    .Width ($bits(coverage_t)),
    .Depth (FifoDepth)
  ) u_fifo (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .reserve_ready_o (job_ready_o),
    .reserve_i       (job_accepted),
    .push_i          (coverage_valid),
    .data_i          (coverage_q),
    .pop_valid_o     (coverage_valid_o),
    .pop_ready_i     (coverage_ready_i),
    .data_o          (coverage_o),
    .empty_o         (idle_o)
  );

  assign activity_o = job_accepted ? EdgeEvaluatorBusy
                      : job_valid_i ? EdgeEvaluatorNoCredit : EdgeEvaluatorNoTile;

endmodule
