/// halfspace_depth_error: the largest error of depth by format, interpolator and family, against exact
/// arithmetic, as a table; exit status 1 if one is beyond the bounds of docs/numerics.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "../frames.hpp"
#include "halfspace/scene/front_end.hpp"
#include "halfspace/stress/depth_bound.hpp"
#include "halfspace/stress/depth_families.hpp"
#include "halfspace/stress/exact_plane.hpp"
#include "halfspace/units/setup.hpp"
#include "halfspace/units/z_test.hpp"

namespace halfspace::testing {
namespace {

using stress::DepthFamily;
using stress::DepthFamilySource;
using stress::DepthSample;
using stress::ExactPlane;

constexpr int kTile = 16;  // all sizes of tiles have the same depths

struct Worst {
  std::uint64_t triangles = 0;
  std::uint64_t samples = 0;
  double ulps = 0;
  double share = 0;  ///< of the sample's bound
};

struct Method {
  DepthFormat format;
  DepthInterpolator interpolator;
};

/// Draws of one family on one target, and what their fragments' depths are off.
class Measurement {
 public:
  Measurement(const Method& method, DepthFamily family, int size, std::uint64_t seed)
      : method_(method),
        source_(family, size, seed),
        size_(size),
        seed_(seed),
        builder_(static_cast<std::uint32_t>(size), method.format) {
    state_ = {.front_positive_area = true,
              .bounds = {.x_last = size - 1, .y_last = size - 1},
              .depth_format = method.format,
              .interpolator = method.interpolator};
  }

  void run(std::uint64_t samples, Worst& worst) {
    for (const std::uint64_t end = worst.samples + samples; worst.samples < end;) {
      const DepthSample sample = source_.next();
      const ExactPlane plane(sample.grid(), sample.z, sample.state, method_.format, 8);
      if (plane.has_area()) {
        ++worst.triangles;
        draw(sample, plane, worst);
      }
    }
  }

 private:
  void draw(const DepthSample& sample, const ExactPlane& plane, Worst& worst) {
    builder_.frame.commands.resize(1);
    builder_.frame.vertices.clear();
    builder_.frame.indices.clear();
    std::vector<glm::dvec3> window;
    for (std::size_t i = 0; i < 3; ++i) {
      window.emplace_back(static_cast<double>(sample.xy[i][0]) / 256,
                          static_cast<double>(sample.xy[i][1]) / 256, sample.z[i]);
    }
    Command& draw = builder_.draw(window);
    draw.flags |= sample.state.flags;
    draw.offset_factor = sample.state.offset_factor;
    draw.offset_units = sample.state.offset_units;
    draw.offset_clamp = sample.state.offset_clamp;
    pieces_.clear();
    FrontEndCounters counters;
    FrontEnd(builder_.frame, draw, method_.format, state_.sub_pixel_bits).process(0, pieces_, counters);
    // Of triangles in many pieces a few.
    const std::size_t step = pieces_.size() / 8 + 1;
    for (std::size_t i = 0; i < pieces_.size(); i += step) {
      SetupTriangle triangle;
      if (setup(pieces_[i], state_, triangle) == SetupVerdict::kDrawn) {
        tile(sample, plane, triangle, worst);
      }
    }
  }

