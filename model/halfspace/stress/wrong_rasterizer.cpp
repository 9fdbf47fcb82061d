#include "halfspace/stress/wrong_rasterizer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "halfspace/config/did_you_mean.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/reference/barycentric.hpp"
#include "halfspace/reference/clipped_triangle.hpp"
#include "halfspace/reference/float_epsilon.hpp"
#include "halfspace/stress/reference_picture.hpp"
#include "halfspace/stress/wrong_coverage.hpp"

namespace halfspace::stress {
namespace {

using reference::ClipTriangle;
using reference::CoverageMethod;
using reference::DrawnTriangle;
using reference::DrawState;
using reference::Fragment;
using reference::Homogeneous;
using reference::Piece;
using wrong::Fragments;

template <CoverageMethod cover>
DrawnTriangle draw(const ClipTriangle& triangle, const DrawState& state) {
  return reference::draw_clipped(triangle, state, reference::guard_band(state), cover);
}

constexpr auto right = draw<reference::cover_barycentrically>;

// Clipping.

/// Without one of the two depth planes, which come first. Without a near plane w must be cut where it is 0.
template <std::size_t plane>
DrawnTriangle without_plane(const ClipTriangle& triangle, const DrawState& state) {
  std::vector<Homogeneous> planes = reference::guard_band(state);
  if (!state.command.has(Flag::kDepthClamp)) {
    planes.erase(planes.begin() + plane);
  }
  return reference::draw_clipped(triangle, state, planes, reference::cover_barycentrically);
}

DrawnTriangle drops_cut(const ClipTriangle& triangle, const DrawState& state) {
  for (const reference::Corner& v : triangle) {
    if (v.z < 0 || v.z > v.w || v.w <= 0) {
      return {};
    }
  }
  return right(triangle, state);
}

DrawnTriangle divides_by_magnitude(const ClipTriangle& triangle, const DrawState& state) {
  ClipTriangle turned = triangle;
  for (reference::Corner& v : turned) {
    v.w = std::abs(v.w);
  }
  return right(turned, state);
}

DrawnTriangle draws_first_piece(const ClipTriangle& triangle, const DrawState& state) {
  DrawnTriangle drawn = right(triangle, state);
  drawn.pieces.resize(std::min<std::size_t>(drawn.pieces.size(), 1));
  return drawn;
}

/// Cuts each edge as it comes, in float32 by a parameter, so that neighbours disagree.
reference::Polygon cut_in_float(const reference::Polygon& polygon, const Homogeneous& plane) {
  const auto distance = [&](const reference::Corner& v) {
    return static_cast<float>(plane.x * v.x + plane.y * v.y + plane.z * v.z + plane.w * v.w);
  };
  reference::Polygon left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const reference::Corner& from = polygon[i];
    const reference::Corner& to = polygon[(i + 1) % polygon.size()];
    const float inside = distance(from);
    const float then = distance(to);
    if (inside >= 0) {
      left.push_back(from);
    }
    if ((inside >= 0) != (then >= 0)) {
      const float t = inside / (inside - then);
      const auto between = [t](double a, double b) {
        return static_cast<float>(a) + t * (static_cast<float>(b) - static_cast<float>(a));
      };
      reference::Corner cut;
      cut.x = between(from.x, to.x);
      cut.y = between(from.y, to.y);
      cut.z = between(from.z, to.z);
      cut.w = between(from.w, to.w);
      left.push_back(cut);
    }
  }
  return left;
}

DrawnTriangle cuts_in_float(const ClipTriangle& triangle, const DrawState& state) {
  reference::Polygon polygon(triangle.begin(), triangle.end());
  for (const Homogeneous& plane : reference::guard_band(state)) {
    polygon = cut_in_float(polygon, plane);
  }
  DrawnTriangle drawn;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const DrawnTriangle part = reference::draw_clipped({polygon[0], polygon[i], polygon[i + 1]}, state, {},
                                                       reference::cover_barycentrically);
    drawn.fate = std::max(drawn.fate, part.fate);
    drawn.pieces.insert(drawn.pieces.end(), part.pieces.begin(), part.pieces.end());
  }
  return drawn;
}

