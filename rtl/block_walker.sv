// From a triangle to the blocks that it may touch, each with a mask of its tiles: one block a cycle.
//
// The walk visits the blocks of the bounds in row order, or as Levels and Order say. A step tests all tiles of a block at once, and leaves out those
// all of whose samples are outside one edge. A block that is left with no tile goes nowhere. Whether it is, shows only
// at the end of the step, so every step waits for a slot of the output FIFO, and nothing stalls behind it. The next
// triangle is loaded in the cycle of the last step of this one.

module block_walker
  import raster_pkg::*;
  import sample_pkg::*;
  import walk_pkg::*;
#(
  /// Slots of the output FIFO, 2 or more, each as wide as block_job_t. A block takes two cycles to the FIFO's output, so
  /// that with 2 blocks cannot leave in every cycle.
  parameter int unsigned FifoDepth = 4,
  /// 0: every tile that the bounds touch is in the mask. Saves most of the gates.
  parameter bit TrivialReject = 1'b1,
  /// What a step decides: 1 a tile, 2 the tiles of a block, 3 the blocks of a superblock, then the tiles of each.
  parameter int unsigned Levels = 2,
  /// In which order: walk_pkg.
  parameter int unsigned Order = RasterWalk,
  /// 1: of a triangle that lies in one block and has few samples, only tiles in which one is covered are in the mask.
  parameter bit SampleReject = 1'b0,
  /// 1: the plane of depth is walked with the edges, for hi_z. 0: it is 0.
  parameter bit HiZ = 1'b0
) (
  input  logic                clk_i,
  input  logic                rst_ni,

  // setup: E at the first pixel of the first block of the bounds
  input  logic                triangle_valid_i,
  output logic                triangle_ready_o,
  input  setup_triangle_t     triangle_i,
  input  depth_equation_t     equation_i,
  input  draw_state_t         state_i,

  // What early_z, or hi_z, keeps of each triangle: written in the cycle after it was taken.
  output logic                slot_write_o,
  output logic [SlotBits-1:0] slot_o,
  output depth_equation_t     slot_equation_o,
  output draw_state_t         slot_state_o,

  // tile_walker
  output logic                block_valid_o,
  input  logic                block_ready_i,
  output block_job_t          block_o,

  // What the cycle is spent on; whether nothing is left to do.
  output block_walker_activity_e activity_o,
  output logic                idle_o
);

  localparam int unsigned RowTiles = BlockSize / TileSize;

  if (!(RowTiles inside {2, 4, 8}) || BlockSize != 1 << BlockLog2) begin : gen_illegal_block
    $error("HALFSPACE_BLOCK_SIZE must be 2, 4 or 8 times HALFSPACE_TILE_SIZE, 8 to 64");
  end
  if (Order > HilbertWalk || !(Levels inside {1, 2, 3}) || (Levels == 1 && SampleReject)
      || (!TrivialReject && (Levels == 3 || Order inside {BacktrackingWalk, ZigzagWalk}))
      || (Levels == 3 && Order inside {BacktrackingWalk, ZigzagWalk})) begin : gen_illegal_walk
    $error("Levels and Order: docs/units/block_walker.md says which go together");
  end

  if (!AtCentre && (SampleReject || HiZ)) begin : gen_illegal_samples
    $error("SampleReject and HiZ are for one sample at the centre of a pixel");
  end

  logic load;
  assign load = triangle_valid_i & triangle_ready_o;

  // The walk.
  logic step, row_end, last_block;

  block_job_t            job_d;
  logic [BlockLog2-1:0]  x_first, x_last, y_first, y_last;
  logic [BlockTiles-1:0] touched;
  logic [BlockTiles-1:0] outside [EdgeCount];

  // Of walks that are not block by block in row order.
  localparam int unsigned RowLog2 = BlockLog2 - TileLog2;
  logic [BlockTiles-1:0] in_all; // inside all edges: tiles, or blocks, or samples
  logic                  pass, superblock;
  walk_move_t            move;
  logic [RowLog2-1:0]    tile_x, tile_y;

  if (Levels == 2 && Order == RasterWalk) begin : gen_raster
    block_position u_position (
      .clk_i     (clk_i),
      .load_i    (load),
      .x_first_i (triangle_i.x_first),
      .x_last_i  (triangle_i.x_last),
      .y_first_i (triangle_i.y_first),
      .y_last_i  (triangle_i.y_last),
      .advance_i (step),
      .row_end_o (row_end),
      .last_o    (last_block),
      .block_x_o (job_d.block_x),
      .block_y_o (job_d.block_y),
      .x_first_o (x_first),
      .x_last_o  (x_last),
      .y_first_o (y_first),
      .y_last_o  (y_last),
      .touched_o (touched)
    );
    assign pass       = 1'b0;
    assign superblock = 1'b0;
    assign move       = '0;
    assign tile_x     = '0;
    assign tile_y     = '0;
  end else begin : gen_walk
    // An edge that is negative at all samples of a cell is so on the side to which it falls.
    logic none_left, none_right;
    always_comb begin
      none_left  = 1'b0;
      none_right = 1'b0;
      for (int unsigned i = 0; i < EdgeCount; i++) begin
        none_left  |= (&outside[i]) & ~job_d.a[i][StepBits-1];
        none_right |= (&outside[i]) & (job_d.a[i][StepBits-1] | (job_d.a[i] == '0));
      end
    end

    block_walk #(
      .Levels (Levels),
      .Order  (Order)
    ) u_walk (
      .clk_i        (clk_i),
      .load_i       (load),
      .x_first_i    (triangle_i.x_first),
      .x_last_i     (triangle_i.x_last),
      .y_first_i    (triangle_i.y_first),
      .y_last_i     (triangle_i.y_last),
      .advance_i    (step),
      .none_left_i  (none_left),
      .none_right_i (none_right),
      .in_all_i     (in_all),
      .pass_o       (pass),
      .last_o       (last_block),
      .superblock_o (superblock),
      .move_o       (move),
      .block_x_o    (job_d.block_x),
      .block_y_o    (job_d.block_y),
      .tile_x_o     (tile_x),
      .tile_y_o     (tile_y),
      .x_first_o    (x_first),
      .x_last_o     (x_last),
      .y_first_o    (y_first),
      .y_last_o     (y_last),
      .touched_o    (touched)
    );
    assign row_end = 1'b0;
  end

  // Few samples: the bounds lie in one block, and have no more columns and rows than a block has of tiles.
  typedef logic [PixelBits-1:0] pixel_t;

  function automatic logic is_short(pixel_t first, pixel_t last);
    return first[PixelBits-1:BlockLog2] == last[PixelBits-1:BlockLog2]
           && last - first < pixel_t'(RowTiles);
  endfunction

  logic samples;
  assign samples = SampleReject && is_short(triangle_i.x_first, triangle_i.x_last)
                   && is_short(triangle_i.y_first, triangle_i.y_last);

  for (genvar i = 0; i < EdgeCount; i++) begin : gen_edge
    block_edge #(
      .TrivialReject (TrivialReject),
      .SampleReject  (SampleReject),
      .Levels        (Levels),
      .Order         (Order)
    ) u_edge (
      .clk_i        (clk_i),
      .load_i       (load),
      .edge_i       (triangle_i.e[i]),
      .a_i          (triangle_i.a[i]),
      .b_i          (triangle_i.b[i]),
      .samples_i    (samples),
      .x_i          (triangle_i.x_first[BlockLog2-1:0]),
      .y_i          (triangle_i.y_first[BlockLog2-1:0]),
      .advance_i    (step),
      .row_end_i    (row_end),
      .move_i       (move),
      .tile_x_i     (tile_x),
      .tile_y_i     (tile_y),
      .superblock_i (superblock),
      .edge_o       (job_d.e[i]),
      .a_o          (job_d.a[i]),
      .b_o          (job_d.b[i]),
      .outside_o    (outside[i])
    );
  end

  if (HiZ) begin : gen_plane
    block_plane #(
      .Levels (Levels),
      .Order  (Order)
    ) u_plane (
      .clk_i     (clk_i),
      .load_i    (load),
      .z_i       (triangle_i.z),
      .dx_i      (triangle_i.z_dx),
      .dy_i      (triangle_i.z_dy),
      .known_i   (triangle_i.z_known),
      .advance_i (step),
      .row_end_i (row_end),
      .move_i    (move),
      .z_o       (job_d.z),
      .dx_o      (job_d.z_dx),
      .dy_o      (job_d.z_dy),
      .known_o   (job_d.z_known)
    );
  end else begin : gen_no_plane
    assign job_d.z       = '0;
    assign job_d.z_dx    = '0;
    assign job_d.z_dy    = '0;
    assign job_d.z_known = '0;

    logic unused_plane;
    assign unused_plane = ^{triangle_i.z, triangle_i.z_dx, triangle_i.z_dy, triangle_i.z_known};
  end

  always_comb begin
    in_all = '1;
    for (int unsigned i = 0; i < EdgeCount; i++) begin
      in_all &= ~outside[i];
    end
  end

  assign job_d.sure    = '0;
  assign job_d.x_first = x_first;
  assign job_d.x_last  = x_last;
  assign job_d.y_first = y_first;
  assign job_d.y_last  = y_last;

  if (SampleReject) begin : gen_samples
    logic samples_q;
    always_ff @(posedge clk_i) begin
      if (load) begin
        samples_q <= samples;
      end
    end

    // Of the columns of samples those in each column of tiles, and likewise of rows; in the bounds.
    typedef logic [RowTiles-1:0] row_t;
    typedef logic [BlockLog2:0] place_t; // beyond the block, too

    function automatic row_t samples_of(place_t tile, logic [BlockLog2-1:0] first,
                                        logic [BlockLog2-1:0] last);
      for (int unsigned i = 0; i < RowTiles; i++) begin
        automatic place_t place = place_t'(first) + place_t'(i);
        samples_of[i] = place <= place_t'(last) && place >> TileLog2 == tile;
      end
    endfunction

    for (genvar y = 0; y < RowTiles; y++) begin : gen_row
      row_t rows;
      assign rows = samples_of(place_t'(y), y_first, y_last);
      for (genvar x = 0; x < RowTiles; x++) begin : gen_tile
        row_t columns;
        logic covered;
        assign columns = samples_of(place_t'(x), x_first, x_last);

        always_comb begin
          covered = 1'b0;
          for (int unsigned row = 0; row < RowTiles; row++) begin
            covered |= rows[row] & (|(in_all[row*RowTiles+:RowTiles] & columns));
          end
        end
        assign job_d.tiles[y*RowTiles+x] =
            touched[y*RowTiles+x] & (samples_q ? covered : in_all[y*RowTiles+x]);
      end
    end
  end else begin : gen_tiles
    assign job_d.tiles = touched & in_all;
  end

  // A step waits for a credit, which only a block that leaves uses.
  logic busy_q, idle_q;  // neither in reset
  logic credit, emit, done, fifo_empty;

  assign step = busy_q & credit;
  assign emit = step & ~pass & (|job_d.tiles);
  assign done = step & last_block;

  assign triangle_ready_o = idle_q | done;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      busy_q <= 1'b0;
      idle_q <= 1'b0;
    end else begin
      busy_q <= load | (busy_q & ~done);
      idle_q <= ~load & (~busy_q | done);
    end
  end

  // A triangle that has given out a block keeps its slot; the others leave theirs to the next.
  logic [SlotBits-1:0] slot_q;
  logic                slot_used_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      slot_q      <= '0;
      slot_used_q <= 1'b0;
    end else if (done) begin
      slot_q      <= slot_used_q || emit ? slot_q + SlotBits'(1) : slot_q;
      slot_used_q <= 1'b0;
    end else if (emit) begin
      slot_used_q <= 1'b1;
    end
  end

  assign job_d.slot = slot_q;

  pipe_register #(
    .Width ($bits(depth_equation_t) + $bits(draw_state_t))
  ) u_slot (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (load),
    .data_i  ({equation_i, state_i}),
    .valid_o (slot_write_o),
    .data_o  ({slot_equation_o, slot_state_o})
  );

  assign slot_o = slot_q;

  block_job_t job_q;
  logic       job_valid;

  pipe_register #(
    .Width ($bits(block_job_t))
  ) u_job (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (emit),
    .data_i  (job_d),
    .valid_o (job_valid),
    .data_o  (job_q)
  );

  credit_fifo #(
    .Width ($bits(block_job_t)),
    .Depth (FifoDepth)
  ) u_fifo (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .reserve_ready_o (credit),
    .reserve_i       (emit),
    .push_i          (job_valid),
    .data_i          (job_q),
    .pop_valid_o     (block_valid_o),
    .pop_ready_i     (block_ready_i),
    .data_o          (block_o),
    .empty_o         (fifo_empty)
  );

  assign activity_o = step     ? BlockWalkerBusy
                      : busy_q ? BlockWalkerNoCredit
                      : load   ? BlockWalkerLoad : BlockWalkerNoTriangle;
  assign idle_o     = ~busy_q & fifo_empty;

endmodule
