#include "halfspace/units/z_codec.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace halfspace {
namespace {

/// A string of bits, the lowest of byte 0 first.
class BitWriter {
 public:
  BitWriter(std::vector<std::uint8_t>& bytes, int size) : bytes_(bytes) {
    bytes_.assign(static_cast<std::size_t>(size), 0);
  }

  void put(std::uint32_t value, int bits) {
    for (int i = 0; i < bits; ++i, ++at_) {
      bytes_[at_ / 8] |= static_cast<std::uint8_t>((value >> i & 1) << (at_ % 8));
    }
  }

 private:
  std::vector<std::uint8_t>& bytes_;
  std::size_t at_ = 0;
};

class BitReader {
 public:
  explicit BitReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint32_t take(int bits) {
    std::uint32_t value = 0;
    for (int i = 0; i < bits; ++i, ++at_) {
      value |= static_cast<std::uint32_t>(bytes_[at_ / 8] >> (at_ % 8) & 1) << i;
    }
    return value;
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

int code_bits(const ZCodecShape& shape) { return 8 * shape.sample_bytes; }

std::uint32_t code_mask(const ZCodecShape& shape) {
  return static_cast<std::uint32_t>((std::uint64_t{1} << code_bits(shape)) - 1);
}

/// The value modulo 2^C that is nearest to zero.
std::int64_t to_signed(std::uint32_t value, const ZCodecShape& shape) {
  return shape.sample_bytes == 2 ? std::int64_t{static_cast<std::int16_t>(value)}
                                 : std::int64_t{static_cast<std::int32_t>(value)};
}

/// The plane through the line's first sample.
struct Plane {
  std::uint32_t dx = 0;
  std::uint32_t dy = 0;

  /// How far it has risen at sample `i`.
  [[nodiscard]] std::uint32_t rise(std::size_t i, const ZCodecShape& shape) const {
    const auto x = static_cast<std::int64_t>(i) % shape.width;
    const auto y = static_cast<std::int64_t>(i) / shape.width;
    const auto floor_of_half = [](std::int64_t value, int size) {
      return value >> (std::countr_zero(static_cast<unsigned>(size)) - 1);
    };
    const std::int64_t along_x = floor_of_half(x * to_signed(dx, shape), shape.width);
    const std::int64_t along_y =
        shape.height == 1 ? 0 : floor_of_half(y * to_signed(dy, shape), shape.height);
    return static_cast<std::uint32_t>(along_x + along_y);
  }
};

Plane plane_of(std::span<const std::uint32_t> codes, const ZCodecShape& shape) {
  const auto half_x = static_cast<std::size_t>(shape.width / 2);
  const auto half_y = static_cast<std::size_t>(shape.height / 2) * static_cast<std::size_t>(shape.width);
  return {.dx = (codes[half_x] - codes[0]) & code_mask(shape),
          .dy = (codes[half_y] - codes[0]) & code_mask(shape)};
}

/// What a line takes in both forms.
struct Coded {
  Plane plane;
  std::uint32_t base = 0;  ///< of the plane
  int plane_bits = 0;      ///< of its largest offset
  std::uint32_t least = 0;
  std::uint32_t most = 0;
  int ends_bits = 0;

  Coded(std::span<const std::uint32_t> codes, const ZCodecShape& shape) : plane(plane_of(codes, shape)) {
    std::int64_t lowest = std::numeric_limits<std::int64_t>::max();
    std::int64_t highest = std::numeric_limits<std::int64_t>::min();
    for (std::size_t i = 0; i < codes.size(); ++i) {
      const std::int64_t above = to_signed(codes[i] - codes[0] - plane.rise(i, shape), shape);
      lowest = std::min(lowest, above);
      highest = std::max(highest, above);
    }
    base = (codes[0] + static_cast<std::uint32_t>(lowest)) & code_mask(shape);
    plane_bits = std::bit_width(static_cast<std::uint64_t>(highest - lowest));
    const auto [first, last] = std::minmax_element(codes.begin(), codes.end());
    least = *first;
    most = *last;
    std::uint32_t farthest = 0;
    for (const std::uint32_t code : codes) {
      farthest = std::max(farthest, std::min(code - least, most - code));
    }
    ends_bits = std::bit_width(farthest);
  }

  [[nodiscard]] ZCodedClass line_class(const ZCodecShape& shape) const {
    for (int shift = kMostCodedShift; shift > 0; --shift) {
      const int bytes = shape.bytes() >> shift;
      if (bytes < kLeastCodedBytes) {
        continue;
      }
      if (plane_bits <= plane_offset_bits(shape, bytes)) {
        return {.form = ZForm::kPlane, .shift = shift};
      }
      if (ends_bits <= ends_offset_bits(shape, bytes)) {
        return {.form = ZForm::kEnds, .shift = shift};
      }
    }
    return {};
  }
};

}  // namespace

int plane_offset_bits(const ZCodecShape& shape, int bytes) {
  return (8 * bytes - 1 - 3 * code_bits(shape)) / shape.samples();
}

int ends_offset_bits(const ZCodecShape& shape, int bytes) {
  return (8 * bytes - 1 - 2 * code_bits(shape)) / shape.samples() - 1;
}

ZCodedClass z_coded_class(std::span<const std::uint32_t> codes, const ZCodecShape& shape) {
  return Coded(codes, shape).line_class(shape);
}

int z_coded_shift(std::span<const std::uint32_t> codes, const ZCodecShape& shape) {
  return z_coded_class(codes, shape).shift;
}

void z_encode(std::span<const std::uint32_t> codes, const ZCodecShape& shape,
              std::vector<std::uint8_t>& bytes) {
  const Coded coded(codes, shape);
  const ZCodedClass line = coded.line_class(shape);
  const int size = shape.bytes() >> line.shift;
  BitWriter writer(bytes, size);
  if (line.form == ZForm::kPlain) {
    for (const std::uint32_t code : codes) {
      writer.put(code, code_bits(shape));
    }
  } else if (line.form == ZForm::kPlane) {
    writer.put(static_cast<std::uint32_t>(ZForm::kPlane), 1);
    writer.put(coded.base, code_bits(shape));
    writer.put(coded.plane.dx, code_bits(shape));
    writer.put(coded.plane.dy, code_bits(shape));
    for (std::size_t i = 0; i < codes.size(); ++i) {
      writer.put((codes[i] - coded.base - coded.plane.rise(i, shape)) & code_mask(shape),
                 plane_offset_bits(shape, size));
    }
  } else {
    writer.put(static_cast<std::uint32_t>(ZForm::kEnds), 1);
    writer.put(coded.least, code_bits(shape));
    writer.put(coded.most, code_bits(shape));
    for (const std::uint32_t code : codes) {
      const bool high = coded.most - code < code - coded.least;
      writer.put(high ? coded.most - code : code - coded.least, ends_offset_bits(shape, size));
      writer.put(high ? 1 : 0, 1);
    }
  }
}

void z_decode(std::span<const std::uint8_t> bytes, const ZCodecShape& shape,
              std::vector<std::uint32_t>& codes) {
  const int size = static_cast<int>(bytes.size());
  codes.assign(static_cast<std::size_t>(shape.samples()), 0);
  BitReader reader(bytes);
  if (size == shape.bytes()) {
    for (std::uint32_t& code : codes) {
      code = reader.take(code_bits(shape));
    }
    return;
  }
  const ZForm form{static_cast<std::uint8_t>(reader.take(1))};
  const std::uint32_t first = reader.take(code_bits(shape));
  const std::uint32_t second = reader.take(code_bits(shape));
  if (form == ZForm::kEnds) {
    for (std::uint32_t& code : codes) {
      const std::uint32_t offset = reader.take(ends_offset_bits(shape, size));
      code = (reader.take(1) != 0 ? second - offset : first + offset) & code_mask(shape);
    }
    return;
  }
  const Plane plane{.dx = second, .dy = reader.take(code_bits(shape))};
  for (std::size_t i = 0; i < codes.size(); ++i) {
    codes[i] =
        (first + plane.rise(i, shape) + reader.take(plane_offset_bits(shape, size))) & code_mask(shape);
  }
}

}  // namespace halfspace
