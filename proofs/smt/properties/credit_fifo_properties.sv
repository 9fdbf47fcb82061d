// A link: a pipeline of fixed latency (pipe_register), and behind it credit_fifo. Packets leave in the order in which
// they came; the pipeline never pushes without a slot; and while the consumer takes, the producer gets a credit again
// after Latency cycles at most, so the link cannot deadlock.

module credit_fifo_properties #(
  parameter int unsigned Width = 8,
  parameter int unsigned Depth = 4,
  parameter int unsigned Latency = 2,
  parameter bit InMemory = 1'b0
) (
  input logic             clk_i,
  input logic             rst_ni,
  input logic             watch_i,
  input logic             offer_i, // the producer has a packet
  input logic [Width-1:0] data_i,
  input logic             pop_ready_i
);

  // Packets are watched from the entry of the pipeline to the exit of the FIFO.
  localparam int unsigned CountBits = $clog2(Depth + 1) + 1;
  typedef logic signed [CountBits-1:0] count_t;

  logic             ready, reserve, pop_valid, pop, empty;
  logic [Width-1:0] data, watched_data;
  count_t           count, ahead;
  logic             watched;

  assign reserve = offer_i & ready;
  assign pop     = pop_valid & pop_ready_i;

  logic             valid [Latency+1];
  logic [Width-1:0] stage [Latency+1];

  assign valid[0] = reserve;
  assign stage[0] = data_i;

  for (genvar i = 0; i < Latency; i++) begin : gen_stage
    pipe_register #(
      .Width (Width)
    ) u_register (
      .clk_i   (clk_i),
      .rst_ni  (rst_ni),
      .valid_i (valid[i]),
      .data_i  (stage[i]),
      .valid_o (valid[i+1]),
      .data_o  (stage[i+1])
    );
  end

  credit_fifo #(
    .Width    (Width),
    .Depth    (Depth),
    .InMemory (InMemory)
  ) u_dut (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .reserve_ready_o (ready),
    .reserve_i       (reserve),
    .push_i          (valid[Latency]),
    .data_i          (stage[Latency]),
    .pop_valid_o     (pop_valid),
    .pop_ready_i     (pop_ready_i),
    .data_o          (data),
    .empty_o         (empty)
  );

  watched_item #(
    .Width (Width),
    .Slots (Depth)
  ) u_item (
    .clk_i     (clk_i),
    .rst_ni    (rst_ni),
    .watch_i   (watch_i),
    .push_i    (reserve),
    .data_i    (data_i),
    .pop_i     (pop),
    .count_o   (count),
    .watched_o (watched),
    .ahead_o   (ahead),
    .data_o    (watched_data)
  );

  // Packets in the pipeline, and in the FIFO but for its output.
  count_t promised, waiting;
  always_comb begin
    promised = '0;
    for (int unsigned i = 1; i <= Latency; i++) begin
      promised += count_t'({1'b0, valid[i]});
    end
  end

  // The packet with `ahead` others before it: at the output, in a slot, or in the pipeline.
  logic [Width-1:0] found, stored;
  count_t           place;

  if (InMemory) begin : gen_memory
    int unsigned read, write, at;
    assign read    = 32'(u_dut.gen_memory.u_slots.read_q);
    assign write   = 32'(u_dut.gen_memory.u_slots.write_q);
    assign at      = read + 32'(ahead) - 1;
    assign waiting = count_t'(write >= read ? write - read : write + Depth - read);

    always_comb begin
      stored = 'x;
      for (int unsigned i = 0; i < Depth; i++) begin
        if ((at >= Depth ? at - Depth : at) == i) stored = u_dut.gen_memory.u_slots.memory_q[i];
      end
      PointersInRange: assert (read < Depth && write < Depth);
    end
  end else begin : gen_registers
    localparam int unsigned Stored = Depth - 1;

    int unsigned read, write, at;
    assign read    = 32'(u_dut.gen_registers.read_q);
    assign write   = 32'(u_dut.gen_registers.write_q);
    assign at      = read + 32'(ahead) - 1;
    assign waiting = count_t'({1'b0, u_dut.gen_registers.waiting_q});

    always_comb begin
      stored = 'x;
      for (int unsigned i = 0; i < Stored; i++) begin
        if ((at >= Stored ? at - Stored : at) == i) stored = u_dut.gen_registers.slot_q[i];
      end
      PointersInRange: assert (read < Stored && write < Stored);
      PointersMeet: assert (read + 32'(waiting) == write || read + 32'(waiting) == write + Stored);
    end
  end

  always_comb begin
    found = data;
    if (ahead > 0) begin
      found = ahead <= waiting ? stored : 'x;
    end
    // In the pipeline the oldest is last.
    place = waiting + count_t'({1'b0, pop_valid});
    for (int unsigned i = Latency; i > 0; i--) begin
      if (valid[i]) begin
        if (ahead == place) found = stage[i];
        place += count_t'(1);
      end
    end
  end

  // Cycles in which the consumer takes and the producer has no credit.
  logic [7:0] starved_q;
  always_ff @(posedge clk_i) begin
    starved_q <= !rst_ni || ready || !pop_ready_i ? '0 : starved_q + 8'd1;
  end

  logic full_q;
  always_ff @(posedge clk_i) begin
    full_q <= rst_ni && (full_q || count == count_t'(Depth));
  end

  always_comb begin
    InRange: assert (count >= 0 && count <= count_t'(Depth));
    CreditsAreTheRest: assert (32'(u_dut.u_credits.free_q) == Depth - 32'(count));
    AllAreSomewhere: assert (count == promised + waiting + count_t'({1'b0, pop_valid}));
    OutputFirst: assert (pop_valid || waiting == 0);
    EmptyIsNone: assert (empty == (count == 0));
    WatchedIsInside: assert (!watched || (ahead >= 0 && ahead < count));
    WatchedIsFound: assert (!watched || found == watched_data);
    OrderKept: assert (!(watched && pop && ahead == 0) || data == watched_data);
    ReadyIsACredit: assert (!ready || count < count_t'(Depth));
    CreditComesBack: assert (starved_q <= 8'(Latency));

    Full: cover (count == count_t'(Depth));
    FullThenEmpty: cover (full_q && count == 0);
    WatchedBehindAll: cover (watched && ahead == count_t'(Depth - 1));
    WatchedLeaves: cover (watched && pop && ahead == 0);
    Starved: cover (starved_q != 0);
  end

endmodule
