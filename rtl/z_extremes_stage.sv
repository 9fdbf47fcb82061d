// A register of z_extremes: the least and the greatest of each group of codes.

module z_extremes_stage
  import raster_pkg::*;
#(
  /// Bits of a code.
  parameter int unsigned Width = CodeBits,
  /// Powers of two; Inputs / Outputs neighbours are a group.
  parameter int unsigned Inputs = 4,
  parameter int unsigned Outputs = 1
) (
  input  logic                           clk_i,

  input  logic                           valid_i,
  input  logic [Inputs-1:0] [Width-1:0]  least_i,
  input  logic [Inputs-1:0] [Width-1:0]  most_i,

  // A cycle later.
  output logic [Outputs-1:0] [Width-1:0] least_o,
  output logic [Outputs-1:0] [Width-1:0] most_o
);

  typedef logic [Inputs-1:0] [Width-1:0] inputs_t;
  typedef logic [Outputs-1:0] [Width-1:0] outputs_t;

  function automatic outputs_t least_of(inputs_t codes);
    for (int unsigned count = Inputs / 2; count >= Outputs; count /= 2) begin
      for (int unsigned i = 0; i < count; i++) begin
        codes[i] = codes[2*i+1] < codes[2*i] ? codes[2*i+1] : codes[2*i];
      end
    end
    return codes[Outputs-1:0];
  endfunction
  function automatic outputs_t most_of(inputs_t codes);
    for (int unsigned count = Inputs / 2; count >= Outputs; count /= 2) begin
      for (int unsigned i = 0; i < count; i++) begin
        codes[i] = codes[2*i+1] < codes[2*i] ? codes[2*i] : codes[2*i+1];
      end
    end
    return codes[Outputs-1:0];
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      least_o <= least_of(least_i);
      most_o  <= most_of(most_i);
    end
  end

endmodule
