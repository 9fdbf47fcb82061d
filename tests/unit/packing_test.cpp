/// Does a packet survive its bits? Are the bits where SystemVerilog puts them?
#include "halfspace/units/packing.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <random>
#include <vector>

namespace halfspace {
namespace {

constexpr std::array<Widths, 6> kConfigurations = {
    Widths{.SubPixelBits = 8, .TileSize = 8},  Widths{.SubPixelBits = 4, .TileSize = 4},
    Widths{.SubPixelBits = 8, .TileSize = 16}, Widths{.SubPixelBits = 5, .TileSize = 16},
    Widths{.SubPixelBits = 7, .TileSize = 4},  Widths{.SubPixelBits = 6, .TileSize = 8}};

template <class Packet>
std::vector<std::uint32_t> random_words(const Widths& widths, std::mt19937_64& random) {
  const int bits = packed_bits<Packet>(widths);
  std::vector<std::uint32_t> words(words_for(bits));
  for (std::uint32_t& word : words) {
    word = static_cast<std::uint32_t>(random());
  }
  if (bits % 32 != 0) {
    words.back() &= (1u << bits % 32) - 1;
  }
  return words;
}

template <class Packet>
void check_round_trip(const Widths& widths) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 1000; ++i) {
    const std::vector<std::uint32_t> words = random_words<Packet>(widths, random);
    const auto packet = unpack<Packet>(words, widths);
    CHECK(fits_widths(packet, widths));
    std::vector<std::uint32_t> again(words.size());
    pack(packet, widths, again);
    REQUIRE(again == words);
  }
}

TEST_CASE("every pattern of bits survives unpack and pack") {
  for (const Widths& widths : kConfigurations) {
    check_round_trip<TileJob>(widths);
    check_round_trip<Coverage>(widths);
  }
}

TEST_CASE("the width of a packet is the sum of its fields") {
  constexpr Widths kBase;
  // slot, tile_x, tile_y, e[3], a[3], b[3], sure, accept, four bounds
  STATIC_REQUIRE(packed_bits<TileJob>(kBase) == 8 + 11 + 11 + 3 * 51 + 3 * 25 + 3 * 25 + 1 + 3 + 4 * 3);
  STATIC_REQUIRE(packed_bits<Coverage>(kBase) == 8 + 11 + 11 + 1 + 2 * 51 + 64);
  STATIC_REQUIRE(kPackedWords<TileJob, 8, 8> == 11);
  STATIC_REQUIRE(kPackedWords<Coverage, 16, 8> == (8 + 10 + 10 + 1 + 2 * 51 + 256 + 31) / 32);
}

TEST_CASE("the first field is the most significant and element 0 of an array the lowest") {
  constexpr Widths kBase;
  TileJob job;
  job.y_last = 5;
  job.a = {-1, 0, 1};
  std::vector<std::uint32_t> words(words_for(packed_bits<TileJob>(kBase)));
  pack(job, kBase, words);
  CHECK(extract_bits(words, 0, 3) == 5);
  constexpr int kA = 4 * 3 + 3 + 1 + 3 * 25;
  CHECK(extract_bits(words, kA, 25) == 0x1ffffff);
  CHECK(extract_bits(words, kA + 25, 25) == 0);
  CHECK(extract_bits(words, kA + 50, 25) == 1);
}

TEST_CASE("values outside their width do not fit") {
  constexpr Widths kBase;
  TileJob job;
  CHECK(fits_widths(job, kBase));
  job.a[1] = 1 << 24;
  CHECK_FALSE(fits_widths(job, kBase));
  job.a[1] = -(1 << 24);
  CHECK(fits_widths(job, kBase));
  job.x_last = 8;
  CHECK_FALSE(fits_widths(job, kBase));
  job.x_last = 7;
  job.e[2] = std::int64_t{1} << 50;
  CHECK_FALSE(fits_widths(job, kBase));
  Coverage coverage;
  coverage.mask.word[1] = 1;
  CHECK_FALSE(fits_widths(coverage, kBase));
  CHECK(fits_widths(coverage, Widths{.SubPixelBits = 8, .TileSize = 16}));
}

TEST_CASE("field slots cover a packet without gap, most significant first") {
  for (const Widths& widths : kConfigurations) {
    int lsb = packed_bits<TileJob>(widths);
    for (const FieldSlot& slot : field_slots<TileJob>(widths)) {
      CHECK(slot.lsb + slot.width == lsb);
      lsb = slot.lsb;
    }
    CHECK(lsb == 0);
  }
  CHECK(field_slots<Coverage>(Widths{})[4].name == "e[1]");
}

}  // namespace
}  // namespace halfspace
