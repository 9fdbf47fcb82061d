// FIFO behind a pipeline of fixed latency, with the credits that keep the pipeline from ever stalling.
//
// Both handshake outputs come from registers: no path leads from pop_ready_i to reserve_ready_o. So does the payload, in a
// memory from one of two.

module credit_fifo #(
  /// Bits of the payload.
  parameter int unsigned Width = 32,
  /// Slots, 2 or more, the output one of them. With fewer than the latency from reserve_i to pop_valid_o
  /// plus one, packets cannot flow in every cycle.
  parameter int unsigned Depth = 4,
  /// 1: slots are words of a memory, for many or wide ones; 0: registers.
  parameter bit InMemory = 1'b0,
  /// Top bits of the payload that are always 0: no memory keeps them. Not with registers.
  parameter int unsigned Zeros = 0
) (
  input  logic             clk_i,
  input  logic             rst_ni,

  // Entry of the pipeline. reserve_i only with reserve_ready_o.
  output logic             reserve_ready_o,
  input  logic             reserve_i,

  // Exit of the pipeline: one push for each reserve_i, after it.
  input  logic             push_i,
  input  logic [Width-1:0] data_i,

  output logic             pop_valid_o,
  input  logic             pop_ready_i,
  output logic [Width-1:0] data_o,

  // All credits are free: nothing is in the FIFO, or promised to it.
  output logic             empty_o
);

  logic pop, unused_ready_next;
  assign pop = pop_valid_o & pop_ready_i;

  credits #(
    .Slots (Depth)
  ) u_credits (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .reserve_ready_o (reserve_ready_o),
    .reserve_i       (reserve_i),
    .return_i        (pop),
    .ready_next_o    (unused_ready_next),
    .empty_o         (empty_o)
  );

  if (InMemory) begin : gen_memory
    localparam int unsigned Kept = Width - Zeros;
    logic [Kept-1:0] kept;
    assign data_o = Width'(kept);

    memory_fifo #(
      .Width (Kept),
      .Slots (Depth)
    ) u_slots (
      .clk_i       (clk_i),
      .rst_ni      (rst_ni),
      .push_i      (push_i),
      .data_i      (data_i[Kept-1:0]),
      .pop_valid_o (pop_valid_o),
      .pop_ready_i (pop_ready_i),
      .data_o      (kept)
    );

    if (Zeros != 0) begin : gen_zeros
      logic unused_zeros;
      assign unused_zeros = ^data_i[Width-1:Kept];
    end
  end else begin : gen_registers
    localparam int unsigned Stored = Depth - 1;
    localparam int unsigned CountBits = $clog2(Depth + 1);
    localparam int unsigned PointerBits = Stored > 1 ? $clog2(Stored) : 1;

    typedef logic [CountBits-1:0] count_t;
    typedef logic [PointerBits-1:0] pointer_t;

    localparam pointer_t LastSlot = pointer_t'(Stored - 1);

    // A packet goes straight to the output register when that is free and nothing waits before it.
    logic             valid_q;
    logic [Width-1:0] data_q;
    logic [Width-1:0] slot_q [Stored];
    count_t           waiting_q;
    pointer_t         read_q, write_q;
    logic             output_free, store, fetch;

    assign output_free = ~valid_q | pop;
    assign fetch       = output_free & (waiting_q != '0);
    assign store       = push_i & (~output_free | fetch);

    function automatic pointer_t next_slot(pointer_t slot);
      return slot == LastSlot ? '0 : slot + pointer_t'(1);
    endfunction

    always_ff @(posedge clk_i) begin
      if (!rst_ni) begin
        valid_q   <= 1'b0;
        waiting_q <= '0;
        read_q    <= '0;
        write_q   <= '0;
      end else begin
        valid_q <= ~output_free | fetch | push_i;
        if (store && !fetch) begin
          waiting_q <= waiting_q + count_t'(1);
        end else if (!store && fetch) begin
          waiting_q <= waiting_q - count_t'(1);
        end
        if (fetch) begin
          read_q <= next_slot(read_q);
        end
        if (store) begin
          write_q <= next_slot(write_q);
        end
      end
    end

    // Payload needs no reset: valid_q and waiting_q say what of it means anything.
    always_ff @(posedge clk_i) begin
      if (store) begin
        slot_q[write_q] <= data_i;
      end
      if (fetch) begin
        data_q <= slot_q[read_q];
      end else if (push_i && output_free) begin
        data_q <= data_i;
      end
    end

    assign pop_valid_o = valid_q;
    assign data_o      = data_q;

`ifndef SYNTHESIS
    SlotBeforePush: assert property (@(posedge clk_i) disable iff (!rst_ni)
        store && !fetch |-> waiting_q != count_t'(Stored));
`endif
  end

endmodule
