// Depth test of the quads of a tile, in front of the fragment shader: lookup of their lines in the z cache,
// interpolation, test and write.
//
// Three units in a row. z_lookup takes the beats of a burst and asks memory for what the cache lacks. depth_interpolator
// computes depth while memory answers. z_test compares and writes where all is there. Between them are the pending
// store (z_pending) and a FIFO with credits, so neither the lookup nor the interpolator ever stalls in mid-pipe.
//
// The first beat of a burst is taken in cycle f, tested not before f + 5 + InterpolatorLatency, and leaves 2 cycles
// after its test.

module early_z
  import raster_pkg::*;
  import depth_pkg::*;
  import z_codec_pkg::*;
  import square_pkg::*;
#(
  /// Bursts between the lookup and the end of their test, 2 or more.
  parameter int unsigned PendingDepth = 32,
  /// Bursts in the output FIFO, 2 or more: a tile's worth of beats each.
  parameter int unsigned FifoDepth = 16,
  /// Interpolator of depth, 0 plane or 1 barycentric.
  parameter int unsigned Interpolator = Plane,
  /// Cycles to interpolate depth, 12 or more.
  parameter int unsigned InterpolatorLatency = 12,
  /// Pixels of triangles that are drawn by squares: 0 none are, 1 outer, 2 inner. Outer ones need barycentric weights.
  parameter int unsigned Conservative = Centres,
  /// How much larger than the pixel its square is on each side, in sub-pixels.
  parameter int unsigned Uncertainty = 0,
  /// 1: says which pixels of outer triangles these fill; needs barycentric weights. 0: inner of beat_o is 0.
  parameter bit InnerCoverage = 1'b0,
  /// Lines of the z cache, a power of two, at least ZParts * Ways.
  parameter int unsigned Lines = 128,
  /// Lines of a set: a power of two.
  parameter int unsigned Ways = 4,
  /// Fill buffers, ZParts or more: a line each.
  parameter int unsigned MissesInFlight = 16,
  /// Lines on their way to memory, ZParts or more.
  parameter int unsigned WriteBuffers = 4,
  /// Bytes that memory reads in a cycle: a power of two.
  parameter int unsigned ReadBytes = 64,
  /// Bytes that memory writes in a cycle: a power of two.
  parameter int unsigned WriteBytes = 64,
  /// Tiles that a clear marks in a cycle: a power of two.
  parameter int unsigned ClearTiles = 64,
  /// Tiles of all surfaces, 2 or more: a bit each for each part.
  parameter int unsigned MemoryTiles = 1024,
  /// 1: says what each burst leaves stored, for hi_z. 0: update_valid_o and update_o are 0.
  parameter bit HiZ = 1'b0,
  /// 1: lines are coded in memory. 0: read_shift_o and write_shift_o are 0.
  parameter bit Compression = 1'b0,
  /// Late writes that may be out, 1 or more; 0: no draw writes late, and late_valid_i is 0.
  parameter int unsigned LateQueue = 0,
  localparam int unsigned TileBits = $clog2(MemoryTiles),
  localparam int unsigned FillBits = 8 * (ReadBytes < LineBytes ? ReadBytes : LineBytes),
  localparam int unsigned WriteBits = 8 * (WriteBytes < LineBytes ? WriteBytes : LineBytes)
) (
  input  logic                 clk_i,
  input  logic                 rst_ni,

  // Triangles: written before their first beat comes.
  input  logic                 slot_write_i,
  input  logic [SlotBits-1:0]  slot_i,
  input  depth_equation_t      slot_equation_i,
  input  draw_state_t          slot_state_i,

  // quad_generator: the beats of a burst come without a gap.
  input  logic                 beat_valid_i,
  output logic                 beat_ready_o,
  input  quad_beat_t           beat_i,

  // fragment shader
  output logic                 beat_valid_o,
  input  logic                 beat_ready_i,
  output tested_beat_t         beat_o,

  // What the shader keeps of a burst of a late draw of which a sample passed: by quad of the tile, for each in order, a
  // cycle or more after its last beat.
  input  logic                 late_valid_i,
  input  logic [TileQuads-1:0] [QuadMaskBits-1:0] late_keep_i,

  // hi_z: what a burst leaves stored, for each in order, four cycles after the test of its last beat.
  output logic                 update_valid_o,
  output hi_z_update_t         update_o,

  // Memory reads: requests, and their data in the same order. A line has 2 bytes a sample (half) or 4; coded, it has so
  // many >> shift.
  output logic                 read_valid_o,
  input  logic                 read_ready_i,
  output logic [LineBits-1:0]  read_line_o,
  output logic                 read_half_o,
  output coded_shift_t         read_shift_o,
  input  logic                 fill_valid_i,
  input  logic [FillBits-1:0]  fill_data_i,

  // Memory writes, beat by beat.
  output logic                 write_valid_o,
  input  logic                 write_ready_i,
  output logic [LineBits-1:0]  write_line_o,
  output logic                 write_half_o,
  output coded_shift_t         write_shift_o,
  output logic                 write_last_o,
  output logic [WriteBits-1:0] write_data_o,

  // Nothing is left to do. A clear or a flush is taken in such a cycle; done is high in the first cycle after it.
  output logic                 idle_o,
  input  logic                 clear_valid_i,
  input  logic [TileBits-1:0]  clear_first_i,
  input  logic [TileBits-1:0]  clear_last_i,
  output logic                 clear_done_o,
  input  logic                 flush_i,
  output logic                 flush_done_o,

  // What the cycle is spent on, by the two stages.
  output z_lookup_activity_e   lookup_activity_o,
  output z_test_activity_e    activity_o
);

  localparam int unsigned PartLines = Lines / ZParts;
  localparam int unsigned PartLineBits = PartLines > 1 ? $clog2(PartLines) : 1;
  localparam int unsigned PendingBits = $clog2(PendingDepth);

  localparam logic [FormatBits-1:0] Unorm16 = 1;
  localparam logic [FuncBits-1:0] Never = 0;
  localparam logic [FuncBits-1:0] Always = '1;

  typedef logic [PendingBits-1:0] burst_t;

  // Triangles, as each side needs them.
  typedef struct packed {
    logic                     touches;
    logic                     half;
    logic [TileBits-1:0]      first_tile;
    logic [TileColumnBits-1:0] tiles_x;
  } lookup_state_t;

  typedef struct packed {
    logic                  touches;
    logic                  test;
    logic                  write;
    logic [FuncBits-1:0]   func;
    logic [CodeBits-1:0]   clear_code;
    logic                  late;
    logic [CodeBits-1:0]   min_code;
    logic [CodeBits-1:0]   max_code;
  } test_state_t;

  // Of the depth equation what the interpolator takes.
  localparam int unsigned OwnBits = Interpolator == Plane ? PlaneBits : BarycentricBits;
  localparam int unsigned EquationBits = OwnBits + CommonBits;

  typedef struct packed {
    logic [EquationBits-1:0] equation;
    logic [FormatBits-1:0]   format;
    test_state_t             state;
  } triangle_t;

  lookup_state_t write_lookup, lookup_state;
  triangle_t     write_triangle, triangle;
  logic          touches, half, state_read;

  assign touches = slot_state_i.test && slot_state_i.func != Never
                   && (slot_state_i.write || slot_state_i.func != Always);
  assign half    = slot_state_i.format == Unorm16;
  assign write_lookup = '{
    touches:    touches,
    half:       half,
    first_tile: TileBits'(slot_state_i.first_tile),
    tiles_x:    slot_state_i.tiles_x
  };
  logic [EquationBits-1:0] write_equation;
  depth_equation_t         equation;

  if (Interpolator == Plane) begin : gen_plane_equation
    assign write_equation = slot_equation_i[EquationBits-1:0];
    assign equation       = depth_equation_t'(triangle.equation);
  end else begin : gen_barycentric_equation
    assign write_equation = {slot_equation_i[$bits(depth_equation_t)-1-:BarycentricBits],
                             slot_equation_i[CommonBits-1:0]};
    assign equation       = {triangle.equation[CommonBits+:BarycentricBits], {PlaneBits{1'b0}},
                             triangle.equation[CommonBits-1:0]};
  end

  assign write_triangle = '{
    equation: write_equation,
    format:   slot_state_i.format,
    state:    '{
      touches:    touches,
      test:       slot_state_i.test,
      write:      slot_state_i.write,
      func:       slot_state_i.func,
      clear_code: slot_state_i.clear_code,
      late:       slot_state_i.late & (LateQueue != 0),
      min_code:   slot_equation_i.min_code,
      max_code:   slot_equation_i.max_code
    }
  };

  logic unused_fields;
  assign unused_fields = ^{slot_state_i, slot_equation_i};

  sync_ram #(
    .Width ($bits(lookup_state_t)),
    .Depth (2 ** SlotBits)
  ) u_lookup_state (
    .clk_i           (clk_i),
    .write_i         (slot_write_i),
    .write_address_i (slot_i),
    .data_i          (write_lookup),
    .read_i          (state_read),
    .read_address_i  (beat_i.slot),
    .data_o          (lookup_state)
  );

  // Lookup.
  logic                                 first, found, resolved, burst_done, leaving, request;
  burst_t                               burst, found_burst;
  logic [ZParts-1:0]                    touched, missed, sure, fetched, victim, victim_half;
  logic [ZParts-1:0]                    fill_free, stored, leaving_part, slot_half;
  logic [ZParts-1:0] [PartLineBits-1:0] line_index;
  logic [ZParts-1:0] [TileBits-1:0]     victim_tile, stored_tile, slot_tile;
  logic [ZParts-1:0] [Ways-1:0]         dropped;
  logic [TileBits-1:0]                  leaving_tile;
  logic                                 lookup_idle, test_idle, written;
  logic [ZParts-1:0]                    line_written;
  logic [TileBits-1:0]                  line_written_tile;

  logic                                 inspect, drop, mark;
  logic [PartLineBits-1:0]              inspect_line;
  logic [TileBits-1:0]                  clear_first, clear_last, mark_from;

  z_lookup #(
    .PendingDepth   (PendingDepth),
    .Lines          (Lines),
    .Ways           (Ways),
    .MissesInFlight (MissesInFlight),
    .MemoryTiles    (MemoryTiles),
    .ClearTiles     (ClearTiles),
    .Compression    (Compression)
  ) u_lookup (
    .clk_i          (clk_i),
    .rst_ni         (rst_ni),
    .beat_valid_i   (beat_valid_i),
    .beat_ready_o   (beat_ready_o),
    .tile_x_i       (beat_i.tile_x),
    .tile_y_i       (beat_i.tile_y),
    .last_i         (beat_i.last),
    .parts_i        (beat_i.parts),
    .sure_i         (beat_i.sure),
    .first_o        (first),
    .burst_o        (burst),
    .state_read_o   (state_read),
    .touches_i      (lookup_state.touches),
    .half_i         (lookup_state.half),
    .first_tile_i   (lookup_state.first_tile),
    .tiles_x_i      (lookup_state.tiles_x),
    .found_o        (found),
    .found_burst_o  (found_burst),
    .touched_o      (touched),
    .missed_o       (missed),
    .sure_o         (sure),
    .line_index_o   (line_index),
    .victim_o       (victim),
    .victim_tile_o  (victim_tile),
    .victim_half_o  (victim_half),
    .resolved_o     (resolved),
    .fetched_o      (fetched),
    .burst_done_i   (burst_done),
    .fill_free_i    (fill_free),
    .stored_i       (stored),
    .stored_tile_i  (stored_tile),
    .leaving_part_o (leaving_part),
    .leaving_tile_o (leaving_tile),
    .leaving_i      (leaving),
    .read_valid_o   (read_valid_o),
    .read_ready_i   (read_ready_i),
    .read_line_o    (read_line_o),
    .read_half_o    (read_half_o),
    .read_shift_o   (read_shift_o),
    .written_i      (line_written),
    .written_tile_i (line_written_tile),
    .written_shift_i (write_shift_o),
    .inspect_i      (inspect),
    .slot_i         (inspect_line),
    .drop_i         (drop),
    .mark_i         (mark),
    .clear_first_i  (clear_first),
    .clear_last_i   (clear_last),
    .mark_from_i    (mark_from),
    .dropped_o      (dropped),
    .slot_tile_o    (slot_tile),
    .slot_half_o    (slot_half),
    .activity_o     (lookup_activity_o),
    .idle_o         (lookup_idle)
  );

  assign request = read_valid_o & read_ready_i;

  // What travels with the codes.
  typedef struct packed {
    logic                                     first;
    burst_t                                   burst;
    logic [SlotBits-1:0]                      slot;
    logic [TileColumnBits-1:0]                tile_x;
    logic [TileCoordBits-1:0]                 tile_y;
    logic                                     last;
    logic [TestWidth-1:0] [QuadIndexBits-1:0] index;
    logic [TestWidth-1:0] [QuadMaskBits-1:0]  mask;
  } traveller_t;

  traveller_t  issued, issued_q;
  edge_t [1:0] issued_e, issued_e_q;
  logic        pending, codes_ready, issue;

  z_pending #(
    .PendingDepth (PendingDepth)
  ) u_pending (
    .clk_i    (clk_i),
    .rst_ni   (rst_ni),
    .take_i   (beat_valid_i & beat_ready_o),
    .first_i  (first),
    .burst_i  (burst),
    .beat_i   (beat_i),
    .found_i  (found),
    .valid_o  (pending),
    .ready_i  (codes_ready),
    .first_o  (issued.first),
    .last_o   (issued.last),
    .burst_o  (issued.burst),
    .slot_o   (issued.slot),
    .tile_x_o (issued.tile_x),
    .tile_y_o (issued.tile_y),
    .e_o      (issued_e),
    .index_o  (issued.index),
    .mask_o   (issued.mask)
  );

  assign issue = pending & codes_ready; // where the FIFO behind the interpolator has room

  sync_ram #(
    .Width ($bits(triangle_t)),
    .Depth (2 ** SlotBits)
  ) u_triangles (
    .clk_i           (clk_i),
    .write_i         (slot_write_i),
    .write_address_i (slot_i),
    .data_i          (write_triangle),
    .read_i          (issue),
    .read_address_i  (issued.slot),
    .data_o          (triangle)
  );

  typedef struct packed {
    logic [TestWidth-1:0] [QuadMaskBits-1:0] inner;
    traveller_t                              beat;
    test_state_t                             state;
    logic [TestSamples-1:0] [CodeBits-1:0]   codes;
  } coded_t;

  traveller_t  beat_q  [InterpolatorLatency] /*verilator split_var*/;
  test_state_t state_q [InterpolatorLatency] /*verilator split_var*/;
  logic [InterpolatorLatency:0] valid_q; // bit i: i cycles after the first stage

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q <= '0;
    end else begin
      valid_q <= {valid_q[InterpolatorLatency-1:0], issue};
    end
  end

  always_ff @(posedge clk_i) begin
    if (issue) begin
      issued_q   <= issued;
      issued_e_q <= issued_e;
    end
    if (valid_q[0]) begin
      beat_q[0]  <= issued_q;
      state_q[0] <= triangle.state;
    end
  end

  for (genvar i = 1; i < InterpolatorLatency; i++) begin : gen_travel
    always_ff @(posedge clk_i) begin
      if (valid_q[i]) begin
        beat_q[i]  <= beat_q[i-1];
        state_q[i] <= state_q[i-1];
      end
    end
  end

  coded_t coded, coded_out;
  logic   coded_valid, coded_taken, unused_codes_empty;

  depth_interpolator #(
    .Quads         (TestWidth),
    .Interpolator  (Interpolator),
    .Latency       (InterpolatorLatency),
    .Conservative  (Conservative),
    .Uncertainty   (Uncertainty),
    .InnerCoverage (InnerCoverage)
  ) u_interpolator (
    .clk_i      (clk_i),
    .valid_i    (valid_q[0]),
    .format_i   (triangle.format),
    .equation_i (equation),
    .tile_x_i   (issued_q.tile_x),
    .tile_y_i   (issued_q.tile_y),
    .e_i        (issued_e_q),
    .index_i    (issued_q.index),
    .mask_i     (issued_q.mask),
    .code_o     (coded.codes),
    .inner_o    (coded.inner)
  );

  assign coded.beat  = beat_q[InterpolatorLatency-1];
  assign coded.state = state_q[InterpolatorLatency-1];

  // As many as are under way and one, so that a beat can go in every cycle.
  credit_fifo #(
    .Width    ($bits(coded_t)),
    .Zeros    (InnerCoverage ? 0 : TestWidth * QuadMaskBits),
    .Depth    (InterpolatorLatency + 3),
    .InMemory (1'b1)
  ) u_codes (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .reserve_ready_o (codes_ready),
    .reserve_i       (issue),
    .push_i          (valid_q[InterpolatorLatency]),
    .data_i          (coded),
    .pop_valid_o     (coded_valid),
    .pop_ready_i     (coded_taken),
    .data_o          (coded_out),
    .empty_o         (unused_codes_empty)
  );

  // Test.
  tested_beat_t test_beat;
  assign test_beat = '{
    inner:  coded_out.inner,
    slot:   coded_out.beat.slot,
    tile_x: coded_out.beat.tile_x,
    tile_y: coded_out.beat.tile_y,
    last:   coded_out.beat.last,
    index:  coded_out.beat.index,
    mask:   coded_out.beat.mask,
    passed: '0,
    depth:  coded_out.codes
  };

  logic                    scan, scan_done;
  logic [ZParts-1:0]       scan_part;
  logic [PartLineBits-1:0] scan_next_line;

  z_test #(
    .PendingDepth   (PendingDepth),
    .InnerCoverage  (InnerCoverage),
    .FifoDepth      (FifoDepth),
    .Lines          (Lines),
    .Ways           (Ways),
    .MissesInFlight (MissesInFlight),
    .WriteBuffers   (WriteBuffers),
    .ReadBytes      (ReadBytes),
    .WriteBytes     (WriteBytes),
    .MemoryTiles    (MemoryTiles),
    .HiZ            (HiZ),
    .Compression    (Compression),
    .LateQueue      (LateQueue)
  ) u_test (
    .clk_i            (clk_i),
    .rst_ni           (rst_ni),
    .found_i          (found),
    .found_burst_i    (found_burst),
    .touched_i        (touched),
    .missed_i         (missed),
    .sure_i           (sure),
    .line_index_i     (line_index),
    .victim_i         (victim),
    .victim_tile_i    (victim_tile),
    .victim_half_i    (victim_half),
    .resolved_i       (resolved),
    .fetched_i        (fetched),
    .beat_valid_i     (coded_valid),
    .beat_ready_o     (coded_taken),
    .first_i          (coded_out.beat.first),
    .burst_i          (coded_out.beat.burst),
    .touches_i        (coded_out.state.touches),
    .test_i           (coded_out.state.test),
    .write_i          (coded_out.state.write),
    .func_i           (coded_out.state.func),
    .clear_code_i     (coded_out.state.clear_code),
    .late_i           (coded_out.state.late),
    .min_code_i       (coded_out.state.min_code),
    .max_code_i       (coded_out.state.max_code),
    .beat_i           (test_beat),
    .beat_valid_o     (beat_valid_o),
    .beat_ready_i     (beat_ready_i),
    .beat_o           (beat_o),
    .answer_i         (late_valid_i),
    .keep_i           (late_keep_i),
    .drain_i          ((clear_valid_i | flush_i) & lookup_idle),
    .update_valid_o   (update_valid_o),
    .update_o         (update_o),
    .burst_done_o     (burst_done),
    .fill_free_o      (fill_free),
    .stored_o         (stored),
    .stored_tile_o    (stored_tile),
    .leaving_part_i   (leaving_part),
    .leaving_tile_i   (leaving_tile),
    .leaving_o        (leaving),
    .request_i        (request),
    .request_half_i   (read_half_o),
    .request_shift_i  (read_shift_o),
    .fill_valid_i     (fill_valid_i),
    .fill_data_i      (fill_data_i),
    .write_valid_o    (write_valid_o),
    .write_ready_i    (write_ready_i),
    .write_line_o     (write_line_o),
    .write_half_o     (write_half_o),
    .write_shift_o    (write_shift_o),
    .write_last_o     (write_last_o),
    .write_data_o     (write_data_o),
    .line_written_o   (line_written),
    .line_written_tile_o (line_written_tile),
    .scan_i           (scan),
    .scan_part_i      (scan_part),
    .scan_line_i      (inspect_line),
    .scan_next_line_i (scan_next_line),
    .scan_tile_i      (slot_tile),
    .scan_half_i      (slot_half),
    .scan_done_o      (scan_done),
    .drop_i           (drop),
    .drop_line_i      (inspect_line),
    .dropped_i        (dropped),
    .written_o        (written),
    .activity_o       (activity_o),
    .idle_o           (test_idle)
  );

  z_control #(
    .Lines       (Lines),
    .Ways        (Ways),
    .ClearTiles  (ClearTiles),
    .MemoryTiles (MemoryTiles)
  ) u_control (
    .clk_i         (clk_i),
    .rst_ni        (rst_ni),
    .idle_i        (lookup_idle & test_idle),
    .written_i     (written),
    .idle_o        (idle_o),
    .clear_valid_i (clear_valid_i),
    .clear_first_i (clear_first_i),
    .clear_last_i  (clear_last_i),
    .clear_done_o  (clear_done_o),
    .flush_i       (flush_i),
    .flush_done_o  (flush_done_o),
    .inspect_o     (inspect),
    .line_o        (inspect_line),
    .drop_o        (drop),
    .mark_o        (mark),
    .first_o       (clear_first),
    .last_o        (clear_last),
    .mark_from_o   (mark_from),
    .scan_o        (scan),
    .scan_part_o   (scan_part),
    .next_line_o   (scan_next_line),
    .scan_done_i   (scan_done)
  );

`ifndef SYNTHESIS
  // block_walker's slots go round: the one that it writes has no burst under way.
  LookupReadsAnotherSlot: assert property (@(posedge clk_i) disable iff (!rst_ni)
      slot_write_i && state_read |-> slot_i != beat_i.slot)
  else $error("the slot of a burst is written while it is looked up");
  TestReadsAnotherSlot: assert property (@(posedge clk_i) disable iff (!rst_ni)
      slot_write_i && issue |-> slot_i != issued.slot)
  else $error("the slot of a burst is written while it is interpolated");
`endif

endmodule
