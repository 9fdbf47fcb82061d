// Hierarchical Z: takes the tiles out of a block in which no sample can pass the depth test, and marks those in which
// every sample passes.
//
// A pipeline in order. In a cycle it takes at most one block, which is decided three cycles later, and applies at most one
// job: what is then stored in the tile of the oldest job in flight goes into the word of its block. A block sees the jobs
// that were applied before the cycle in which it is taken, and it is taken when these are all that it must see. What the
// next block must see may be applied in the cycle in which this one is taken.
//
// What early_z keeps of a triangle gets its slot here, when the first block of the triangle leaves: so a triangle of which
// nothing is left holds none, however many of them go by while a burst waits for memory.
//
// cycle of a job  | 0 to 3: its word is read, changed and written (hi_z_memory)
// cycle of a block | 0: read the triangle's | 1: number the block, read its word | 2: decode it, look for jobs in flight
//                  | 3: compare, count what is left | 4: in flight, or rejected; gives a slot, and reads what to keep
//                  | 5: into the FIFO, the triangle into its slot

module hi_z
  import raster_pkg::*;
#(
  /// Slots of the output FIFO, 4 or more, each as wide as block_job_t. With fewer than 7 blocks cannot leave in every
  /// cycle.
  parameter int unsigned FifoDepth = 12,
  /// Marks tiles in which every sample passes.
  parameter bit Accept = 1'b1,
  /// Bits of a bound, 4 to 32.
  parameter int unsigned Bits = 8,
  /// A block sees what jobs have written that are at least so many older: 1 or more.
  parameter int unsigned Lag = 128,
  /// Blocks of all surfaces, 2 or more.
  parameter int unsigned MemoryBlocks = 1024,
  /// Blocks that a clear marks in a cycle: a power of two.
  parameter int unsigned ClearBlocks = 64,
  localparam int unsigned BlockBits = $clog2(MemoryBlocks)
) (
  input  logic                 clk_i,
  input  logic                 rst_ni,

  // block_walker: each triangle, at least two cycles before its first block can be taken.
  input  logic                 slot_write_i,
  input  logic [SlotBits-1:0]  slot_i,
  input  depth_equation_t      slot_equation_i,
  input  draw_state_t          slot_state_i,

  // What early_z keeps of each triangle that has a block: written before the block is visible.
  output logic                 slot_write_o,
  output logic [SlotBits-1:0]  slot_o,
  output depth_equation_t      slot_equation_o,
  output draw_state_t          slot_state_o,

  input  logic                 block_valid_i,
  output logic                 block_ready_o,
  input  block_job_t           block_i,

  // tile_walker
  output logic                 block_valid_o,
  input  logic                 block_ready_i,
  output block_job_t           block_o,

  // quad_generator took the coverage of the next job in the cycle before, with a burst or without.
  input  logic                 job_valid_i,
  input  logic                 job_burst_i,
  // early_z: for each burst.
  input  logic                 update_valid_i,
  input  hi_z_update_t         update_i,

  // Everything else in the machine is idle, and a clear waits: all jobs are applied before, when no block is under way
  // here.
  input  logic                 drain_i,
  // The surface of these blocks is cleared. In an idle cycle.
  input  logic                 clear_i,
  input  logic [BlockBits-1:0] clear_first_i,
  input  logic [BlockBits-1:0] clear_last_i,
  output logic                 clear_done_o,
  // The frame has ended: nothing is known of any block, and no job is in flight. In an idle cycle.
  input  logic                 forget_i,

  // What the cycle is spent on; whether nothing is left to do.
  output hi_z_activity_e       activity_o,
  output logic                 idle_o
);

  localparam int unsigned Entries = BlockTiles * ZParts;
  // Jobs that have left and are not applied: those that no block sees yet, and those of the blocks that do not count yet.
  localparam int unsigned Jobs = Lag + 6 * BlockTiles;
  // Blocks that have such jobs.
  localparam int unsigned Flights = Lag + 10;

  if (Entries > 64) begin : gen_illegal_entries
    $error("a block has more than 64 parts of tiles");
  end
  if (FifoDepth < 4) begin : gen_illegal_depth
    $error("FifoDepth must be 4 or more");
  end
  if (Bits < 4 || Bits > CodeBits) begin : gen_illegal_bits
    $error("Bits must be 4 to 32");
  end

  typedef logic [BlockTiles-1:0] tiles_t;
  typedef logic [BlockBits-1:0] number_t;
  typedef logic [FuncBits-1:0] func_t;
  typedef logic [CodeBits-1:0] code_t;

  // Nothing of a frame outlives it; what is on its way to tile_walker has left.
  logic frame_ni;
  assign frame_ni = rst_ni & ~forget_i;

  // What is kept of a triangle.
  typedef struct packed {
    logic                      test;
    logic                      up;       // its jobs may raise what is stored
    logic                      down;
    logic                      late;     // they write when the shader is through
    func_t                     func;
    logic                      is_float;
    logic                      is_unorm16;
    exponent_t                 exponent;
    code_t                     min_code;
    code_t                     max_code;
    code_t                     clear_code;
    number_t                   first_block;
    logic [BlockCoordBits-1:0] blocks_x;
  } triangle_t;

  // Functions, as Vulkan numbers them.
  localparam func_t Never = 0, Less = 1, Equal = 2, Lequal = 3, Greater = 4, NotEqual = 5;
  localparam func_t Gequal = 6, Always = 7;
  localparam logic [FormatBits-1:0] Unorm16 = 1, Float32 = 4;

  // The exponent of words; those of unorm codes in [0, 1] have 0.
  exponent_t exponent;
  logic      lowers, raises, both;

  assign both     = slot_state_i.func inside {NotEqual, Always};
  assign raises   = both | (slot_state_i.func inside {Greater, Gequal});
  assign lowers   = both | (slot_state_i.func inside {Less, Lequal});
  assign exponent = slot_state_i.format == Float32 || slot_equation_i.beyond
                    ? slot_equation_i.exponent : '0;

  triangle_t write_triangle, triangle;
  logic      take;

  assign write_triangle = '{
    test:        slot_state_i.test,
    up:          slot_state_i.test & slot_state_i.write & raises,
    down:        slot_state_i.test & slot_state_i.write & lowers,
    late:        slot_state_i.late,
    func:        slot_state_i.func,
    is_float:    slot_state_i.format == Float32,
    is_unorm16:  slot_state_i.format == Unorm16,
    exponent:    exponent,
    min_code:    slot_equation_i.min_code,
    max_code:    slot_equation_i.max_code,
    clear_code:  slot_state_i.clear_code,
    first_block: number_t'(slot_state_i.first_block),
    blocks_x:    slot_state_i.blocks_x
  };

  // Of block_walker's slots so many are in use: one for each block of its FIFO, which has 8 at most, for each block that
  // is here in cycle 1 to 4, and for the triangle that is written.
  localparam int unsigned Triangles = 16;
  typedef logic [$clog2(Triangles)-1:0] place_t;

  sync_ram #(
    .Width ($bits(triangle_t)),
    .Depth (Triangles)
  ) u_triangles (
    .clk_i           (clk_i),
    .write_i         (slot_write_i),
    .write_address_i (place_t'(slot_i)),
    .data_i          (write_triangle),
    .read_i          (take),
    .read_address_i  (place_t'(block_i.slot)),
    .data_o          (triangle)
  );

  // Jobs: which have a burst, and what early_z says of those.
  logic         kind_valid, kind_burst, update_valid, apply;
  hi_z_update_t update;

  memory_fifo #(
    .Width (1),
    .Slots (Jobs)
  ) u_kinds (
    .clk_i       (clk_i),
    .rst_ni      (frame_ni),
    .push_i      (job_valid_i),
    .data_i      (job_burst_i),
    .pop_valid_o (kind_valid),
    .pop_ready_i (apply),
    .data_o      (kind_burst)
  );

  memory_fifo #(
    .Width ($bits(hi_z_update_t)),
    .Slots (Jobs)
  ) u_updates (
    .clk_i       (clk_i),
    .rst_ni      (frame_ni),
    .push_i      (update_valid_i),
    .data_i      (update_i),
    .pop_valid_o (update_valid),
    .pop_ready_i (apply & kind_burst),
    .data_o      (update)
  );

  // The oldest block in flight: its jobs are applied in the order of its tiles.
  typedef struct packed {
    number_t number;
    tiles_t  tiles;
    code_t   clear_code;
  } flight_t;

  flight_t new_flight, flight;
  logic    new_flight_valid, flight_valid, flight_last;
  tiles_t  unapplied_q, unapplied, after, pick;

  assign unapplied   = flight.tiles & unapplied_q;
  assign after       = unapplied & (unapplied - tiles_t'(1));
  assign pick        = unapplied & ~after;
  assign flight_last = after == '0;

  memory_fifo #(
    .Width ($bits(flight_t)),
    .Slots (Flights)
  ) u_order (
    .clk_i       (clk_i),
    .rst_ni      (frame_ni),
    .push_i      (new_flight_valid),
    .data_i      (new_flight),
    .pop_valid_o (flight_valid),
    .pop_ready_i (apply & flight_last),
    .data_o      (flight)
  );

  always_ff @(posedge clk_i) begin
    if (!frame_ni) begin
      unapplied_q <= '1;
    end else if (apply) begin
      unapplied_q <= flight_last ? '1 : after;
    end
  end

  // How many jobs the next block must see that are not applied; `due` is of the block after the one of this cycle. It does
  // not count those of the last four blocks: these wait here, the oldest first, until as many blocks have been taken after
  // them.
  localparam int unsigned CountBits = $clog2(Jobs + 1) + 2;
  localparam int unsigned LeftBits = $clog2(BlockTiles + 1);

  typedef logic signed [CountBits-1:0] count_t;
  typedef logic signed [$clog2(FifoDepth+1):0] slots_t;
  typedef logic [LeftBits-1:0] left_t;

  slots_t      blocks_q;           // in the unit
  count_t      due_q, due;
  left_t [3:0] waiting_q, waiting_d;
  left_t       left_count;         // of the block in cycle 3
  logic [5:1]  valid_q;            // bit i: a block is in its cycle i
  logic        job_ready, seen, credit;

  assign seen      = due_q <= count_t'(0);
  assign due       = due_q + (take ? count_t'({1'b0, waiting_q[0]}) : '0);
  assign job_ready = kind_valid & (~kind_burst | update_valid);
  assign apply     = job_ready & (due > count_t'(0) | (drain_i & blocks_q == '0));

  assign block_ready_o = credit & seen;
  assign take          = block_valid_i & block_ready_o;

  always_comb begin
    waiting_d = waiting_q;
    if (take) begin
      waiting_d = {left_t'(0), waiting_q[3:1]};
    end
    if (valid_q[3]) begin
      waiting_d[2'd3-2'(take)-2'(valid_q[1])-2'(valid_q[2])] = left_count;
    end
  end

  // A clear has seen all jobs, and all count from then on.
  always_ff @(posedge clk_i) begin
    if (!frame_ni || clear_i) begin
      due_q     <= -count_t'(Lag);
      waiting_q <= '0;
    end else begin
      due_q     <= due - count_t'({1'b0, apply});
      waiting_q <= waiting_d;
    end
  end

  // A job in its cycles 1 and 2.
  logic [2:1] apply_q, apply_last_q;
  tiles_t     apply_pick_q [1:2];

  always_ff @(posedge clk_i) begin
    if (!frame_ni) begin
      apply_q <= '0;
    end else begin
      apply_q <= {apply_q[1], apply};
    end
  end

  always_ff @(posedge clk_i) begin
    if (apply) begin
      apply_pick_q[1] <= pick;
      apply_last_q[1] <= flight_last;
    end
    if (apply_q[1]) begin
      apply_pick_q[2] <= apply_pick_q[1];
      apply_last_q[2] <= apply_last_q[1];
    end
  end

  // A block in its cycle 1: its number, and the plane. number1 and the like are of the block in that cycle.
  number_t    number1, number2_q, number3_q, number4_q;
  block_job_t job_q [1:5];

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q <= '0;
    end else begin
      valid_q <= {valid_q[4] & (|job_q[4].tiles), valid_q[3:1], take};
    end
  end

  always_ff @(posedge clk_i) begin
    if (take) begin
      job_q[1] <= block_i;
    end
    if (valid_q[1]) begin
      job_q[2] <= job_q[1];
    end
    if (valid_q[2]) begin
      job_q[3] <= job_q[2];
    end
  end

  // y * (blocks_x + 1) + x: blocks in a row less 1 come with the draw.
  typedef logic [LineBits-1:0] line_t;
  number_t row_start;
  assign row_start = number_t'(line_t'(job_q[1].block_y)
                               * (line_t'(triangle.blocks_x) + line_t'(1)));
  assign number1   = triangle.test
                     ? triangle.first_block + row_start + number_t'(job_q[1].block_x)
                     : '0;

  localparam int unsigned UnitBits = HiZWordBits - 16;
  logic [BlockTiles-1:0][UnitBits:0] plane_least, plane_most;

  hi_z_plane u_plane (
    .clk_i   (clk_i),
    .valid_i (valid_q[1]),
    .z_i     (job_q[1].z),
    .dx_i    (job_q[1].z_dx),
    .dy_i    (job_q[1].z_dy),
    .least_o (plane_least),
    .most_o  (plane_most)
  );

  // What the test needs of the triangle.
  typedef logic signed [10:0] up_t;

  typedef struct packed {
    logic                test;
    logic                up;
    logic                down;
    logic                late;
    func_t               func;
    logic                is_float;
    logic                is_unorm16;
    up_t                 scale; // of a code of exponent 0 as a word
    code_t               min_code;
    code_t               max_code;
    code_t               clear_code;
  } test_t;

  // A float32 of field 0 is mantissa * 2^-150 and twice that; two bits are put below it; a word's unit is 2^(exponent - 31).
  localparam up_t FloatScale = -11'sd121;

  test_t test2_q, test3_q;

  always_ff @(posedge clk_i) begin
    if (valid_q[1]) begin
      number2_q <= number1;
      test2_q   <= '{
        test:       triangle.test,
        up:         triangle.up,
        down:       triangle.down,
        late:       triangle.late,
        func:       triangle.func,
        is_float:   triangle.is_float,
        is_unorm16: triangle.is_unorm16,
        scale:      (triangle.is_float ? FloatScale : '0) - up_t'(triangle.exponent),
        min_code:   triangle.min_code,
        max_code:   triangle.max_code,
        clear_code: triangle.clear_code
      };
    end
  end

  // The words: for jobs, and for blocks in their cycle 2.
  logic [BlockTiles-1:0][CodeBits-1:0] least, most;

  hi_z_memory #(
    .Bits         (Bits),
    .MemoryBlocks (MemoryBlocks),
    .ClearBlocks  (ClearBlocks)
  ) u_memory (
    .clk_i              (clk_i),
    .rst_ni             (rst_ni),
    .forget_i           (forget_i),
    .apply_i            (apply),
    .apply_write_i      (kind_burst & (|update.touched)),
    .apply_number_i     (flight.number),
    .apply_clear_code_i (flight.clear_code),
    .apply_tile_i       (pick),
    .apply_update_i     (update),
    .read_i             (valid_q[1]),
    .read_number_i      (number1),
    .number_i           (number2_q),
    .clear_code_i       (test2_q.clear_code),
    .least_o            (least),
    .most_o             (most),
    .clear_i            (clear_i),
    .clear_first_i      (clear_first_i),
    .clear_last_i       (clear_last_i),
    .clear_done_o       (clear_done_o)
  );

  // Cycle 2: a function looks at a bound of each tile, or at the code after it.
  logic [BlockTiles-1:0][CodeBits:0] upper, lower;
  logic                              after_upper, after_lower;

  assign after_upper = test2_q.func inside {Lequal, Equal, NotEqual, Greater};
  assign after_lower = test2_q.func inside {Lequal, Greater};

  typedef logic [CodeBits:0] wide_code_t;

  for (genvar i = 0; i < BlockTiles; i++) begin : gen_bounds
    assign lower[i] = wide_code_t'(least[i]) + wide_code_t'(after_lower);
    assign upper[i] = wide_code_t'(most[i]) + wide_code_t'(after_upper);
  end

  // Jobs in flight in the same block: those in u_flights, and those of the blocks in cycle 4 of this cycle and the next.
  tiles_t found_up, found_down, left4, up3_q, down3_q;
  logic   up4_q, down4_q, leaves4, same3_q, same4;

  hi_z_flights #(
    .MemoryBlocks (MemoryBlocks),
    .Slots        (Flights)
  ) u_flights (
    .clk_i     (clk_i),
    .rst_ni    (frame_ni),
    .push_i    (new_flight_valid),
    .number_i  (number4_q),
    .tiles_i   (left4),
    .up_i      (up4_q),
    .down_i    (down4_q),
    .applied_i (apply_q[2]),
    .pick_i    (apply_pick_q[2]),
    .last_i    (apply_last_q[2]),
    .search_i  (number2_q),
    .up_o      (found_up),
    .down_o    (found_down)
  );

  logic [BlockTiles-1:0][CodeBits:0] upper3_q, lower3_q;
  logic [BlockTiles-1:0][UnitBits:0] least3_q, most3_q;

  assign left4   = job_q[4].tiles;
  assign leaves4 = valid_q[4] & (|left4);
  assign same4   = leaves4 && number4_q == number2_q;

  always_ff @(posedge clk_i) begin
    if (valid_q[2]) begin
      number3_q <= number2_q;
      test3_q   <= test2_q;
      upper3_q  <= upper;
      lower3_q  <= lower;
      least3_q  <= plane_least;
      most3_q   <= plane_most;
      up3_q     <= found_up | (same4 && up4_q ? left4 : '0);
      down3_q   <= found_down | (same4 && down4_q ? left4 : '0);
      same3_q   <= valid_q[3] && number3_q == number2_q;
    end
  end

  // Cycle 3.
  tiles_t at_least, below, up, down, over, under, rejected, accepted, left, sure;

  for (genvar i = 0; i < BlockTiles; i++) begin : gen_test
    hi_z_test u_test (
      .is_float_i   (test3_q.is_float),
      .is_unorm16_i (test3_q.is_unorm16),
      .up_i         (test3_q.scale),
      .known_i      (job_q[3].z_known),
      .min_code_i   (test3_q.min_code),
      .max_code_i   (test3_q.max_code),
      .least_i      (least3_q[i]),
      .most_i       (most3_q[i]),
      .upper_i      (upper3_q[i]),
      .lower_i      (lower3_q[i]),
      .at_least_o   (at_least[i]),
      .below_o      (below[i])
    );
  end

  assign up   = up3_q | (same3_q && up4_q ? left4 : '0);
  assign down = down3_q | (same3_q && down4_q ? left4 : '0);

  assign over  = at_least & ~up;
  assign under = below & ~down;

  always_comb begin
    unique case (test3_q.func)
      Never:           rejected = '1;
      Less, Lequal:    rejected = over;
      Equal:           rejected = over | under;
      Greater, Gequal: rejected = under;
      default:         rejected = '0;
    endcase
    unique case (test3_q.func)
      Less, Lequal:    accepted = under;
      NotEqual:        accepted = over | under;
      Greater, Gequal: accepted = over;
      Always:          accepted = '1;
      default:         accepted = '0;
    endcase
  end

  // Only draws that write may raise or lower what is stored.
  assign left = test3_q.test ? job_q[3].tiles & ~rejected : job_q[3].tiles;
  assign sure = Accept && (test3_q.up || test3_q.down) && !test3_q.late ? left & accepted : '0;

  always_comb begin
    left_count = '0;
    for (int unsigned i = 0; i < BlockTiles; i++) begin
      left_count += left_t'(left[i]);
    end
  end

  code_t clear_code4_q;

  logic [SlotBits-1:0] slot4;

  hi_z_slots #(
    .Triangles (Triangles)
  ) u_slots (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .forget_i        (forget_i),
    .write_i         (slot_write_i),
    .slot_i          (slot_i),
    .equation_i      (slot_equation_i),
    .state_i         (slot_state_i),
    .block_i         (valid_q[4]),
    .block_slot_i    (job_q[4].slot),
    .leaves_i        (leaves4),
    .leaves_slot_o   (slot4),
    .slot_write_o    (slot_write_o),
    .slot_o          (slot_o),
    .slot_equation_o (slot_equation_o),
    .slot_state_o    (slot_state_o)
  );

  always_ff @(posedge clk_i) begin
    if (valid_q[3]) begin
      job_q[4]       <= job_q[3];
      job_q[4].tiles <= left;
      job_q[4].sure  <= sure;
      number4_q      <= number3_q;
      up4_q          <= test3_q.up;
      down4_q        <= test3_q.down;
      clear_code4_q  <= test3_q.clear_code;
    end
    if (valid_q[4]) begin
      job_q[5]      <= job_q[4];
      job_q[5].slot <= slot4;
    end
  end

  assign new_flight_valid = leaves4;
  assign new_flight       = '{number: number4_q, tiles: left4, clear_code: clear_code4_q};

  // A block is taken when there is a slot for it and for the three before it, of which it is not known yet whether they
  // leave. Of those before, as many hold one as have left and not been popped: fewer than none where one of the three
  // has been popped already.
  slots_t held_q, held;
  logic   pop;

  assign pop    = block_valid_o & block_ready_i;
  assign held   = held_q + slots_t'({1'b0, |waiting_q[0]});
  assign credit = held <= slots_t'(FifoDepth - 4);

  always_ff @(posedge clk_i) begin
    if (!frame_ni || clear_i) begin
      held_q <= '0;
    end else begin
      held_q <= (take ? held : held_q) - slots_t'({1'b0, pop});
    end
  end

  // Blocks in the unit: a block that is rejected is in it up to its cycle 4.

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      blocks_q <= '0;
    end else begin
      blocks_q <= blocks_q + slots_t'({1'b0, take}) - slots_t'({1'b0, pop})
                  - slots_t'({1'b0, valid_q[4] & ~leaves4});
    end
  end

  memory_fifo #(
    .Width ($bits(block_job_t)),
    .Slots (FifoDepth)
  ) u_fifo (
    .clk_i       (clk_i),
    .rst_ni      (rst_ni),
    .push_i      (valid_q[5]),
    .data_i      (job_q[5]),
    .pop_valid_o (block_valid_o),
    .pop_ready_i (block_ready_i),
    .data_o      (block_o)
  );

  assign activity_o = take             ? HiZBusy
                      : !block_valid_i ? HiZNoBlock
                      : !seen          ? HiZNoUpdate : HiZNoCredit;
  assign idle_o     = blocks_q == '0 & ~(drain_i & (flight_valid | apply_q[1]));

`ifndef SYNTHESIS
  JobHasLeft: assert property (@(posedge clk_i) disable iff (!frame_ni)
      apply |-> flight_valid && unapplied != '0)
  else $error("a job that has not left is applied");
  ClearIsIdle: assert property (@(posedge clk_i) disable iff (!rst_ni)
      clear_i || forget_i |-> blocks_q == '0 && !take)
  else $error("a clear or the end of a frame with a block under way");
  ClearSeesAll: assert property (@(posedge clk_i) disable iff (!rst_ni)
      clear_i |-> !flight_valid && !kind_valid)
  else $error("a clear before all jobs are applied");
`endif

endmodule
