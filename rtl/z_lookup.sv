// The lookup of the z cache: takes the beats of a burst, finds out which parts of its tile are not in the cache, which
// lines they replace, and asks memory for them.
//
// The first beat of a burst is taken in cycle f. Its draw state and the tags are looked at in f + 1; from then on one
// missing part is resolved in a cycle, in order of parts: found cleared or overwritten whole, or asked for, once the line
// is out of the cache and, if it is to be fetched, a fill buffer is free. The next burst is taken when all beats have moved, from the
// cycle in which the last part is resolved on. beat_ready_o comes from registers and the tags, not from an input.

module z_lookup
  import raster_pkg::*;
  import z_codec_pkg::*;
#(
  /// Bursts between the lookup and the end of their test, 2 or more.
  parameter int unsigned PendingDepth = 32,
  /// Lines of the cache, a power of two, at least ZParts * Ways.
  parameter int unsigned Lines = 128,
  /// Lines of a set: a power of two.
  parameter int unsigned Ways = 4,
  /// Fill buffers, ZParts or more.
  parameter int unsigned MissesInFlight = 16,
  /// Tiles of all surfaces, 2 or more.
  parameter int unsigned MemoryTiles = 1024,
  /// Tiles that a clear marks in a cycle: a power of two.
  parameter int unsigned ClearTiles = 64,
  /// 1: lines are coded in memory.
  parameter bit Compression = 1'b0,
  localparam int unsigned TileBits = $clog2(MemoryTiles),
  localparam int unsigned PartLines = Lines / ZParts,
  localparam int unsigned PartLineBits = PartLines > 1 ? $clog2(PartLines) : 1,
  localparam int unsigned PendingBits = $clog2(PendingDepth)
) (
  input  logic                                   clk_i,
  input  logic                                   rst_ni,

  // Bursts. The state of the draw comes a cycle after state_read_o.
  input  logic                                   beat_valid_i,
  output logic                                   beat_ready_o,
  input  logic [TileColumnBits-1:0]              tile_x_i,
  input  logic [TileCoordBits-1:0]               tile_y_i,
  input  logic                                   last_i,
  input  logic [ZParts-1:0]                      parts_i,
  input  logic [ZParts-1:0]                      sure_i,    // of these: overwritten whole
  output logic                                   first_o,   // the beat is the first of its burst
  output logic [PendingBits-1:0]                 burst_o,   // where the burst is kept
  output logic                                   state_read_o,
  input  logic                                   touches_i,
  input  logic                                   half_i,
  input  logic [TileBits-1:0]                    first_tile_i,
  input  logic [TileColumnBits-1:0]              tiles_x_i, // less 1

  // What is known of a burst in the cycle after its first beat.
  output logic                                   found_o,
  output logic [PendingBits-1:0]                 found_burst_o,
  output logic [ZParts-1:0]                      touched_o,
  output logic [ZParts-1:0]                      missed_o,
  output logic [ZParts-1:0]                      sure_o,
  output logic [ZParts-1:0] [PartLineBits-1:0]   line_index_o,
  output logic [ZParts-1:0]                      victim_o,      // the slot was in use
  output logic [ZParts-1:0] [TileBits-1:0]       victim_tile_o,
  output logic [ZParts-1:0]                      victim_half_o,
  // All its parts are resolved, and these were asked for.
  output logic                                   resolved_o,
  output logic [ZParts-1:0]                      fetched_o,

  // The test: the last beat of a burst, fill buffers that became free, victims that are written back.
  input  logic                                   burst_done_i,
  input  logic [ZParts-1:0]                      fill_free_i,
  input  logic [ZParts-1:0]                      stored_i,
  input  logic [ZParts-1:0] [TileBits-1:0]       stored_tile_i,

  // Is this line on its way out? Answered in the same cycle.
  output logic [ZParts-1:0]                      leaving_part_o,
  output logic [TileBits-1:0]                    leaving_tile_o,
  input  logic                                   leaving_i,

  // Requests, in order.
  output logic                                   read_valid_o,
  input  logic                                   read_ready_i,
  output logic [LineBits-1:0]                    read_line_o,
  output logic                                   read_half_o,
  output coded_shift_t                           read_shift_o,

  // A line has been written: by how much it is coded.
  input  logic [ZParts-1:0]                      written_i,
  input  logic [TileBits-1:0]                    written_tile_i,
  input  coded_shift_t                           written_shift_i,

  // Clear: drops the lines of tiles first to last from the set of a slot, and marks them cleared from mark_from_i on.
  // And what a slot holds, for the flush. Only when the unit is idle.
  input  logic                                   inspect_i,     // slot_i counts, there is no burst
  input  logic [PartLineBits-1:0]                slot_i,
  input  logic                                   drop_i,
  input  logic                                   mark_i,
  input  logic [TileBits-1:0]                    clear_first_i,
  input  logic [TileBits-1:0]                    clear_last_i,
  input  logic [TileBits-1:0]                    mark_from_i,
  output logic [ZParts-1:0] [Ways-1:0]           dropped_o,     // by way
  output logic [ZParts-1:0] [TileBits-1:0]       slot_tile_o,
  output logic [ZParts-1:0]                      slot_half_o,

  output z_lookup_activity_e                     activity_o,
  output logic                                   idle_o
);

  localparam int unsigned Sets = PartLines / Ways;
  localparam int unsigned SetLog2 = $clog2(Sets);
  localparam int unsigned SetBits = SetLog2 > 0 ? SetLog2 : 1;
  localparam int unsigned XBits = (SetLog2 + 1) / 2; // of the tile's x in the set's number
  localparam int unsigned WayBits = Ways > 1 ? $clog2(Ways) : 1;
  localparam int unsigned FillBits = $clog2(MissesInFlight + 1);

  typedef logic [SetBits-1:0] set_t;
  typedef logic [WayBits-1:0] way_t;
  typedef logic [PendingBits-1:0] burst_t;
  typedef logic [FillBits-1:0] fill_t;

  typedef struct packed {
    logic                valid;
    logic                half;  // two bytes a sample in memory
    logic [TileBits-1:0] tile;
    way_t                way;   // slot in the set
  } entry_t;
  typedef entry_t [Ways-1:0] entries_t; // the most recently used first

  // Cycle f: beats.
  logic    middle_q;    // of a burst
  logic    fresh_q;     // the first beat came in the last cycle
  burst_t  next_burst_q, burst_q;
  logic    credit, all_free;
  logic    take_first;

  logic [TileColumnBits-1:0] tile_x_q;
  logic [TileCoordBits-1:0]  tile_y_q;
  logic [ZParts-1:0]        parts_q, sure_q;

  assign take_first   = beat_valid_i & beat_ready_o & ~middle_q;
  assign first_o      = ~middle_q;
  assign burst_o      = middle_q ? burst_q : next_burst_q;
  assign state_read_o = take_first;

  logic unused_ready_next;

  credits #(
    .Slots (PendingDepth)
  ) u_credits (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .reserve_ready_o (credit),
    .reserve_i       (take_first),
    .return_i        (burst_done_i),
    .ready_next_o    (unused_ready_next),
    .empty_o         (all_free)
  );

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      middle_q     <= 1'b0;
      fresh_q      <= 1'b0;
      next_burst_q <= '0;
    end else begin
      fresh_q <= take_first;
      if (beat_valid_i && beat_ready_o) begin
        middle_q <= ~last_i;
      end
      if (take_first) begin
        next_burst_q <= next_burst_q == burst_t'(PendingDepth - 1)
                        ? '0 : next_burst_q + burst_t'(1);
      end
    end
  end

  always_ff @(posedge clk_i) begin
    if (take_first) begin
      burst_q  <= next_burst_q;
      tile_x_q <= tile_x_i;
      tile_y_q <= tile_y_i;
      parts_q  <= parts_i;
      sure_q   <= sure_i;
    end
  end

  // Cycle f + 1: the tile's number and the set of it.
  logic [TileBits-1:0] tile;
  set_t                set;
  assign tile = TileBits'(LineBits'(tile_y_q) * (LineBits'(tiles_x_i) + LineBits'(1)))
                + TileBits'(LineBits'(tile_x_q)) + first_tile_i;

  if (SetLog2 == 0) begin : gen_one_set
    logic unused_slot;
    assign unused_slot = ^{slot_i, inspect_i};
    assign set = '0;
  end else begin : gen_sets
    set_t tile_set;
    for (genvar i = 0; i < SetLog2; i++) begin : gen_bit
      assign tile_set[i] = i < XBits ? tile_x_q[i] : tile_y_q[i-XBits];
    end
    assign set = inspect_i ? set_t'(slot_i / PartLineBits'(Ways)) : tile_set;
  end

  way_t slot_way;
  assign slot_way = way_t'(slot_i);

  // The tags. A set that was not used since reset has its slots in order, none in use.
  logic     found;
  logic [ZParts-1:0] cleared;
  coded_shift_t [ZParts-1:0] shifts; // of the tile's lines in memory
  assign found = fresh_q & touches_i;

  for (genvar p = 0; p < ZParts; p++) begin : gen_part
    entries_t        entries_q [Sets];
    logic [Sets-1:0] used_q;
    entries_t        entries, looked_up, kept;
    logic            hit;
    entry_t          chosen;
    logic [TileBits-1:0] slot_tile;
    logic                slot_half;
    logic [Ways-1:0]     dropped;

    always_comb begin
      entries = entries_q[set];
      if (!used_q[set]) begin
        for (int unsigned i = 0; i < Ways; i++) begin
          entries[i] = '{valid: 1'b0, half: 1'b0, tile: '0, way: way_t'(i)};
        end
      end
    end

    // The line, or the least recently used slot, moves to the front; those before it move back by one.
    always_comb begin
      hit       = 1'b0;
      chosen    = entries[Ways-1];
      looked_up = entries;
      for (int unsigned i = 0; i < Ways; i++) begin
        if (entries[i].valid && entries[i].tile == tile) begin
          hit    = 1'b1;
          chosen = entries[i];
        end
      end
      for (int unsigned i = Ways - 1; i > 0; i--) begin
        automatic logic behind = 1'b0; // the chosen one is before this place
        for (int unsigned j = 0; j < i; j++) begin
          behind |= entries[j].way == chosen.way;
        end
        looked_up[i] = behind ? entries[i] : entries[i-1];
      end
      looked_up[0] = '{valid: 1'b1, half: half_i, tile: tile, way: chosen.way};
    end

    // A clear: dropped slots go to the end, in order.
    always_comb begin
      automatic int unsigned place = 0;
      automatic logic [Ways-1:0] in_range = '0;
      kept    = entries;
      dropped = '0;
      if (drop_i) begin
        for (int unsigned i = 0; i < Ways; i++) begin
          in_range[i] = entries[i].tile >= clear_first_i && entries[i].tile <= clear_last_i;
          if (entries[i].valid && !in_range[i]) begin
            kept[place[WayBits-1:0]] = entries[i];
            place++;
          end
        end
        for (int unsigned i = 0; i < Ways; i++) begin
          if (!entries[i].valid || in_range[i]) begin
            kept[place[WayBits-1:0]]       = entries[i];
            kept[place[WayBits-1:0]].valid = 1'b0;
            dropped[entries[i].way] = 1'b1;
            place++;
          end
        end
      end
    end

    // What is in a slot.
    always_comb begin
      slot_tile = '0;
      slot_half = 1'b0;
      for (int unsigned i = 0; i < Ways; i++) begin
        if (entries[i].way == slot_way || Ways == 1) begin
          slot_tile = entries[i].tile;
          slot_half = entries[i].half;
        end
      end
    end

    always_ff @(posedge clk_i) begin
      if (!rst_ni) begin
        used_q <= '0;
      end else if (found && parts_q[p]) begin
        used_q[set] <= 1'b1;
      end
    end

    always_ff @(posedge clk_i) begin
      if (found && parts_q[p]) begin
        entries_q[set] <= looked_up;
      end else if (drop_i) begin
        entries_q[set] <= kept;
      end
    end

    assign missed_o[p]      = touches_i & parts_q[p] & ~hit;
    assign line_index_o[p]  = PartLineBits'(int'(set) * int'(Ways) + int'(chosen.way));
    assign victim_o[p]      = chosen.valid;
    assign victim_tile_o[p] = chosen.tile;
    assign victim_half_o[p] = chosen.half;
    assign slot_tile_o[p]   = slot_tile;
    assign slot_half_o[p]   = slot_half;
    assign dropped_o[p]     = dropped;

    z_clear_flags #(
      .Tiles      (MemoryTiles),
      .ClearTiles (ClearTiles)
    ) u_flags (
      .clk_i         (clk_i),
      .rst_ni        (rst_ni),
      .tile_i        (tile),
      .cleared_o     (cleared[p]),
      .clear_i       (mark_i),
      .first_i       (mark_from_i),
      .last_i        (clear_last_i),
      .stored_i      (stored_i[p]),
      .stored_tile_i (stored_tile_i[p])
    );

    if (Compression) begin : gen_shifts
      z_coded_shifts #(
        .Tiles (MemoryTiles)
      ) u_shifts (
        .clk_i           (clk_i),
        .rst_ni          (rst_ni),
        .tile_i          (tile),
        .shift_o         (shifts[p]),
        .written_i       (written_i[p]),
        .written_tile_i  (written_tile_i),
        .written_shift_i (written_shift_i)
      );
    end else begin : gen_no_shifts
      assign shifts[p] = '0;
    end
  end

  assign found_o       = fresh_q;
  assign found_burst_o = burst_q;
  assign sure_o        = sure_q;
  assign touched_o     = touches_i ? parts_q : '0;

  // From cycle f + 1 on: the missing parts, the lowest first.
  logic [ZParts-1:0] left, left_d, left_q, part;
  logic [ZParts-1:0] fetched_d, fetched_q;
  logic              is_made, resolve, ask;
  logic              waits_q; // a request, for memory to take it
  fill_t             fills_d, fills_q;

  assign left           = fresh_q ? missed_o : left_q;
  assign part           = left & (~left + ZParts'(1));
  assign is_made        = |((cleared | sure_q) & part);
  assign leaving_part_o = part;
  assign leaving_tile_o = tile;
  assign resolve        = left != '0 && !leaving_i && (is_made || fills_q != '0) && !waits_q;
  assign ask            = resolve & ~is_made;
  assign left_d         = resolve ? left & ~part : left;
  assign fetched_d      = (fresh_q ? '0 : fetched_q) | (ask ? part : '0);
  assign resolved_o     = (fresh_q || left_q != '0) && left_d == '0;
  assign fetched_o      = fetched_d;

  logic [LineBits-1:0] line;
  coded_shift_t        shift;

  always_comb begin
    line  = LineBits'(tile) * LineBits'(ZParts);
    shift = '0;
    for (int unsigned p = 0; p < ZParts; p++) begin
      if (part[p]) begin
        line  |= LineBits'(p);
        shift |= shifts[p];
      end
    end
  end

  if (!Compression) begin : gen_unused_written
    logic unused_written;
    assign unused_written = ^{written_i, written_tile_i, written_shift_i};
  end

  // A request that memory does not take at once waits here, so that beat_ready_o need not know of it.
  logic                waiting_half_q;
  coded_shift_t        waiting_shift_q;
  logic [LineBits-1:0] waiting_line_q;

  assign read_valid_o = waits_q | ask;
  assign read_line_o  = waits_q ? waiting_line_q : line;
  assign read_half_o  = waits_q ? waiting_half_q : half_i;
  assign read_shift_o = waits_q ? waiting_shift_q : shift;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      waits_q <= 1'b0;
    end else begin
      waits_q <= read_valid_o & ~read_ready_i;
    end
  end

  always_ff @(posedge clk_i) begin
    if (ask) begin
      waiting_line_q <= line;
      waiting_half_q <= half_i;
      waiting_shift_q <= shift;
    end
  end

  always_comb begin
    fills_d = fills_q;
    for (int unsigned p = 0; p < ZParts; p++) begin
      fills_d += fill_t'(fill_free_i[p]);
    end
    fills_d -= fill_t'(ask);
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      left_q  <= '0;
      fills_q <= fill_t'(MissesInFlight);
    end else begin
      left_q  <= left_d;
      fills_q <= fills_d;
    end
  end

  always_ff @(posedge clk_i) begin
    fetched_q <= fetched_d;
  end

  assign beat_ready_o = middle_q | (credit & left_d == '0);
  assign activity_o   = beat_valid_i && beat_ready_o ? ZLookupBusy
                        : left_d != '0 && resolve    ? ZLookupRequest
                        : left_d != '0 && leaving_i  ? ZLookupWriteBack
                        : left_d != '0               ? ZLookupFillBuffers
                        : beat_valid_i               ? ZLookupPendingFull : ZLookupNoBurst;
  assign idle_o       = ~middle_q & ~fresh_q & all_free;

`ifndef SYNTHESIS
  // The quad generator has the whole burst before it sends the first beat; the test counts on it.
  BurstWithoutGap: assert property (@(posedge clk_i) disable iff (!rst_ni)
      middle_q |-> beat_valid_i)
  else $error("gap in a burst");
  ClearWhenIdle: assert property (@(posedge clk_i) disable iff (!rst_ni)
      drop_i || mark_i |-> idle_o);
`endif

endmodule
