#include "halfspace/whatif/sort.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "halfspace/scene/clip.hpp"
#include "halfspace/scene/front_end.hpp"

namespace halfspace::whatif {
namespace {

using Triangle = Polygon<glm::dvec4>;

bool is_finite(const glm::vec4& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

/// Where w is not positive, z / w means nothing. A triangle that depth clamp keeps there is as near and as
/// far as can be.
constexpr double kLeastW = std::numeric_limits<float>::min();

Triangle between_near_and_far(const Command& draw, const Triangle& triangle) {
  const Triangle front = clip(triangle, [](const glm::dvec4& v) { return v.w - kLeastW; });
  if (draw.has(Flag::kDepthClamp)) {
    return front;
  }
  const double least = draw.has(Flag::kNdcZMinusOneToOne) ? -1 : 0;
  const Triangle behind_near = clip(front, [&](const glm::dvec4& v) { return v.z - least * v.w; });
  return clip(behind_near, [](const glm::dvec4& v) { return v.w - v.z; });
}

}  // namespace

double farthest_depth(const Frame& frame, const Command& draw) {
  const FrontEnd::Depth window = FrontEnd(frame, draw, DepthFormat::kNone, 0).depth();
  const double sign = keeps_least(draw) ? 1 : -1;
  double farthest = -std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < draw.index_count; i += 3) {
    Triangle triangle;
    bool finite = true;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const glm::vec4& v = frame.vertices[draw.first_vertex + frame.indices[draw.first_index + i + k]];
      finite = finite && is_finite(v);
      triangle.push(glm::dvec4(v));
    }
    if (!finite) {
      continue;
    }
    const Triangle seen = between_near_and_far(draw, triangle);
    for (std::size_t k = 0; k < seen.size; ++k) {
      const double depth = seen.v[k].z / seen.v[k].w * window.scale + window.bias;
      farthest = std::max(farthest, sign * std::clamp(depth, window.least, window.most));
    }
  }
  return farthest;
}

Acted sort(Frame& frame, SortOrder order) {
  return rewrite_ranges(frame, [&](std::span<const Command> draws) {
    std::vector<std::pair<double, Command>> keyed;
    keyed.reserve(draws.size());
    for (const Command& draw : draws) {
      const double depth = farthest_depth(frame, draw);
      keyed.emplace_back(order == SortOrder::kFrontToBack ? depth : -depth, draw);
    }
    std::ranges::stable_sort(keyed, {}, &std::pair<double, Command>::first);
    std::vector<Command> out;
    out.reserve(draws.size());
    for (const auto& [depth, draw] : keyed) {
      out.push_back(draw);
    }
    return out;
  });
}

Acted reverse(Frame& frame) {
  return rewrite_ranges(frame, [&](std::span<const Command> draws) {
    std::vector<Command> out(draws.rbegin(), draws.rend());
    for (Command& draw : out) {
      const std::uint32_t first = draw.first_index;
      draw.first_index = static_cast<std::uint32_t>(frame.indices.size());  // draws may share indices
      for (std::uint32_t i = draw.index_count; i != 0; i -= 3) {
        for (std::uint32_t k = 0; k < 3; ++k) {
          const std::uint32_t index = frame.indices[first + i - 3 + k];
          frame.indices.push_back(index);
        }
      }
    }
    return out;
  });
}

}  // namespace halfspace::whatif
