// A payload, a fixed number of cycles later, by way of a memory: where a pipeline register for each of them would be large.
//
// The pipeline that it goes beside never stalls, so the slot that a payload takes is free again when it has come round. The
// payload at the output means something in the cycles in which that pipeline says so. Where nothing is on its way the slots
// stand still, so that nothing toggles in a machine at rest.

module delay_memory #(
  /// Bits of the payload.
  parameter int unsigned Width = 32,
  /// Cycles, 2 or more.
  parameter int unsigned Cycles = 4
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  // Nothing is kept of other payloads.
  input  logic             valid_i,
  input  logic [Width-1:0] data_i,
  output logic [Width-1:0] data_o
);

  localparam int unsigned PointerBits = $clog2(Cycles);

  typedef logic [PointerBits-1:0] pointer_t;

  localparam pointer_t LastSlot = pointer_t'(Cycles - 1);

  pointer_t slot_q, slot_d;
  assign slot_d = slot_q == LastSlot ? '0 : slot_q + pointer_t'(1);

  // Cycles that the slots still have to move after this one, so that the youngest payload is next to be read.
  pointer_t left_q;
  logic     moves;
  assign moves = valid_i | left_q != '0;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      slot_q <= '0;
      left_q <= '0;
    end else if (moves) begin
      slot_q <= slot_d;
      left_q <= valid_i ? pointer_t'(Cycles - 2) : left_q - pointer_t'(1);
    end
  end

  // The slot that the next cycle writes holds the oldest payload: it is read now, and leaves then.
  logic [Width-1:0] memory_q [Cycles];
  logic [Width-1:0] data_q;

  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      memory_q[slot_q] <= data_i;
    end
    data_q <= memory_q[slot_d];
  end

  assign data_o = data_q;

endmodule
