// tile_walker: the jobs of a block are its tiles in row order; each has E at its own first sample, its part of the bounds,
// and an accept bit exactly where all of its samples are inside an edge.

module tile_walker_properties
  import raster_pkg::*;
(
  input logic                clk_i,
  input logic                rst_ni,
  input logic                block_valid_i,
  input block_job_t          block_i,
  input logic                job_ready_i,
  input logic [TileLog2-1:0] sample_x_i, // any sample of a tile
  input logic [TileLog2-1:0] sample_y_i
);

  localparam int unsigned Latency = 2;
  localparam int unsigned RowTiles = BlockSize / TileSize;
  localparam int unsigned PlaceBits = $clog2(BlockTiles);

  // Nothing below overflows.
  typedef logic signed [EdgeBits+1:0] wide_t;
  typedef logic [BlockTiles-1:0] tiles_t;

  logic                  block_ready, job_valid, idle;
  tile_job_t             job, popped;
  tile_walker_activity_e activity;

  tile_walker u_dut (
    .clk_i         (clk_i),
    .rst_ni        (rst_ni),
    .block_valid_i (block_valid_i),
    .block_ready_o (block_ready),
    .block_i       (block_i),
    .job_valid_o   (job_valid),
    .job_ready_i   (job_ready_i),
    .job_o         (popped),
    .activity_o    (activity),
    .idle_o        (idle)
  );

  // What is pushed into the FIFO, of which the proof `link` says that it keeps its order.
  assign job = u_dut.job;

  // The first tile that is left.
  tiles_t               tiles, behind;
  logic [PlaceBits-1:0] first;

  assign tiles  = block_i.tiles & u_dut.left_q;
  assign behind = tiles & (tiles - tiles_t'(1));

  always_comb begin
    first = '0;
    for (int unsigned i = BlockTiles; i > 0; i--) begin
      if (tiles[i-1]) first = PlaceBits'(i - 1);
    end
  end

  typedef struct packed {
    block_job_t           block;
    logic [PlaceBits-1:0] tile;
  } picked_t;

  logic [Latency:0]    taken;
  picked_t [Latency:0] picked;

  assign taken[0]  = u_dut.emit;
  assign picked[0] = '{block: block_i, tile: first};

  tiles_t left_d_q;
  logic   was_reset_q;

  always_ff @(posedge clk_i) begin
    taken[Latency:1]  <= rst_ni ? taken[Latency-1:0] : '0;
    picked[Latency:1] <= picked[Latency-1:0];
    left_d_q          <= !rst_ni || (u_dut.emit && behind == '0) ? '1
                         : u_dut.emit ? behind : u_dut.left_q;
    was_reset_q       <= !rst_ni;
  end

  block_job_t b;
  wide_t      x, y; // of the tile in its block, in pixels
  assign b = picked[Latency].block;
  assign x = wide_t'({1'b0, picked[Latency].tile % PlaceBits'(RowTiles)}) * wide_t'(TileSize);
  assign y = wide_t'({1'b0, picked[Latency].tile / PlaceBits'(RowTiles)}) * wide_t'(TileSize);

  function automatic logic [TileLog2-1:0] clamped(logic [BlockLog2-1:0] pixel, wide_t from);
    wide_t place = wide_t'({1'b0, pixel}) - from;
    return place < 0 ? '0 : place > wide_t'(TileSize - 1) ? '1 : place[TileLog2-1:0];
  endfunction

  // proofs/coq/widths.v, edge_fits_closely: E at a sample of the guard band.
  localparam wide_t Close = wide_t'(1) <<< (2 * CoordBits);

  for (genvar i = 0; i < EdgeCount; i++) begin : gen_edge
    wide_t at_tile, least, across, down, falling;
    assign at_tile = wide_t'(b.e[i])
                     + ((wide_t'(b.a[i]) * x + wide_t'(b.b[i]) * y) <<< SubPixelBits);
    assign across  = wide_t'(b.a[i]) < 0 ? wide_t'(b.a[i]) : wide_t'(0);
    assign down    = wide_t'(b.b[i]) < 0 ? wide_t'(b.b[i]) : wide_t'(0);
    assign falling = across + down;
    assign least   = wide_t'(u_dut.gen_edge[i].u_edge.least_q);

    always_comb begin
      EdgeFits: assume (wide_t'(b.e[i]) >= -Close && wide_t'(b.e[i]) < Close);

      if (taken[Latency]) begin
        EdgeAtTile: assert (wide_t'(job.e[i]) == at_tile
                            && job.a[i] == b.a[i] && job.b[i] == b.b[i]);
        CornerIsLeast: assert (least == (falling <<< TileLog2) - falling);
        FollowsAccept: assert (job.accept[i]
                               == ((wide_t'(job.e[i]) >>> SubPixelBits) + least >= 0));
        // The corner is the least sample, along each axis.
        LeastAcross: assert (across * wide_t'(TileSize - 1)
                             <= wide_t'(b.a[i]) * wide_t'({1'b0, sample_x_i}));
        LeastDown: assert (down * wide_t'(TileSize - 1)
                           <= wide_t'(b.b[i]) * wide_t'({1'b0, sample_y_i}));
      end
      Accepted: cover (taken[Latency] && job.accept[i] && b.a[i] < 0 && b.b[i] < 0);
    end
  end

  // block_walker: every block has a tile, and the bounds touch each of its tiles.
  logic [PlaceBits-1:0] column, row;
  assign column = first % PlaceBits'(RowTiles);
  assign row    = first / PlaceBits'(RowTiles);

  always_comb begin
    HasTile: assume (!u_dut.emit || tiles != '0);
    TouchedX: assume (!u_dut.emit || (32'(block_i.x_first) / TileSize <= 32'(column)
                                      && 32'(column) <= 32'(block_i.x_last) / TileSize));
    TouchedY: assume (!u_dut.emit || (32'(block_i.y_first) / TileSize <= 32'(row)
                                      && 32'(row) <= 32'(block_i.y_last) / TileSize));

    RowOrder: assert (!u_dut.emit || (u_dut.pick == (tiles_t'(1) << first)
                                     && u_dut.rest == behind));
    LastTileTakesBlock: assert (!u_dut.emit || block_ready == (behind == '0));
    RestIsLeft: assert (u_dut.left_q == left_d_q);

    ValidAfterLatency: assert (u_dut.placed_valid == taken[Latency]);
    if (taken[Latency]) begin
      Place: assert (32'(job.tile_x) == 32'(b.block_x) * RowTiles + 32'(x) / TileSize
                     && 32'(job.tile_y) == 32'(b.block_y) * RowTiles + 32'(y) / TileSize);
      Bounds: assert (job.x_first == clamped(b.x_first, x) && job.x_last == clamped(b.x_last, x)
                      && job.y_first == clamped(b.y_first, y)
                      && job.y_last == clamped(b.y_last, y));
      Carried: assert (job.slot == b.slot && job.sure == b.sure[picked[Latency].tile]);
    end

    LastTile: cover (taken[Latency] && picked[Latency].tile == PlaceBits'(BlockTiles - 1));
  end

endmodule