/// Discards what is on the far side of a border of the screen, by vertices that were divided by any w.
DrawnTriangle discards_by_division(const ClipTriangle& triangle, const DrawState& state) {
  const auto all = [&](const auto& beyond) { return std::all_of(triangle.begin(), triangle.end(), beyond); };
  const bool discarded = all([](const reference::Corner& v) { return v.x / v.w < -1; }) ||
                         all([](const reference::Corner& v) { return v.x / v.w > 1; }) ||
                         all([](const reference::Corner& v) { return v.y / v.w < -1; }) ||
                         all([](const reference::Corner& v) { return v.y / v.w > 1; });
  return discarded ? DrawnTriangle{} : right(triangle, state);
}

// Depth.

/// The right fragments, their depths changed by change(piece, fragment).
template <auto change>
void with_depth(const Piece& piece, Fragments& fragments) {
  reference::cover_barycentrically(piece, fragments);
  for (Fragment& fragment : fragments) {
    change(piece, fragment);
  }
}

double plane_at(const Piece& piece, double x, double y) { return piece.plane.at(x, y); }

void depth_at_corner(const Piece& piece, Fragment& fragment) {
  fragment.depth = plane_at(piece, static_cast<double>(fragment.x), static_cast<double>(fragment.y));
}

/// From the first vertex, with gradients of float32.
void depth_of_float_plane(const Piece& piece, Fragment& fragment) {
  const auto dx = static_cast<float>(piece.plane.dzdx);
  const auto dy = static_cast<float>(piece.plane.dzdy);
  fragment.depth = static_cast<float>(piece.plane.z) +
                   dx * (static_cast<float>(fragment.x) + 0.5F - static_cast<float>(piece.plane.x0)) +
                   dy * (static_cast<float>(fragment.y) + 0.5F - static_cast<float>(piece.plane.y0));
}

void depth_cut(const Piece&, Fragment& fragment) {
  fragment.depth = std::floor(fragment.depth * 0xFFFFFF) / 0xFFFFFF;
}

void depth_of_16_bits(const Piece&, Fragment& fragment) {
  fragment.depth = std::round(fragment.depth * 0xFFFF) / 0xFFFF;
}

void depth_of_nearest(const Piece& piece, Fragment& fragment) {
  fragment.depth = std::min({piece.depth[0], piece.depth[1], piece.depth[2]});
}

void swapped_depths(const Piece& piece, Fragments& fragments) {
  Piece swapped = piece;
  if (reference::twice_area(piece.grid[0], piece.grid[1], piece.grid[2]) < 0) {
    std::swap(swapped.depth[1], swapped.depth[2]);
  }
  reference::cover_barycentrically(swapped, fragments);
}

/// Depth depends on where the walk starts: a unit more behind column 16 of the target.
void depth_by_place(const Piece&, Fragment& fragment) {
  fragment.depth += fragment.x >= 16 ? 1.0 / 0xFFFFFF : 0;
}

// State.

template <auto change>
void each_draw(Frame& frame) {
  for (Command& command : frame.commands) {
    if (command.kind == CommandKind::kDraw) {
      change(command);
    }
  }
}

template <DepthFunc from, DepthFunc to>
void other_func(Command& command) {
  command.depth_func = command.depth_func == from ? to : command.depth_func;
}

template <Flag flag>
void without(Command& command) {
  command.flags &= ~bits({flag});
}

void always_writes(Command& command) { command.flags |= bits({Flag::kDepthWrite}); }
void no_slope(Command& command) { command.offset_factor = 0; }
void no_offset_clamp(Command& command) { command.offset_clamp = 0; }

/// Blocks of 2x2 pixels are inside or outside as a whole.
void even_scissor(Command& command) {
  Scissor& scissor = command.scissor;
  const std::int32_t right = (scissor.x + scissor.width + 1) & ~1;
  const std::int32_t bottom = (scissor.y + scissor.height + 1) & ~1;
  scissor.x &= ~1;
  scissor.y &= ~1;
  scissor.width = right - scissor.x;
  scissor.height = bottom - scissor.y;
}

void faces_before_viewport(Command& command) {
  command.flags ^= command.viewport.w < 0 ? bits({Flag::kFrontPositiveArea}) : 0;
}

