#include "halfspace/study/precision/depth_measure.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <numeric>

#include "halfspace/machine/draw_state.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/numerics/split_mix.hpp"
#include "halfspace/scene/front_end.hpp"
#include "halfspace/scene/load.hpp"
#include "halfspace/stress/depth_families.hpp"
#include "halfspace/stress/exact_plane.hpp"

namespace halfspace::study {
namespace {

/// Some covered pixels of the square of 16 x 16 around a point of the triangle, on the target.
std::vector<reference::GridPoint> some_pixels(const GridDepth& triangle, std::int64_t size,
                                              SplitMix64& random) {
  constexpr std::int64_t kSquare = 16;
  constexpr std::size_t kMost = 4;
  double u = random.real(0, 1);
  double v = random.real(0, 1);
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  const auto first = [&](auto axis) {
    const auto at = [&](std::size_t i) { return static_cast<double>(triangle.grid[i].*axis); };
    const double position = at(0) + u * (at(1) - at(0)) + v * (at(2) - at(0));
    const auto pixel = static_cast<std::int64_t>(std::floor(std::ldexp(position, -kSubPixelBits)));
    return std::clamp<std::int64_t>(pixel, 0, size - 1) / kSquare * kSquare;
  };
  const std::int64_t x0 = first(&reference::GridPoint::x);
  const std::int64_t y0 = first(&reference::GridPoint::y);
  std::vector<reference::GridPoint> covered;
  for (std::int64_t y = y0; y < std::min(y0 + kSquare, size); ++y) {
    for (std::int64_t x = x0; x < std::min(x0 + kSquare, size); ++x) {
      if (reference::covers(triangle.grid, reference::pixel_centre(x, y, kSubPixelBits),
                            reference::TieRule::kTopLeft)) {
        covered.push_back({x, y});
      }
    }
  }
  if (covered.size() > kMost) {
    for (std::size_t i = 0; i < kMost; ++i) {
      std::swap(covered[i],
                covered[static_cast<std::size_t>(random.integer(
                    static_cast<std::int64_t>(i), static_cast<std::int64_t>(covered.size()) - 1))]);
    }
    covered.resize(kMost);
  }
  return covered;
}

void add_draw(const Frame& frame, const Command& command, std::vector<GridDepth>& triangles) {
  const SetupState state = setup_state(command, frame.targets[command.target], DepthFormat::kNone, Config{});
  Command plain = command;  // depth is that of the vertices
  plain.flags &= ~bits({Flag::kPolygonOffset, Flag::kDepthClamp});
  const FrontEnd front_end(frame, plain, DepthFormat::kFloat32, kSubPixelBits);
  FrontEndCounters counters;
  std::vector<ScreenTriangle> pieces;
  for (std::uint32_t index = 0; index < command.index_count / 3; ++index) {
    front_end.process(index, pieces, counters);
  }
  for (const ScreenTriangle& piece : pieces) {
    GridDepth made{};
    for (std::size_t i = 0; i < 3; ++i) {
      made.grid[i] = {piece.v[i].x, piece.v[i].y};
      made.z[i] = std::bit_cast<float>(static_cast<std::uint32_t>(piece.v[i].z));
    }
    const reference::Int128 area = reference::twice_area(made.grid[0], made.grid[1], made.grid[2]);
    const bool front = (area > 0) == state.front_positive_area;
    const auto [least, most] = std::minmax({made.z[0], made.z[1], made.z[2]});
    if (area != 0 && !(front ? state.cull_front : state.cull_back) && least >= 0 && most <= 1) {
      triangles.push_back(made);
    }
  }
}

}  // namespace

std::vector<std::vector<DepthFamily>> depth_families(std::uint64_t seed) {
  using Kind = stress::DepthFamily;
  struct Named {
    Kind kind;
    const char* name;
    const char* looks;
  };
  std::vector<std::vector<DepthFamily>> families;
  for (const Named& named : {Named{Kind::kAny, "general", "anywhere on the target"},
                             {Kind::kPixel, "small", "about a pixel, and steep"},
                             {Kind::kSliver, "slivers", "long and thin, and steep"},
                             {Kind::kGuardBand, "large", "to the guard band"},
                             {Kind::kReversed, "any_exponent", "depths of any exponent, and 0"}}) {
    families.emplace_back();
    for (const std::uint32_t size : {64u, 1024u, 16384u}) {
      const auto source = std::make_shared<stress::DepthFamilySource>(named.kind, size, seed);
      families.back().push_back({named.name, named.looks,
                                 [source] {
                                   const stress::DepthSample sample = source->next();
                                   return GridDepth{sample.grid(), sample.z};
                                 },
                                 size});
    }
  }
  return families;
}

DepthFamily frame_depths(const std::filesystem::path& path) {
  const Frame frame = load(path);
  const auto triangles = std::make_shared<std::vector<GridDepth>>();
  std::uint32_t side = 1;
  for (const Command& command : frame.commands) {
    if (command.kind == CommandKind::kDraw) {
      const Target& target = frame.targets[command.target];
      side = std::max({side, target.width, target.height});
      add_draw(frame, command, *triangles);
    }
  }
  if (triangles->empty()) {
    throw InputError(path.string() + " has no triangle; a frame to measure depth on must have one");
  }
  const std::string file = path.filename().string();
  // In strides without a common factor with their number, so that few samples are of the whole frame.
  const auto place = std::make_shared<std::size_t>(0);
  std::size_t stride = triangles->size() * 5 / 8 + 1;
  while (std::gcd(stride, triangles->size()) != 1) {
    ++stride;
  }
  return {file.substr(0, file.find('.')), "a frame",
          [triangles, place, stride] {
            *place = (*place + stride) % triangles->size();
            return (*triangles)[*place];
          },
          std::bit_ceil(side)};
}

double percentile(std::span<float> errors, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(errors.size())));
  const std::size_t at = std::max<std::size_t>(rank, 1) - 1;
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(at), errors.end());
  return errors[at];
}