  /// Some covered samples of a tile around a point of the triangle.
  void tile(const DepthSample& sample, const ExactPlane& plane, const SetupTriangle& triangle, Worst& worst) {
    double u = source_.fraction();
    double v = source_.fraction();
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const auto pixel = [&](std::size_t axis, std::int32_t first, std::int32_t last) {
      const auto at = [&](std::size_t i) { return static_cast<double>(sample.xy[i][axis]); };
      const double value = at(0) + u * (at(1) - at(0)) + v * (at(2) - at(0));
      return std::clamp(static_cast<std::int32_t>(std::floor(value / 256)), first, last);
    };
    const PixelRect& bounds = triangle.bounds;
    const int x0 = pixel(0, bounds.x_first, bounds.x_last) / kTile * kTile;
    const int y0 = pixel(1, bounds.y_first, bounds.y_last) / kTile * kTile;
    const auto edge_at = [&](std::size_t i, int x, int y) {
      const Edge& edge = triangle.edge[i];
      return edge.c + ((std::int64_t{edge.a} * x + std::int64_t{edge.b} * y) << state_.sub_pixel_bits);
    };
    QuadBurst burst;
    burst.coverage.tile_x = static_cast<std::uint16_t>(x0 / kTile);
    burst.coverage.tile_y = static_cast<std::uint16_t>(y0 / kTile);
    burst.coverage.e = {edge_at(1, x0, y0), edge_at(2, x0, y0)};
    for (int bit = 0; bit < kTile * kTile; ++bit) {
      const int x = x0 + bit % kTile;
      const int y = y0 + bit / kTile;
      if (x >= bounds.x_first && x <= bounds.x_last && y >= bounds.y_first && y <= bounds.y_last &&
          edge_at(0, x, y) >= 0 && edge_at(1, x, y) >= 0 && edge_at(2, x, y) >= 0) {
        burst.coverage.mask.word[static_cast<std::size_t>(bit / 64)] |= std::uint64_t{1} << (bit % 64);
      }
    }
    TileCodes<kTile> codes{};
    interpolate_tile<kTile>(triangle, burst,
                            {.test = true, .format = method_.format, .interpolator = method_.interpolator},
                            codes);
    for (std::size_t word = 0; word < 4; ++word) {
      const std::uint64_t covered = burst.coverage.mask.word[word];
      // Neighbours are much alike: of a whole tile every eleventh.
      const std::uint64_t some = std::popcount(covered) > 8 ? covered & 0x8010020040080100 : covered;
      for (std::uint64_t left = some; left != 0; left &= left - 1) {
        const int bit = static_cast<int>(word) * 64 + std::countr_zero(left);
        const int x = x0 + bit % kTile;
        const int y = y0 + bit / kTile;
        const ExactPlane::Error error = plane.error(std::int64_t{x} * 256 + 128, std::int64_t{y} * 256 + 128,
                                                    codes[static_cast<std::size_t>(bit)]);
        const double share = error.ulps / stress::depth_bound({.sub_pixel_bits = state_.sub_pixel_bits,
                                                               .format = method_.format},
                                                              method_.interpolator, sample.z, plane, error);
        ++worst.samples;
        worst.ulps = std::max(worst.ulps, error.ulps);
        if (share > worst.share) {
          worst.share = share;
          if (share > 1) {
            report(sample, error, x, y, share);
          }
        }
      }
    }
  }

  void report(const DepthSample& sample, const ExactPlane::Error& error, int x, int y, double share) const {
    fmt::print(stderr, "seed {}, target {}: pixel ({}, {}), depth {}, {} units off, {} of the bound:", seed_,
               size_, x, y, error.depth, error.ulps, share);
    for (std::size_t i = 0; i < 3; ++i) {
      fmt::print(stderr, " ({}, {}, {:a})", sample.xy[i][0], sample.xy[i][1], sample.z[i]);
    }
    fmt::print(stderr, " offset {:a} {:a} {:a}\n", sample.state.offset_factor, sample.state.offset_units,
               sample.state.offset_clamp);
  }

  Method method_;
  DepthFamilySource source_;
  int size_;
  std::uint64_t seed_;
  FrameBuilder builder_;
  SetupState state_;
  std::vector<ScreenTriangle> pieces_;
};

}  // namespace
}  // namespace halfspace::testing

int main(int argc, char** argv) {
  using namespace halfspace;
  using namespace halfspace::testing;
  CLI::App app{"The largest error of depth by format, interpolator and family", "halfspace_depth_error"};
  std::uint64_t samples = 1'000'000;
  std::uint64_t seed = 20240229;
  app.add_option("--samples", samples, "in all")->capture_default_str();
  app.add_option("--seed", seed, "of the random triangles")->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  constexpr std::array kMethods{Method{DepthFormat::kUnorm16, DepthInterpolator::kPlane},
                                Method{DepthFormat::kUnorm24, DepthInterpolator::kPlane},
                                Method{DepthFormat::kFloat32, DepthInterpolator::kPlane},
                                Method{DepthFormat::kUnorm16, DepthInterpolator::kBarycentric},
                                Method{DepthFormat::kUnorm24, DepthInterpolator::kBarycentric},
                                Method{DepthFormat::kFloat32, DepthInterpolator::kBarycentric}};
  constexpr std::array kSizes{64, 1024, 16384};
  std::uint64_t all = 0;
  std::uint64_t triangles = 0;
  double most = 0;
  std::string rows;
  for (const auto& [family, text] : stress::kDepthFamilies) {
    rows += fmt::format("| {} |", text);
    for (const Method& method : kMethods) {
      Worst worst;
      for (const int size : kSizes) {
        Measurement(method, family, size, seed)
            .run(samples / (stress::kDepthFamilies.size() * kMethods.size() * kSizes.size()) + 1, worst);
      }
      rows += fmt::format(" {:.4g} ({:.0f} %) |", worst.ulps, 100 * worst.share);
      all += worst.samples;
      triangles += worst.triangles;
      most = std::max(most, worst.share);
    }
    rows += "\n";
  }
  fmt::print("{} samples of {} triangles, seed {}.\n\n", all, triangles, seed);
  fmt::print("| family | plane: unorm16 | unorm24 | float32 | barycentric: unorm16 | unorm24 | float32 |\n");
  fmt::print("| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n{}", rows);
  return most <= 1 ? 0 : 1;
}