void zero_for_nan(Frame& frame) {
  for (glm::vec4& v : frame.vertices) {
    for (int i = 0; i < 4; ++i) {
      v[i] = std::isfinite(v[i]) ? v[i] : 0;
    }
  }
}

void clears_once(Frame& frame) {
  bool cleared = false;
  for (Command& command : frame.commands) {
    if (command.kind == CommandKind::kClear) {
      command.flags &= cleared ? ~bits({Flag::kClearDepth}) : ~0U;
      cleared = true;
    }
  }
}

void clears_a_code_less(Frame& frame) {
  for (Command& command : frame.commands) {
    command.clear_depth = std::max(command.clear_depth - 1.0F / 0xFFFFFF, 0.0F);
  }
}

// clang-format off
constexpr std::array kWrong{
    WrongRasterizer{"owns_nothing", "no edge owns the samples on it", draw<wrong::owns_nothing>},
    WrongRasterizer{"owns_everything", "every edge owns them", draw<wrong::owns_everything>},
    WrongRasterizer{"bottom_right", "right and bottom edges own them", draw<wrong::bottom_right>},
    WrongRasterizer{"no_top", "left edges own them, top edges do not", draw<wrong::no_top>},
    WrongRasterizer{"every_horizontal", "left edges and all horizontal ones own them", draw<wrong::every_horizontal>},
    WrongRasterizer{"unturned_ties", "ties of triangles of negative area by their edges as they came", draw<wrong::unturned_ties>},
    WrongRasterizer{"float_epsilon", "float32 edges, ties within an epsilon", draw<reference::cover_with_epsilon>},
    WrongRasterizer{"float_edges", "float32 edges relative to a vertex", draw<wrong::float_edges>},
    WrongRasterizer{"float_difference", "float32 edges, C a difference of two products", draw<wrong::float_difference>},
    WrongRasterizer{"float_increments", "float32 edges, by increments", draw<wrong::float_increments>},
    WrongRasterizer{"coarse_grid", "positions on 1/8 pixel", draw<wrong::coarse_grid>},
    WrongRasterizer{"edges_of_32_bits", "edge values of 32 bits", draw<wrong::edges_of_32_bits>},
    WrongRasterizer{"drops_tiny", "nothing below 16 square sub-pixels", draw<wrong::drops_tiny>},
    WrongRasterizer{"one_winding", "nothing of negative area", draw<wrong::one_winding>},
    WrongRasterizer{"short_box", "a bounding box without its last column", draw<wrong::short_box>},
    WrongRasterizer{"late_box", "a bounding box without its first row", draw<wrong::late_box>},
    WrongRasterizer{"corner_samples", "samples at the corners of pixels", draw<wrong::corner_samples>},
    WrongRasterizer{"swapped_reject", "tiles rejected by the wrong corner", draw<wrong::swapped_reject>},
    WrongRasterizer{"hasty_accept", "tiles accepted by two corners", draw<wrong::hasty_accept>},
    WrongRasterizer{"saturates_to_16_bits", "edges saturated to 16 bits at the tile's origin", draw<wrong::saturates_to_16_bits>},
    WrongRasterizer{"cuts_steps", "A and B without their lowest bit", draw<wrong::cuts_steps>},
    WrongRasterizer{"widens_slivers", "half a sub-pixel more on all sides", draw<wrong::widens_slivers>},
    WrongRasterizer{"no_prestep", "edges begin at a whole row, not at the sample below their end", draw<wrong::no_prestep>},
    WrongRasterizer{"unsigned_box", "nothing with a vertex left of the target or above it", draw<wrong::unsigned_box>},
    WrongRasterizer{"even_scissor", "scissors grown to blocks of 2x2 pixels", right, each_draw<even_scissor>},
    WrongRasterizer{"faces_before_viewport", "faces by their area before the viewport turns them over", right, each_draw<faces_before_viewport>},
    WrongRasterizer{"no_near_plane", "not clipped at the near plane", without_plane<0>},
    WrongRasterizer{"no_far_plane", "not clipped at the far plane", without_plane<1>},
    WrongRasterizer{"drops_cut", "nothing of a triangle that a depth plane cuts", drops_cut},
    WrongRasterizer{"divides_by_magnitude", "the magnitude of w for w", divides_by_magnitude},
    WrongRasterizer{"draws_first_piece", "the first piece only of what clipping leaves", draws_first_piece},
    WrongRasterizer{"cuts_in_float", "cuts of float32, from the end of an edge that comes first", cuts_in_float},
    WrongRasterizer{"discards_by_division", "nothing that lies beyond a border of the screen by x / w and y / w, w of any sign", discards_by_division},
    WrongRasterizer{"zero_for_nan", "0 for NaN and infinities", right, zero_for_nan},
    WrongRasterizer{"depth_at_corner", "depth at the corner of the pixel", draw<with_depth<depth_at_corner>>},
    WrongRasterizer{"depth_of_float_plane", "float32 gradients from a vertex", draw<with_depth<depth_of_float_plane>>},
    WrongRasterizer{"depth_cut", "depth cut to 24 bits", draw<with_depth<depth_cut>>},
    WrongRasterizer{"depth_of_16_bits", "depth of 16 bits", draw<with_depth<depth_of_16_bits>>},
    WrongRasterizer{"depth_of_nearest", "depth of the nearest vertex", draw<with_depth<depth_of_nearest>>},
    WrongRasterizer{"depth_by_place", "depth a code more right of column 16", draw<with_depth<depth_by_place>>},
    WrongRasterizer{"swapped_depths", "depths of two vertices swapped where the triangle is turned", draw<swapped_depths>},
    WrongRasterizer{"no_slope", "polygon offset without its slope", right, each_draw<no_slope>},
    WrongRasterizer{"no_offset_clamp", "polygon offset without its clamp", right, each_draw<no_offset_clamp>},
    WrongRasterizer{"no_depth_clamp", "no depth clamp", right, each_draw<without<Flag::kDepthClamp>>},
    WrongRasterizer{"lequal_for_less", "LEQUAL for LESS", right, each_draw<other_func<DepthFunc::kLess, DepthFunc::kLequal>>},
    WrongRasterizer{"greater_for_gequal", "GREATER for GEQUAL", right, each_draw<other_func<DepthFunc::kGequal, DepthFunc::kGreater>>},
    WrongRasterizer{"lequal_for_equal", "LEQUAL for EQUAL", right, each_draw<other_func<DepthFunc::kEqual, DepthFunc::kLequal>>},
    WrongRasterizer{"always_writes", "depth written where the draw does not", right, each_draw<always_writes>},
    WrongRasterizer{"clears_once", "clears after the first do nothing", right, clears_once},
    WrongRasterizer{"clears_a_code_less", "clears to a code less", right, clears_a_code_less},
};
// clang-format on

