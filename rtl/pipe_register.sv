// An optional pipeline register: a cut that a parameter puts in or leaves out.

module pipe_register #(
  /// Bits of the payload.
  parameter int unsigned Width = 32,
  /// 1: one cycle of latency; 0: wires.
  parameter bit Cut = 1'b1
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic             valid_i,
  input  logic [Width-1:0] data_i,
  output logic             valid_o,
  output logic [Width-1:0] data_o
);

  if (Cut) begin : gen_cut
    logic             valid_q;
    logic [Width-1:0] data_q;

    always_ff @(posedge clk_i) begin
      if (!rst_ni) begin
        valid_q <= 1'b0;
      end else begin
        valid_q <= valid_i;
      end
    end

    // Loaded for valid packets only, so that an idle pipeline does not toggle.
    always_ff @(posedge clk_i) begin
      if (valid_i) begin
        data_q <= data_i;
      end
    end

    assign valid_o = valid_q;
    assign data_o  = data_q;
  end else begin : gen_wires
    logic unused_clock;
    assign unused_clock = ^{clk_i, rst_ni};

    assign valid_o = valid_i;
    assign data_o  = data_i;
  end

endmodule
