// What the entries of a word of hi_z span, but for those that are left out: the least of their least bounds, and the most
// of their most. Combinational.

module hi_z_span #(
  /// Bits of a bound.
  parameter int unsigned Width = 8,
  parameter int unsigned Entries = 16
) (
  input  logic [Entries-1:0]            leave_out_i,
  input  logic [Entries-1:0][Width-1:0] least_i,
  input  logic [Entries-1:0][Width-1:0] most_i,

  // Of one entry at least.
  output logic [Width-1:0]              first_o,
  output logic [Width-1:0]              last_o
);

  // A tree: in each round half of what is left is compared with the other half. Entries are a power of two.
  always_comb begin
    automatic logic [Entries-1:0][Width-1:0] first = least_i;
    automatic logic [Entries-1:0][Width-1:0] last = most_i;
    for (int unsigned i = 0; i < Entries; i++) begin
      first[i] = leave_out_i[i] ? '1 : least_i[i];
      last[i]  = leave_out_i[i] ? '0 : most_i[i];
    end
    for (int unsigned half = Entries / 2; half > 0; half /= 2) begin
      for (int unsigned i = 0; i < half; i++) begin
        first[i] = first[i] < first[i+half] ? first[i] : first[i+half];
        last[i]  = last[i] > last[i+half] ? last[i] : last[i+half];
      end
    end
    first_o = first[0];
    last_o  = last[0];
  end

endmodule
