// From a block to its tiles: one tile job a cycle, in row order or another. With several samples a pixel a tile leaves
// once for each, in their order, before the next.
//
// The block stays at the head of block_walker's FIFO until its last tile is made; here is only a register of the tiles
// that are left. A job takes three cycles: the tile is picked; the edges move to it; the test for accept bits, and the
// FIFO. It is made only with a slot of the output FIFO reserved for it, so nothing stalls in mid-pipe.

module tile_walker
  import raster_pkg::*;
  import sample_pkg::*;
#(
  /// Slots of the output FIFO, 2 or more, each as wide as tile_job_t. With 2 or 3 jobs cannot leave in every cycle.
  parameter int unsigned FifoDepth = 16,
  /// 0: no accept bits.
  parameter bit TrivialAccept = 1'b1,
  /// In which order tiles leave: walk_pkg.
  parameter int unsigned Order = walk_pkg::RasterTiles
) (
  input  logic       clk_i,
  input  logic       rst_ni,

  // block_walker. Whether a block is taken follows from its mask, and not from block_valid_i.
  input  logic       block_valid_i,
  output logic       block_ready_o,
  input  block_job_t block_i,

  // edge_evaluator
  output logic       job_valid_o,
  input  logic       job_ready_i,
  output tile_job_t  job_o,

  // What the cycle is spent on; whether nothing is left to do.
  output tile_walker_activity_e activity_o,
  output logic       idle_o
);

  localparam int unsigned RowTiles = BlockSize / TileSize;
  localparam int unsigned RowBits = BlockLog2 - TileLog2;

  typedef logic [BlockTiles-1:0] tiles_t;
  typedef logic [RowBits-1:0] place_t;

  if (!(RowTiles inside {2, 4, 8}) || BlockSize != 1 << BlockLog2) begin : gen_illegal_block
    $error("HALFSPACE_BLOCK_SIZE must be 2, 4 or 8 times HALFSPACE_TILE_SIZE, 8 to 64");
  end

  // Tiles that the jobs of this block have not passed: all of them before the first job.
  tiles_t left_q, tiles, rest, pick;
  logic   credit, emit;

  assign tiles = block_i.tiles & left_q;

  ordered_pick #(
    .Side  (RowTiles),
    .Order (Order)
  ) u_pick (
    .set_i  (tiles),
    .pick_o (pick),
    .rest_o (rest)
  );

  // Which sample of the picked tile.
  sample_t sample;
  logic    last_sample;

  if (PixelSamples == 1) begin : gen_one_sample
    assign sample      = '0;
    assign last_sample = 1'b1;
  end else begin : gen_samples
    sample_t sample_q;
    always_ff @(posedge clk_i) begin
      if (!rst_ni) begin
        sample_q <= '0;
      end else if (emit) begin
        sample_q <= sample_q + sample_t'(1);
      end
    end
    assign sample      = sample_q;
    assign last_sample = &sample_q;
  end

  assign emit  = block_valid_i & credit;

  assign block_ready_o = credit & (rest == '0) & last_sample;

  // Only hi_z looks at depth.
  logic unused_plane;
  assign unused_plane = ^{block_i.z, block_i.z_dx, block_i.z_dy, block_i.z_known};

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      left_q <= '1;
    end else if (emit && last_sample) begin
      left_q <= rest == '0 ? '1 : rest;
    end
  end

  // Bit b of the place in the block, of all tiles: of the row, or of the column.
  function automatic tiles_t place_bit(int unsigned b, bit row);
    tiles_t bits;
    for (int unsigned i = 0; i < BlockTiles; i++) begin
      bits[i] = (((row ? i / RowTiles : i % RowTiles) >> b) & 1) == 1;
    end
    return bits;
  endfunction

  place_t tile_x_d, tile_y_d;

  for (genvar b = 0; b < RowBits; b++) begin : gen_place
    localparam tiles_t ColumnBit = place_bit(b, 1'b0);
    localparam tiles_t RowBit = place_bit(b, 1'b1);
    assign tile_x_d[b] = |(pick & ColumnBit);
    assign tile_y_d[b] = |(pick & RowBit);
  end

  // First register; tile_edge keeps the edges in step with both.
  typedef struct packed {
    logic [SlotBits-1:0]       slot;
    logic                      sure;
    logic [BlockCoordBits-1:0] block_x;
    logic [BlockCoordBits-1:0] block_y;
    logic [BlockLog2-1:0]      x_first;
    logic [BlockLog2-1:0]      x_last;
    logic [BlockLog2-1:0]      y_first;
    logic [BlockLog2-1:0]      y_last;
    place_t                    tile_x;
    place_t                    tile_y;
    sample_t                   sample;
  } picked_t;

  picked_t picked_d, picked;
  logic    picked_valid;

  assign picked_d = '{
    slot:    block_i.slot,
    sure:    |(block_i.sure & pick),
    block_x: block_i.block_x,
    block_y: block_i.block_y,
    x_first: block_i.x_first,
    x_last:  block_i.x_last,
    y_first: block_i.y_first,
    y_last:  block_i.y_last,
    tile_x:  tile_x_d,
    tile_y:  tile_y_d,
    sample:  sample
  };

  pipe_register #(
    .Width ($bits(picked_t))
  ) u_picked (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (emit),
    .data_i  (picked_d),
    .valid_o (picked_valid),
    .data_o  (picked)
  );

  // The tiles of all samples lie side by side.
  typedef logic [TileColumnBits-1:0] tile_column_t;

  function automatic tile_column_t tile_column(logic [BlockCoordBits-1:0] block_x, place_t tile_x,
                                               sample_t number);
    tile_column_t first = tile_column_t'({block_x, tile_x}) << SampleLog2;
    return first | tile_column_t'(number);
  endfunction

  // Second register. The bounds cut a tile only where they begin or end.
  typedef struct packed {
    logic [SlotBits-1:0]      slot;
    logic                     sure;
    tile_column_t             tile_x;
    logic [TileCoordBits-1:0] tile_y;
    logic [TileLog2-1:0]      x_first;
    logic [TileLog2-1:0]      x_last;
    logic [TileLog2-1:0]      y_first;
    logic [TileLog2-1:0]      y_last;
  } placed_t;

  // A pixel of the block.
  typedef struct packed {
    place_t              tile;
    logic [TileLog2-1:0] pixel; // in the tile
  } in_tile_t;

  in_tile_t x_first, x_last, y_first, y_last;
  placed_t  placed_d, placed;
  logic     placed_valid;

  assign x_first = picked.x_first;
  assign x_last  = picked.x_last;
  assign y_first = picked.y_first;
  assign y_last  = picked.y_last;

  assign placed_d = '{
    slot:    picked.slot,
    sure:    picked.sure,
    tile_x:  tile_column(picked.block_x, picked.tile_x, picked.sample),
    tile_y:  {picked.block_y, picked.tile_y},
    x_first: picked.tile_x == x_first.tile ? x_first.pixel : '0,
    x_last:  picked.tile_x == x_last.tile ? x_last.pixel : '1,
    y_first: picked.tile_y == y_first.tile ? y_first.pixel : '0,
    y_last:  picked.tile_y == y_last.tile ? y_last.pixel : '1
  };

  pipe_register #(
    .Width ($bits(placed_t))
  ) u_placed (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (picked_valid),
    .data_i  (placed_d),
    .valid_o (placed_valid),
    .data_o  (placed)
  );

  tile_job_t job;

  for (genvar i = 0; i < EdgeCount; i++) begin : gen_edge
    tile_edge #(
      .TrivialAccept (TrivialAccept)
    ) u_edge (
      .clk_i          (clk_i),
      .picked_valid_i (emit),
      .edge_i         (block_i.e[i]),
      .a_i            (block_i.a[i]),
      .b_i            (block_i.b[i]),
      .sample_i       (sample),
      .placed_valid_i (picked_valid),
      .tile_x_i       (picked.tile_x),
      .tile_y_i       (picked.tile_y),
      .edge_o         (job.e[i]),
      .a_o            (job.a[i]),
      .b_o            (job.b[i]),
      .accept_o       (job.accept[i])
    );
  end

  assign job.slot    = placed.slot;
  assign job.sure    = placed.sure;
  assign job.tile_x  = placed.tile_x;
  assign job.tile_y  = placed.tile_y;
  assign job.x_first = placed.x_first;
  assign job.x_last  = placed.x_last;
  assign job.y_first = placed.y_first;
  assign job.y_last  = placed.y_last;

  credit_fifo #(
    .Width ($bits(tile_job_t)),
    .Depth (FifoDepth)
  ) u_fifo (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .reserve_ready_o (credit),
    .reserve_i       (emit),
    .push_i          (placed_valid),
    .data_i          (job),
    .pop_valid_o     (job_valid_o),
    .pop_ready_i     (job_ready_i),
    .data_o          (job_o),
    .empty_o         (idle_o)
  );

  assign activity_o = emit            ? TileWalkerBusy
                      : block_valid_i ? TileWalkerNoCredit : TileWalkerNoBlock;

`ifndef SYNTHESIS
  BlockHasTiles: assert property (@(posedge clk_i) disable iff (!rst_ni)
      block_valid_i |-> tiles != '0)
  else $error("a block without a tile");
`endif

endmodule
