// FIFO of bursts: a head that all beats of a burst share, and the beats.
//
// A credit stands for a whole burst: one is taken by reserve_i when work on a burst begins, and returned in the cycle
// after its last beat is popped. So a burst, once begun, always finds room. The head is stored once, not with every
// beat, because it is most of a beat's bits.

module burst_fifo #(
  /// Bits that all beats of a burst share.
  parameter int unsigned HeadWidth = 128,
  /// Bits of a beat of its own.
  parameter int unsigned BeatWidth = 32,
  /// Bursts, 2 or more. Costs Depth heads and Depth * Beats beats of memory.
  parameter int unsigned Depth = 2,
  /// Beats of the longest burst, 1 or more.
  parameter int unsigned Beats = 4
) (
  input  logic                 clk_i,
  input  logic                 rst_ni,

  // A credit is free in the next cycle. Follows pop_ready_i within the cycle: for a register.
  output logic                 credit_next_o,
  // Only with a credit.
  input  logic                 reserve_i,

  // The beats of a burst, after its reserve_i, without a gap. The head counts with the first one.
  input  logic                 push_i,
  input  logic                 first_i,
  input  logic                 last_i,
  input  logic [HeadWidth-1:0] head_i,
  input  logic [BeatWidth-1:0] beat_i,

  output logic                 pop_valid_o,
  input  logic                 pop_ready_i,
  output logic                 last_o,
  output logic [HeadWidth-1:0] head_o,
  output logic [BeatWidth-1:0] beat_o,

  // All credits are free.
  output logic                 empty_o
);

  logic pop_last;
  assign pop_last = pop_valid_o & pop_ready_i & last_o;

  // Bursts.
  logic unused_ready;

  credits #(
    .Slots (Depth)
  ) u_credits (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .reserve_ready_o (unused_ready),
    .reserve_i       (reserve_i),
    .return_i        (pop_last),
    .ready_next_o    (credit_next_o),
    .empty_o         (empty_o)
  );

  memory_fifo #(
    .Width (BeatWidth + 1),
    .Slots (Depth * Beats)
  ) u_beats (
    .clk_i       (clk_i),
    .rst_ni      (rst_ni),
    .push_i      (push_i),
    .data_i      ({last_i, beat_i}),
    .pop_valid_o (pop_valid_o),
    .pop_ready_i (pop_ready_i),
    .data_o      ({last_o, beat_o})
  );

  // Beats come without a gap, so the head of a burst is at its output for exactly as long as its beats are at theirs.
  logic head_valid;

  memory_fifo #(
    .Width (HeadWidth),
    .Slots (Depth)
  ) u_heads (
    .clk_i       (clk_i),
    .rst_ni      (rst_ni),
    .push_i      (push_i & first_i),
    .data_i      (head_i),
    .pop_valid_o (head_valid),
    .pop_ready_i (pop_last),
    .data_o      (head_o)
  );

`ifdef SYNTHESIS
  logic unused_head_valid;
  assign unused_head_valid = head_valid;
`else
  HeadWithBeats: assert property (@(posedge clk_i) disable iff (!rst_ni)
      head_valid == pop_valid_o)
  else $error("a head without its beats, or beats without their head");
`endif

endmodule
