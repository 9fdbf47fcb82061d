// Setup, the walk over blocks and tiles, and the edge evaluator with any samples a pixel: every sample is
// covered as the definition says, and what is left out, or accepted, is so by the definition.
#include <catch2/catch.hpp>
#include <map>
#include <tuple>
#include <vector>

#include "../property/random.hpp"
#include "../triangles.hpp"
#include "halfspace/units/block_walker.hpp"
#include "halfspace/units/edge_evaluator.hpp"
#include "halfspace/units/setup.hpp"
#include "halfspace/units/tile_walker.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

constexpr int kSide = 50;  // not a multiple of any tile

SamplePattern random_pattern(Random& random) {
  const int count = 1 << random.between(0, 4);
  SamplePattern pattern = standard_samples(count);
  if (random.between(0, 1) == 0) {
    for (SamplePosition& each : pattern.at) {
      each = {.x = static_cast<std::uint8_t>(random.between(0, 15)),
              .y = static_cast<std::uint8_t>(random.between(0, 15))};
    }
  }
  return pattern;
}

ScreenTriangle random_triangle(Random& random, int bits) {
  const std::int64_t one = std::int64_t{1} << bits;
  const std::int64_t reach = random.between(0, 2) == 0 ? one : random.between(0, 1) == 0 ? 6 * one : 60 * one;
  const std::int64_t x = random.between(-one, (kSide + 1) * one);
  const std::int64_t y = random.between(-one, (kSide + 1) * one);
  // Every other triangle on sixteenths, so that its edges meet samples.
  const std::int64_t step = random.between(0, 1) == 0 ? one / 16 : 1;
  ScreenTriangle triangle;
  for (ScreenVertex& v : triangle.v) {
    v.x = static_cast<std::int32_t>((x + random.between(-reach, reach)) / step * step);
    v.y = static_cast<std::int32_t>((y + random.between(-reach, reach)) / step * step);
  }
  return triangle;
}

template <int TileSize>
class Walked {
 public:
  Walked(const ScreenTriangle& triangle, const WalkerConfig& config)
      : grid_(grid(triangle)), config_(config), counts_(samples()) {}

  /// A step that only leads the walk.
  void pass(const GridPlace& /*cell*/, int /*side*/) {}

  void block(const BlockJob& job, std::uint64_t touched) {
    CHECK((job.tiles & ~touched) == 0);
    tile_walker<TileSize>(job, config_, *this);
  }

  void tile(const TileJob& job, bool whole) {
    const int column = job.tile_x / config_.samples.count;
    const int sample = job.tile_x % config_.samples.count;
    const std::tuple<int, int, int> here{job.tile_y, column, sample};
    if (std::get<0>(last_) == job.tile_y && std::get<1>(last_) == column) {
      REQUIRE(sample == std::get<2>(last_) + 1);  // the samples of a tile follow each other
    } else {
      REQUIRE(sample == 0);
      REQUIRE(std::get<2>(last_) == config_.samples.count - 1);
    }
    last_ = here;
    const Coverage coverage = edge_evaluator<TileSize>(job, config_.sub_pixel_bits);
    REQUIRE(coverage.tile_x == job.tile_x);
    for (int y = 0; y < TileSize; ++y) {
      for (int x = 0; x < TileSize; ++x) {
        const bool covered = test<TileSize>(coverage.mask, x, y);
        REQUIRE((covered || !whole));
        const int px = column * TileSize + x;
        const int py = job.tile_y * TileSize + y;
        if (px < kSide && py < kSide) {
          counts_[at(px, py, sample)] += covered ? 1 : 0;
        } else {
          REQUIRE_FALSE(covered);
        }
      }
    }
    check_accept(job, column, sample);
  }

