// Numbers of depth that setup and the interpolators share: float32 as fixed-point words and back, bit for bit those of
// model/halfspace/units/float_parts.hpp.

package depth_pkg;

  import raster_pkg::*;

  // What the parameter Interpolator chooses.
  parameter int unsigned Plane = 0;
  parameter int unsigned Barycentric = 1;

  // Bits of depth_equation_t: the last are of both interpolators, those before of the plane, the first of the barycentric
  // one.
  parameter int unsigned CommonBits = FlagBits + ExponentBits + WordBits + 2 * CodeBits;
  parameter int unsigned PlaneBits = 4 * HalfGradientBits + WordBits + 2 * CoordBits;
  parameter int unsigned BarycentricBits = $bits(depth_equation_t) - PlaneBits - CommonBits;

  // A gradient of the plane: a word and below it bits that an origin of a tile needs.
  parameter int unsigned GradientFraction = 22;
  parameter int unsigned GradientBits = 2 * HalfGradientBits;
  // Of a short word: a unorm depth in [0, 1].
  parameter int unsigned ShortBits = 32;
  parameter int unsigned ShortGradientBits = ShortBits + GradientFraction;

  // The power of two of a number's last bit, signed; holds every sum of exponents of covered samples.
  parameter int unsigned PlaceBits = 11;

  typedef logic signed [PlaceBits-1:0] place_t;

  // A number shifted left by `zeros` until its top bit is at bit 63; by 63 for 0.
  typedef struct packed {
    logic [5:0]          zeros;
    logic [WordBits-1:0] value;
  } normalized_t;

  function automatic normalized_t normalize(logic [WordBits-1:0] value);
    normalized_t result;
    result.value = value;
    result.zeros = '0;
    for (int unsigned level = 6; level > 0; level--) begin
      if (result.value >> (WordBits - (1 << (level - 1))) == '0) begin
        result.zeros |= 6'(1 << (level - 1));
        result.value <<= 1 << (level - 1);
      end
    end
    return result;
  endfunction

  // Exponent fields of subnormal numbers are 0, their exponents those of 1.
  function automatic logic [7:0] exponent_of(logic [7:0] field);
    return field == '0 ? 8'd1 : field;
  endfunction

  typedef logic [7:0] down_t;

  // A float32 as a word, cut towards zero. `down` is how far its exponent is below that of the word's 1.
  function automatic word_t word_of_float(logic [CodeBits-1:0] bits, down_t down);
    word_t magnitude;
    magnitude = {1'b0, |bits[30:23], bits[22:0], 39'b0};
    magnitude = down > 8'd62 ? '0 : magnitude >> down[5:0];
    return bits[31] ? -magnitude : magnitude;
  endfunction

  // How a number whose last bit is 2^place, with bit 63 set, becomes a float32.
  typedef struct packed {
    logic       vanishes; // less than half of the least float32
    logic [5:0] shift;    // to one bit more than is kept
    logic [8:0] field;    // one less than the exponent field
  } rounding_t;

  function automatic rounding_t rounding_of(place_t place);
    localparam place_t Normal = place_t'(WordBits - 24);
    place_t subnormal, cut;
    subnormal = place_t'(-149) - place;
    cut       = Normal > subnormal ? Normal : subnormal;
    return '{
      vanishes: cut > place_t'(WordBits),
      shift:    6'(cut - place_t'(1)),
      field:    9'(place + cut + place_t'(149))
    };
  endfunction

  // The float32 nearest to it, halves upwards; of 0, 0.
  function automatic logic [CodeBits-1:0] rounded_float(logic [WordBits-1:0] value,
                                                        rounding_t rounding);
    logic [CodeBits-1:0] rounded;
    rounded = CodeBits'(((value >> rounding.shift) + WordBits'(1)) >> 1);
    return value == '0 || rounding.vanishes ? '0 : {rounding.field, 23'b0} + rounded;
  endfunction

  // Columns of quads in a tile are 2^QuadLog2.
  localparam int unsigned QuadLog2 = TileLog2 - 1;

  // E by the pixel.
  function automatic edge_t of_pixel(step_t step);
    return edge_t'(step) <<< SubPixelBits;
  endfunction

  // E at the first pixel of a quad of the tile, `from` at that of the tile. Multiples too small for multipliers: a shifted step
  // for each bit of the quad's place. One sum, so that carries go through it once.
  function automatic edge_t at_quad(edge_t from, edge_t x_step, edge_t y_step,
                                    logic [QuadIndexBits-1:0] index);
    edge_t sum;
    sum = from;
    for (int unsigned i = 0; i < QuadLog2; i++) begin
      sum += (x_step <<< (i + 1)) & {EdgeBits{index[i]}};
      sum += (y_step <<< (i + 1)) & {EdgeBits{index[QuadLog2+i]}};
    end
    return sum;
  endfunction

endpackage : depth_pkg
