// One edge on the walk over blocks: its value at the block, moved by shifted steps, and the tiles of the block that are
// outside it.
//
// E is the same modulo 2^SubPixelBits at all pixel centres, so those bits are kept once for the triangle, and what moves
// is floor(E / 2^SubPixelBits), which a pixel changes by a or b.
//
// An edge function is linear: over the samples of a tile it is largest at a corner, and the signs of a and b say at which.
// What lies between the block's top left sample and that corner of a tile is the same in every block: the sum of a number
// for the tile's row and one for its column. Where samples are not at the centres, the way from a centre to the corner of
// the box of the samples comes to it: E mod 2^SubPixelBits is one number, so that way is a whole number of pixels' E too. So a test is two adders, of which only the sign is used, and the first is
// that of the whole row.
//
// Of a triangle with few samples the same adders test these: rows and columns are those of samples, from the first of the
// bounds on.

module block_edge
  import raster_pkg::*;
  import sample_pkg::*;
  import sample_box_pkg::*;
  import walk_pkg::*;
#(
  /// 0: no tile is found to be outside.
  parameter bit TrivialReject = 1'b1,
  /// 1: samples_i counts.
  parameter bit SampleReject = 1'b0,
  /// What a step decides and in which order. Only levels of 2 in raster order follow row_end_i, the others move_i.
  parameter int unsigned Levels = 2,
  parameter int unsigned Order = RasterWalk,
  localparam int unsigned RowLog2 = BlockLog2 - TileLog2
) (
  input  logic                  clk_i,

  // A triangle, at the first block of its walk.
  input  logic                  load_i,
  input  edge_t                 edge_i,
  input  step_t                 a_i,
  input  step_t                 b_i,
  // Test samples, not tiles: from this one on, as many in rows and columns as the block has tiles.
  input  logic                  samples_i,
  input  logic [BlockLog2-1:0]  x_i,
  input  logic [BlockLog2-1:0]  y_i,

  input  logic                  advance_i, // to the next block, at the end of the cycle
  input  logic                  row_end_i, // the block is the last of its row
  input  walk_move_t            move_i,
  // With one level only this tile is tested, and all of outside_o are it; with three levels blocks of a superblock.
  input  logic [RowLog2-1:0]    tile_x_i,
  input  logic [RowLog2-1:0]    tile_y_i,
  input  logic                  superblock_i,

  output edge_t                 edge_o,    // at the block's top left sample
  output step_t                 a_o,
  output step_t                 b_o,
  output logic [BlockTiles-1:0] outside_o  // tiles all of whose samples are outside, or samples
);

  localparam int unsigned RowTiles = BlockSize / TileSize;

  typedef logic signed [PixelEdgeBits-1:0] pixel_edge_t;

  step_t a_q, b_q;
  logic [SubPixelBits-1:0] sub_pixel_q;

  always_ff @(posedge clk_i) begin
    if (load_i) begin
      a_q         <= a_i;
      b_q         <= b_i;
      sub_pixel_q <= edge_i[SubPixelBits-1:0];
    end
  end

  // The value at the block.
  pixel_edge_t here, loaded;

  assign loaded = edge_i[EdgeBits-1:SubPixelBits];

  if (Levels == 2 && Order == RasterWalk) begin : gen_raster
    // And at the first block of its row.
    pixel_edge_t here_q, row_q;
    pixel_edge_t along, down, next;

    assign along = here_q + (pixel_edge_t'(a_q) <<< BlockLog2);
    assign down  = row_q + (pixel_edge_t'(b_q) <<< BlockLog2);
    assign next  = row_end_i ? down : along;

    always_ff @(posedge clk_i) begin
      if (load_i) begin
        here_q <= loaded;
        row_q  <= loaded;
      end else if (advance_i) begin
        here_q <= next;
        if (row_end_i) begin
          row_q <= next;
        end
      end
    end
    assign here = here_q;

    logic unused_move;
    assign unused_move = ^move_i;
  end else begin : gen_walk
    walk_value #(
      .Width     (PixelEdgeBits),
      .SlopeBits (StepBits),
      .Jumps     (jumps(Levels, Order))
    ) u_value (
      .clk_i     (clk_i),
      .load_i    (load_i),
      .value_i   (loaded),
      .dx_i      (a_q),
      .dy_i      (b_q),
      .advance_i (advance_i),
      .move_i    (move_i),
      .value_o   (here)
    );

    logic unused_row_end;
    assign unused_row_end = row_end_i;
  end

  assign edge_o = {here, sub_pixel_q};
  assign a_o    = a_q;
  assign b_o    = b_q;

  if (TrivialReject || SampleReject) begin : gen_reject
    localparam int unsigned SumBits = StepBits + 1;
    localparam int unsigned AcrossBits = StepBits + BlockLog2;
    localparam int unsigned DownBits = StepBits + BlockLog2 + 2;

    typedef logic signed [SumBits-1:0] sum_t;
    typedef logic signed [AcrossBits-1:0] across_t;
    typedef logic signed [DownBits-1:0] down_t;

    // `count` steps, as a sum of shifted ones.
    function automatic across_t steps(step_t one, logic [BlockLog2-1:0] count);
      steps = '0;
      for (int unsigned i = 0; i < BlockLog2; i++) begin
        if (count[i]) begin
          steps = steps + (across_t'(one) <<< i);
        end
      end
    endfunction

    // To where E is largest in a tile: TileSize - 1 times the sum of the steps that go up.
    function automatic down_t to_largest(step_t a, step_t b);
      sum_t rising = (a[StepBits-1] ? '0 : sum_t'(a)) + (b[StepBits-1] ? '0 : sum_t'(b));
      return (down_t'(rising) <<< TileLog2) - down_t'(rising);
    endfunction

    // From a centre to the corner of the box of the samples where E is largest.
    down_t largest_sample;

    if (AtCentre) begin : gen_centre
      assign largest_sample = '0;
    end else begin : gen_box
      localparam int unsigned WayBits = StepBits + SampleGridLog2 + 1 + SubPixelBits;
      typedef logic signed [WayBits-1:0] way_t;
      to_sample_t to_corner;
      way_t       way;
      assign to_corner = sixteenths(a_i, from_centre(a_i[StepBits-1] ? LeastX : MostX))
                         + sixteenths(b_i, from_centre(b_i[StepBits-1] ? LeastY : MostY));
      assign way = (way_t'(to_corner) <<< (SubPixelBits - SampleGridLog2))
                   + way_t'({1'b0, edge_i[SubPixelBits-1:0]});
      assign largest_sample = down_t'(way >>> SubPixelBits);
    end

    // To a row, and there to the point of its first tile or sample; to a column.
    down_t   down_q   [RowTiles];
    across_t across_q [RowTiles];
    down_t   first_sample;

    assign first_sample = down_t'(steps(a_i, x_i)) + down_t'(steps(b_i, y_i));

    for (genvar i = 0; i < RowTiles; i++) begin : gen_steps
      localparam logic [BlockLog2-1:0] Sample = BlockLog2'(i);
      localparam logic [BlockLog2-1:0] Tile = BlockLog2'(i * TileSize);
      always_ff @(posedge clk_i) begin
        if (load_i) begin
          down_q[i]   <= SampleReject && samples_i
                         ? down_t'(steps(b_i, Sample)) + first_sample
                         : down_t'(steps(b_i, Tile)) + to_largest(a_i, b_i) + largest_sample;
          across_q[i] <= SampleReject && samples_i ? steps(a_i, Sample) : steps(a_i, Tile);
        end
      end
    end

    logic samples_q;
    always_ff @(posedge clk_i) begin
      if (load_i) begin
        samples_q <= samples_i;
      end
    end

    if (Levels == 1) begin : gen_one
      pixel_edge_t largest;
      assign largest   = here + pixel_edge_t'(down_q[tile_y_i]) + pixel_edge_t'(across_q[tile_x_i]);
      assign outside_o = {BlockTiles{largest[PixelEdgeBits-1]}};
    end else begin : gen_all
      // Blocks lie as many times farther apart than tiles as a block has tiles, and are as many times larger.
      pixel_edge_t down [RowTiles];
      pixel_edge_t across [RowTiles];

      if (Levels == 3) begin : gen_superblock
        localparam int unsigned BlocksDownBits = DownBits + RowLog2;
        typedef logic signed [BlocksDownBits-1:0] blocks_down_t;

        blocks_down_t to_largest_block, blocks_down_q [RowTiles];
        sum_t         rising;
        assign rising = (a_i[StepBits-1] ? '0 : sum_t'(a_i)) + (b_i[StepBits-1] ? '0 : sum_t'(b_i));
        assign to_largest_block = (blocks_down_t'(rising) <<< BlockLog2) - blocks_down_t'(rising)
                                  + blocks_down_t'(largest_sample);

        for (genvar i = 0; i < RowTiles; i++) begin : gen_steps
          localparam logic [BlockLog2-1:0] Tile = BlockLog2'(i * TileSize);
          always_ff @(posedge clk_i) begin
            if (load_i) begin
              blocks_down_q[i] <= (blocks_down_t'(steps(b_i, Tile)) <<< RowLog2) + to_largest_block;
            end
          end
          assign down[i]   = superblock_i ? pixel_edge_t'(blocks_down_q[i])
                                          : pixel_edge_t'(down_q[i]);
          assign across[i] = pixel_edge_t'(across_q[i]) <<< (superblock_i ? RowLog2 : 0);
        end
      end else begin : gen_block
        for (genvar i = 0; i < RowTiles; i++) begin : gen_steps
          assign down[i]   = pixel_edge_t'(down_q[i]);
          assign across[i] = pixel_edge_t'(across_q[i]);
        end
      end

      for (genvar y = 0; y < RowTiles; y++) begin : gen_row
        pixel_edge_t first;
        assign first = here + down[y];
        for (genvar x = 0; x < RowTiles; x++) begin : gen_tile
          assign outside_o[y*RowTiles+x] =
              first + across[x] < $signed(PixelEdgeBits'(0)) && (TrivialReject || samples_q);
        end
      end
    end

    if (Levels != 1) begin : gen_no_tile
      logic unused_tile;
      assign unused_tile = ^{tile_x_i, tile_y_i};
    end
    if (Levels != 3) begin : gen_no_superblock
      logic unused_superblock;
      assign unused_superblock = superblock_i;
    end

    if (!SampleReject) begin : gen_unused
      logic unused_samples;
      assign unused_samples = ^{first_sample, samples_q};
    end
  end else begin : gen_no_reject
    assign outside_o = '0;

    logic unused_samples;
    assign unused_samples = ^{samples_i, x_i, y_i, tile_x_i, tile_y_i, superblock_i};
  end

endmodule
