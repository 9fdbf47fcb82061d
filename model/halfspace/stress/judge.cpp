#include "halfspace/stress/judge.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "halfspace/reference/pixel_square.hpp"
#include "halfspace/stress/depth_bound.hpp"
#include "halfspace/stress/exact_plane.hpp"

namespace halfspace::stress {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;

/// Whether the triangle has sample `sample` of the pixel, by the definition of what pixels triangles have.
/// Conservative pixels have one sample.
bool has_sample(const reference::GridTriangle& triangle, std::int64_t x, std::int64_t y, int sample,
                const Precision& precision) {
  if (precision.conservative == Conservative::kOff) {
    return reference::covers(triangle, precision.sample_of(x, y, sample), precision.rule);
  }
  const reference::PixelSquare square =
      reference::pixel_square(x, y, precision.sub_pixel_bits, precision.uncertainty);
  return precision.conservative == Conservative::kOuter ? reference::touches(triangle, square)
                                                        : reference::fills(triangle, square);
}

/// What the definition says of the known triangles.
struct Definition {
  std::uint64_t samples = 0;              ///< looked at: those of all pixels that the box of a triangle meets
  std::vector<std::int32_t> fragments{};  ///< of each sample, in the order of Picture
  std::vector<std::uint32_t> last{};      ///< of the triangles that cover it, or kNone
};

Definition define(const Case& made, const Precision& precision) {
  const Target& target = made.frame.targets.front();
  const std::size_t pixels = std::size_t{target.width} * target.height;
  const std::size_t samples = pixels * static_cast<std::size_t>(precision.samples.count);
  Definition result{.fragments = std::vector<std::int32_t>(samples, 0),
                    .last = std::vector<std::uint32_t>(samples, kNone)};
  for (std::uint32_t i = 0; i < made.triangles.size(); ++i) {
    const KnownTriangle& triangle = made.triangles[i];
    const reference::GridTriangle& v = triangle.grid;
    const auto [left, right] = std::minmax({v[0].x, v[1].x, v[2].x});
    const auto [top, bottom] = std::minmax({v[0].y, v[1].y, v[2].y});
    // An outer pixel may lie beside the box.
    const std::int64_t beside =
        precision.conservative == Conservative::kOuter ? std::int64_t{1} << precision.sub_pixel_bits : 0;
    const auto pixel = [&](std::int64_t position, std::uint32_t size) {
      return std::clamp<std::int64_t>(position >> precision.sub_pixel_bits, 0, std::int64_t{size} - 1);
    };
    const auto look = [&](std::int64_t x, std::int64_t y, int sample) {
      ++result.samples;
      if (has_sample(v, x, y, sample, precision)) {
        const auto at =
            static_cast<std::size_t>(sample) * pixels + static_cast<std::size_t>(y * target.width + x);
        ++result.fragments[at];
        result.last[at] = i;
      }
    };
    for (std::int64_t y = pixel(top - beside, target.height); y <= pixel(bottom + beside, target.height);
         ++y) {
      for (std::int64_t x = pixel(left - beside, target.width); x <= pixel(right + beside, target.width);
           ++x) {
        for (int sample = 0; sample < precision.samples.count; ++sample) {
          look(x, y, sample);
        }
      }
    }
  }
  return result;
}

/// Where the sample that a law of each pixel speaks of begins in a picture.
std::size_t plane_of(const Case& made) {
  const Target& target = made.frame.targets.front();
  return static_cast<std::size_t>(made.sample) * target.width * target.height;
}

void count(std::int32_t expected, std::uint32_t got, Tally& tally) {
  const std::int64_t more = std::int64_t{got} - expected;
  (more > 0 ? tally.extra : tally.missing) += static_cast<std::uint64_t>(std::abs(more));
}

/// Whether the triangle has the centre of a pixel that it has. Where it has not, the depth of an outer pixel
/// is that of the plane, kept within the range of the vertices, or with cut weights that of some point of the
/// triangle.
bool has_centre(const reference::GridTriangle& triangle, const reference::GridPoint& centre,
                const Precision& precision) {
  const reference::PixelSquare point{.least = centre, .most = centre};
  return precision.conservative != Conservative::kOuter || reference::fills(triangle, point);
}

/// The sum of the magnitudes of the vertices' weights at a place: 1 inside the triangle, more outside.
double spread_at(const reference::GridTriangle& t, const reference::GridPoint& place) {
  const auto area = [](const reference::GridPoint& a, const reference::GridPoint& b,
                       const reference::GridPoint& c) {
    return std::abs(static_cast<double>(reference::twice_area(a, b, c)));
  };
  return (area(t[1], t[2], place) + area(t[2], t[0], place) + area(t[0], t[1], place)) /
         area(t[0], t[1], t[2]);
}

/// Calls visit(pixel, error, bound) for each depth that the definition knows.
template <class Visit>
void each_depth(const Case& made, const Precision& precision, const DepthLaw& law,
                const Definition& definition, const Picture& picture, const Visit& visit) {
  std::map<std::uint32_t, ExactPlane> planes;
  for (std::uint32_t at = 0; at < picture.codes.size(); ++at) {
    const std::uint32_t last = definition.last[at];
    if (last == kNone) {
      continue;
    }
    const KnownTriangle& triangle = made.triangles[last];
    const ExactPlane& plane =
        planes
            .try_emplace(last, triangle.grid, triangle.z, made.frame.commands[triangle.command],
                         precision.format, precision.sub_pixel_bits)
            .first->second;
    const std::uint32_t row = at / picture.width;
    const reference::GridPoint sample =
        precision.sample_of(at % picture.width, row % picture.height, static_cast<int>(row / picture.height));
    if (!plane.has_area()) {
      continue;
    }
    const bool outside = !has_centre(triangle.grid, sample, precision);
    ExactPlane::Error error = plane.error(sample.x, sample.y, picture.codes[at], outside);
    if (outside && law.interpolator == DepthInterpolator::kBarycentric) {
      error.ulps = error.beyond;
    }
    const double bound = law.bound ? *law.bound
                                   : depth_bound(precision, law.interpolator, triangle.z, plane, error,
                                                 outside ? spread_at(triangle.grid, sample) : 1);
    visit(at, error, bound);
  }
}

void judge_depth(const Case& made, const Precision& precision, const DepthLaw& law,
                 const Definition& definition, const Picture& picture, Tally& tally) {
  each_depth(made, precision, law, definition, picture,
             [&](std::size_t /*at*/, const ExactPlane::Error& error, double bound) {
               ++tally.depths;
               tally.worst_ulps = std::max(tally.worst_ulps, error.ulps);
               tally.worst_share = std::max(tally.worst_share, error.ulps / bound);
               tally.inexact += error.ulps > bound ? 1 : 0;
               tally.out_of_range += error.beyond > bound ? 1 : 0;
             });
}

/// Whether the definition says the same of all samples of a pixel: covered, or not.
bool all_samples(const KnownTriangle& triangle, std::uint32_t x, std::uint32_t y, const Precision& precision,
                 bool covered) {
  bool all = true;
  for (int sample = 0; sample < precision.samples.count; ++sample) {
    all &= has_sample(triangle.grid, x, y, sample, precision) == covered;
  }
  return all;
}

/// Rejected: no sample of the tile is covered. Accepted: all of them are.
void judge_decisions(const Case& made, const Precision& precision, const Picture& picture, Tally& tally) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, const KnownTriangle*> known;
  for (const KnownTriangle& triangle : made.triangles) {
    known[{triangle.draw, triangle.index}] = &triangle;
  }
  const auto size = static_cast<std::uint32_t>(picture.tile_size);
  for (const DecisionEvent& decision : picture.decisions) {
    const auto found = known.find({decision.draw, decision.triangle});
    if (found == known.end() || decision.verdict == TileVerdict::kPartial) {
      continue;
    }
    const KnownTriangle& triangle = *found->second;
    const bool rejected = decision.verdict == TileVerdict::kReject;
    bool sound = true;
    for (std::uint32_t y = decision.tile_y * size; y < std::min((decision.tile_y + 1) * size, picture.height);
         ++y) {
      for (std::uint32_t x = decision.tile_x * size;
           x < std::min((decision.tile_x + 1) * size, picture.width); ++x) {
        sound &= all_samples(triangle, x, y, precision, !rejected);
      }
    }
    ++tally.decisions;
    tally.unsound += sound ? 0 : 1;
  }
}

