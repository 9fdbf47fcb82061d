/// z_codec: lines of depth as memory holds them, smaller without loss.
///
/// A coded line takes half, a quarter or an eighth of the line's bytes, never fewer than kLeastCodedBytes. It
/// has one of two forms, both of which J. Hasselgren and T. Akenine-Möller, "Efficient Depth Buffer
/// Compression", Graphics Hardware 2006, describe (anchor encoding, depth offset compression):
///
/// - *plane*: a plane through the first sample and those half the line to the right and below it; for each
///   sample how far it is above the lowest such plane of which none is below;
/// - *ends*: the least and the greatest code; for each sample to which of the two it is nearer, and how far
///   from it.
///
/// All arithmetic is modulo 2^C, C the bits of a code in memory. So whatever does not fit is only larger.
/// A coded line is a string of bits, the lowest bit of byte 0 first: the form, the fields of C bits each, and
/// then the samples in row order, each with the same number of bits: as many as fit.
///
///     plane  0, base, dx, dy, samples of {offset}
///     ends   1, least, most, samples of {offset, nearer to most}
///
///     dx = code(w/2, 0) - code(0, 0), dy = code(0, h/2) - code(0, 0), 0 where h = 1
///     code(x, y) = base + floor(x dx / (w/2)) + floor(y dy / (h/2)) + offset
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace halfspace {

/// A line is not coded in fewer bytes: memory moves no fewer at once.
inline constexpr int kLeastCodedBytes = 32;
/// A coded line has its bytes >> shift, with a shift of 1 to kMostCodedShift; 0 is a line as it is.
inline constexpr int kMostCodedShift = 3;

struct ZCodecShape {
  int width = 8;  ///< samples, 4 or more; a power of two as the height
  int height = 8;
  int sample_bytes = 4;  ///< 2 or 4

  [[nodiscard]] int samples() const { return width * height; }
  [[nodiscard]] int bytes() const { return samples() * sample_bytes; }
};

/// Bits of a sample's offset in each form of a line in `bytes`, kLeastCodedBytes or more.
int plane_offset_bits(const ZCodecShape& shape, int bytes);
int ends_offset_bits(const ZCodecShape& shape, int bytes);

/// What a line is in memory. The first two have the bit that begins a coded line; a plain line has none.
enum class ZForm : std::uint8_t { kPlane, kEnds, kPlain };

/// The class of a line. Its bytes tell the shift, but not the form: only the encoder knows both.
struct ZCodedClass {
  ZForm form = ZForm::kPlain;
  int shift = 0;  ///< 0 where plain, and only there
  friend bool operator==(const ZCodedClass&, const ZCodedClass&) = default;
};

/// The class of a line (codes in row order, below 2^C): the largest shift with which one of the forms holds
/// it, the plane where both do.
ZCodedClass z_coded_class(std::span<const std::uint32_t> codes, const ZCodecShape& shape);

/// Its shift.
int z_coded_shift(std::span<const std::uint32_t> codes, const ZCodecShape& shape);

/// The line in memory, in shape.bytes() >> z_coded_shift() bytes: the plane where both forms fit, little
/// endian codes in row order where none does.
void z_encode(std::span<const std::uint32_t> codes, const ZCodecShape& shape,
              std::vector<std::uint8_t>& bytes);

/// Back from z_encode: the number of bytes tells the shift. Takes any bytes, of shape.bytes() >> 0 to
/// kMostCodedShift.
void z_decode(std::span<const std::uint8_t> bytes, const ZCodecShape& shape,
              std::vector<std::uint32_t>& codes);

}  // namespace halfspace
