// FIFO of a memory with one write port and one read port, whose read data is a register: what block RAM is, and
// what a memory of an ASIC is.
//
// A packet is at the output one cycle after its push where nothing waits before it: it goes round the memory, which
// would take one cycle more. The payload at the output is therefore one of two registers, chosen by a third. There
// is no back-pressure: whoever pushes knows of a free slot.

module memory_fifo #(
  /// Bits of the payload.
  parameter int unsigned Width = 32,
  /// Slots, 2 or more. As many packets may be in the FIFO, the one at the output among them.
  parameter int unsigned Slots = 4
) (
  input  logic             clk_i,
  input  logic             rst_ni,

  input  logic             push_i,
  input  logic [Width-1:0] data_i,

  output logic             pop_valid_o,
  input  logic             pop_ready_i,
  output logic [Width-1:0] data_o
);

  typedef logic [$clog2(Slots)-1:0] pointer_t;

  localparam pointer_t LastSlot = pointer_t'(Slots - 1);

  function automatic pointer_t next_slot(pointer_t slot);
    return slot == LastSlot ? '0 : slot + pointer_t'(1);
  endfunction

  // One packet is always at the output when others wait, so fewer than Slots wait: equal pointers mean none, and the
  // memory never reads the slot that it writes.
  logic     valid_q;
  pointer_t read_q, write_q;
  logic     output_free, fetch, pass, store;

  assign output_free = ~valid_q | pop_ready_i;
  assign fetch       = output_free & (read_q != write_q);
  assign pass        = output_free & ~fetch & push_i;
  assign store       = push_i & ~pass;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q <= 1'b0;
      read_q  <= '0;
      write_q <= '0;
    end else begin
      valid_q <= ~output_free | fetch | pass;
      if (fetch) begin
        read_q <= next_slot(read_q);
      end
      if (store) begin
        write_q <= next_slot(write_q);
      end
    end
  end

  logic [Width-1:0] memory_q [Slots];
  logic [Width-1:0] fetched_q;

  always_ff @(posedge clk_i) begin
    if (store) begin
      memory_q[write_q] <= data_i;
    end
    if (fetch) begin
      fetched_q <= memory_q[read_q];
    end
  end

  // Payload needs no reset: valid_q says whether it means anything.
  logic [Width-1:0] passed_q;
  logic             was_fetched_q;

  always_ff @(posedge clk_i) begin
    if (pass) begin
      passed_q <= data_i;
    end
    if (fetch || pass) begin
      was_fetched_q <= fetch;
    end
  end

  assign pop_valid_o = valid_q;
  assign data_o      = was_fetched_q ? fetched_q : passed_q;

`ifndef SYNTHESIS
  SlotBeforePush: assert property (@(posedge clk_i) disable iff (!rst_ni)
      store && !fetch |-> next_slot(write_q) != read_q)
  else $error("push into a full FIFO");
  NothingWaitsBehindNothing: assert property (@(posedge clk_i) disable iff (!rst_ni)
      !valid_q |-> read_q == write_q)
  else $error("packets wait while the output is free");
`endif

endmodule
