/// halfspace_study_depth_resolution: which shares of neighbouring planes come out equal or swapped, in
/// float32 as published and through this pipeline; tables in Markdown.
#include <fmt/format.h>

#include <algorithm>
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
  const std::vector<double> linear = distances(kPublished, kPairs, false);
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

/// By far / near, at equal steps of the logarithm.
void print_by_ratio() {
  constexpr Transform kTransform = Transform::kViewThenProjection;
  fmt::print("\n{} pairs at equal steps of the logarithm; {}\n\n| far / near | projection |", kPairs,
             kTransformNames[static_cast<std::size_t>(kTransform)]);
  for (const DepthFormat format : kFormats) {
    fmt::print(" {}: computed | drawn | tilted |", name(format));
  }
  fmt::print("\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  std::size_t most_different = 0;
  for (const int ratio : {100, 1000, 10'000, 100'000, 1'000'000}) {
    const Planes planes{.near = 0.1, .far = 0.1 * ratio};
    const std::vector<double> all = distances(planes, kPairs, true);
    // So far from near and far that no vertex of a tilted plane is beyond.
    const std::vector<double> within =
        distances({.near = planes.near * 2.5, .far = planes.far / 2}, kPairs, true);
    for (const Projection projection : {Projection::kStandard, Projection::kReversed}) {
      fmt::print("| {} | {} |", ratio, kProjectionNames[static_cast<std::size_t>(projection)]);
      for (const DepthFormat format : kFormats) {
        const auto drawn = [&](Slope slope, DepthInterpolator interpolator) {
          return pipeline_codes(planes, projection, kTransform, format, interpolator, slope,
                                slope == Slope::kTilted ? within : all);
        };
        const auto computed = float_depths(planes, projection, kTransform, format, all);
        const auto facing = drawn(Slope::kFacing, DepthInterpolator::kPlane);
        const auto tilted = confusion(drawn(Slope::kTilted, DepthInterpolator::kPlane), projection);
        const auto other = confusion(drawn(Slope::kTilted, DepthInterpolator::kBarycentric), projection);
        const auto apart = [](std::size_t a, std::size_t b) { return std::max(a, b) - std::min(a, b); };
        most_different = std::max(
            {most_different, apart(tilted.equal, other.equal), apart(tilted.swapped, other.swapped)});
        fmt::print(" {} | {} | {} |", cell(confusion(computed, projection)),
                   cell(confusion(facing, projection)), cell(tilted));
      }
      fmt::print("\n");
    }
  }
  fmt::print(
      "\nTilted planes are interpolated by `plane`. With `barycentric` the counts differ by {} pairs at "
      "most.\n",
      most_different);
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
