// The test of the z cache: the codes of its lines, fill buffers, write buffer, and the comparison.
//
// A beat waits in the test register, the codes of its lines read, until what its burst misses is there. In that cycle b
// it is tested; if it is the first of a burst that misses, lines move: the old one to the write buffer, the new one,
// with what the beat writes, to the banks. All later beats see it: banks forward what is written.

module z_test
  import raster_pkg::*;
  import z_codec_pkg::*;
#(
  /// Bursts between the lookup and the end of their test, 2 or more.
  parameter int unsigned PendingDepth = 32,
  /// Bursts in the output FIFO, 2 or more.
  parameter int unsigned FifoDepth = 16,
  /// 0: inner of beat_i is 0, and takes no memory.
  parameter bit InnerCoverage = 1'b0,
  /// Lines of the cache, a power of two, at least ZParts * Ways.
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
  /// Tiles of all surfaces, 2 or more.
  parameter int unsigned MemoryTiles = 1024,
  /// 1: says what each burst leaves stored, for hi_z. 0: update_valid_o and update_o are 0.
  parameter bit HiZ = 1'b0,
  /// 1: lines are coded in memory.
  parameter bit Compression = 1'b0,
  /// Late writes that may be out; 0: no draw writes late.
  parameter int unsigned LateQueue = 0,
  localparam int unsigned TileBits = $clog2(MemoryTiles),
  localparam int unsigned PartLines = Lines / ZParts,
  localparam int unsigned PartLineBits = PartLines > 1 ? $clog2(PartLines) : 1,
  localparam int unsigned PendingBits = $clog2(PendingDepth),
  localparam int unsigned FillBits = 8 * (ReadBytes < LineBytes ? ReadBytes : LineBytes),
  localparam int unsigned WriteBits = 8 * (WriteBytes < LineBytes ? WriteBytes : LineBytes)
) (
  input  logic                                   clk_i,
  input  logic                                   rst_ni,

  // What the lookup knows of a burst, long before its first beat comes.
  input  logic                                   found_i,
  input  logic [PendingBits-1:0]                 found_burst_i,
  input  logic [ZParts-1:0]                      touched_i,
  input  logic [ZParts-1:0]                      missed_i,
  input  logic [ZParts-1:0]                      sure_i,
  input  logic [ZParts-1:0] [PartLineBits-1:0]   line_index_i,
  input  logic [ZParts-1:0]                      victim_i,
  input  logic [ZParts-1:0] [TileBits-1:0]       victim_tile_i,
  input  logic [ZParts-1:0]                      victim_half_i,
  // Of the same burst, some time later: all parts are resolved.
  input  logic                                   resolved_i,
  input  logic [ZParts-1:0]                      fetched_i,

  // Beats with their interpolated codes, and the state of the draw.
  input  logic                                   beat_valid_i,
  output logic                                   beat_ready_o,
  input  logic                                   first_i,
  input  logic [PendingBits-1:0]                 burst_i,
  input  logic                                   touches_i,
  input  logic                                   test_i,
  input  logic                                   write_i,
  input  logic [FuncBits-1:0]                    func_i,
  input  logic [CodeBits-1:0]                    clear_code_i,
  input  logic                                   late_i,
  input  logic [CodeBits-1:0]                    min_code_i, // of the triangle, for late draws
  input  logic [CodeBits-1:0]                    max_code_i,
  // depth of all samples; passed means nothing
  input  tested_beat_t                           beat_i,

  output logic                                   beat_valid_o,
  input  logic                                   beat_ready_i,
  output tested_beat_t                           beat_o,

  // The shader is through with a burst of a late draw of which a sample passed: for each in order, what it keeps, by quad.
  input  logic                                   answer_i,
  input  logic [TileQuads-1:0] [QuadMaskBits-1:0] keep_i,
  // Nothing else is left to do, and a clear or a flush waits: late writes that are out are done.
  input  logic                                   drain_i,

  // To hi_z, for each burst in order, four cycles after the test of its last beat: the least and the greatest code in each
  // part of the tile in which it has quads. All is 0 if its draw does not touch depth.
  output logic                                   update_valid_o,
  output hi_z_update_t                           update_o,

  // To the lookup.
  output logic                                   burst_done_o,
  output logic [ZParts-1:0]                      fill_free_o,
  output logic [ZParts-1:0]                      stored_o,
  output logic [ZParts-1:0] [TileBits-1:0]       stored_tile_o,
  input  logic [ZParts-1:0]                      leaving_part_i,
  input  logic [TileBits-1:0]                    leaving_tile_i,
  output logic                                   leaving_o,

  // Memory: what was asked for, its data, what is written.
  input  logic                                   request_i,
  input  logic                                   request_half_i,
  input  coded_shift_t                           request_shift_i,
  input  logic                                   fill_valid_i,
  input  logic [FillBits-1:0]                    fill_data_i,
  output logic                                   write_valid_o,
  input  logic                                   write_ready_i,
  output logic [LineBits-1:0]                    write_line_o,
  output logic                                   write_half_o,
  output coded_shift_t                           write_shift_o,
  output logic                                   write_last_o,
  output logic [WriteBits-1:0]                   write_data_o,
  output logic [ZParts-1:0]                      line_written_o,
  output logic [TileBits-1:0]                    line_written_tile_o,

  // Flush: looks at a slot in each cycle of scan_i until it may go on. inspect_i: the next cycle may look at a slot.
  input  logic                                   scan_i,
  input  logic [ZParts-1:0]                      scan_part_i,
  input  logic [PartLineBits-1:0]                scan_line_i,
  input  logic [PartLineBits-1:0]                scan_next_line_i,
  input  logic [ZParts-1:0] [TileBits-1:0]       scan_tile_i,
  input  logic [ZParts-1:0]                      scan_half_i,
  output logic                                   scan_done_o,

  // Clear: slots of a set that hold nothing any more.
  input  logic                                   drop_i,
  input  logic [PartLineBits-1:0]                drop_line_i,   // the first of the set
  input  logic [ZParts-1:0] [Ways-1:0]           dropped_i,

  output logic                                   written_o,     // the write buffer is empty
  output z_test_activity_e                       activity_o,
  output logic                                   idle_o
);

  localparam int unsigned TestBeats = TileQuads / TestWidth;
  localparam int unsigned BurstCountBits = $clog2(PendingDepth + 1);
  localparam int unsigned BufferCountBits = $clog2(WriteBuffers + 1);
  localparam int unsigned FifoCountBits = $clog2(FifoDepth + 1);

  typedef logic [BurstCountBits-1:0]    burst_count_t;
  typedef logic [BufferCountBits-1:0]   buffer_count_t;
  typedef logic [FifoCountBits-1:0]     fifo_count_t;

  typedef struct packed {
    logic [ZParts-1:0]                     touched;
    logic [ZParts-1:0]                     missed;
    logic [ZParts-1:0]                     sure;
    logic [ZParts-1:0] [PartLineBits-1:0]  line_index;
    logic [ZParts-1:0]                     victim;
    logic [ZParts-1:0] [TileBits-1:0]      victim_tile;
    logic [ZParts-1:0]                     victim_half;
  } header_t;

  function automatic logic passes(logic [FuncBits-1:0] func, logic [CodeBits-1:0] code,
                                  logic [CodeBits-1:0] stored);
    return (func[0] && code < stored) || (func[1] && code == stored)
           || (func[2] && code > stored);
  endfunction

  // Headers of the bursts, and which of their victims have yet to leave.
  header_t           headers_q [PendingDepth];
  logic [ZParts-1:0] fetched_q [PendingDepth];
  logic [PendingDepth-1:0] [ZParts-1:0] leaving_q;

  logic    fire, swap;
  logic [PendingBits-1:0] test_burst_q;

  always_ff @(posedge clk_i) begin
    if (found_i) begin
      headers_q[found_burst_i] <= '{
        touched: touched_i, missed: missed_i, sure: sure_i, line_index: line_index_i,
        victim: victim_i, victim_tile: victim_tile_i, victim_half: victim_half_i};
    end
    if (resolved_i) begin
      fetched_q[found_burst_i] <= fetched_i;
    end
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      leaving_q <= '0;
    end else begin
      if (swap) begin
        leaving_q[test_burst_q] <= '0;
      end
      if (found_i) begin
        leaving_q[found_burst_i] <= missed_i & victim_i;
      end
    end
  end

  // The test register. Codes of its lines are read as it is loaded.
  logic         valid_q, first_q, touches_q, test_q, write_q, late_q;
  logic [CodeBits-1:0] min_code_q, max_code_q;
  logic [FuncBits-1:0] func_q;
  logic [CodeBits-1:0] clear_code_q;
  tested_beat_t beat_q;
  logic         load;

  assign beat_ready_o = ~valid_q | fire;
  assign load         = beat_valid_i & beat_ready_o;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q <= 1'b0;
    end else begin
      valid_q <= load | (valid_q & ~fire);
    end
  end

  always_ff @(posedge clk_i) begin
    if (load) begin
      first_q      <= first_i;
      test_burst_q <= burst_i;
      touches_q    <= touches_i;
      test_q       <= test_i;
      write_q      <= write_i;
      func_q       <= func_i;
      clear_code_q <= clear_code_i;
      late_q       <= late_i;
      min_code_q   <= min_code_i;
      max_code_q   <= max_code_i;
      beat_q       <= beat_i;
    end
  end

  header_t           header, next_header;
  logic [ZParts-1:0] fetched, dirty_victim;
  logic [ZParts-1:0] [PartLines-1:0] dirty_q;
  assign header      = headers_q[test_burst_q];
  assign next_header = headers_q[burst_i];
  assign fetched     = fetched_q[test_burst_q] & header.missed;

  for (genvar p = 0; p < ZParts; p++) begin : gen_dirty_victim
    assign dirty_victim[p] = header.missed[p] & header.victim[p] & dirty_q[p][header.line_index[p]];
  end

  logic unused_next_header;
  assign unused_next_header = ^{next_header.touched, header.touched, next_header.missed,
                                next_header.sure, next_header.victim, next_header.victim_tile,
                                next_header.victim_half};

  // Late writes, which go before the beat in the test register or, where it is empty, before a clear or the flush.
  logic                                      blocked, writes_late, late_empty;
  logic [ZParts-1:0]                         late_part, held;
  logic [ZParts-1:0] [PartLineBits-1:0]      late_line;
  logic [TileQuads-1:0] [3:0]                late_sample;
  logic [TileQuads-1:0] [3:0] [CodeBits-1:0] late_codes;

  assign writes_late = valid_q ? first_q & blocked : drain_i & ~late_empty;

  // When the first beat of a burst may be tested.
  burst_count_t  resolved_q;                  // bursts, not yet begun
  buffer_count_t buffers_left, wanted_buffers; // write buffers: free; for this burst
  fifo_count_t   fifo_free_q;                 // bursts for which the output FIFO has room

  always_comb begin
    wanted_buffers = '0;
    for (int unsigned p = 0; p < ZParts; p++) begin
      wanted_buffers += buffer_count_t'(dirty_victim[p]);
    end
  end

  logic filled, there, buffers_free, ready_to_begin;
  assign there          = resolved_q != '0 && filled;
  assign buffers_free   = buffers_left >= wanted_buffers;
  assign ready_to_begin = ~blocked && there && buffers_free && fifo_free_q != '0;
  assign activity_o     = writes_late     ? ZTestLate
                          : !valid_q      ? ZTestNoBurst
                          : fire          ? ZTestBusy
                          : !there        ? ZTestFill
                          : !buffers_free ? ZTestWriteBuffer : ZTestNoCredit;
  assign fire           = valid_q & (~first_q | ready_to_begin);
  assign swap           = fire & first_q;
  assign burst_done_o   = fire & beat_q.last;
  assign fill_free_o    = swap ? fetched : '0;

  logic last_popped;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      resolved_q  <= '0;
      fifo_free_q <= fifo_count_t'(FifoDepth);
    end else begin
      resolved_q  <= resolved_q + burst_count_t'(resolved_i) - burst_count_t'(swap);
      fifo_free_q <= fifo_free_q + fifo_count_t'(last_popped) - fifo_count_t'(swap);
    end
  end

  quads_t [ZParts-1:0] fills;

  z_fill_buffers #(
    .MissesInFlight (MissesInFlight),
    .ReadBytes      (ReadBytes),
    .Compression    (Compression)
  ) u_fill_buffers (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .request_i       (request_i),
    .request_half_i  (request_half_i),
    .request_shift_i (request_shift_i),
    .fill_valid_i    (fill_valid_i),
    .fill_data_i     (fill_data_i),
    .take_i          (swap),
    .wanted_i        (fetched),
    .there_o         (filled),
    .lines_o         (fills)
  );

  // The banks, and the lines as the beat sees them. A quad of which a sample is written is written whole: the others
  // are as they were read.
  quads_t [ZParts-1:0] stored, line;
  logic [TileQuads-1:0] [3:0] [CodeBits-1:0] updated;
  logic [TileQuads-1:0] [3:0] wrote;
  logic [ZParts-1:0]   wrote_part;

  for (genvar p = 0; p < ZParts; p++) begin : gen_part
    logic [PartLineBits-1:0] read_line;
    assign read_line = load ? next_header.line_index[p] : scan_next_line_i;

    for (genvar q = 0; q < PartQuads; q++) begin : gen_bank
      localparam int unsigned Quad = p * PartQuads + q;
      logic writes_quad;
      assign writes_quad = |wrote[Quad] | (swap & header.missed[p]);

      z_bank #(
        .Lines (PartLines),
        .Late  (LateQueue != 0)
      ) u_bank (
        .clk_i        (clk_i),
        .read_i       (load | ~valid_q),
        .read_line_i  (read_line),
        .codes_o      (stored[p][q]),
        .write_i      (late_part[p] ? late_sample[Quad] : {4{writes_quad}}),
        .held_i       (held[p]),
        .write_line_i (late_part[p] ? late_line[p] : header.line_index[p]),
        .codes_i      (late_part[p] ? late_codes[Quad] : updated[Quad])
      );
    end

    always_comb begin
      line[p] = stored[p];
      if (first_q && header.missed[p]) begin
        if (fetched[p]) begin
          line[p] = fills[p];
        end else begin
          line[p] = {4 * PartQuads{clear_code_q}};
        end
      end
    end

    assign wrote_part[p] = |wrote[p*PartQuads+:PartQuads];
  end

  // The comparison, and where its results go. Nothing of it is of use in a cycle without a test.
  tested_beat_t result_d;
  logic [TileQuads-1:0] [3:0] [CodeBits-1:0] tile_codes; // of the whole tile, by quad

  assign tile_codes = line;

  // Whatever the lines of these hold: nobody has asked for them.
  logic [TileQuads-1:0] sure_quads;
  for (genvar p = 0; p < ZParts; p++) begin : gen_sure
    assign sure_quads[p*PartQuads+:PartQuads] = {PartQuads{header.sure[p]}};
  end

  always_comb begin
    automatic logic [3:0] [CodeBits-1:0] old = '0;
    automatic logic [CodeBits-1:0] code = '0;
    automatic logic pass = 1'b0;
    result_d = beat_q;
    wrote    = '0;
    updated  = line;
    if (fire) begin
      for (int unsigned v = 0; v < TestWidth; v++) begin
        old = tile_codes[beat_q.index[v]];
        for (int unsigned s = 0; s < 4; s++) begin
          code = beat_q.depth[4*v+s];
          pass = 1'b0;
          if (beat_q.mask[v][s]) begin
            pass = passes(func_q, code, old[s]) | ~test_q | (func_q == '1)
                   | sure_quads[beat_q.index[v]];
            if (pass && touches_q && write_q && !late_q) begin
              wrote[beat_q.index[v]][s]   = 1'b1;
              updated[beat_q.index[v]][s] = code;
            end
          end else begin
            result_d.depth[4*v+s] = '0;
          end
          result_d.passed[v][s] = pass;
        end
      end
    end
  end

  if (LateQueue != 0) begin : gen_late
    logic writes;

    z_late_writes #(
      .Queue         (LateQueue),
      .LineIndexBits (PartLineBits)
    ) u_late_writes (
      .clk_i             (clk_i),
      .rst_ni            (rst_ni),
      .beat_i            (fire & late_q),
      .first_i           (first_q),
      .last_i            (beat_q.last),
      .index_i           (beat_q.index),
      .passed_i          (result_d.passed),
      .codes_i           (result_d.depth),
      .touched_i         (header.touched),
      .line_index_i      (header.line_index),
      .answer_i          (answer_i),
      .keep_i            (keep_i),
      .load_i            (load & first_i),
      .next_late_i       (late_i),
      .next_touched_i    (next_header.touched),
      .next_line_index_i (next_header.line_index),
      .blocked_o         (blocked),
      .write_i           (writes_late),
      .write_o           (writes),
      .write_part_o      (late_part),
      .write_line_o      (late_line),
      .write_sample_o    (late_sample),
      .write_codes_o     (late_codes),
      .empty_o           (late_empty)
    );

    for (genvar p = 0; p < ZParts; p++) begin : gen_held
      assign held[p] = writes & valid_q & header.touched[p]
                       & (late_line[p] == header.line_index[p]);
    end
  end else begin : gen_no_late
    assign blocked    = 1'b0;
    assign late_empty = 1'b1;
    assign {late_part, held, late_line, late_sample} = '0;
    assign late_codes = '0;

    logic unused_late;
    assign unused_late = ^{answer_i, keep_i, late_q};
  end

  // What the burst leaves: its last beat sees all that the others have written.
  if (HiZ) begin : gen_update
    // In which the burst has quads: of the beats up to this one; before it.
    logic [ZParts-1:0] parts, parts_q;

    always_comb begin
      parts = first_q ? '0 : parts_q;
      for (int unsigned v = 0; v < TestWidth; v++) begin
        for (int unsigned p = 0; p < ZParts; p++) begin
          parts[p] |= beat_q.mask[v] != '0 && int'(beat_q.index[v]) / PartQuads == p;
        end
      end
    end

    always_ff @(posedge clk_i) begin
      if (fire) begin
        parts_q <= parts;
      end
    end

    z_extremes u_extremes (
      .clk_i          (clk_i),
      .rst_ni         (rst_ni),
      .valid_i        (burst_done_o),
      .parts_i        (touches_q ? parts : '0),
      .codes_i        (updated),
      .least_i        (late_q && func_q[0] ? min_code_q : '1),
      .most_i         (late_q && func_q[2] ? max_code_q : '0),
      .update_valid_o (update_valid_o),
      .update_o       (update_o)
    );
  end else begin : gen_no_update
    assign update_valid_o = 1'b0;
    assign update_o       = '0;

    logic unused_update;
    assign unused_update = ^{min_code_q, max_code_q};
  end

  // Dirty slots.
  always_ff @(posedge clk_i) begin
    for (int unsigned p = 0; p < ZParts; p++) begin
      if (!rst_ni) begin
        dirty_q[p] <= '0;
      end else if (fire) begin
        if (wrote_part[p]) begin
          dirty_q[p][header.line_index[p]] <= 1'b1;
        end else if (first_q && header.missed[p]) begin
          dirty_q[p][header.line_index[p]] <= 1'b0;
        end
      end else if (late_part[p]) begin
        dirty_q[p][late_line[p]] <= 1'b1;
      end else if (scan_i && scan_part_i[p] && scan_done_o) begin
        dirty_q[p][scan_line_i] <= 1'b0;
      end else if (drop_i) begin
        for (int unsigned w = 0; w < Ways; w++) begin
          if (dropped_i[p][w]) begin
            dirty_q[p][int'(drop_line_i)+w] <= 1'b0;
          end
        end
      end
    end
  end

  // The write buffer: victims of a burst in order of parts, or a line of the flush.
  logic              scan_dirty;
  logic [ZParts-1:0] push;
  always_comb begin
    scan_dirty = 1'b0;
    for (int unsigned p = 0; p < ZParts; p++) begin
      scan_dirty |= scan_part_i[p] & dirty_q[p][scan_line_i];
    end
  end
  assign scan_done_o = ~scan_dirty | (buffers_left != '0);
  assign push        = swap ? dirty_victim : scan_i && scan_dirty && scan_done_o ? scan_part_i : '0;

  logic [ZParts-1:0] [TileBits-1:0] old_tile;
  logic [ZParts-1:0]                old_half;
  logic                             leaving_buffer;
  assign old_tile      = swap ? header.victim_tile : scan_tile_i;
  assign old_half      = swap ? header.victim_half : scan_half_i;
  assign stored_o      = push;
  assign stored_tile_o = old_tile;

  z_write_buffer #(
    .WriteBuffers (WriteBuffers),
    .WriteBytes   (WriteBytes),
    .MemoryTiles  (MemoryTiles),
    .Compression  (Compression)
  ) u_write_buffer (
    .clk_i          (clk_i),
    .rst_ni         (rst_ni),
    .push_i         (push),
    .tile_i         (old_tile),
    .half_i         (old_half),
    .lines_i        (stored),
    .free_o         (buffers_left),
    .leaving_part_i (leaving_part_i),
    .leaving_tile_i (leaving_tile_i),
    .leaving_o      (leaving_buffer),
    .write_valid_o  (write_valid_o),
    .write_ready_i  (write_ready_i),
    .write_line_o   (write_line_o),
    .write_half_o   (write_half_o),
    .write_shift_o  (write_shift_o),
    .write_last_o   (write_last_o),
    .write_data_o   (write_data_o),
    .written_o      (line_written_o),
    .written_tile_o (line_written_tile_o)
  );

  // Lines on their way out: victims of bursts that are not tested, and what is not yet written.
  always_comb begin
    leaving_o = leaving_buffer;
    if (leaving_part_i != '0) begin
      for (int unsigned i = 0; i < PendingDepth; i++) begin
        for (int unsigned p = 0; p < ZParts; p++) begin
          leaving_o |= leaving_part_i[p] && leaving_q[i][p]
                       && headers_q[i].victim_tile[p] == leaving_tile_i;
        end
      end
    end
  end

  // Results. The FIFO has room for whole bursts, so the credit of a burst is credit for its beats.
  logic         result_q, reserve_ready, unused_empty;
  tested_beat_t result_beat_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      result_q <= 1'b0;
    end else begin
      result_q <= fire;
    end
  end

  always_ff @(posedge clk_i) begin
    if (fire) begin
      result_beat_q <= result_d;
    end
  end

  credit_fifo #(
    .Width    ($bits(tested_beat_t)),
    .Zeros    (InnerCoverage ? 0 : TestWidth * QuadMaskBits),
    .Depth    (FifoDepth * TestBeats),
    .InMemory (1'b1)
  ) u_fifo (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .reserve_ready_o (reserve_ready),
    .reserve_i       (fire),
    .push_i          (result_q),
    .data_i          (result_beat_q),
    .pop_valid_o     (beat_valid_o),
    .pop_ready_i     (beat_ready_i),
    .data_o          (beat_o),
    .empty_o         (unused_empty)
  );

  // Both count bursts here, not beats.
  logic unused_fifo;
  assign unused_fifo = reserve_ready ^ unused_empty;

  assign last_popped = beat_valid_o & beat_ready_i & beat_o.last;
  assign written_o   = buffers_left == buffer_count_t'(WriteBuffers);
  assign idle_o      = fifo_free_q == fifo_count_t'(FifoDepth) && written_o && late_empty;

endmodule
