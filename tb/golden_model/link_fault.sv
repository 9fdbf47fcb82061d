// A fault on a link, for the tests that must fail: what a scoreboard has to find. Without one, two wires.
//   +fault=none|flip|drop|repeat  what happens to a packet    +fault_packet=N  which, counted from 0 (100)
//   +fault_bit=N                  the bit that is flipped (0)

module link_fault #(
  /// Bits of the payload.
  parameter int unsigned Width = 32
) (
  input  logic             clk_i,
  input  logic             rst_ni,

  // The design
  input  logic             valid_i,
  output logic             ready_o,
  input  logic [Width-1:0] data_i,

  // The scoreboard
  output logic             valid_o,
  input  logic             ready_i,
  output logic [Width-1:0] data_o
);

  string       fault;
  int unsigned fault_packet, fault_bit;

  initial begin
    if ($value$plusargs("fault=%s", fault) == 0) fault = "none";
    if ($value$plusargs("fault_packet=%d", fault_packet) == 0) fault_packet = 100;
    if ($value$plusargs("fault_bit=%d", fault_bit) == 0) fault_bit = 0;
  end

  int unsigned count_q;
  logic        repeated_q;

  logic hit, drop, again;
  assign hit   = count_q == fault_packet;
  assign drop  = hit && fault == "drop";
  assign again = hit && fault == "repeat" && !repeated_q;

  assign valid_o = valid_i && !drop;
  assign ready_o = drop || (ready_i && !again);
  assign data_o  = hit && fault == "flip" ? data_i ^ (Width'(1) << fault_bit) : data_i;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      count_q    <= 0;
      repeated_q <= 1'b0;
    end else begin
      if (valid_i && ready_o) begin
        count_q <= count_q + 1;
      end
      if (valid_o && ready_i && again) begin
        repeated_q <= 1'b1;
      end
    end
  end

endmodule
