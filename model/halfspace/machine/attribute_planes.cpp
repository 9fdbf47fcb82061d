#include "halfspace/machine/attribute_planes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "halfspace/units/interpolator.hpp"

namespace halfspace {

std::int32_t to_attribute(double value) {
  constexpr double kLeast = std::numeric_limits<std::int32_t>::min();
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(
      std::lrint(std::clamp(std::ldexp(value, kAttributeFraction), kLeast, kMost)));
}

AttributePlanes::AttributePlanes(const FrontEnd& front_end, std::uint32_t index, int sub_pixel_bits)
    : sub_pixel_bits_(sub_pixel_bits) {
  std::vector<ScreenTriangle> fan;
  FrontEndCounters counters;
  front_end.process(index, fan, counters);
  const auto polygon = front_end.corners(index);
  for (std::size_t i = 0; i < fan.size(); ++i) {
    add(fan[i], {polygon.v[0], polygon.v[i + 1], polygon.v[i + 2]});
  }
}

void AttributePlanes::add(const ScreenTriangle& screen, const std::array<FrontEnd::Corner, 3>& corners) {
  Piece piece{.edges = {}, .area2 = 0, .corners = corners, .q = {}, .number = screen.piece};
  const auto& v = screen.v;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& from = v[(i + 1) % 3];
    const auto& to = v[(i + 2) % 3];
    const std::int64_t dx = std::int64_t{to.x} - from.x;
    const std::int64_t dy = std::int64_t{to.y} - from.y;
    piece.edges[i] = {.e = dy * from.x - dx * from.y, .a = -dy, .b = dx};
    piece.area2 += piece.edges[i].e;
  }
  if (piece.area2 == 0) {
    return;  // setup culls it
  }
  if (piece.area2 < 0) {
    piece.area2 = -piece.area2;
    for (Edge& edge : piece.edges) {
      edge = {.e = -edge.e, .a = -edge.a, .b = -edge.b};
    }
  }
  const double least = std::min({corners[0].clip.w, corners[1].clip.w, corners[2].clip.w});
  for (std::size_t i = 0; i < 3; ++i) {
    // Only their ratios count. What is too small for a normal number is nothing beside the largest.
    const auto q = static_cast<float>(least / corners[i].clip.w);
    piece.q[i] = std::bit_cast<std::uint32_t>(std::max(q, std::numeric_limits<float>::min()));
  }
  pieces_.push_back(piece);
}

std::int64_t AttributePlanes::edge_at(const Edge& edge, int x, int y, const SamplePosition& sample) const {
  const auto place = [&](int pixel, int sixteenths) {
    return (std::int64_t{pixel} << sub_pixel_bits_) + sample_way(sixteenths, sub_pixel_bits_);
  };
  return edge.e + edge.a * place(x, sample.x) + edge.b * place(y, sample.y);
}

std::size_t AttributePlanes::place_of(std::uint8_t number) const {
  return static_cast<std::size_t>(std::ranges::find(pieces_, number, &Piece::number) - pieces_.begin());
}

bool AttributePlanes::covers(const Piece& piece, int x, int y) const {
  return std::ranges::all_of(piece.edges, [&](const Edge& edge) { return edge_at(edge, x, y) >= 0; });
}

std::size_t AttributePlanes::piece_at(int x, int y) const {
  std::size_t best = 0;
  double nearest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    double inside = std::numeric_limits<double>::infinity();
    for (const Edge& edge : pieces_[i].edges) {
      const double length = std::hypot(static_cast<double>(edge.a), static_cast<double>(edge.b));
      inside = std::min(inside, static_cast<double>(edge_at(edge, x, y)) / length);
    }
    if (inside >= 0) {
      return i;
    }
    if (inside > nearest) {
      nearest = inside;
      best = i;
    }
  }
  return best;
}

std::uint8_t AttributePlanes::mask(std::size_t piece, int x, int y) const {
  unsigned mask = 0;
  for (int p = 0; p < 4; ++p) {
    mask |= covers(pieces_[piece], x + p % 2, y + p / 2) ? 1u << p : 0u;
  }
  return static_cast<std::uint8_t>(mask);
}

AttributeQuad AttributePlanes::packet(std::size_t piece, int x, int y, std::uint8_t mask,
                                      const std::array<glm::dvec4, 3>& corners, Interpolation how,
                                      const SamplePosition& sample) const {
  const Piece& of = pieces_[piece];
  AttributeQuad quad;
  quad.mask = mask;
  for (std::size_t i = 0; i < 2; ++i) {
    quad.e[i] = edge_at(of.edges[i + 1], x, y, sample);
    quad.a[i] = static_cast<std::int32_t>(of.edges[i + 1].a);
    quad.b[i] = static_cast<std::int32_t>(of.edges[i + 1].b);
  }
  quad.area2 = of.area2;
  quad.q = of.q;
  if (how == Interpolation::kAffine) {
    quad.q.fill(std::bit_cast<std::uint32_t>(1.0f));
  }
  for (std::size_t v = 0; v < 3; ++v) {
    const glm::dvec3& w = of.corners[v].weights;
    const glm::dvec4 value =
        how == Interpolation::kFlat ? corners[0] : corners[0] * w[0] + corners[1] * w[1] + corners[2] * w[2];
    for (std::size_t c = 0; c < 4; ++c) {
      quad.value[4 * v + c] = to_attribute(value[static_cast<int>(c)]);
    }
  }
  return quad;
}

QuadValues AttributePlanes::values(std::size_t piece, int x, int y, std::uint8_t mask,
                                   const std::array<glm::dvec4, 3>& corners, Interpolation how) const {
  const ShadedQuad shaded =
      interpolator(packet(piece, x, y, mask, corners, how), sub_pixel_bits_, kShaderBits);
  QuadValues values{};
  for (std::size_t i = 0; i < 16; ++i) {
    values[i / 4][i % 4] = shaded.value[i];
  }
  return values;
}

}  // namespace halfspace
