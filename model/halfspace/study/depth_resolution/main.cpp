/// halfspace_study_depth_resolution: which shares of neighbouring planes come out equal or swapped, in
/// float32 as published and through this pipeline; tables in Markdown.
#include <fmt/format.h>

#include <array>
#include <exception>
#include <string>
#include <vector>

#include "halfspace/study/depth_resolution/float_depth.hpp"
#include "halfspace/study/depth_resolution/pipeline_depth.hpp"

namespace halfspace::study {
namespace {

constexpr std::array kFormats{DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32};
constexpr std::size_t kPairs = 10000;
constexpr Planes kPublished{.near = 0.1, .far = 10000};

std::string cell(const Confusion& confusion) {
  return fmt::format("{:.1f} / {:.1f}", confusion.equal_percent(), confusion.swapped_percent());
}

/// Of the published planes and distances, by transform and projection.
void print_published() {
  const std::vector<double> linear = equal_steps(kPublished, kPairs);
  fmt::print("near {}, far {}, {} pairs at equal steps\n\n| transform | projection |", kPublished.near,
             kPublished.far, kPairs);
  for (const DepthFormat format : kFormats) {
    fmt::print(" {}: computed | drawn |", name(format));
  }
  fmt::print("\n|---|---|---:|---:|---:|---:|---:|---:|\n");
  for (std::size_t t = 0; t < kTransformNames.size(); ++t) {
    for (std::size_t p = 0; p < kProjectionNames.size(); ++p) {
      const auto transform = static_cast<Transform>(t);
      const auto projection = static_cast<Projection>(p);
      fmt::print("| {} | {} |", kTransformNames[t], kProjectionNames[p]);
      for (const DepthFormat format : kFormats) {
        const auto computed = float_depths(kPublished, projection, transform, format, linear);
        const auto drawn = pipeline_codes(kPublished, projection, transform, format,
                                          DepthInterpolator::kPlane, Slope::kFacing, linear);
        fmt::print(" {} | {} |", cell(confusion(computed, projection)), cell(confusion(drawn, projection)));
      }
      fmt::print("\n");
    }
  }
}

/// Random pairs by far / near. There is no view matrix, so nothing but depth is rounded coarsely.
void print_by_ratio() {
  constexpr std::size_t kRandomPairs = 8000;
  fmt::print("\n{} random pairs, 2^-20 to 2^-8 of their distance apart\n\n| far / near | projection |",
             kRandomPairs);
  for (const DepthFormat format : kFormats) {
    fmt::print(" {}: computed | drawn | tilted, `plane` | tilted, `barycentric` |", name(format));
  }
  fmt::print("\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  for (const int ratio : {100, 1000, 10'000, 100'000, 1'000'000}) {
    const Planes planes{.near = 0.1, .far = 0.1 * ratio};
    // So far from near and far that no vertex of a tilted plane is beyond.
    const std::vector<double> pairs =
        random_pairs({.near = planes.near * 2.5, .far = planes.far / 2}, kRandomPairs);
    for (const Projection projection : {Projection::kStandard, Projection::kReversed}) {
      fmt::print("| {} | {} |", ratio, kProjectionNames[static_cast<std::size_t>(projection)]);
      for (const DepthFormat format : kFormats) {
        const auto drawn = [&](Slope slope, DepthInterpolator interpolator) {
          return confusion(pipeline_codes(planes, projection, Transform::kProjectionOnly, format,
                                          interpolator, slope, pairs),
                           projection, 2);
        };
        const Confusion computed = confusion(
            float_depths(planes, projection, Transform::kProjectionOnly, format, pairs), projection, 2);
        fmt::print(" {} | {} | {} | {} |", cell(computed),
                   cell(drawn(Slope::kFacing, DepthInterpolator::kPlane)),
                   cell(drawn(Slope::kTilted, DepthInterpolator::kPlane)),
                   cell(drawn(Slope::kTilted, DepthInterpolator::kBarycentric)));
      }
      fmt::print("\n");
    }
  }
}

}  // namespace
}  // namespace halfspace::study

int main(int argc, char** argv) {
  if (argc > 1) {
    fmt::print(stderr, "halfspace_study_depth_resolution takes no arguments; there is '{}'\n", argv[1]);
    return 2;
  }
  try {
    halfspace::study::print_published();
    halfspace::study::print_by_ratio();
  } catch (const std::exception& error) {
    fmt::print(stderr, "halfspace_study_depth_resolution: {}\n", error.what());
    return 1;
  }
}
