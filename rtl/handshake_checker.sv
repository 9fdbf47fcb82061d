// The law of every link: once valid, a packet stays valid and unchanged until it is taken. Bound to the links of a
// unit, see tb.

module handshake_checker #(
  /// Bits of the payload.
  parameter int unsigned Width = 32
) (
  input logic             clk_i,
  input logic             rst_ni,
  input logic             valid_i,
  input logic             ready_i,
  input logic [Width-1:0] payload_i
);

  ValidStays: assert property (@(posedge clk_i) disable iff (!rst_ni)
      valid_i && !ready_i |=> valid_i)
  else $error("valid withdrawn before ready");

  // As statements: Verilator 5.006 makes no C++ that compiles of a concurrent assertion on more than 1280 bits.
  logic             stalled_q;
  logic [Width-1:0] payload_q;

  always_ff @(posedge clk_i) begin
    stalled_q <= rst_ni & valid_i & ~ready_i;
    payload_q <= payload_i;
    if (rst_ni && stalled_q) begin
      PayloadStays: assert (payload_i == payload_q)
      else $error("payload changed while stalled");
    end
  end

endmodule
