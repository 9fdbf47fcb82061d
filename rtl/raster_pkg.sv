// Widths and packets of the links between the units, for every configuration.
//
// Printed by the target print_raster_pkg from model/halfspace/numerics/widths.hpp, model/halfspace/units/packets.hpp,
// model/halfspace/units/link_packets.hpp, model/halfspace/units/z_codec.hpp, model/halfspace/machine/shape.hpp and
// model/halfspace/timing/contract.hpp: change those and print this file again. A configuration is chosen by defines:
// -DHALFSPACE_SUB_PIXEL_BITS=4..8
// -DHALFSPACE_SAMPLES=1|2|4|8|16
// -DHALFSPACE_SAMPLE_POSITIONS=128'h...: x and y of each sample in 16ths of a pixel, the first last
// -DHALFSPACE_BLOCK_SIZE=8|16|32|64
// -DHALFSPACE_TILE_SIZE=4|8|16
// -DHALFSPACE_QUAD_WIDTH=1|2|4|8|16
// -DHALFSPACE_TEST_WIDTH=1|2|4|8|16
// -DHALFSPACE_Z_PARTS=1|2|4

`ifndef HALFSPACE_SUB_PIXEL_BITS
`define HALFSPACE_SUB_PIXEL_BITS 8
`endif
`ifndef HALFSPACE_SAMPLES
`define HALFSPACE_SAMPLES 1
`endif
`ifndef HALFSPACE_SAMPLE_POSITIONS
`define HALFSPACE_SAMPLE_POSITIONS (PixelSamples == 2 ? 128'h44cc : \
  PixelSamples == 4 ? 128'hae2ae662 : \
  PixelSamples == 8 ? 128'hf1bf173d53d97b95 : \
  PixelSamples == 16 ? 128'h10eff4082c42816eb3dbad36c75a7599 : \
  128'h88)
`endif
`ifndef HALFSPACE_BLOCK_SIZE
`define HALFSPACE_BLOCK_SIZE 32
`endif
`ifndef HALFSPACE_TILE_SIZE
`define HALFSPACE_TILE_SIZE 8
`endif
`ifndef HALFSPACE_QUAD_WIDTH
`define HALFSPACE_QUAD_WIDTH 4
`endif
`ifndef HALFSPACE_TEST_WIDTH
`define HALFSPACE_TEST_WIDTH 4
`endif
`ifndef HALFSPACE_Z_PARTS
`define HALFSPACE_Z_PARTS 1
`endif

package raster_pkg;

  parameter int unsigned SubPixelBits = `HALFSPACE_SUB_PIXEL_BITS;
  parameter int unsigned PixelSamples = `HALFSPACE_SAMPLES;
  parameter logic [127:0] SamplePositions = `HALFSPACE_SAMPLE_POSITIONS;
  parameter int unsigned BlockSize = `HALFSPACE_BLOCK_SIZE;
  parameter int unsigned TileSize = `HALFSPACE_TILE_SIZE;
  parameter int unsigned QuadWidth = `HALFSPACE_QUAD_WIDTH;
  parameter int unsigned TestWidth = `HALFSPACE_TEST_WIDTH;
  parameter int unsigned ZParts = `HALFSPACE_Z_PARTS;

  // window coordinate, signed, 1/2^SubPixelBits pixel
  parameter int unsigned CoordBits = 16 + SubPixelBits;
  // A or B of an edge: the difference of two coordinates
  parameter int unsigned StepBits = CoordBits + 1;
  // E at any sample inside the guard band
  parameter int unsigned EdgeBits = 2 * CoordBits + 3;
  // floor(E / 2^SubPixelBits), which decides coverage at pixel centres
  parameter int unsigned PixelEdgeBits = EdgeBits - SubPixelBits;
  // pixel coordinate on a screen of at most 16384
  parameter int unsigned PixelBits = 14;
  // pixel coordinate inside a tile
  parameter int unsigned TileLog2 = (TileSize == 4 ? 2 : TileSize == 8 ? 3 : 4);
  // coordinate of a tile on the screen
  parameter int unsigned TileCoordBits = PixelBits - TileLog2;
  // sample of a pixel
  parameter int unsigned SampleLog2 = (PixelSamples == 1 ? 0 : PixelSamples == 2 ? 1 :
      PixelSamples == 4 ? 2 : PixelSamples == 8 ? 3 : 4);
  // column of a tile behind tile_walker, where the tiles of all samples lie side by side
  parameter int unsigned TileColumnBits = TileCoordBits + SampleLog2;
  // tiles of a block: a mask, bit y * BlockSize / TileSize + x
  parameter int unsigned BlockTiles = BlockSize * BlockSize / (TileSize * TileSize);
  // pixel coordinate inside a block
  parameter int unsigned BlockLog2 = TileLog2 + (BlockTiles == 4 ? 1 : BlockTiles == 16 ? 2 : 3);
  // coordinate of a block on the screen
  parameter int unsigned BlockCoordBits = PixelBits - BlockLog2;
  // edge value inside one tile, saturated at the tile origin
  parameter int unsigned LocalEdgeBits = StepBits + TileLog2 + 2;
  // coverage mask of a tile, bit y * TileSize + x
  parameter int unsigned MaskBits = TileSize * TileSize;
  // edges of a triangle: one accept bit each
  parameter int unsigned EdgeCount = 3;
  // where the units keep what all tiles of a triangle share
  parameter int unsigned SlotBits = 8;
  // yes or no
  parameter int unsigned FlagBits = 1;
  // bit 0: bottom edges own the samples on them, not top ones; bit 1: right edges, not left ones
  parameter int unsigned FillRuleBits = 2;
  // 0: a triangle; else a thin line, by its rule: 1 bresenham, 2 diamond exit, 3 midpoint, 4 DDA
  parameter int unsigned LineRuleBits = 3;
  // pixels that a thin line has in a column, at most 64
  parameter int unsigned LineWidthBits = 7;
  // depth of a vertex, or polygon offset: a unorm code with a fraction below it, signed, or a float32 in the low bits
  parameter int unsigned VertexDepthBits = 48;
  // depth with the binary point behind the sign, on a scale of the triangle
  parameter int unsigned WordBits = 64;
  // half of a gradient of depth: a word and 22 bits below it, together 86
  parameter int unsigned HalfGradientBits = 43;
  // power of two above all depths of a triangle, signed
  parameter int unsigned ExponentBits = 9;
  // depth as hi_z sees it: a word of 32 bits, 16 bits below it, and 2 above, signed
  parameter int unsigned HiZWordBits = 50;
  // its change for a pixel, signed
  parameter int unsigned HiZStepBits = 42;
  // a stored depth code of any format
  parameter int unsigned CodeBits = 32;
  // (2^63 - 1) / (2A scaled to 32 bits)
  parameter int unsigned ReciprocalBits = 32;
  // E >> shift is on the scale of the 32-bit 2A, signed
  parameter int unsigned ShiftBits = 6;
  // depth format: 0 none, 1 unorm16, 2 unorm24, 4 float32
  parameter int unsigned FormatBits = 3;
  // depth comparison, numbered as in Vulkan
  parameter int unsigned FuncBits = 3;
  // number of a tile, or of a line of depth in memory
  parameter int unsigned LineBits = 32;
  // quads of a tile
  parameter int unsigned TileQuads = TileSize * TileSize / 4;
  // a quad of the tile, in row order
  parameter int unsigned QuadIndexBits = 2 * TileLog2 - 2;
  // samples of a quad: (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)
  parameter int unsigned QuadMaskBits = 4;
  // samples that are tested in a cycle
  parameter int unsigned TestSamples = 4 * TestWidth;
  // a float32
  parameter int unsigned FloatBits = 32;
  // a component of an attribute: fixed-point with 16 bits below the point, signed
  parameter int unsigned AttributeBits = 32;
  // pixels of a quad
  parameter int unsigned QuadPixels = 4;
  // components of an attribute
  parameter int unsigned Components = 4;
  // components at the three vertices
  parameter int unsigned VertexValues = 3 * Components;
  // components at the four pixels of a quad
  parameter int unsigned QuadValues = QuadPixels * Components;
  // a line of depth is not coded in fewer
  parameter int unsigned LeastCodedBytes = 32;
  // a coded line has its bytes >> 1 to this
  parameter int unsigned MostCodedShift = 3;
  // cycles from a line of depth to its bytes
  parameter int unsigned ZEncodeLatency = 6;
  // and back
  parameter int unsigned ZDecodeLatency = 4;

  typedef logic signed [CoordBits-1:0] coord_t;
  typedef logic signed [VertexDepthBits-1:0] vertex_depth_t;
  typedef logic signed [EdgeBits-1:0] edge_t;
  typedef logic signed [HiZWordBits-1:0] hi_z_word_t;
  typedef logic signed [HiZStepBits-1:0] hi_z_step_t;
  typedef logic signed [StepBits-1:0] step_t;
  typedef logic signed [ShiftBits-1:0] shift_t;
  typedef logic signed [WordBits-1:0] word_t;
  typedef logic signed [ExponentBits-1:0] exponent_t;
  typedef logic signed [AttributeBits-1:0] attribute_t;

  // front end -> setup: on the sub-pixel grid
  typedef struct packed {
    coord_t [2:0] x;
    coord_t [2:0] y;
    vertex_depth_t [2:0] z;
    vertex_depth_t offset;
    logic [FlagBits-1:0] by_square;
    logic [LineRuleBits-1:0] line_rule;
    logic [LineWidthBits-1:0] line_width;
  } screen_triangle_t;

  // the state of a draw, as it travels with its triangles
  typedef struct packed {
    logic [FlagBits-1:0] front_positive_area;
    logic [FlagBits-1:0] cull_front;
    logic [FlagBits-1:0] cull_back;
    logic [FillRuleBits-1:0] fill_rule;
    logic [FlagBits-1:0] empty;
    logic [PixelBits-1:0] x_first;
    logic [PixelBits-1:0] x_last;
    logic [PixelBits-1:0] y_first;
    logic [PixelBits-1:0] y_last;
    logic [FormatBits-1:0] format;
    logic [CodeBits-1:0] least_code;
    logic [CodeBits-1:0] most_code;
    logic [FlagBits-1:0] test;
    logic [FlagBits-1:0] write;
    logic [FlagBits-1:0] late;
    logic [FuncBits-1:0] func;
    logic [CodeBits-1:0] clear_code;
    logic [LineBits-1:0] first_tile;
    logic [TileColumnBits-1:0] tiles_x;
    logic [LineBits-1:0] first_block;
    logic [BlockCoordBits-1:0] blocks_x;
  } draw_state_t;

  // setup -> block_walker: what the walk needs
  typedef struct packed {
    edge_t [2:0] e;
    hi_z_word_t z;
    hi_z_step_t z_dx;
    hi_z_step_t z_dy;
    logic [FlagBits-1:0] z_known;
    step_t [2:0] a;
    step_t [2:0] b;
    logic [PixelBits-1:0] x_first;
    logic [PixelBits-1:0] x_last;
    logic [PixelBits-1:0] y_first;
    logic [PixelBits-1:0] y_last;
  } setup_triangle_t;

  // setup -> early_z, by way of the slots of block_walker
  typedef struct packed {
    step_t [1:0] a;
    step_t [1:0] b;
    vertex_depth_t [2:0] z;
    logic [2:0] [FlagBits-1:0] bias;
    edge_t area2;
    logic [ReciprocalBits-1:0] reciprocal;
    shift_t shift;
    logic [1:0] [HalfGradientBits-1:0] dx;
    logic [1:0] [HalfGradientBits-1:0] dy;
    word_t word;
    coord_t x;
    coord_t y;
    logic [FlagBits-1:0] beyond;
    exponent_t exponent;
    word_t offset;
    logic [CodeBits-1:0] min_code;
    logic [CodeBits-1:0] max_code;
  } depth_equation_t;

  // block_walker -> tile_walker
  typedef struct packed {
    logic [SlotBits-1:0] slot;
    logic [BlockCoordBits-1:0] block_x;
    logic [BlockCoordBits-1:0] block_y;
    edge_t [2:0] e;
    step_t [2:0] a;
    step_t [2:0] b;
    logic [BlockLog2-1:0] x_first;
    logic [BlockLog2-1:0] x_last;
    logic [BlockLog2-1:0] y_first;
    logic [BlockLog2-1:0] y_last;
    logic [BlockTiles-1:0] tiles;
    logic [BlockTiles-1:0] sure;
    hi_z_word_t z;
    hi_z_step_t z_dx;
    hi_z_step_t z_dy;
    logic [FlagBits-1:0] z_known;
  } block_job_t;

  // tile_walker -> edge_evaluator
  typedef struct packed {
    logic [SlotBits-1:0] slot;
    logic [TileColumnBits-1:0] tile_x;
    logic [TileCoordBits-1:0] tile_y;
    edge_t [2:0] e;
    step_t [2:0] a;
    step_t [2:0] b;
    logic [FlagBits-1:0] sure;
    logic [EdgeCount-1:0] accept;
    logic [TileLog2-1:0] x_first;
    logic [TileLog2-1:0] x_last;
    logic [TileLog2-1:0] y_first;
    logic [TileLog2-1:0] y_last;
  } tile_job_t;

  // edge_evaluator -> quad_generator
  typedef struct packed {
    logic [SlotBits-1:0] slot;
    logic [TileColumnBits-1:0] tile_x;
    logic [TileCoordBits-1:0] tile_y;
    logic [FlagBits-1:0] sure;
    edge_t [1:0] e;
    logic [MaskBits-1:0] mask;
  } coverage_t;

  // quad_generator -> early_z: a beat of a burst
  typedef struct packed {
    logic [SlotBits-1:0] slot;
    logic [TileColumnBits-1:0] tile_x;
    logic [TileCoordBits-1:0] tile_y;
    edge_t [1:0] e;
    logic [FlagBits-1:0] last;
    logic [ZParts-1:0] [FlagBits-1:0] parts;
    logic [ZParts-1:0] [FlagBits-1:0] sure;
    logic [QuadWidth-1:0] [QuadIndexBits-1:0] index;
    logic [QuadWidth-1:0] [QuadMaskBits-1:0] mask;
  } quad_beat_t;

  // early_z -> hi_z: what is stored behind a burst
  typedef struct packed {
    logic [ZParts-1:0] [FlagBits-1:0] touched;
    logic [ZParts-1:0] [CodeBits-1:0] least;
    logic [ZParts-1:0] [CodeBits-1:0] most;
  } hi_z_update_t;

  // early_z -> fragment shader: a beat of a burst
  typedef struct packed {
    logic [TestWidth-1:0] [QuadMaskBits-1:0] inner;
    logic [SlotBits-1:0] slot;
    logic [TileColumnBits-1:0] tile_x;
    logic [TileCoordBits-1:0] tile_y;
    logic [FlagBits-1:0] last;
    logic [TestWidth-1:0] [QuadIndexBits-1:0] index;
    logic [TestWidth-1:0] [QuadMaskBits-1:0] mask;
    logic [TestWidth-1:0] [QuadMaskBits-1:0] passed;
    logic [TestSamples-1:0] [CodeBits-1:0] depth;
  } tested_beat_t;

  // early_z -> interpolator: a quad, an attribute, and their triangle
  typedef struct packed {
    logic [QuadMaskBits-1:0] mask;
    edge_t [1:0] e;
    step_t [1:0] a;
    step_t [1:0] b;
    edge_t area2;
    logic [2:0] [FloatBits-1:0] q;
    attribute_t [VertexValues-1:0] value;
  } attribute_quad_t;

  // interpolator -> fragment shader: the attribute at the pixels of the quad
  typedef struct packed {
    attribute_t [QuadValues-1:0] value;
    logic [QuadMaskBits-1:0] mask;
  } shaded_quad_t;

  // stages that count their cycles, and what each of them may spend one on: busy, or a reason to wait
  parameter int unsigned StageCount = 9;
  parameter int unsigned ActivityCount = 6;
  parameter int unsigned ActivityBits = $clog2(ActivityCount);

  // a cycle of setup
  typedef enum logic [ActivityBits-1:0] {
    SetupBusy = 0,
    SetupNoTriangle = 1,
    SetupDivider = 2,
    SetupNoCredit = 3
  } setup_activity_e;

  // a cycle of block_walker
  typedef enum logic [ActivityBits-1:0] {
    BlockWalkerBusy = 0,
    BlockWalkerNoTriangle = 1,
    BlockWalkerLoad = 2,
    BlockWalkerNoCredit = 3
  } block_walker_activity_e;

  // a cycle of hi_z
  typedef enum logic [ActivityBits-1:0] {
    HiZBusy = 0,
    HiZNoBlock = 1,
    HiZNoUpdate = 2,
    HiZNoCredit = 3
  } hi_z_activity_e;

  // a cycle of tile_walker
  typedef enum logic [ActivityBits-1:0] {
    TileWalkerBusy = 0,
    TileWalkerNoBlock = 1,
    TileWalkerNoCredit = 2
  } tile_walker_activity_e;

  // a cycle of edge_evaluator
  typedef enum logic [ActivityBits-1:0] {
    EdgeEvaluatorBusy = 0,
    EdgeEvaluatorNoTile = 1,
    EdgeEvaluatorNoCredit = 2
  } edge_evaluator_activity_e;

  // a cycle of quad_generator
  typedef enum logic [ActivityBits-1:0] {
    QuadGeneratorBusy = 0,
    QuadGeneratorNoCoverage = 1,
    QuadGeneratorNoCredit = 2
  } quad_generator_activity_e;

  // a cycle of z_lookup
  typedef enum logic [ActivityBits-1:0] {
    ZLookupBusy = 0,
    ZLookupNoBurst = 1,
    ZLookupPendingFull = 2,
    ZLookupWriteBack = 3,
    ZLookupFillBuffers = 4,
    ZLookupRequest = 5
  } z_lookup_activity_e;

  // a cycle of z_test
  typedef enum logic [ActivityBits-1:0] {
    ZTestBusy = 0,
    ZTestNoBurst = 1,
    ZTestLate = 2,
    ZTestFill = 3,
    ZTestWriteBuffer = 4,
    ZTestNoCredit = 5
  } z_test_activity_e;

  // a cycle of interpolator
  typedef enum logic [ActivityBits-1:0] {
    InterpolatorBusy = 0,
    InterpolatorNoBurst = 1,
    InterpolatorNoCredit = 2
  } interpolator_activity_e;

  // what can happen in a cycle: bits of the probe of the pipeline's bench
  parameter int unsigned EventDecide = 0;  // setup draws or drops a triangle
  parameter int unsigned EventAccept = 1;  // block_walker takes a triangle
  parameter int unsigned EventBlock = 2;  // block_walker makes a block job
  parameter int unsigned EventHiZ = 3;  // hi_z takes a block
  parameter int unsigned EventBlockDone = 4;  // tile_walker makes the last tile job of a block job
  parameter int unsigned EventEmit = 5;  // tile_walker makes a tile job
  parameter int unsigned EventJob = 6;  // edge_evaluator takes a tile job
  parameter int unsigned EventCoverage = 7;  // quad_generator takes a coverage
  parameter int unsigned EventBeat = 8;  // z_lookup takes a beat
  parameter int unsigned EventFirstBeat = 9;  // it is the first of its burst
  parameter int unsigned EventLastBeat = 10;  // it is the last of its burst
  parameter int unsigned EventTestFirst = 11;  // z_test tests the first beat of a burst
  parameter int unsigned EventTestLast = 12;  // z_test tests the last beat of a burst
  parameter int unsigned EventCount = 13;

endpackage : raster_pkg

`undef HALFSPACE_SUB_PIXEL_BITS
`undef HALFSPACE_SAMPLES
`undef HALFSPACE_SAMPLE_POSITIONS
`undef HALFSPACE_BLOCK_SIZE
`undef HALFSPACE_TILE_SIZE
`undef HALFSPACE_QUAD_WIDTH
`undef HALFSPACE_TEST_WIDTH
`undef HALFSPACE_Z_PARTS
