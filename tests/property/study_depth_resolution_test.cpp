// The depth experiment of Upchurch and Desbrun 2012 and Reed 2015: his figures and conclusions, and the same
// planes through the pipeline.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <set>

#include "halfspace/study/depth_resolution/float_depth.hpp"
#include "halfspace/study/depth_resolution/pipeline_depth.hpp"

namespace halfspace::study {
namespace {

constexpr Planes kPublished{.near = 0.1, .far = 10000};
constexpr std::size_t kPairs = 10000;

Confusion by_float(Projection projection, Transform transform, DepthFormat format) {
  return confusion(float_depths(kPublished, projection, transform, format, equal_steps(kPublished, kPairs)),
                   projection);
}

Confusion drawn(Projection projection, Transform transform, DepthFormat format) {
  return confusion(pipeline_codes(kPublished, projection, transform, format, DepthInterpolator::kPlane,
                                  Slope::kFacing, equal_steps(kPublished, kPairs)),
                   projection);
}

}  // namespace

TEST_CASE("depth resolution: equal and swapped neighbours are counted", "[property]") {
  const std::vector<int> depths{1, 2, 2, 5, 4, 6};
  const Confusion rising = confusion(depths, Projection::kStandard);
  CHECK((rising.pairs == 5 && rising.equal == 1 && rising.swapped == 1));
  const Confusion falling = confusion(depths, Projection::kReversed);
  CHECK((falling.equal == 1 && falling.swapped == 3));
}

TEST_CASE("depth resolution: float32 has the counts of the published program", "[property]") {
  // What the formulas of https://gist.github.com/Reedbeta/ae437a9acb5dc137eabf give with NumPy 2.4.6, of
  // 10,000 pairs. Its random points differ from ours, which matters only where there is a view matrix.
  struct Published {
    Projection projection;
    std::size_t equal_float32;
    std::size_t equal_unorm24;
    std::size_t swapped;
  };
  for (const Published& published : {Published{Projection::kStandard, 7720, 7720, 1},
                                     {Projection::kInfinite, 7575, 7575, 1},
                                     {Projection::kReversed, 0, 7577, 0},
                                     {Projection::kReversedInfinite, 0, 7578, 0},
                                     {Projection::kGlStandard, 7734, 7734, 0},
                                     {Projection::kGlInfinite, 7663, 7663, 0}}) {
    CAPTURE(kProjectionNames[static_cast<std::size_t>(published.projection)]);
    for (const DepthFormat format : {DepthFormat::kFloat32, DepthFormat::kUnorm24}) {
      CAPTURE(name(format));
      const std::size_t equal =
          format == DepthFormat::kFloat32 ? published.equal_float32 : published.equal_unorm24;
      const Confusion alone = by_float(published.projection, Transform::kProjectionOnly, format);
      CHECK(alone.equal == equal);
      CHECK(alone.swapped == published.swapped);
      const Confusion viewed = by_float(published.projection, Transform::kViewThenProjection, format);
      CHECK(std::abs(viewed.equal_percent() - static_cast<double>(equal) / 100) < 0.2);
      CHECK(viewed.swapped <= 5);
    }
  }
}

TEST_CASE("depth resolution: the published conclusions hold in float32 and in the pipeline", "[property]") {
  for (const auto measure : {by_float, drawn}) {
    for (const Transform transform : {Transform::kProjectionOnly, Transform::kViewThenProjection,
                                      Transform::kPrecomposed, Transform::kPrecomposedInPairs}) {
      CAPTURE(transform);
      // Reversed depth in float32 has no error, and in integers not more than any other.
      for (const Projection projection : {Projection::kReversed, Projection::kReversedInfinite}) {
        const Confusion reversed = measure(projection, transform, DepthFormat::kFloat32);
        CHECK(reversed.equal + reversed.swapped == 0);
        const Confusion integers = measure(projection, transform, DepthFormat::kUnorm24);
        CHECK(integers.swapped == 0);
        CHECK(integers.equal_percent() < 76);
      }
      // Standard depth has as many errors in float32 as in 24 bits, and the two matrices in one swap planes.
      const Confusion standard = measure(Projection::kStandard, transform, DepthFormat::kFloat32);
      const Confusion integers = measure(Projection::kStandard, transform, DepthFormat::kUnorm24);
      const bool in_one = transform >= Transform::kPrecomposed;
      CHECK(std::abs(standard.equal_percent() - integers.equal_percent()) < 1);
      CHECK((in_one ? standard.swapped > kPairs / 10 : standard.swapped <= 5));
    }
  }
}

TEST_CASE("depth resolution: the pipeline's codes are those of the formula", "[property]") {
  const std::vector<double> all = equal_steps(kPublished, kPairs);
  for (const Projection projection : {Projection::kStandard, Projection::kReversed}) {
    const std::vector<std::uint32_t> codes =
        pipeline_codes(kPublished, projection, Transform::kProjectionOnly, DepthFormat::kUnorm16,
                       DepthInterpolator::kBarycentric, Slope::kFacing, all);
    std::set<std::uint32_t> distinct;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double part =
          kPublished.near / all[i] * (kPublished.far - all[i]) / (kPublished.far - kPublished.near);
      const double depth = projection == Projection::kStandard ? 1 - part : part;
      // Positions are float32, which is 1/256 of a code of 16 bits.
      REQUIRE(std::abs(codes[i] - depth * 65535) < 0.5 + 3.0 / 256);
      distinct.insert(codes[i]);
    }
    CHECK(confusion(codes, projection).equal == kPairs + 1 - distinct.size());
  }
}

TEST_CASE("depth resolution: random pairs, tilted: more bits tell more, reversed float32 most",
          "[property]") {
  const Planes planes{.near = 0.1, .far = 10000};
  const std::vector<double> pairs = random_pairs({.near = planes.near * 2.5, .far = planes.far / 2}, 4000);
  REQUIRE(pairs.size() == 8000);
  for (std::size_t i = 0; i < pairs.size(); i += 2) {
    const double apart = pairs[i + 1] / pairs[i] - 1;
    REQUIRE((apart > 0.99 * 0x1p-20 && apart < 1.01 * 0x1p-8));
  }
  for (const DepthInterpolator interpolator : {DepthInterpolator::kPlane, DepthInterpolator::kBarycentric}) {
    const auto of = [&](Projection projection, DepthFormat format) {
      return confusion(pipeline_codes(planes, projection, Transform::kProjectionOnly, format, interpolator,
                                      Slope::kTilted, pairs),
                       projection, 2);
    };
    const Confusion reversed = of(Projection::kReversed, DepthFormat::kFloat32);
    CHECK(reversed.equal + reversed.swapped == 0);
    for (const Projection projection : {Projection::kStandard, Projection::kReversed}) {
      const Confusion coarse = of(projection, DepthFormat::kUnorm16);
      const Confusion fine = of(projection, DepthFormat::kUnorm24);
      CHECK(coarse.equal > fine.equal);
      CHECK(fine.equal > 0);
    }
    CHECK(of(Projection::kStandard, DepthFormat::kFloat32).equal > 0);
  }
}

TEST_CASE("depth resolution: there is a pixel for each plane") {
  CHECK_THROWS(pipeline_codes(kPublished, Projection::kStandard, Transform::kProjectionOnly,
                              DepthFormat::kUnorm24, DepthInterpolator::kPlane, Slope::kFacing,
                              std::vector<double>(16385, 1.0)));
}

}  // namespace halfspace::study
