// Puts bounds in the place of some entries of a word of hi_z; the others keep theirs, rounded outwards where the range of
// the block has grown. The shift is the least with which all fit. Combinational; bit for bit put_entries() of
// model/halfspace/units/hi_z_bounds.hpp.

module hi_z_word
  import raster_pkg::*;
#(
  /// Bits of a bound, 4 to 32.
  parameter int unsigned Bits = 8,
  localparam int unsigned Entries = BlockTiles * ZParts,
  localparam int unsigned WordShiftBits = 5
) (
  input  logic [CodeBits-1:0]          base_i,
  input  logic [WordShiftBits-1:0]     shift_i,
  input  logic [Entries-1:0][Bits-1:0] least_i,
  input  logic [Entries-1:0][Bits-1:0] most_i,

  // At least one entry; entry i gets the bounds of part i % ZParts.
  input  logic [Entries-1:0]              put_i,
  input  logic [ZParts-1:0][CodeBits-1:0] put_least_i,
  input  logic [ZParts-1:0][CodeBits-1:0] put_most_i,

  output logic [CodeBits-1:0]          base_o,
  output logic [WordShiftBits-1:0]     shift_o,
  output logic [Entries-1:0][Bits-1:0] least_o,
  output logic [Entries-1:0][Bits-1:0] most_o
);

  typedef logic [CodeBits-1:0] code_t;
  typedef logic [Bits-1:0] bound_t;
  typedef logic [WordShiftBits-1:0] word_shift_t;

  localparam code_t Ones = '1;

  // The first and the last code of a step: all bits below it are 0, or 1.
  function automatic code_t first_code(code_t base, word_shift_t shift, bound_t step);
    return base + (code_t'(step) << shift);
  endfunction
  function automatic code_t last_code(code_t base, word_shift_t shift, bound_t step);
    return base + ((code_t'(step) << shift) | ~(Ones << shift));
  endfunction

  // What the others span is found among their steps, and is one code then.
  logic   others;
  bound_t least, most;

  always_comb begin
    others = 1'b0;
    least  = '1;
    most   = '0;
    for (int unsigned i = 0; i < Entries; i++) begin
      if (!put_i[i]) begin
        others = 1'b1;
        least  = least_i[i] < least ? least_i[i] : least;
        most   = most_i[i] > most ? most_i[i] : most;
      end
    end
  end

  // A part counts where one of its entries is put.
  logic [ZParts-1:0] put_part;
  code_t             first, last;

  always_comb begin
    put_part = '0;
    for (int unsigned i = 0; i < Entries; i++) begin
      put_part[i%ZParts] |= put_i[i];
    end
    first = others ? first_code(base_i, shift_i, least) : '1;
    last  = others ? last_code(base_i, shift_i, most) : '0;
    for (int unsigned part = 0; part < ZParts; part++) begin
      if (put_part[part]) begin
        first = put_least_i[part] < first ? put_least_i[part] : first;
        last  = put_most_i[part] > last ? put_most_i[part] : last;
      end
    end
  end

  // From the length of the range follows the shift, or one less where a step more than that begins in it.
  code_t       length;
  word_shift_t at_least, shift;
  logic [CodeBits:0] steps;

  always_comb begin
    length   = last - first;
    at_least = '0;
    for (int unsigned i = Bits; i < CodeBits; i++) begin
      if (length[i]) begin
        at_least = word_shift_t'(i + 1 - Bits);
      end
    end
    steps = {1'b0, last >> at_least} - {1'b0, first >> at_least};
    shift = at_least + word_shift_t'(steps >> Bits != '0);
  end

  bound_t start; // the low bits of the first step, of all codes that there are
  assign start   = bound_t'(first >> shift);
  assign shift_o = shift;
  assign base_o  = first >> shift << shift;

  for (genvar i = 0; i < Entries; i++) begin : gen_entry
    code_t kept_least, kept_most, new_least, new_most;
    assign kept_least = first_code(base_i, shift_i, least_i[i]);
    assign kept_most  = last_code(base_i, shift_i, most_i[i]);
    assign new_least  = put_i[i] ? put_least_i[i%ZParts] : kept_least;
    assign new_most   = put_i[i] ? put_most_i[i%ZParts] : kept_most;
    assign least_o[i] = bound_t'(new_least >> shift) - start;
    assign most_o[i]  = bound_t'(new_most >> shift) - start;
  end

endmodule
