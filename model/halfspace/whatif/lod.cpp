#include "halfspace/whatif/lod.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <numeric>
#include <utility>

#include "halfspace/scene/front_end.hpp"
#include "halfspace/whatif/surface_distance.hpp"

namespace halfspace::whatif {
namespace {

/// Errors that the simplifier is asked for, as powers of two of what is allowed, and how often the range is
/// halved. Of meshes with sharp features far less may be asked for than is allowed, of others more.
constexpr double kLeastPower = -9;
constexpr double kMostPower = 3;
constexpr int kTries = 8;

/// Triangles of a draw that hang together, by vertices that are all in different places.
struct Part {
  std::vector<std::uint32_t> indices;
  std::vector<std::uint32_t> vertex_of;  ///< of the draw, for each index
  std::vector<glm::dvec3> positions;     ///< in the window, depth scaled
};

bool in_front(const glm::vec4& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w) && v.w > 0;
}

glm::dvec3 in_window(const Command& draw, const FrontEnd::Depth& depth, const glm::vec4& v) {
  const double w = v.w;
  return {draw.viewport.x + (v.x / w + 1) * draw.viewport.z / 2,
          draw.viewport.y + (v.y / w + 1) * draw.viewport.w / 2, v.z / w * depth.scale + depth.bias};
}

void scale_depth(std::vector<glm::dvec3>& positions) {
  glm::dvec3 low = positions.front();
  glm::dvec3 high = low;
  for (const glm::dvec3& p : positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::dvec3 size = high - low;
  const double scale = size.z > 0 ? std::max(size.x, size.y) / size.z : 0;
  for (glm::dvec3& p : positions) {
    p = {p.x - low.x, p.y - low.y, (p.z - low.z) * scale};
  }
}

/// Sets of places that edges join.
class Joined {
 public:
  explicit Joined(std::size_t places) : parent_(places) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t root(std::uint32_t place) {
    while (parent_[place] != place) {
      place = parent_[place] = parent_[parent_[place]];
    }
    return place;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

/// In the order of their first triangles. `place`: of each index; `positions`: of each place.
std::vector<Part> parts_of(std::span<const std::uint32_t> indices, std::span<const std::uint32_t> place,
                           std::span<const glm::dvec3> positions) {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  Joined joined(positions.size());
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    joined.join(place[indices[i]], place[indices[i + 1]]);
    joined.join(place[indices[i]], place[indices[i + 2]]);
  }
  std::vector<Part> parts;
  std::vector<std::uint32_t> part_of(positions.size(), kNone);  // of the root
  std::vector<std::uint32_t> vertex_in(positions.size(),
                                       kNone);  // of its part, which a place has only one of
  for (const std::uint32_t index : indices) {
    const std::uint32_t at = place[index];
    std::uint32_t& number = part_of[joined.root(at)];
    if (number == kNone) {
      number = static_cast<std::uint32_t>(parts.size());
      parts.emplace_back();
    }
    Part& part = parts[number];
    if (vertex_in[at] == kNone) {
      vertex_in[at] = static_cast<std::uint32_t>(part.positions.size());
      part.vertex_of.push_back(index);
      part.positions.push_back(positions[at]);
    }
    part.indices.push_back(vertex_in[at]);
  }
  return parts;
}

/// None where the draw cannot be simplified.
std::vector<Part> parts_of(const Frame& frame, const Command& draw) {
  const std::span<const glm::vec4> vertices =
      std::span(frame.vertices).subspan(draw.first_vertex, draw.vertex_count);
  const std::span<const std::uint32_t> indices =
      std::span(frame.indices).subspan(draw.first_index, draw.index_count);
  if (indices.empty() ||
      !std::ranges::all_of(indices, [&](std::uint32_t index) { return in_front(vertices[index]); })) {
    return {};
  }
  std::vector<std::uint32_t> place(vertices.size());
  const std::size_t places = meshopt_generateVertexRemap(place.data(), indices.data(), indices.size(),
                                                         vertices.data(), vertices.size(), sizeof(glm::vec4));
  const FrontEnd::Depth depth = FrontEnd(frame, draw, DepthFormat::kNone, 0).depth();
  std::vector<glm::dvec3> positions(places);
  for (const std::uint32_t index : indices) {
    positions[place[index]] = in_window(draw, depth, vertices[index]);
  }
  scale_depth(positions);
  return parts_of(indices, place, positions);
}

std::vector<Corners> surface(const Part& part, std::span<const std::uint32_t> indices) {
  std::vector<Corners> triangles;
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    triangles.push_back(
        {part.positions[indices[i]], part.positions[indices[i + 1]], part.positions[indices[i + 2]]});
  }
  return triangles;
}

/// Empty where fewer triangles cannot be had within `pixels`.
std::vector<std::uint32_t> fewer_triangles(const Part& part, double pixels) {
  std::vector<std::array<float, 3>> positions;
  for (const glm::dvec3& p : part.positions) {
    positions.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  }
  constexpr std::size_t kStride = sizeof(positions[0]);
  const double extent = meshopt_simplifyScale(positions.front().data(), positions.size(), kStride);
  const std::vector<Corners> before = surface(part, part.indices);
  std::vector<std::uint32_t> fewest;
  double low = kLeastPower;
  double high = kMostPower;
  for (int i = 0; i < kTries && extent > 0; ++i) {
    const double power = (low + high) / 2;
    std::vector<std::uint32_t> indices(part.indices.size());
    const auto error = static_cast<float>(pixels * std::exp2(power) / extent);
    indices.resize(meshopt_simplify(indices.data(), part.indices.data(), part.indices.size(),
                                    positions.front().data(), positions.size(), kStride, 0, error, 0,
                                    nullptr));
    if (indices.size() == part.indices.size()) {
      low = power;
    } else if (within(before, surface(part, indices), pixels)) {
      low = power;
      fewest = std::move(indices);
    } else {
      high = power;
    }
  }
  return fewest;
}

}  // namespace

Acted simplify(Frame& frame, double pixels) {
  Acted acted;
  for (Command& draw : frame.commands) {
    if (!may_move(frame, draw)) {
      continue;
    }
    std::vector<std::uint32_t> all;
    for (const Part& part : parts_of(frame, draw)) {
      const std::vector<std::uint32_t> fewer = fewer_triangles(part, pixels);
      for (const std::uint32_t index : fewer.empty() ? part.indices : fewer) {
        all.push_back(part.vertex_of[index]);
      }
    }
    if (all.empty() || all.size() == draw.index_count) {
      continue;
    }
    draw.first_index = static_cast<std::uint32_t>(frame.indices.size());
    draw.index_count = static_cast<std::uint32_t>(all.size());
    frame.indices.insert(frame.indices.end(), all.begin(), all.end());
    ++acted.draws;
  }
  return acted;
}

}  // namespace halfspace::whatif
