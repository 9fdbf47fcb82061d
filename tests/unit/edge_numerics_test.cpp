/// The two facts that make the edge hardware small, and the widths that rest on them
/// (docs/units/edge_evaluator.md).
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <random>

#include "halfspace/numerics/edge.hpp"
#include "halfspace/numerics/widths.hpp"

namespace halfspace {
namespace {

__extension__ using Int128 = __int128;

/// The value at the tile origin, saturated to `step_bits`-wide steps: the formula of saturate_local_edge at
/// any width.
constexpr std::int64_t saturate(std::int64_t value, int tile_size, int step_bits) {
  const std::int64_t limit = std::int64_t{tile_size} << step_bits;
  return std::clamp(value, -limit, limit - 1);
}

/// True when `value` is a signed number of `bits` bits.
constexpr bool fits(Int128 value, int bits) {
  const Int128 limit = static_cast<Int128>(1) << (bits - 1);
  return value >= -limit && value < limit;
}

TEST_CASE("saturation keeps every sign in a tile, exhaustively at small widths") {
  constexpr int kTileSize = 4;
  constexpr int kTileLog2 = 2;
  constexpr int kStepBits = 4;
  constexpr int kStep = 1 << (kStepBits - 1);
  constexpr int kSpan = 4 * kTileSize << kStepBits;  // well past the limit on both sides
  std::int64_t wrong_signs = 0;
  std::int64_t too_wide = 0;
  for (std::int64_t value = -kSpan; value <= kSpan; ++value) {
    const std::int64_t local = saturate(value, kTileSize, kStepBits);
    for (int a = -kStep; a < kStep; ++a) {
      for (int b = -kStep; b < kStep; ++b) {
        for (int y = 0; y < kTileSize; ++y) {
          for (int x = 0; x < kTileSize; ++x) {
            wrong_signs += (local + x * a + y * b >= 0) != (value + x * a + y * b >= 0);
            too_wide += !fits(local + x * a + y * b, kStepBits + kTileLog2 + 2);
          }
        }
      }
    }
  }
  CHECK(wrong_signs == 0);
  CHECK(too_wide == 0);
}

TEST_CASE("one bit less than LocalEdgeBits is not enough") {
  // The largest saturated value plus the largest steps, at the width that the case above allows.
  CHECK_FALSE(fits(saturate(1 << 20, 4, 4) + 3 * 7 + 3 * 7, 4 + 2 + 1));
}

template <int TileSize>
void check_full_width(int sub_pixel_bits) {
  const Widths widths{.SubPixelBits = sub_pixel_bits, .TileSize = TileSize};
  std::mt19937_64 random(static_cast<std::uint64_t>(TileSize * 16 + sub_pixel_bits));
  const std::int64_t step = std::int64_t{1} << (widths.StepBits - 1);
  const auto pick = [&](std::int64_t first, std::int64_t last) {
    return first + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(last - first + 1));
  };
  const std::int64_t limit = std::int64_t{TileSize} << widths.StepBits;
  for (int i = 0; i < 20000; ++i) {
    const std::array<std::int64_t, 5> steps = {-step, -1, 0, step - 1, pick(-step, step - 1)};
    const std::int64_t a = steps[random() % 5];
    const std::int64_t b = steps[random() % 5];
    const std::int64_t half = std::int64_t{1} << (widths.PixelEdgeBits - 1);
    const std::array<std::int64_t, 6> values = {
        pick(-half, half - 1), half - 1, -half, pick(-3, 3), limit + pick(-2, 2), -limit + pick(-2, 2)};
    const std::int64_t value = values[random() % 6];
    const std::int64_t model = saturate_local_edge<TileSize>(value);
    const std::int64_t narrow = saturate(value, TileSize, widths.StepBits);
    REQUIRE(fits(narrow, widths.LocalEdgeBits - 1));
    for (int y = 0; y < TileSize; ++y) {
      for (int x = 0; x < TileSize; ++x) {
        const bool exact =
            static_cast<Int128>(value) + static_cast<Int128>(x) * a + static_cast<Int128>(y) * b >= 0;
        if ((model + x * a + y * b >= 0) != exact || (narrow + x * a + y * b >= 0) != exact ||
            !fits(narrow + x * a + y * b, widths.LocalEdgeBits) || !fits(model + x * a + y * b, 32)) {
          FAIL("value " << value << " a " << a << " b " << b << " at " << x << "," << y);
        }
      }
    }
  }
}

TEST_CASE("saturation keeps every sign in a tile at full width") {
  for (int sub_pixel_bits = 4; sub_pixel_bits <= 8; ++sub_pixel_bits) {
    check_full_width<4>(sub_pixel_bits);
    check_full_width<8>(sub_pixel_bits);
    check_full_width<16>(sub_pixel_bits);
  }
}

TEST_CASE("the whole part of E decides coverage at pixel centres, exhaustively at small widths") {
  // 2 sub-pixel bits; every edge on an 8 x 8 grid of vertices; centres at 4n + 2.
  constexpr int kSubPixelBits = 2;
  std::int64_t wrong = 0;
  std::int64_t changed_low_bits = 0;
  for (int xi = 0; xi < 8; ++xi) {
    for (int yi = 0; yi < 8; ++yi) {
      for (int xj = 0; xj < 8; ++xj) {
        for (int yj = 0; yj < 8; ++yj) {
          const int a = yi - yj;
          const int b = xj - xi;
          const bool owns = a > 0 || (a == 0 && b > 0);
          const int low_bits = (a * (2 - xi) + b * (2 - yi) - !owns) & 3;
          for (int y = -3; y <= 3; ++y) {
            for (int x = -3; x <= 3; ++x) {
              const int exact = a * (4 * x + 2 - xi) + b * (4 * y + 2 - yi);
              const int biased = exact - !owns;
              const bool inside = exact > 0 || (exact == 0 && owns);
              wrong += (drop_sub_pixel(biased, kSubPixelBits) >= 0) != inside;
              changed_low_bits += (biased & 3) != low_bits;
            }
          }
        }
      }
    }
  }
  CHECK(wrong == 0);
  CHECK(changed_low_bits == 0);
}

TEST_CASE("whole parts add up without their fractions from tile origin to pixel") {
  std::mt19937_64 random(7);
  for (int i = 0; i < 100000; ++i) {
    const int sub_pixel_bits = 4 + static_cast<int>(random() % 5);
    const Widths widths{.SubPixelBits = sub_pixel_bits, .TileSize = 8};
    const auto coordinate = [&] {
      const std::int64_t extreme = std::int64_t{1} << (widths.CoordBits - 1);
      const std::int64_t free =
          static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(2 * extreme)) - extreme;
      const std::array<std::int64_t, 4> choice = {-extreme, extreme - 1, free, free % 4096};
      return choice[random() % 4];
    };
    const std::int64_t xi = coordinate();
    const std::int64_t yi = coordinate();
    const std::int64_t xj = coordinate();
    const std::int64_t yj = coordinate();
    const std::int64_t a = yi - yj;
    const std::int64_t b = xj - xi;
    const bool owns = a > 0 || (a == 0 && b > 0);
    const std::int64_t one = std::int64_t{1} << sub_pixel_bits;
    const auto exact_at = [&](std::int64_t x, std::int64_t y) {
      return static_cast<Int128>(a) * (x * one + one / 2 - xi) +
             static_cast<Int128>(b) * (y * one + one / 2 - yi);
    };
    const auto tile_x = static_cast<std::int64_t>(random() % 2048) * 8;
    const auto tile_y = static_cast<std::int64_t>(random() % 2048) * 8;
    const Int128 origin = exact_at(tile_x, tile_y) - !owns;
    REQUIRE(fits(origin, widths.EdgeBits));
    const std::int64_t pixel_edge = drop_sub_pixel(static_cast<std::int64_t>(origin), sub_pixel_bits);
    const auto x = static_cast<std::int64_t>(random() % 8);
    const auto y = static_cast<std::int64_t>(random() % 8);
    const Int128 exact = exact_at(tile_x + x, tile_y + y);
    REQUIRE((pixel_edge + x * a + y * b >= 0) == (exact > 0 || (exact == 0 && owns)));
  }
}

