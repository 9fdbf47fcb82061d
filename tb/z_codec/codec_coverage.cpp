#include "z_codec/codec_coverage.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace halfspace::tb {
namespace {

std::string size_name(bool half, int shift) {
  return fmt::format("{} codes, shift {}", half ? "16-bit" : "32-bit", shift);
}

/// `bits` bits of a string of bytes, from bit `at` on.
std::uint64_t bits_at(const std::vector<std::uint8_t>& bytes, int at, int bits) {
  std::uint64_t value = 0;
  for (int i = 0; i < bits; ++i) {
    const auto bit = static_cast<std::size_t>(at + i);
    value |= static_cast<std::uint64_t>(bytes[bit / 8] >> (bit % 8) & 1) << i;
  }
  return value;
}

}  // namespace

CodecCoverage::CodecCoverage(const CodecShape& shape) : shape_(shape) {
  for (const bool half : {false, true}) {
    for (const char* side : {"encoder", "decoder"}) {
      bins_.add(fmt::format("{}: plain, {}", side, size_name(half, 0)));
    }
    for (int shift = 1; shape.has(half, shift); ++shift) {
      const std::string size = size_name(half, shift);
      for (const char* form : {"plane", "ends"}) {
        bins_.add(fmt::format("encoder: {}, {}", form, size));
        bins_.add(fmt::format("encoder: {}, {}, largest offset at the limit", form, size));
        bins_.add(fmt::format("encoder: {}, {}, largest offset one beyond", form, size));
        bins_.add(fmt::format("decoder: {}, {}, of an encoder", form, size));
        bins_.add(fmt::format("decoder: {}, {}, any bytes", form, size));
      }
      bins_.add(fmt::format("encoder: plane, {}, samples below the first", size));
      bins_.add(fmt::format("encoder: {}, both forms fit", size));
      bins_.add(fmt::format("decoder: plane, {}, an offset at the limit", size));
      bins_.add(fmt::format("decoder: ends, {}, an offset at the limit from the least", size));
      bins_.add(fmt::format("decoder: ends, {}, an offset at the limit from the most", size));
    }
    if (shape.has(half, 1)) {
      const char* const bits = half ? "16-bit" : "32-bit";
      bins_.add(fmt::format("encoder: plane of {} codes that wraps", bits));
      bins_.add(fmt::format("encoder: plane of {} codes as steep as it gets", bits));
      bins_.add(fmt::format("encoder: ends of {} codes, a sample as far from either", bits));
      bins_.add(fmt::format("encoder: ends of {} codes, from 0 to the largest", bits));
    }
  }
  for (const char* side : {"encoder", "decoder"}) {
    for (const char* before : {"32-bit", "16-bit"}) {
      for (const char* after : {"32-bit", "16-bit"}) {
        bins_.add(fmt::format("{}: {} codes behind {} ones", side, after, before));
      }
    }
    for (const char* gap : {"a cycle", "some cycles", "a long time"}) {
      bins_.add(fmt::format("{}: after {} without a line", side, gap));
    }
    bins_.add(fmt::format("{}: reset with a line under way", side));
  }
}

