// What is known of a triangle's codes in one tile, against the bounds of what is stored there: whether all of them are
// `upper_i` or more, and whether all are less than `lower_i`. Combinational; CodeRange of
// model/halfspace/units/hi_z.cpp, with word_of_code() of hi_z_plane.hpp.

module hi_z_test
  import raster_pkg::*;
(
  // Of the triangle. `up_i`: a code of exponent 0 is a word of 2^up_i.
  input  logic                       is_float_i,
  input  logic                       is_unorm16_i,
  input  logic signed [10:0]         up_i,
  input  logic                       known_i,
  input  logic [CodeBits-1:0]        min_code_i,
  input  logic [CodeBits-1:0]        max_code_i,
  // Its words in the tile lie between these.
  input  logic signed [HiZWordBits-16:0] least_i,
  input  logic signed [HiZWordBits-16:0] most_i,
  // One more than the largest code is possible.
  input  logic [CodeBits:0]          upper_i,
  input  logic [CodeBits:0]          lower_i,
  output logic                       at_least_o,
  output logic                       below_o
);

  // A word without the bits below its unit, as an unsigned number; one bit more holds what is beyond all of them.
  localparam int unsigned UnitBits = HiZWordBits - 16;
  // A unorm code with the bits of a vertex depth below it. Of a float32 fewer: its mantissa, and two more.
  localparam int unsigned ValueBits = 31;
  // With more than this a value is beyond all words.
  localparam int unsigned MostUp = UnitBits - 1;

  typedef logic [CodeBits:0] code_t;
  typedef logic signed [10:0] up_t;
  typedef logic signed [UnitBits:0] word_t;
  typedef logic signed [UnitBits+2:0] difference_t;
  typedef logic [ValueBits-1:0] value_t;
  typedef logic [MostUp+ValueBits-1:0] wide_t;

  // A code as value * 2^up units: half way to the code below it. Only one between two codes of the triangle matters.
  typedef struct packed {
    value_t value;
    up_t    up;
  } scaled_t;

  function automatic scaled_t scaled(logic [CodeBits-2:0] code, logic is_float, logic is_unorm16,
                                     up_t up);
    scaled_t    result;
    logic [7:0] field;
    logic       power;
    field = code[30:23];
    // The float below a power of two is half as far away as the one above it.
    power = code[22:0] == '0 && field > 8'd1;
    if (is_float) begin
      result.value = {5'b0, field != '0, code[22:0], 2'b0} - (power ? value_t'(1) : value_t'(2));
      result.up    = up + up_t'({3'b0, field == '0 ? 8'd1 : field});
    end else begin
      result.value = is_unorm16 ? {code[15:0], 15'b0} - value_t'(15'h4000)
                                : {code[23:0], 7'b0} - value_t'(7'h40);
      result.up    = up;
    end
    return result;
  endfunction

  // Whether a word is at least that. Rounding up the value is a borrow of the comparison.
  function automatic logic reaches(word_t word, scaled_t code);
    localparam up_t MostRight = up_t'(MostUp + ValueBits);
    up_t         right;
    wide_t       all, whole;
    logic        beyond, rest;
    difference_t difference;
    right      = up_t'(MostUp) - code.up;
    right      = right < up_t'(0) ? up_t'(0) : right > MostRight ? MostRight : right;
    all        = {code.value, MostUp'(0)};
    whole      = all >> right[6:0];
    rest       = (all & ~(wide_t'('1) << right[6:0])) != '0;
    beyond     = code.up > up_t'(MostUp) || whole >> UnitBits != '0;
    difference = difference_t'(word) - difference_t'({3'b0, whole[UnitBits-1:0]})
                 - difference_t'({1'b0, rest});
    return ~beyond & ~difference[UnitBits+2];
  endfunction

  code_t min_code, max_code;
  assign min_code = {1'b0, min_code_i};
  assign max_code = {1'b0, max_code_i};

  scaled_t upper, lower;
  assign upper = scaled(upper_i[CodeBits-2:0], is_float_i, is_unorm16_i, up_i);
  assign lower = scaled(lower_i[CodeBits-2:0], is_float_i, is_unorm16_i, up_i);

  assign at_least_o = min_code >= upper_i
                      || (known_i && max_code >= upper_i && reaches(least_i, upper));
  assign below_o    = max_code < lower_i
                      || (known_i && min_code < lower_i && !reaches(most_i, lower));

endmodule
