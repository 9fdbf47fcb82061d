// Credits of the slots behind a pipeline of fixed latency, which keep the pipeline from ever stalling.
//
// The pipeline takes a packet only with reserve_ready_o, which says that a slot is free for what it will push. A slot is
// taken by reserve_i when the packet enters, and is free again in the cycle after return_i.

module credits #(
  /// Slots, 2 or more. With fewer than the latency from reserve_i to return_i plus one, packets cannot flow in every
  /// cycle.
  parameter int unsigned Slots = 4
) (
  input  logic clk_i,
  input  logic rst_ni,

  // From a register. reserve_i only with it.
  output logic reserve_ready_o,
  input  logic reserve_i,
  input  logic return_i,
  // reserve_ready_o of the next cycle.
  output logic ready_next_o,

  // All credits are free: nothing is in a slot, or promised to one.
  output logic empty_o
);

  // Slots that are neither filled nor promised.
  typedef logic [$clog2(Slots+1)-1:0] count_t;
  count_t free_d, free_q;
  logic   reserve_ready_q;

  always_comb begin
    free_d = free_q;
    if (reserve_i && !return_i) begin
      free_d = free_q - count_t'(1);
    end else if (!reserve_i && return_i) begin
      free_d = free_q + count_t'(1);
    end
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      free_q          <= count_t'(Slots);
      reserve_ready_q <= 1'b0;
    end else begin
      free_q          <= free_d;
      reserve_ready_q <= ready_next_o;
    end
  end

  assign ready_next_o    = free_d != '0;
  assign reserve_ready_o = reserve_ready_q;
  assign empty_o         = free_q == count_t'(Slots);

`ifndef SYNTHESIS
  CreditBeforeReserve: assert property (@(posedge clk_i) disable iff (!rst_ni)
      reserve_i |-> reserve_ready_o);
`endif

endmodule
