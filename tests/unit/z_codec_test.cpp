#include "halfspace/units/z_codec.hpp"

#include <catch2/catch.hpp>
#include <numeric>

namespace halfspace::testing {
namespace {

using Codes = std::vector<std::uint32_t>;
using Bytes = std::vector<std::uint8_t>;

Bytes coded(const Codes& codes, const ZCodecShape& shape) {
  Bytes bytes;
  z_encode(codes, shape, bytes);
  CHECK(static_cast<int>(bytes.size()) == shape.bytes() >> z_coded_shift(codes, shape));
  Codes back;
  z_decode(bytes, shape, back);
  CHECK(back == codes);
  return bytes;
}

/// Codes of a plane that falls by `dx` / 8 and rises by `dy` / 8 a sample.
Codes plane(const ZCodecShape& shape, int dx, int dy) {
  Codes codes;
  for (int i = 0; i < shape.samples(); ++i) {
    codes.push_back(
        static_cast<std::uint32_t>(40000 + (dy * (i / shape.width) - dx * (i % shape.width)) / 8));
  }
  return codes;
}

}  // namespace

TEST_CASE("z_codec: every size that a line can be coded in holds both forms") {
  for (const int tile : {4, 8, 16}) {
    for (const int parts : {1, 2, 4}) {
      for (const int sample_bytes : {2, 4}) {
        const ZCodecShape shape{.width = tile, .height = tile / parts, .sample_bytes = sample_bytes};
        for (int shift = 1; shift <= kMostCodedShift; ++shift) {
          const int bytes = shape.bytes() >> shift;
          CAPTURE(tile, parts, sample_bytes, bytes);
          if (bytes >= kLeastCodedBytes) {
            CHECK(plane_offset_bits(shape, bytes) >= 0);
            CHECK(ends_offset_bits(shape, bytes) >= 0);
          }
        }
      }
    }
  }
}

TEST_CASE("z_codec: the bits of a plane") {
  // 8x4 codes of 16 bits in 32 bytes: 207 bits of offsets, 6 for each of 32 samples.
  const ZCodecShape shape{.width = 8, .height = 4, .sample_bytes = 2};
  Codes codes(32);
  for (std::uint32_t i = 0; i < 32; ++i) {
    codes[i] = 0x1234 + 3 * (i % 8) - 5 * (i / 8);
  }
  codes[9] += 2;
  const Bytes bytes = coded(codes, shape);
  REQUIRE(bytes.size() == 32);
  // 0, base 0x1234, dx 12, dy -10, then the only offset that is not 0: sample 9, from bit 49 + 6 * 9 on.
  Bytes expected(32);
  const auto put = [&](int at, std::uint32_t value) {
    for (int i = 0; i < 16; ++i) {
      expected[static_cast<std::size_t>((at + i) / 8)] |=
          static_cast<std::uint8_t>((value >> i & 1) << ((at + i) % 8));
    }
  };
  put(1, 0x1234);
  put(17, 12);
  put(33, 0xFFF6);
  put(49 + 54, 2);
  CHECK(bytes == expected);
}

TEST_CASE("z_codec: the bits of two layers") {
  // 4x4 codes of 32 bits in 32 bytes: 191 bits for 16 samples, 11 for each: 10 of offset, then the end.
  const ZCodecShape shape{.width = 4, .height = 4};
  Codes codes(16, 100);
  for (const std::size_t i : {1u, 6u, 11u}) {
    codes[i] = 0x7FFFFFF0;
  }
  codes[3] = 107;
  codes[6] = 0x7FFFFFEF;
  const Bytes bytes = coded(codes, shape);
  REQUIRE(bytes.size() == 32);
  Bytes expected(32);
  const auto put = [&](int at, std::uint64_t value, int bits) {
    for (int i = 0; i < bits; ++i) {
      expected[static_cast<std::size_t>((at + i) / 8)] |=
          static_cast<std::uint8_t>((value >> i & 1) << ((at + i) % 8));
    }
  };
  put(0, 1, 1);
  put(1, 100, 32);
  put(33, 0x7FFFFFF0, 32);
  put(65 + 1 * 11, 1u << 10, 11);
  put(65 + 3 * 11, 7, 11);
  put(65 + 6 * 11, 1u << 10 | 1, 11);
  put(65 + 11 * 11, 1u << 10, 11);
  CHECK(bytes == expected);
}

TEST_CASE("z_codec: how far lines shrink") {
  const ZCodecShape tile;
  CHECK(z_coded_shift(Codes(64, 12345), tile) == 3);
  // Rounded down, a plane is within 3 of what its anchors say.
  CHECK(z_coded_shift(plane(tile, 13, 7), tile) == 3);
  Codes far_apart = plane(tile, 13, 7);
  far_apart[20] += 40;
  CHECK(z_coded_shift(far_apart, tile) == 2);
  far_apart[20] += 10000;  // two layers now
  CHECK(z_coded_shift(far_apart, tile) == 2);
  far_apart[40] += 5000;  // three
  CHECK(z_coded_shift(far_apart, tile) == 1);
  far_apart[40] += 15000;
  CHECK(z_coded_shift(far_apart, tile) == 0);
  // A line of 32 bytes is what memory moves at once.
  CHECK(z_coded_shift(Codes(16, 0), {.width = 4, .height = 4, .sample_bytes = 2}) == 0);
  CHECK(z_coded_shift(Codes(16, 0), {.width = 4, .height = 4}) == 1);
}

TEST_CASE("z_codec: the class of a line is its form and its size") {
  const ZCodecShape tile;
  const auto is = [&](const Codes& codes, ZForm form, int shift) {
    return z_coded_class(codes, tile) == ZCodedClass{.form = form, .shift = shift};
  };
  Codes line(64, 12345);
  CHECK(is(line, ZForm::kPlane, 3));  // both forms fit
  line = plane(tile, 13, 7);
  CHECK(is(line, ZForm::kPlane, 3));
  line[20] += 40;
  CHECK(is(line, ZForm::kPlane, 2));  // both fit again
  line[20] += 10000;
  CHECK(is(line, ZForm::kEnds, 2));
  line = Codes(64, 12345);
  line[20] = 0x40000000;  // two layers, each flat
  CHECK(is(line, ZForm::kEnds, 3));
  line[40] = 0x20000000;
  CHECK(is(line, ZForm::kPlain, 0));
}

TEST_CASE("z_codec: a line that does not shrink is its codes, little endian") {
  const ZCodecShape shape{.width = 4, .height = 4};
  Codes codes(16);
  std::iota(codes.begin(), codes.end(), 0u);
  codes[7] = 0x89ABCDEF;
  codes[9] = 0x40000000;
  const Bytes bytes = coded(codes, shape);
  REQUIRE(bytes.size() == 64);
  CHECK(bytes[28] == 0xEF);
  CHECK(bytes[31] == 0x89);
  CHECK(bytes[39] == 0x40);
}

}  // namespace halfspace::testing