void CodecCoverage::line(const CodecLine& line, const CodedLine& coded) {
  const ZCodecShape shape = shape_.line(line.half);
  const LineFacts facts = facts_of(line, shape_);
  const bool ends = (coded.bytes[0] & 1) != 0;
  const char* const bits = line.half ? "16-bit" : "32-bit";
  for (int shift = 1; shape_.has(line.half, shift); ++shift) {
    const int bytes = shape.bytes() >> shift;
    const std::string size = size_name(line.half, shift);
    const std::uint64_t plane_most = (std::uint64_t{1} << plane_offset_bits(shape, bytes)) - 1;
    const std::uint64_t ends_most = (std::uint64_t{1} << ends_offset_bits(shape, bytes)) - 1;
    // Beyond is seen only where the other form does not take the line.
    if (coded.shift < shift) {
      if (facts.plane_range == plane_most + 1) {
        bins_.hit(fmt::format("encoder: plane, {}, largest offset one beyond", size));
      }
      if (facts.ends_farthest == ends_most + 1) {
        bins_.hit(fmt::format("encoder: ends, {}, largest offset one beyond", size));
      }
    }
    if (coded.shift == shift) {
      bins_.hit(fmt::format("encoder: {}, {}", ends ? "ends" : "plane", size));
      if (!ends && facts.plane_range == plane_most) {
        bins_.hit(fmt::format("encoder: plane, {}, largest offset at the limit", size));
      }
      if (!ends && facts.below) {
        bins_.hit(fmt::format("encoder: plane, {}, samples below the first", size));
      }
      if (ends && facts.ends_farthest == ends_most) {
        bins_.hit(fmt::format("encoder: ends, {}, largest offset at the limit", size));
      }
      if (facts.plane_range <= plane_most && facts.ends_farthest <= ends_most) {
        bins_.hit(fmt::format("encoder: {}, both forms fit", size));
      }
    }
  }
  if (coded.shift == 0) {
    bins_.hit(fmt::format("encoder: plain, {}", size_name(line.half, 0)));
  } else if (ends) {
    const auto [least, most] = std::ranges::minmax(line.codes);
    if (facts.tie) {
      bins_.hit(fmt::format("encoder: ends of {} codes, a sample as far from either", bits));
    }
    if (least == 0 && most == (line.half ? 0xFFFFu : ~0u)) {
      bins_.hit(fmt::format("encoder: ends of {} codes, from 0 to the largest", bits));
    }
  } else {
    if (facts.wraps) {
      bins_.hit(fmt::format("encoder: plane of {} codes that wraps", bits));
    }
    if (facts.steepest) {
      bins_.hit(fmt::format("encoder: plane of {} codes as steep as it gets", bits));
    }
  }
}

void CodecCoverage::coded(const CodedLine& coded) {
  const ZCodecShape shape = shape_.line(coded.half);
  const std::string size = size_name(coded.half, coded.shift);
  if (coded.shift == 0) {
    bins_.hit(fmt::format("decoder: plain, {}", size));
    return;
  }
  const bool ends = (coded.bytes[0] & 1) != 0;
  bins_.hit(fmt::format("decoder: {}, {}, {}", ends ? "ends" : "plane", size,
                        coded.arbitrary ? "any bytes" : "of an encoder"));
  const int bytes = shape.bytes() >> coded.shift;
  const int bits = ends ? ends_offset_bits(shape, bytes) : plane_offset_bits(shape, bytes);
  const int width = bits + (ends ? 1 : 0);
  const int first = 1 + (ends ? 2 : 3) * 8 * shape.sample_bytes;
  for (int i = 0; i < shape.samples(); ++i) {
    const std::uint64_t sample = bits_at(coded.bytes, first + i * width, width);
    const std::uint64_t limit = (std::uint64_t{1} << bits) - 1;
    if ((sample & limit) == limit) {
      bins_.hit(!ends ? fmt::format("decoder: plane, {}, an offset at the limit", size)
                : sample >> bits == 0
                    ? fmt::format("decoder: ends, {}, an offset at the limit from the least", size)
                    : fmt::format("decoder: ends, {}, an offset at the limit from the most", size));
    }
  }
}

void CodecCoverage::taken(const std::string& side, std::uint64_t after, bool half, bool half_before) {
  constexpr std::uint64_t kLong = 8;  // nothing is left inside
  if (after == 1) {
    bins_.hit(fmt::format("{}: {} codes behind {} ones", side, half ? "16-bit" : "32-bit",
                          half_before ? "16-bit" : "32-bit"));
  } else {
    bins_.hit(fmt::format("{}: after {} without a line", side,
                          after == 2       ? "a cycle"
                          : after <= kLong ? "some cycles"
                                           : "a long time"));
  }
}

}  // namespace halfspace::tb
