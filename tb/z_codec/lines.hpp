/// Lines for the bench of z_codec: what it sends, what must come of it, and what is special about it.
#pragma once

#include <cstdint>
#include <vector>

#include "common/random.hpp"
#include "z_codec/models.hpp"

namespace halfspace::tb {

struct CodecLine {
  bool half = false;
  std::vector<std::uint32_t> codes;  ///< in row order
};

struct CodedLine {
  bool half = false;
  int shift = 0;
  std::vector<std::uint8_t> bytes;
  bool arbitrary = false;  ///< no encoder has made it
};

/// In both forms and every size: the largest offset at the limit and one beyond it, the offsets on both sides
/// of the first sample; codes around both ends of the range, and what wraps there.
[[nodiscard]] std::vector<CodecLine> directed_lines(const CodecShape& shape, Random& random);

/// Planes, layers, clears, noise; offsets of any size.
[[nodiscard]] CodecLine random_line(const CodecShape& shape, Random& random);

/// What z_encode makes of a line, or bytes that nobody has made.
[[nodiscard]] CodedLine random_coded_line(const CodecShape& shape, Random& random);
[[nodiscard]] CodedLine encoded(const CodecLine& line, const CodecShape& shape);

/// Codes by quad, as the ports have them.
[[nodiscard]] std::vector<std::uint32_t> by_quad(const std::vector<std::uint32_t>& rows, int width);
/// Bytes as the words of a port, `filler` behind the last.
[[nodiscard]] std::vector<std::uint32_t> port_words(const std::vector<std::uint8_t>& bytes, std::size_t words,
                                                    Random* filler);

/// What decides how a line is coded, from the definition of the forms.
struct LineFacts {
  std::uint64_t plane_range = 0;    ///< between the lowest and the highest sample above the plane
  std::uint32_t ends_farthest = 0;  ///< from the nearer end
  bool below = false;               ///< a sample is below the plane through the first
  bool wraps = false;               ///< a sample of the plane through the first is beyond the range of codes
  bool tie = false;                 ///< a sample is as far from either end, and not at it
  bool steepest = false;            ///< a gradient is -2^(C-1), which has no negative
};
[[nodiscard]] LineFacts facts_of(const CodecLine& line, const CodecShape& shape);

}  // namespace halfspace::tb
