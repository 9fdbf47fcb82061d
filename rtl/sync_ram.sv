// A memory with one write port and one registered read port: reads what was written before this cycle. Its user never
// reads a word in the cycle in which it is written, because memories differ in what that gives.

module sync_ram #(
  /// Bits of a word.
  parameter int unsigned Width = 32,
  /// Words, 2 or more.
  parameter int unsigned Depth = 256,
  localparam int unsigned AddressBits = $clog2(Depth)
) (
  input  logic                   clk_i,
  input  logic                   write_i,
  input  logic [AddressBits-1:0] write_address_i,
  input  logic [Width-1:0]       data_i,
  /// data_o holds the word from the next cycle on, until another read.
  input  logic                   read_i,
  input  logic [AddressBits-1:0] read_address_i,
  output logic [Width-1:0]       data_o
);

  (* no_rw_check *) // so synthesis puts nothing around the block RAM for such a cycle
  logic [Width-1:0] memory_q [Depth];
  logic [Width-1:0] data_q;

  always_ff @(posedge clk_i) begin
    if (write_i) begin
      memory_q[write_address_i] <= data_i;
    end
    if (read_i) begin
      data_q <= memory_q[read_address_i];
    end
  end

  assign data_o = data_q;

endmodule
