#include "z_codec/lines.hpp"

#include <algorithm>
#include <array>

namespace halfspace::tb {
namespace {

std::uint32_t mask_of(bool half) { return half ? 0xFFFFu : ~0u; }

std::int64_t nearest_zero(std::uint32_t code, bool half) {
  const std::int64_t modulus = std::int64_t{mask_of(half)} + 1;
  const std::int64_t value = code & mask_of(half);
  return value >= modulus / 2 ? value - modulus : value;
}

std::int64_t floor_quotient(std::int64_t value, int divisor) {
  const std::int64_t quotient = value / divisor;
  return quotient - (value % divisor < 0 ? 1 : 0);
}

/// How far a plane has risen at (x, y).
std::int64_t rise_at(const ZCodecShape& line, std::int64_t dx, std::int64_t dy, int x, int y) {
  return floor_quotient(x * dx, line.width / 2) + floor_quotient(y * dy, line.height / 2);
}

/// A number of any size, either sign.
std::int64_t any_size(Random& random, int most_bits) {
  const std::int64_t reach = std::int64_t{1} << random.below(static_cast<std::uint64_t>(most_bits));
  return random.range(-reach, reach);
}

std::uint32_t any_code(bool half, Random& random) {
  const std::uint64_t kind = random.below(6);
  const auto bits = static_cast<std::uint32_t>(random.bits());
  return (kind == 0   ? 0u
          : kind == 1 ? ~0u
          : kind == 2 ? bits % 8
          : kind == 3 ? ~(bits % 8)
                      : bits) &
         mask_of(half);
}

/// A plane through the first sample and the two that the form takes, and samples from `lowest` to `highest`
/// above it, at least one at each.
CodecLine around_a_plane(const CodecShape& shape, bool half, std::int64_t lowest, std::int64_t highest,
                         Random& random) {
  const ZCodecShape shape_of_line = shape.line(half);
  const std::uint32_t first = any_code(half, random);
  const int bits = 8 * shape_of_line.sample_bytes;
  // Now and then the steepest of all.
  const auto gradient = [&] {
    return random.below(8) == 0 ? -(std::int64_t{1} << (bits - 1)) : any_size(random, bits - 1);
  };
  const std::int64_t dx = gradient();
  const std::int64_t dy = gradient();
  CodecLine line{.half = half, .codes = {}};
  std::vector<std::size_t> free;
  for (int y = 0; y < shape_of_line.height; ++y) {
    for (int x = 0; x < shape_of_line.width; ++x) {
      const bool anchor =
          (y == 0 && (x == 0 || x == shape_of_line.width / 2)) || (x == 0 && y == shape_of_line.height / 2);
      if (!anchor) {
        free.push_back(line.codes.size());
      }
      const std::int64_t above = anchor ? 0 : random.range(lowest, highest);
      line.codes.push_back(static_cast<std::uint32_t>(first + rise_at(shape_of_line, dx, dy, x, y) + above) &
                           mask_of(half));
    }
  }
  const auto put = [&](std::size_t which, std::int64_t above) {
    const auto i = static_cast<int>(free[which]);
    const std::int64_t rise =
        rise_at(shape_of_line, dx, dy, i % shape_of_line.width, i / shape_of_line.width);
    line.codes[free[which]] = static_cast<std::uint32_t>(first + rise + above) & mask_of(half);
  };
  const std::size_t low = random.below(free.size());
  put(low, lowest);
  put((low + 1 + random.below(free.size() - 1)) % free.size(), highest);
  return line;
}

/// Samples no farther than `farthest` from one of two ends, at least one as far.
CodecLine around_two_ends(const CodecShape& shape, bool half, std::int64_t farthest, Random& random) {
  const std::int64_t most_code = mask_of(half);
  std::int64_t least = 0;
  std::int64_t most = most_code;
  switch (random.below(4)) {
    case 0:  // as wide as it gets
      break;
    case 1:  // so near that a sample can be as far from either
      least = random.range(0, most_code - std::min(most_code, 2 * farthest));
      most = std::min(most_code, least + 2 * farthest);
      break;
    case 2:  // or a little wider
      least = random.range(0, most_code - std::min(most_code, 2 * farthest + 1));
      most = std::min(most_code, least + 2 * farthest + 1);
      break;
    default:
      least = any_code(half, random);
      most = any_code(half, random);
      if (least > most) {
        std::swap(least, most);
      }
  }
  CodecLine line{.half = half, .codes = {}};
  const auto samples = static_cast<std::size_t>(shape.line(half).samples());
  for (std::size_t i = 0; i < samples; ++i) {
    const std::int64_t offset =
        std::min<std::int64_t>(most - least, random.range(0, random.below(2) == 0 ? farthest : 0));
    line.codes.push_back(static_cast<std::uint32_t>(random.below(2) == 0 ? least + offset : most - offset));
  }
  const std::size_t at = random.below(samples);
  const auto other = [&](std::size_t steps) { return (at + steps * (1 + samples / 4)) % samples; };
  line.codes[at] = static_cast<std::uint32_t>(least);
  line.codes[other(1)] = static_cast<std::uint32_t>(most);
  line.codes[other(2)] = static_cast<std::uint32_t>(random.below(2) == 0 ? std::min(most, least + farthest)
                                                                         : std::max(least, most - farthest));
  return line;
}

/// A size that a line of the format can be coded in, or shift 0 where there is none.
int any_shift(const CodecShape& shape, bool half, Random& random) {
  int most = 0;
  while (shape.has(half, most + 1)) {
    ++most;
  }
  return most == 0 ? 0 : static_cast<int>(random.range(1, most));
}

/// At the limit of a size in one of the forms, or one beyond it.
CodecLine at_a_limit(const CodecShape& shape, bool half, int shift, bool plane, bool beyond, int side,
                     Random& random) {
  const int bytes = shape.line(half).bytes() >> shift;
  const int bits =
      plane ? plane_offset_bits(shape.line(half), bytes) : ends_offset_bits(shape.line(half), bytes);
  const std::int64_t reach = (std::int64_t{1} << bits) - (beyond ? 0 : 1);
  if (!plane) {
    return around_two_ends(shape, half, reach, random);
  }
  const std::int64_t lowest = side == 0 ? 0 : side == 1 ? -reach : -random.range(0, reach);
  return around_a_plane(shape, half, lowest, lowest + reach, random);
}

}  // namespace

std::vector<CodecLine> directed_lines(const CodecShape& shape, Random& random) {
  std::vector<CodecLine> lines;
  for (const bool half : {false, true}) {
    for (const std::uint32_t code : {0u, 1u, mask_of(half)}) {
      lines.push_back({half, std::vector<std::uint32_t>(shape.words(), code)});
    }
    for (int shift = 1; shape.has(half, shift); ++shift) {
      for (const bool plane : {false, true}) {
        for (const bool beyond : {false, true}) {
          for (int side = 0; side < 12; ++side) {
            lines.push_back(at_a_limit(shape, half, shift, plane, beyond, side % 3, random));
          }
        }
      }
    }
    // As far from the plane as a code can be, with neighbours.
    for (int bits = 0; bits < (half ? 16 : 32); ++bits) {
      for (const std::int64_t step : {-1, 0, 1}) {
        const std::int64_t above = (std::int64_t{1} << bits) + step;
        lines.push_back(around_a_plane(shape, half, 0, above, random));
        lines.push_back(around_a_plane(shape, half, -above, 0, random));
      }
    }
  }
  return lines;
}

CodecLine random_line(const CodecShape& shape, Random& random) {
  const bool half = random.below(2) == 0;
  const int shift = any_shift(shape, half, random);
  const std::uint64_t kind = random.below(8);
  if (kind < 4 && shift != 0) {
    return at_a_limit(shape, half, shift, kind % 2 == 0, random.below(4) == 0,
                      static_cast<int>(random.below(3)), random);
  }
  const int bits = half ? 16 : 32;
  if (kind == 7) {
    CodecLine line{.half = half, .codes = {}};
    for (std::size_t i = 0; i < shape.words(); ++i) {
      line.codes.push_back(static_cast<std::uint32_t>(random.bits()) & mask_of(half));
    }
    return line;
  }
  if (kind == 6) {
    return around_two_ends(shape, half, std::int64_t{1} << random.below(16), random);
  }
  const std::int64_t lowest = -std::abs(any_size(random, bits - 2));
  return around_a_plane(shape, half, lowest, std::abs(any_size(random, bits - 2)), random);
}

CodedLine encoded(const CodecLine& line, const CodecShape& shape) {
  CodedLine coded{.half = line.half, .shift = z_coded_shift(line.codes, shape.line(line.half)), .bytes = {}};
  z_encode(line.codes, shape.line(line.half), coded.bytes);
  return coded;
}

CodedLine random_coded_line(const CodecShape& shape, Random& random) {
  if (random.below(2) == 0) {
    return encoded(random_line(shape, random), shape);
  }
  CodedLine coded{.half = random.below(2) == 0, .shift = 0, .bytes = {}, .arbitrary = true};
  coded.shift = random.below(4) == 0 ? 0 : any_shift(shape, coded.half, random);
  const int size = shape.line(coded.half).bytes() >> coded.shift;
  const std::uint64_t kind = random.below(8);
  for (int i = 0; i < size; ++i) {
    coded.bytes.push_back(static_cast<std::uint8_t>(kind == 0 ? 0 : kind == 1 ? ~0 : random.bits()));
  }
  coded.bytes[0] = static_cast<std::uint8_t>(coded.bytes[0] ^ random.below(2));  // the form
  return coded;
}

std::vector<std::uint32_t> by_quad(const std::vector<std::uint32_t>& rows, int width) {
  std::vector<std::uint32_t> quads;
  const int height = static_cast<int>(rows.size()) / width;
  for (int y = 0; y < height; y += 2) {
    for (int x = 0; x < width; x += 2) {
      for (const auto& [dx, dy] : {std::array{0, 0}, std::array{1, 0}, std::array{0, 1}, std::array{1, 1}}) {
        quads.push_back(rows[static_cast<std::size_t>((y + dy) * width + x + dx)]);
      }
    }
  }
  return quads;
}

std::vector<std::uint32_t> port_words(const std::vector<std::uint8_t>& bytes, std::size_t words,
                                      Random* filler) {
  std::vector<std::uint32_t> all(words);
  for (std::size_t i = 0; i < 4 * words; ++i) {
    const std::uint32_t byte = i < bytes.size()    ? bytes[i]
                               : filler != nullptr ? static_cast<std::uint32_t>(filler->below(256))
                                                   : 0;
    all[i / 4] |= byte << (8 * (i % 4));
  }
  return all;
}

LineFacts facts_of(const CodecLine& line, const CodecShape& shape) {
  const ZCodecShape shape_of_line = shape.line(line.half);
  const auto code = [&](int x, int y) {
    return line.codes[static_cast<std::size_t>(y * shape_of_line.width + x)];
  };
  const std::int64_t dx = nearest_zero(code(shape_of_line.width / 2, 0) - code(0, 0), line.half);
  const std::int64_t dy = nearest_zero(code(0, shape_of_line.height / 2) - code(0, 0), line.half);
  const auto [least, most] = std::ranges::minmax(line.codes);
  LineFacts facts;
  std::int64_t lowest = 0;
  std::int64_t highest = 0;
  for (int y = 0; y < shape_of_line.height; ++y) {
    for (int x = 0; x < shape_of_line.width; ++x) {
      const std::int64_t plane = code(0, 0) + rise_at(shape_of_line, dx, dy, x, y);
      const std::int64_t above = nearest_zero(static_cast<std::uint32_t>(code(x, y) - plane), line.half);
      lowest = std::min(lowest, above);
      highest = std::max(highest, above);
      facts.wraps = facts.wraps || plane < 0 || plane > mask_of(line.half);
      const std::uint32_t up = code(x, y) - least;
      const std::uint32_t down = most - code(x, y);
      facts.ends_farthest = std::max(facts.ends_farthest, std::min(up, down));
      facts.tie = facts.tie || (up == down && up != 0);
    }
  }
  const std::int64_t steepest = -(std::int64_t{mask_of(line.half)} + 1) / 2;
  facts.steepest = dx == steepest || dy == steepest;
  facts.plane_range = static_cast<std::uint64_t>(highest - lowest);
  facts.below = lowest < 0;
  return facts;
}

}  // namespace halfspace::tb
