// Puts bounds in the place of some entries of a word of hi_z; the others keep theirs, rounded outwards where the range of
// the block has grown. A step has the least power of two of codes with which all fit. Combinational; bit for bit
// put_entries() of model/halfspace/units/hi_z_bounds.hpp.
//
// Steps begin at multiples of their length. So bounds stay codes here, of which rounding clears or sets the bits below a
// step, and nothing is shifted or added.

module hi_z_word
  import raster_pkg::*;
#(
  /// Bits of a bound in memory, 4 to 32.
  parameter int unsigned Bits = 8,
  localparam int unsigned Entries = BlockTiles * ZParts
) (
  input  logic [Entries-1:0][CodeBits-1:0] least_i,
  input  logic [Entries-1:0][CodeBits-1:0] most_i,
  // What the entries that keep their bounds span.
  input  logic [CodeBits-1:0]              first_i,
  input  logic [CodeBits-1:0]              last_i,

  // Entries of one tile, at least one; entry i gets the bounds of part i % ZParts.
  input  logic [Entries-1:0]               put_i,
  input  logic [ZParts-1:0]                put_part_i, // of an entry that is put
  input  logic [ZParts-1:0][CodeBits-1:0]  put_least_i,
  input  logic [ZParts-1:0][CodeBits-1:0]  put_most_i,

  // All entries, before they are rounded.
  output logic [Entries-1:0][CodeBits-1:0] least_o,
  output logic [Entries-1:0][CodeBits-1:0] most_o,
  output logic [CodeBits-1:0]              first_o,
  // The bits below a step: rounding clears them in least bounds, and sets them in most.
  output logic [CodeBits-1:0]              below_o
);

  typedef logic [CodeBits-1:0] code_t;

  for (genvar i = 0; i < Entries; i++) begin : gen_entry
    assign least_o[i] = put_i[i] ? put_least_i[i%ZParts] : least_i[i];
    assign most_o[i]  = put_i[i] ? put_most_i[i%ZParts] : most_i[i];
  end

  code_t first, last;

  always_comb begin
    first = first_i;
    last  = last_i;
    for (int unsigned part = 0; part < ZParts; part++) begin
      if (put_part_i[part]) begin
        first = put_least_i[part] < first ? put_least_i[part] : first;
        last  = put_most_i[part] > last ? put_most_i[part] : last;
      end
    end
  end

  assign first_o = first;

  // Bit i is below a step where steps of 2^i codes are too many: the range has 2^(i + Bits) codes or more, or it has
  // 2^Bits - 1 such steps and a borrow into bit i, which is one step more.
  code_t length;
  assign length = last - first;

  if (Bits == CodeBits) begin : gen_exact // a step is a code
    logic unused_length;
    assign unused_length = ^length;
  end

  for (genvar i = 0; i < CodeBits; i++) begin : gen_below
    if (i + Bits < CodeBits) begin : gen_more
      logic borrow;
      assign borrow     = length[i] ^ last[i] ^ first[i];
      assign below_o[i] = (|length[CodeBits-1:i+Bits]) | ((&length[i+Bits-1:i]) & borrow);
    end else begin : gen_none
      assign below_o[i] = 1'b0;
    end
  end

endmodule