ErrorSummary summary(std::span<float> errors) {
  const double sum = std::accumulate(errors.begin(), errors.end(), 0.0);
  return {.samples = errors.size(),
          .mean = sum / static_cast<double>(errors.size()),
          .most_of_all = percentile(errors, 0.999),
          .worst = *std::max_element(errors.begin(), errors.end())};
}

std::vector<std::vector<float>> depth_errors(const DepthFamily& family, DepthFormat format,
                                             std::uint64_t samples, std::uint64_t seed) {
  // A frame may be such that no pixel is found.
  const std::uint64_t most_triangles = 1000 + 100 * samples;
  const auto& subjects = depth_subjects();
  SplitMix64 random(seed);
  std::vector<std::vector<float>> errors(subjects.size());
  std::uint64_t found = 0;
  for (std::uint64_t triangles = 0; found < samples && triangles < most_triangles; ++triangles) {
    const GridDepth made = family.next();
    if (reference::twice_area(made.grid[0], made.grid[1], made.grid[2]) == 0) {
      continue;
    }
    const std::vector<reference::GridPoint> pixels = some_pixels(made, family.size, random);
    if (pixels.empty()) {
      continue;
    }
    found += pixels.size();
    const stress::ExactPlane exact(made.grid, made.z, Command{}, format, kSubPixelBits);
    const DepthTriangle triangle(made.grid, made.z);
    for (std::size_t i = 0; i < subjects.size(); ++i) {
      if (!subjects[i].takes(format)) {
        continue;
      }
      const DepthAt code = subjects[i].prepare(triangle, format, family.size);
      for (const reference::GridPoint& pixel : pixels) {
        const reference::GridPoint at = reference::pixel_centre(pixel.x, pixel.y, kSubPixelBits);
        errors[i].push_back(static_cast<float>(exact.error(at.x, at.y, code(pixel.x, pixel.y)).ulps));
      }
    }
  }
  return errors;
}

}  // namespace halfspace::study