void judge_twin(const Twin& twin, const Picture& picture, const Picture& second, Tally& tally) {
  const auto width = static_cast<std::int64_t>(picture.width);
  const auto height = static_cast<std::int64_t>(picture.height);
  const auto compare = [&](std::int64_t at, std::int64_t there) {
    const auto one = static_cast<std::size_t>(at);
    const auto other = static_cast<std::size_t>(there);
    const bool same = picture.fragments[one] == second.fragments[other] &&
                      (!twin.same_depth || picture.codes[one] == second.codes[other]);
    tally.moved += same ? 0 : 1;
  };
  const auto size = static_cast<std::int64_t>(picture.fragments.size());
  for (std::int64_t plane = 0; plane < size; plane += width * height) {
    for (std::int64_t y = 0; y < height - twin.dy; ++y) {
      for (std::int64_t x = 0; x < width - twin.dx; ++x) {
        compare(plane + y * width + x, plane + (y + twin.dy) * width + x + twin.dx);
      }
    }
  }
}

}  // namespace

std::vector<std::int32_t> expected_fragments(const Case& made, const Precision& precision) {
  if (!made.triangles.empty()) {
    return define(made, precision).fragments;
  }
  std::vector<std::int32_t> expected(plane_of(made), kUncertain);
  expected.insert(expected.end(), made.fragments.begin(), made.fragments.end());
  return expected;
}

