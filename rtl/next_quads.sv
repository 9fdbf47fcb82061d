// The lowest Picks bits of a set, each as a one-hot vector, and the set without them.
//
// Bit i has as rank the number of bits of the set below it; the bit of rank n is pick n. The ranks come from a
// parallel prefix sum (J. Sklansky, "Conditional-Sum Addition Logic", 1960), log2(Size) adders deep: a chain that
// clears one bit after the other would be Picks priority encoders deep.

module next_quads #(
  /// Bits of the set, a power of two, 4 to 64. Costs Size / 2 * log2(Size) adders of at most log2(Size) + 1 bits.
  parameter int unsigned Size = 16,
  /// Bits to pick, 1 to Size. Costs a comparison and an AND for each bit of the set, and what the picks choose.
  parameter int unsigned Picks = 4
) (
  input  logic [Size-1:0]             set_i,
  output logic [Picks-1:0][Size-1:0]  pick_o,  // zero where the set has fewer bits
  output logic [Size-1:0]             rest_o
);

  localparam int unsigned Levels = $clog2(Size);

  typedef logic [Levels:0] count_t;

  // Of the bits up to i, i among them. Level n adds the sum of the block of 2^n below to each sum of an odd block.
  count_t sum [Size];

  always_comb begin
    for (int unsigned i = 0; i < Size; i++) begin
      sum[i] = count_t'(set_i[i]);
    end
    for (int unsigned level = 0; level < Levels; level++) begin
      for (int unsigned i = 0; i < Size; i++) begin
        if (((i >> level) & 1) == 1) begin
          sum[i] = sum[i] + sum[((i >> level) << level) - 1];
        end
      end
    end
  end

  // Bit b of all sums together: a comparison is then one of vectors, which is the same gates and much less for a
  // simulator.
  logic [Levels:0][Size-1:0] sum_bits;

  for (genvar i = 0; i < Size; i++) begin : gen_sum_bits
    for (genvar b = 0; b <= Levels; b++) begin : gen_bit
      assign sum_bits[b][i] = sum[i][b];
    end
  end

  // A bit of the set with rank n has sum n + 1.
  always_comb begin
    rest_o = set_i;
    for (int unsigned n = 0; n < Picks; n++) begin
      pick_o[n] = set_i;
      for (int unsigned b = 0; b <= Levels; b++) begin
        pick_o[n] &= (((n + 1) >> b) & 1) == 1 ? sum_bits[b] : ~sum_bits[b];
      end
      rest_o &= ~pick_o[n];
    end
  end

endmodule