TEST_CASE("EdgeBits holds E at the extremes of the guard band") {
  for (int sub_pixel_bits = 4; sub_pixel_bits <= 8; ++sub_pixel_bits) {
    const Widths widths{.SubPixelBits = sub_pixel_bits, .TileSize = 8};
    const std::array<std::int64_t, 2> ends = {-(std::int64_t{1} << (widths.CoordBits - 1)),
                                              (std::int64_t{1} << (widths.CoordBits - 1)) - 1};
    Int128 least = 0;
    Int128 most = 0;
    // E is linear in the sample and in each coordinate of the vertices: its extremes are at corners.
    for (unsigned corner = 0; corner < 64; ++corner) {
      const auto end = [&](unsigned bit) { return ends[corner >> bit & 1]; };
      const Int128 a = end(0) - end(1);
      const Int128 b = end(2) - end(3);
      const Int128 e = a * (end(4) - end(3)) + b * (end(5) - end(0));
      least = std::min(least, e - 1);
      most = std::max(most, e);
      CHECK(fits(a, widths.StepBits));
      CHECK(fits(b, widths.StepBits));
    }
    CHECK(fits(least, widths.EdgeBits));
    CHECK(fits(most, widths.EdgeBits));
    // E is twice the area of a triangle in a square of side 2^CoordBits - 1, so never more than the square:
    // two of the bits are in reserve. They hold the sum of two products of which nothing is known.
    CHECK(fits(most, widths.EdgeBits - 2));
    CHECK(fits(least, widths.EdgeBits - 2));
    CHECK_FALSE(fits(most, widths.EdgeBits - 3));
  }
  STATIC_REQUIRE(Widths{}.EdgeBits == 51);
}

}  // namespace
}  // namespace halfspace
