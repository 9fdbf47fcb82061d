// One packet that is watched on its way through a FIFO: any one, because an input that the solver is free in says which.
//
// A FIFO keeps its order when a packet that finds n others in it is the one that is taken after n others were. If that
// holds for any packet, none is lost, doubled or passed.

module watched_item #(
  /// Bits of the packet.
  parameter int unsigned Width = 8,
  /// Packets that the FIFO holds at most.
  parameter int unsigned Slots = 4,
  localparam int unsigned CountBits = $clog2(Slots + 1) + 1
) (
  input  logic                        clk_i,
  input  logic                        rst_ni,
  input  logic                        watch_i, // this push, if none is watched
  input  logic                        push_i,
  input  logic [Width-1:0]            data_i,
  input  logic                        pop_i,

  // Packets in the FIFO; less than zero if more were taken than came.
  output logic signed [CountBits-1:0] count_o,
  // A packet is watched and in the FIFO; how many are before it; its data.
  output logic                        watched_o,
  output logic signed [CountBits-1:0] ahead_o,
  output logic [Width-1:0]            data_o
);

  typedef logic signed [CountBits-1:0] count_t;

  count_t count_d;
  assign count_d = count_o - count_t'({1'b0, pop_i});

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      count_o   <= '0;
      watched_o <= 1'b0;
    end else begin
      count_o <= count_d + count_t'({1'b0, push_i});
      if (watched_o) begin
        watched_o <= !(pop_i && ahead_o == '0);
        ahead_o   <= ahead_o - count_t'({1'b0, pop_i});
      end else if (push_i && watch_i) begin
        watched_o <= 1'b1;
        ahead_o   <= count_d;
        data_o    <= data_i;
      end
    end
  end

endmodule