  /// Against the definition, in bounds that hold all of the target.
  void check() const {
    REQUIRE(std::get<2>(last_) == config_.samples.count - 1);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        for (int sample = 0; sample < config_.samples.count; ++sample) {
          const bool expected = reference::covers(grid_, place(x, y, sample), reference::TieRule::kTopLeft);
          REQUIRE(counts_[at(x, y, sample)] == (expected ? 1 : 0));
        }
      }
    }
  }

 private:
  [[nodiscard]] std::size_t samples() const {
    return static_cast<std::size_t>(kSide * kSide * config_.samples.count);
  }
  [[nodiscard]] std::size_t at(int x, int y, int sample) const {
    return static_cast<std::size_t>((sample * kSide + y) * kSide + x);
  }
  [[nodiscard]] reference::GridPoint place(int x, int y, int sample) const {
    const SamplePosition& p = config_.samples.at[static_cast<std::size_t>(sample)];
    return reference::place_in_pixel(x, y, p.x, p.y, config_.sub_pixel_bits);
  }

  /// An edge is accepted where it owns all samples of the tile, not where it owns fewer.
  void check_accept(const TileJob& job, int column, int sample) const {
    for (std::size_t i = 0; i < 3; ++i) {
      bool all = true;
      for (int y = 0; y < TileSize; ++y) {
        for (int x = 0; x < TileSize; ++x) {
          // From the packet's own edge, pixel by pixel.
          const std::int64_t e = job.e[i] + ((std::int64_t{job.a[i]} * x + std::int64_t{job.b[i]} * y)
                                             << config_.sub_pixel_bits);
          all = all && e >= 0;
        }
      }
      REQUIRE((job.accept >> i & 1) == (all && config_.trivial_accept ? 1 : 0));
    }
    // The packet's edge is that of the definition at the sample of the tile's first pixel.
    const reference::GridPoint first = place(column * TileSize, job.tile_y * TileSize, sample);
    bool inside = true;
    for (const std::int64_t e : job.e) {
      inside = inside && e >= 0;
    }
    REQUIRE(inside == reference::covers(grid_, first, reference::TieRule::kTopLeft));
  }

  reference::GridTriangle grid_;
  WalkerConfig config_;
  std::vector<int> counts_;
  std::tuple<int, int, int> last_{-1, -1, config_.samples.count - 1};
};

/// Any legal walk: the led ones need the reject test, and blocks of up to two levels.
void draw_walk(Random& random, WalkerConfig& config) {
  config.levels = static_cast<int>(random.between(1, 3));
  config.order = static_cast<WalkOrder>(random.between(0, 5));
  config.tile_order = static_cast<TileOrder>(random.between(0, 3));
  if (config.levels == 3 || !config.trivial_reject) {
    config.levels = config.trivial_reject ? config.levels : static_cast<int>(random.between(1, 2));
    config.order = is_led(config.order) ? WalkOrder::kRaster : config.order;
  }
}

template <int TileSize>
bool check_triangle(Random& random) {
  WalkerConfig config{.sub_pixel_bits = static_cast<int>(random.between(4, 8)),
                      .block_size = TileSize << random.between(1, 3),
                      .trivial_reject = random.between(0, 3) != 0,
                      .trivial_accept = random.between(0, 3) != 0,
                      .sample_reject = false,
                      .samples = random_pattern(random)};
  draw_walk(random, config);
  const ScreenTriangle triangle = random_triangle(random, config.sub_pixel_bits);
  const SetupState state{.sub_pixel_bits = config.sub_pixel_bits,
                         .bounds = {.x_last = kSide - 1, .y_last = kSide - 1},
                         .samples = config.samples.box()};
  SetupTriangle out;
  Walked<TileSize> walked(triangle, config);
  const SetupVerdict verdict = setup(triangle, state, out);
  if (verdict == SetupVerdict::kDrawn) {
    block_walker<TileSize>(out, config, 0, walked);
  }
  walked.check();  // of a dropped triangle: nothing is covered
  return verdict == SetupVerdict::kDrawn;
}

}  // namespace

TEST_CASE("sample walk: every sample is covered as the definition says", "[property]") {
  CAPTURE(seed());
  Random random(seed());
  int drawn = 0;
  for (int n = 0; n < 400; ++n) {
    drawn += check_triangle<4>(random) ? 1 : 0;
    drawn += check_triangle<8>(random) ? 1 : 0;
    drawn += check_triangle<16>(random) ? 1 : 0;
  }
  CHECK(drawn > 400);
}

TEST_CASE("sample walk: bounds are the pixels whose box of samples meets the triangle's", "[property]") {
  CAPTURE(seed());
  Random random(seed());
  for (int n = 0; n < 3000; ++n) {
    const int bits = static_cast<int>(random.between(4, 8));
    const SampleBox box = random_pattern(random).box();
    const ScreenTriangle t = random_triangle(random, bits);
    const PixelRect bounds = sample_bounds(t.v, bits, 0, box);
    const auto [x_min, x_max] = std::minmax({t.v[0].x, t.v[1].x, t.v[2].x});
    const auto [y_min, y_max] = std::minmax({t.v[0].y, t.v[1].y, t.v[2].y});
    const auto meets = [bits](int pixel, int least, int most, int min, int max) {
      const std::int64_t one = std::int64_t{1} << bits;
      return pixel * one + most * one / 16 >= min && pixel * one + least * one / 16 <= max;
    };
    for (int pixel = -70; pixel < 120; ++pixel) {
      REQUIRE((pixel >= bounds.x_first && pixel <= bounds.x_last) ==
              meets(pixel, box.x_least, box.x_most, x_min, x_max));
      REQUIRE((pixel >= bounds.y_first && pixel <= bounds.y_last) ==
              meets(pixel, box.y_least, box.y_most, y_min, y_max));
    }
  }
}
