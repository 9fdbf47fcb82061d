// Credits: as many are out as were taken and not returned, and never more than there are.

module credits_properties #(
  parameter int unsigned Slots = 4
) (
  input logic clk_i,
  input logic rst_ni,
  input logic reserve_i,
  input logic return_i
);

  logic ready, ready_next, empty;

  credits #(
    .Slots (Slots)
  ) u_dut (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .reserve_ready_o (ready),
    .reserve_i       (reserve_i),
    .return_i        (return_i),
    .ready_next_o    (ready_next),
    .empty_o         (empty)
  );

  // Counted with bits to spare: below zero it is negative.
  localparam int unsigned Bits = $clog2(Slots + 1) + 2;
  typedef logic signed [Bits-1:0] wide_t;

  wide_t out_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      out_q <= '0;
    end else begin
      out_q <= out_q + wide_t'({1'b0, reserve_i}) - wide_t'({1'b0, return_i});
    end
  end

  logic was_ready_next_q, was_reset_q;

  always_ff @(posedge clk_i) begin
    was_ready_next_q <= ready_next;
    was_reset_q      <= !rst_ni;
  end

  always_comb begin
    TakenWithCredit: assume (!reserve_i || ready);
    ReturnedOnce: assume (!return_i || out_q > 0);

    NeverBelowZero: assert (out_q >= 0);
    NeverAboveSlots: assert (out_q <= wide_t'(Slots));
    FreeIsTheRest: assert (wide_t'({1'b0, u_dut.free_q}) == wide_t'(Slots) - out_q);
    ReadyIsACredit: assert (ready == (out_q < wide_t'(Slots) && !was_reset_q));
    ReadyNextIsReady: assert (was_reset_q || ready == was_ready_next_q);
    EmptyIsNoneOut: assert (empty == (out_q == 0));

    AllOut: cover (out_q == wide_t'(Slots));
    AllOutAndOneBack: cover (out_q == wide_t'(Slots) && return_i);
    BothAtOnce: cover (reserve_i && return_i);
  end

endmodule