class Wrong final : public Subject {
 public:
  Wrong(const WrongRasterizer& wrong, const Precision& precision) : wrong_(wrong), precision_(precision) {}

  [[nodiscard]] std::string name() const override { return fmt::format("wrong on purpose: {}", wrong_.name); }

  Picture draw(const Frame& frame) override {
    Frame twisted = frame;
    if (wrong_.twist != nullptr) {
      wrong_.twist(twisted);
    }
    return reference_picture(twisted, precision_, {wrong_.name, wrong_.draw});
  }

 private:
  const WrongRasterizer& wrong_;
  Precision precision_;
};

}  // namespace

std::span<const WrongRasterizer> wrong_rasterizers() { return kWrong; }

const WrongRasterizer& wrong_rasterizer(std::string_view name) {
  std::string names;
  for (const WrongRasterizer& wrong : kWrong) {
    if (wrong.name == name) {
      return wrong;
    }
    names += fmt::format("{}{}", names.empty() ? "" : ", ", wrong.name);
  }
  throw OptionError(fmt::format("wrong rasterizer is '{}'{}; it must be one of {}", name,
                                did_you_mean(name, kWrong, &WrongRasterizer::name), names));
}

std::unique_ptr<Subject> wrong_subject(const WrongRasterizer& wrong, const Precision& precision) {
  return std::make_unique<Wrong>(wrong, precision);
}

}  // namespace halfspace::stress
