// burst_fifo: beats leave in order, each with the head of its burst and the mark of the last; no burst finds no room.
//
// The producer is that of quad_generator: a burst of up to `Beats` beats, without a gap, from the cycle after its credit.

module burst_fifo_properties #(
  parameter int unsigned Width = 4,
  parameter int unsigned Depth = 2,
  parameter int unsigned Beats = 2,
  localparam int unsigned LeftBits = $clog2(Beats + 1)
) (
  input logic                clk_i,
  input logic                rst_ni,
  input logic                watch_i,
  input logic                offer_i,
  input logic [LeftBits-1:0] length_i,
  input logic [Width-1:0]    head_i,
  input logic [Width-1:0]    beat_i,
  input logic                pop_ready_i
);

  typedef logic [LeftBits-1:0] left_t;
  typedef struct packed {
    logic             last;
    logic [Width-1:0] head;
    logic [Width-1:0] beat;
  } item_t;

  logic             credit_next, ready_q, start, first_q, push, pop_valid, pop, empty;
  left_t            left_d, left_q;
  logic [Width-1:0] head_q;
  item_t            out, in;

  assign start = offer_i & ready_q;
  assign push  = left_q != '0;
  assign pop   = pop_valid & pop_ready_i;
  assign in    = '{last: left_q == left_t'(1), head: head_q, beat: beat_i};

  always_comb begin
    left_d = left_q == '0 ? '0 : left_q - left_t'(1);
    if (start) left_d = length_i;
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      left_q  <= '0;
      first_q <= 1'b0;
      ready_q <= 1'b0;
    end else begin
      left_q  <= left_d;
      first_q <= start;
      ready_q <= credit_next & (left_d <= left_t'(1));
    end
    if (start) head_q <= head_i;
  end

  burst_fifo #(
    .HeadWidth (Width),
    .BeatWidth (Width),
    .Depth     (Depth),
    .Beats     (Beats)
  ) u_dut (
    .clk_i         (clk_i),
    .rst_ni        (rst_ni),
    .credit_next_o (credit_next),
    .reserve_i     (start),
    .push_i        (push),
    .first_i       (first_q),
    .last_i        (in.last),
    .head_i        (head_q),
    .beat_i        (beat_i),
    .pop_valid_o   (pop_valid),
    .pop_ready_i   (pop_ready_i),
    .last_o        (out.last),
    .head_o        (out.head),
    .beat_o        (out.beat),
    .empty_o       (empty)
  );

  localparam int unsigned Slots = Depth * Beats;
  localparam int unsigned CountBits = $clog2(Slots + 1) + 1;
  logic signed [CountBits-1:0] count, ahead;
  logic                        watched;
  item_t                       watched_item;

  watched_item #(
    .Width ($bits(item_t)),
    .Slots (Slots)
  ) u_item (
    .clk_i     (clk_i),
    .rst_ni    (rst_ni),
    .watch_i   (watch_i),
    .push_i    (push),
    .data_i    (in),
    .pop_i     (pop),
    .count_o   (count),
    .watched_o (watched),
    .ahead_o   (ahead),
    .data_o    (watched_item)
  );

  // Cycles in which the consumer takes and the producer has no credit.
  logic [7:0] starved_q;
  always_ff @(posedge clk_i) begin
    starved_q <= !rst_ni || credit_next || !pop_ready_i ? '0 : starved_q + 8'd1;
  end

  always_comb begin
    Length: assume (length_i != '0 && length_i <= left_t'(Beats));

    InRange: assert (count >= 0 && 32'(count) <= Slots);
    ValidIsNotEmpty: assert (pop_valid == (count != 0));
    HeadWithBeats: assert (u_dut.head_valid == pop_valid);
    OrderKept: assert (!(watched && ahead == 0) || out == watched_item);
    CreditComesBack: assert (32'(starved_q) <= Beats + 1);

    Full: cover (32'(count) == Slots);
    WatchedBehindAll: cover (watched && 32'(ahead) == Slots - 1);
    SecondBurstLeaves: cover (watched && ahead == 0 && pop && !watched_item.last && count > 2);
  end

endmodule
