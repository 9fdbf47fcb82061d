// A fault on a link, for the tests that must fail: what a scoreboard has to find. Without one, two wires.

module link_fault #(
  /// Bits of the payload.
  parameter int unsigned Width = 32
) (
  input  logic              clk_i,
  input  logic              rst_ni,

  /// What happens to packet number `packet_i`, counted from 0: "none", "flip" (its bit `bit_i`), "drop" or "repeat".
  input  string             fault_i,
  input  int unsigned       packet_i,
  input  int unsigned       bit_i,

  // The design
  input  logic              valid_i,
  output logic              ready_o,
  input  logic [Width-1:0]  data_i,

  // The scoreboard
  output logic              valid_o,
  input  logic              ready_i,
  output logic [Width-1:0]  data_o
);

  int unsigned count_q;
  logic        repeated_q;

  logic hit, drop, again;
  assign hit   = count_q == packet_i;
  assign drop  = hit && fault_i == "drop";
  assign again = hit && fault_i == "repeat" && !repeated_q;

  assign valid_o = valid_i && !drop;
  assign ready_o = drop || (ready_i && !again);
  assign data_o  = hit && fault_i == "flip" ? data_i ^ (Width'(1) << bit_i) : data_i;

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