std::vector<double> depth_shares(const Case& made, const Precision& precision, const DepthLaw& law,
                                 const Picture& picture) {
  std::vector<double> shares(picture.codes.size(), kNotJudged);
  if (made.depth) {
    each_depth(made, precision, law, define(made, precision), picture,
               [&](std::size_t at, const ExactPlane::Error& error, double bound) {
                 shares[at] = error.ulps / bound;
               });
  }
  return shares;
}

Tally judge(const Case& made, const Precision& precision, const DepthLaw& law, const Picture& picture,
            const Picture* twin) {
  Tally tally{.cases = 1};
  for (const Command& command : made.frame.commands) {
    tally.triangles += command.kind == CommandKind::kDraw ? command.primitive_count() : 0;
  }
  if (!made.triangles.empty()) {
    const Definition definition = define(made, precision);
    tally.samples += definition.samples;
    // What hi_z rejects is no fragment: early-Z would have killed it.
    const bool some_culled = picture.culls && !made.survivors.empty();
    for (std::size_t at = 0; at < picture.fragments.size(); ++at) {
      if (some_culled && picture.fragments[at] < static_cast<std::uint32_t>(definition.fragments[at])) {
        continue;
      }
      const bool once = made.partition && precision.conservative == Conservative::kOff;
      count(once ? 1 : definition.fragments[at], picture.fragments[at], tally);
    }
    if (made.depth) {
      judge_depth(made, precision, law, definition, picture, tally);
    }
    if (!made.depth) {  // a triangle whose depth is resolved sample by sample is decided piece by piece
      judge_decisions(made, precision, picture, tally);
    }
  }
  if (precision.conservative != Conservative::kOff) {
    return tally;  // the other laws are of centres
  }
  const std::size_t plane = plane_of(made);
  for (std::size_t at = 0; at < made.fragments.size(); ++at) {
    if (made.fragments[at] != kUncertain) {
      ++tally.samples;
      count(made.fragments[at], picture.fragments[plane + at], tally);
    }
  }
  for (std::size_t at = 0; at < made.survivors.size(); ++at) {
    ++tally.tested;
    tally.mistested += made.survivors[at] == static_cast<std::int32_t>(picture.survivors[plane + at]) ? 0 : 1;
  }
  if (made.twin) {
    judge_twin(*made.twin, picture, *twin, tally);
  }
  return tally;
}

}  // namespace halfspace::stress
