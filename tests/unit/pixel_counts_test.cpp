// Counts of pixels as bits, against numbers.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <random>

#include "halfspace/fast/pixel_counts.hpp"

namespace halfspace::testing {
namespace {

constexpr std::size_t kPixels = 64;

std::uint32_t count(const fast::PixelCounts& counts, std::size_t tile, std::size_t pixel) {
  std::uint32_t sum = 0;
  for (std::size_t k = 0; k < counts.used(tile); ++k) {
    sum |= static_cast<std::uint32_t>(counts.word(tile, k) >> pixel & 1) << k;
  }
  return sum;
}

}  // namespace

TEST_CASE("pixel counts: masks add up, each tile by itself, to the largest count and no further") {
  constexpr std::size_t kTiles = 3;
  constexpr std::uint32_t kMost = 0xFFFF;
  fast::PixelCounts counts(kTiles);
  counts.start(0, kTiles);
  std::array<std::array<std::uint32_t, kPixels>, kTiles> sum{};
  std::mt19937_64 random;  // its output is fixed by the C++ standard
  for (int i = 0; i < 200'000; ++i) {
    // The first tile is full at the end, in some pixels; the last one is never touched.
    const std::size_t tile = random() % 16 == 0 ? 1 : 0;
    const std::uint64_t some = random();
    const std::uint64_t mask = tile == 0 ? some | 0xF0F : some & random();
    counts.add(tile, mask);
    for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
      sum[tile][pixel] = std::min(sum[tile][pixel] + static_cast<std::uint32_t>(mask >> pixel & 1), kMost);
    }
  }
  REQUIRE(sum[0][0] == kMost);
  for (std::size_t tile = 0; tile < kTiles; ++tile) {
    for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
      INFO("tile " << tile << ", pixel " << pixel);
      CHECK(count(counts, tile, pixel) == sum[tile][pixel]);
    }
  }
  counts.start(0, 1);
  CHECK(counts.used(0) == 0);
  counts.add(0, 5);
  CHECK(count(counts, 0, 0) == 1);
  CHECK(count(counts, 0, 1) == 0);
  CHECK(count(counts, 1, 7) == sum[1][7]);
}

}  // namespace halfspace::testing
