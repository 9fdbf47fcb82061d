// memory_fifo: packets leave in the order in which they came, none lost or doubled.

module memory_fifo_properties #(
  parameter int unsigned Width = 8,
  parameter int unsigned Slots = 4
) (
  input logic             clk_i,
  input logic             rst_ni,
  input logic             watch_i,
  input logic             push_i,
  input logic [Width-1:0] data_i,
  input logic             pop_ready_i
);

  localparam int unsigned CountBits = $clog2(Slots + 1) + 1;
  typedef logic signed [CountBits-1:0] count_t;

  logic             pop_valid, pop;
  logic [Width-1:0] data, watched_data;
  count_t           count, ahead;
  logic             watched;

  assign pop = pop_valid & pop_ready_i;

  memory_fifo #(
    .Width (Width),
    .Slots (Slots)
  ) u_dut (
    .clk_i       (clk_i),
    .rst_ni      (rst_ni),
    .push_i      (push_i),
    .data_i      (data_i),
    .pop_valid_o (pop_valid),
    .pop_ready_i (pop_ready_i),
    .data_o      (data)
  );

  watched_item #(
    .Width (Width),
    .Slots (Slots)
  ) u_item (
    .clk_i     (clk_i),
    .rst_ni    (rst_ni),
    .watch_i   (watch_i),
    .push_i    (push_i),
    .data_i    (data_i),
    .pop_i     (pop),
    .count_o   (count),
    .watched_o (watched),
    .ahead_o   (ahead),
    .data_o    (watched_data)
  );

  // Where the packet with `place` others before it in the memory is, and how many there are.
  function automatic int unsigned slot(count_t place);
    int unsigned at = 32'(u_dut.read_q) + 32'(place);
    return at >= Slots ? at - Slots : at;
  endfunction

  int unsigned waiting;
  assign waiting = u_dut.write_q >= u_dut.read_q ? 32'(u_dut.write_q) - 32'(u_dut.read_q)
                                                 : 32'(u_dut.write_q) + Slots - 32'(u_dut.read_q);

  logic [Width-1:0] stored;
  always_comb begin
    stored = 'x;
    for (int unsigned i = 0; i < Slots; i++) begin
      if (slot(ahead - count_t'(1)) == i) stored = u_dut.memory_q[i];
    end
  end

  logic full_q;
  always_ff @(posedge clk_i) begin
    full_q <= rst_ni && (full_q || count == count_t'(Slots));
  end

  always_comb begin
    SlotBeforePush: assume (!push_i || count < count_t'(Slots) || pop);

    InRange: assert (count >= 0 && count <= count_t'(Slots));
    ValidIsNotEmpty: assert (pop_valid == (count != 0));
    PointersInRange: assert (32'(u_dut.read_q) < Slots && 32'(u_dut.write_q) < Slots);
    RestWaits: assert (!pop_valid ? waiting == 0 : waiting == 32'(count) - 1);
    WatchedIsInside: assert (!watched || (ahead >= 0 && ahead < count));
    WatchedIsNext: assert (!(watched && ahead == 0) || data == watched_data);
    WatchedWaits: assert (!(watched && ahead > 0) || stored == watched_data);

    Full: cover (count == count_t'(Slots));
    FullThenEmpty: cover (full_q && count == 0);
    WatchedBehindAll: cover (watched && ahead == count_t'(Slots - 1));
    WatchedLeaves: cover (watched && pop && ahead == 0);
  end

endmodule
