// The late writes that are out: what the shader keeps of bursts that were tested, to be written when it is through.
//
// A beat goes in when it is tested. With the last of a burst the late write is out, if a sample passed; else its beats are
// forgotten. The shader answers for each that is out, in order. The oldest is written, a beat in a cycle of write_i, while
// the beat before the test waits for it: docs/units/early_z.md.

module z_late_writes
  import raster_pkg::*;
#(
  /// Late writes that may be out, 1 or more.
  parameter int unsigned Queue = 16,
  /// Bits of the number of a line in its part of the cache.
  parameter int unsigned LineIndexBits = 7
) (
  input  logic                                    clk_i,
  input  logic                                    rst_ni,

  // A beat of a late draw is tested.
  input  logic                                    beat_i,
  input  logic                                    first_i,
  input  logic                                    last_i,
  input  logic [TestWidth-1:0] [QuadIndexBits-1:0] index_i,
  input  logic [TestWidth-1:0] [QuadMaskBits-1:0] passed_i,
  input  logic [TestWidth-1:0] [3:0] [CodeBits-1:0] codes_i,
  // The lines of its burst.
  input  logic [ZParts-1:0]                       touched_i,
  input  logic [ZParts-1:0] [LineIndexBits-1:0]   line_index_i,

  // The shader is through with the oldest that it has not answered for: what it keeps, by quad of the tile.
  input  logic                                    answer_i,
  input  logic [TileQuads-1:0] [QuadMaskBits-1:0] keep_i,

  // The burst that comes to the test, when it comes there; load_i is a first beat's.
  input  logic                                    load_i,
  input  logic                                    next_late_i,
  input  logic [ZParts-1:0]                       next_touched_i,
  input  logic [ZParts-1:0] [LineIndexBits-1:0]   next_line_index_i,
  // Late writes go before it.
  output logic                                    blocked_o,

  // Write, if the shader has answered.
  input  logic                                    write_i,
  output logic                                    write_o,
  output logic [ZParts-1:0]                       write_part_o,
  output logic [ZParts-1:0] [LineIndexBits-1:0]   write_line_o,
  output logic [TileQuads-1:0] [3:0]              write_sample_o,
  output logic [TileQuads-1:0] [3:0] [CodeBits-1:0] write_codes_o,

  output logic                                    empty_o
);

  localparam int unsigned Beats = TileQuads / TestWidth;
  localparam int unsigned Words = (Queue + 1) * Beats; // the beats of the burst that is tested, too
  localparam int unsigned PlaceBits = Words > 1 ? $clog2(Words) : 1;
  localparam int unsigned ItemBits = Queue > 1 ? $clog2(Queue) : 1;
  localparam int unsigned CountBits = $clog2(Queue + 1);

  typedef logic [PlaceBits-1:0] word_t;
  typedef logic [ItemBits-1:0]  slot_t;
  typedef logic [CountBits-1:0] count_t;

  typedef struct packed {
    logic                                      last;
    logic [TestWidth-1:0] [QuadIndexBits-1:0]  index;
    logic [TestWidth-1:0] [QuadMaskBits-1:0]   passed;
    logic [TestWidth-1:0] [3:0] [CodeBits-1:0] codes;
  } beat_t;

  function automatic word_t next_word(word_t word);
    return word == word_t'(Words - 1) ? '0 : word + word_t'(1);
  endfunction
  function automatic slot_t next_slot(slot_t slot);
    return slot == slot_t'(Queue - 1) ? '0 : slot + slot_t'(1);
  endfunction

  // What is out: the lines of each, and the beats. A burst of which nothing passed goes where it began again.
  logic [Queue-1:0] [ZParts-1:0]                    touched_q;
  logic [Queue-1:0] [ZParts-1:0] [LineIndexBits-1:0] line_index_q;
  slot_t  oldest_q, free_q;
  count_t count_q;
  logic   passed_q, passed, push, pop;
  word_t  store_q, begin_q, fetch_q, store;

  assign passed = (~first_i & passed_q) | (passed_i != '0);
  assign push   = beat_i & last_i & passed;
  assign store  = first_i ? begin_q : store_q;

  always_ff @(posedge clk_i) begin
    if (beat_i) begin
      passed_q <= passed;
      store_q  <= next_word(store);
    end
  end

  always_ff @(posedge clk_i) begin
    if (push) begin
      touched_q[free_q]    <= touched_i;
      line_index_q[free_q] <= line_index_i;
    end
  end

  // The next beat to write is at the memory's output long before the shader answers for its burst.
  beat_t stored, next_beat;
  logic  next_valid_q, fetch;

  assign fetch  = (~next_valid_q | write_o) & (fetch_q != begin_q);
  assign stored = '{last: last_i, index: index_i, passed: passed_i, codes: codes_i};

  sync_ram #(
    .Width ($bits(beat_t)),
    .Depth (Words > 1 ? Words : 2)
  ) u_beats (
    .clk_i           (clk_i),
    .write_i         (beat_i),
    .write_address_i (store),
    .data_i          (stored),
    .read_i          (fetch),
    .read_address_i  (fetch_q),
    .data_o          (next_beat)
  );

  logic                                    answered;
  logic [TileQuads-1:0] [QuadMaskBits-1:0] keep;

  memory_fifo #(
    .Width (TileQuads * QuadMaskBits),
    .Slots (Queue > 1 ? Queue : 2)
  ) u_answers (
    .clk_i       (clk_i),
    .rst_ni      (rst_ni),
    .push_i      (answer_i),
    .data_i      (keep_i),
    .pop_valid_o (answered),
    .pop_ready_i (pop),
    .data_o      (keep)
  );

  assign write_o = write_i & answered;
  assign pop     = write_o & next_beat.last;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      oldest_q     <= '0;
      free_q       <= '0;
      count_q      <= '0;
      begin_q      <= '0;
      fetch_q      <= '0;
      next_valid_q <= 1'b0;
    end else begin
      count_q      <= count_q + count_t'(push) - count_t'(pop);
      next_valid_q <= fetch | (next_valid_q & ~write_o);
      if (push) begin
        free_q  <= next_slot(free_q);
        begin_q <= next_word(store);
      end
      if (pop) begin
        oldest_q <= next_slot(oldest_q);
      end
      if (fetch) begin
        fetch_q <= next_word(fetch_q);
      end
    end
  end

  // Which of them the burst before the test has to wait for: those that write to one of its lines. They are looked up as
  // it comes there, among them the one that goes out in that cycle.
  logic [Queue-1:0] meets, meets_q;
  logic             late_q, full_q;

  function automatic logic meet(logic [ZParts-1:0] touched,
                                logic [ZParts-1:0] [LineIndexBits-1:0] line_index);
    meet = 1'b0;
    for (int unsigned p = 0; p < ZParts; p++) begin
      meet |= touched[p] & next_touched_i[p] & (line_index[p] == next_line_index_i[p]);
    end
  endfunction

  logic [Queue-1:0] out_q; // by slot

  always_comb begin
    meets = meets_q;
    if (load_i) begin
      for (int unsigned i = 0; i < Queue; i++) begin
        meets[i] = out_q[i] & meet(touched_q[i], line_index_q[i]);
      end
      if (push) begin
        meets[free_q] = meet(touched_i, line_index_i);
      end
    end
    if (pop) begin
      meets[oldest_q] = 1'b0;
    end
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      meets_q <= '0;
      out_q   <= '0;
      late_q  <= 1'b0;
    end else begin
      meets_q <= meets;
      if (load_i) begin
        late_q <= next_late_i;
      end
      if (pop) begin
        out_q[oldest_q] <= 1'b0;
      end
      if (push) begin
        out_q[free_q] <= 1'b1;
      end
    end
  end

  assign full_q    = count_q == count_t'(Queue);
  assign blocked_o = (meets_q != '0) | (late_q & full_q);
  assign empty_o   = count_q == '0;

  // Where the samples of a beat go.
  always_comb begin
    write_sample_o = '0;
    write_codes_o  = '0;
    write_part_o   = '0;
    for (int unsigned v = 0; v < TestWidth; v++) begin
      if (write_o && next_beat.passed[v] != '0) begin
        write_codes_o[next_beat.index[v]]  = next_beat.codes[v];
        write_sample_o[next_beat.index[v]] = next_beat.passed[v] & keep[next_beat.index[v]];
      end
    end
    for (int unsigned p = 0; p < ZParts; p++) begin
      write_part_o[p] = write_sample_o[p*(TileQuads/ZParts)+:TileQuads/ZParts] != '0;
    end
  end
  assign write_line_o = line_index_q[oldest_q];

`ifndef SYNTHESIS
  BeatBeforeWrite: assert property (@(posedge clk_i) disable iff (!rst_ni)
      write_o |-> next_valid_q)
  else $error("a late write that is answered for has no beat");
  RoomForPush: assert property (@(posedge clk_i) disable iff (!rst_ni)
      push |-> count_q != count_t'(Queue))
  else $error("more late writes are out than the queue holds");
  // Those that the shader has not answered for.
  int unsigned unanswered_q;
  always_ff @(posedge clk_i) begin
    unanswered_q <= !rst_ni ? 0 : unanswered_q + 32'(push) - 32'(answer_i);
  end
  AnswerForOneThatIsOut: assert property (@(posedge clk_i) disable iff (!rst_ni)
      answer_i |-> unanswered_q != 0)
  else $error("the shader answers for a late write that is not out");
`endif

endmodule
