#include "halfspace/reference/rasterizer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "halfspace/numerics/error.hpp"
#include "halfspace/reference/depth_code.hpp"
#include "halfspace/reference/pixel_rect.hpp"
#include "halfspace/reference/thin_lines.hpp"
#include "halfspace/reference/triangle_method.hpp"
#include "halfspace/reference/vertex_color.hpp"

namespace halfspace::reference {
namespace {

PixelRect to_rect(const Scissor& s) {
  return {s.x, s.y, std::int64_t{s.x} + s.width, std::int64_t{s.y} + s.height};
}

/// The pixels of a line of `size` whose centres are between two ends; of a centre on an end, `low_is_in` says
/// whether the low end holds it, and then the high one does not.
std::pair<std::int64_t, std::int64_t> centres_between(double a, double b, std::int64_t size, bool low_is_in) {
  const double low = std::min(a, b);
  const double high = std::max(a, b);
  const auto is_in = [&](std::int64_t i) {
    const double centre = static_cast<double>(i) + 0.5;
    return low_is_in ? low <= centre && centre < high : low < centre && centre <= high;
  };
  std::int64_t first = 0;
  while (first < size && !is_in(first)) ++first;
  std::int64_t end = first;
  while (end < size && is_in(end)) ++end;
  return {first, end};
}

PixelRect viewport_rect(const Command& draw, const Target& target, TieRule rule) {
  const glm::dvec4 v(draw.viewport);
  const auto [first_x, end_x] = centres_between(v.x, v.x + v.z, target.width, owns_left(rule));
  const auto [first_y, end_y] = centres_between(v.y, v.y + v.w, target.height, owns_top(rule));
  return {first_x, first_y, end_x, end_y};
}

void count_up(std::uint16_t& value) {
  if (value != std::numeric_limits<std::uint16_t>::max()) ++value;
}

bool is_late_z(const Command& draw) {
  if (draw.has(Flag::kEarlyTestsForced)) return false;
  return draw.has(Flag::kShaderDiscards) || draw.has(Flag::kShaderWritesDepth) ||
         draw.has(Flag::kShaderSideEffects) || draw.has(Flag::kAlphaToCoverage);
}

/// What a draw does to its surface.
struct DepthTarget {
  const DrawState& state;
  Surface& surface;
  bool tests;
  bool writes;
  bool has_colors;
};

void test_and_write(const DepthTarget& to, const Fragment& fragment, Counters& counters, Quad& quad) {
  Surface& s = to.surface;
  const std::size_t pixel =
      static_cast<std::size_t>(fragment.y) * s.width + static_cast<std::size_t>(fragment.x);
  const auto place = static_cast<std::size_t>(fragment.y % 2 * 2 + fragment.x % 2);
  const auto bit = static_cast<std::uint8_t>(1u << place);
  ++counters.covered_fragments;
  count_up(s.fragments[pixel]);
  const double rounded = to.state.options.float32_depth ? static_cast<float>(fragment.depth) : fragment.depth;
  const std::uint32_t code = encode_depth(rounded, to.state.storage);
  quad.mask |= bit;
  quad.depth[place] = code;
  if (to.tests) {
    ++counters.depth_tested;
    const auto func = static_cast<std::uint32_t>(to.state.command.depth_func);
    if (!depth_test(func, code, s.codes[pixel])) return;
  }
  ++counters.depth_passed;
  count_up(s.survivors[pixel]);
  quad.passed |= bit;
  if (to.has_colors) s.colors[pixel] = fragment.color;
  if (!to.writes) return;
  ++counters.depth_written;
  s.codes[pixel] = code;
}

/// Tests and writes the fragments of one piece of a triangle, quad by quad.
std::vector<Quad> draw_piece_quads(const DepthTarget& to, std::vector<Fragment> fragments,
                                   Counters& counters) {
  const auto key = [](const Fragment& f) { return std::array{f.y / 2, f.x / 2, f.y, f.x}; };
  std::sort(fragments.begin(), fragments.end(),
            [&](const Fragment& a, const Fragment& b) { return key(a) < key(b); });
  std::vector<Quad> quads;
  for (const Fragment& fragment : fragments) {
    const auto x = static_cast<std::uint32_t>(fragment.x - fragment.x % 2);
    const auto y = static_cast<std::uint32_t>(fragment.y - fragment.y % 2);
    if (quads.empty() || quads.back().x != x || quads.back().y != y) quads.push_back({x, y, 0, 0, {}});
    test_and_write(to, fragment, counters, quads.back());
  }
  for (const Quad& quad : quads) {
    const int covered = std::popcount(quad.mask);
    ++counters.quads;
    counters.full_quads += covered == 4 ? 1 : 0;
    counters.helper_fragments += static_cast<std::uint64_t>(4 - covered);
  }
  return quads;
}

bool is_finite(const glm::vec4& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

/// The corners of a triangle or a line of a draw; nothing where one is not finite.
template <std::size_t Count>
std::optional<std::array<Corner, Count>> clip_corners(const Frame& frame, const Command& command,
                                                      std::uint32_t primitive) {
  std::array<Corner, Count> corners;
  for (std::uint32_t k = 0; k < Count; ++k) {
    const std::uint32_t index = frame.indices[command.first_index + primitive * Count + k];
    const glm::vec4& v = frame.vertices[std::uint64_t{command.first_vertex} + index];
    if (!is_finite(v)) return std::nullopt;
    corners[k] = {{v.x, v.y, v.z, v.w}, vertex_color(index)};
  }
  return corners;
}

void count_fate(Fate fate, Counters& counters) {
  switch (fate) {
    case Fate::kClippedAway:
      ++counters.clipped_away;
      break;
    case Fate::kDegenerate:
      ++counters.degenerate;
      break;
    case Fate::kCulled:
      ++counters.culled;
      break;
    case Fate::kDrawn:
      ++counters.drawn;
      break;
  }
}

TieRule rule_of(const Command& draw, const Options& options) {
  const TieRule own = draw.has(Flag::kBottomLeftRule) ? TieRule::kBottomLeft : TieRule::kTopLeft;
  return options.rule.value_or(own);
}

/// The primitives of a draw, one after the other. Nothing where a corner is not finite.
class Primitives {
 public:
  Primitives(const Frame& frame, const Command& command, const DrawState& state, const Method& method)
      : frame_(frame), command_(command), state_(state), method_(method), lines_(state) {}

  std::optional<DrawnTriangle> draw(std::uint32_t number) {
    if (command_.primitive != Primitive::kTriangles) {
      const auto ends = clip_corners<2>(frame_, command_, number);
      const std::uint32_t* const index = frame_.indices.data() + command_.first_index + 2 * number;
      const bool goes_on =
          command_.primitive == Primitive::kLineStrip && number != 0 && index[0] == index[-1];
      return ends ? std::optional(lines_.line(*ends, goes_on)) : std::nullopt;
    }
    const auto triangle = clip_corners<3>(frame_, command_, number);
    if (!triangle) return std::nullopt;
    return command_.polygon_mode == PolygonMode::kLine ? lines_.outline(*triangle)
                                                       : method_.draw(*triangle, state_);
  }

 private:
  const Frame& frame_;
  const Command& command_;
  const DrawState& state_;
  const Method& method_;
  ThinLines lines_;
};

/// Draw `number` of the frame.
void draw(const Frame& frame, const Command& command, std::uint32_t number, const Options& options,
          const Method& method, Surface& surface, Observer& observer) {
  const Target& target = frame.targets[command.target];
  const bool has_depth = target.depth_surface != kNoSurface;
  const TieRule rule = rule_of(command, options);
  const PixelRect whole = {0, 0, target.width, target.height};
  const DrawState state = {
      command, options, has_depth ? static_cast<Storage>(target.depth_format) : Storage::kNone,
      intersect(intersect(to_rect(command.scissor), viewport_rect(command, target, rule)), whole), rule};
  const bool may_write = options.late_z == LateZ::kOpaque || !is_late_z(command);
  const DepthTarget to = {state, surface, has_depth && command.has(Flag::kDepthTest),
                          has_depth && command.has(Flag::kDepthWrite) && may_write, method.has_colors};
  Counters counters;
  Primitives primitives(frame, command, state, method);
  for (std::uint32_t i = 0; i < command.primitive_count(); ++i) {
    ++counters.triangles;
    std::optional<DrawnTriangle> drawn = primitives.draw(i);
    if (!drawn) {
      ++counters.non_finite;
      continue;
    }
    count_fate(drawn->fate, counters);
    for (std::vector<Fragment>& piece : drawn->pieces) {
      observer.piece(number, i, draw_piece_quads(to, std::move(piece), counters));
    }
  }
  surface.counters += counters;
  observer.draw_done(number, counters);
}

void clear(const Frame& frame, const Command& command, Surface& surface) {
  if (!command.has(Flag::kClearDepth)) return;
  const Target& target = frame.targets[command.target];
  const std::uint32_t code = encode_depth(command.clear_depth, static_cast<Storage>(target.depth_format));
  const PixelRect rect = intersect(to_rect(command.scissor), {0, 0, target.width, target.height});
  for (std::int64_t y = rect.first_y; y < rect.end_y; ++y) {
    for (std::int64_t x = rect.first_x; x < rect.end_x; ++x) {
      surface.codes[static_cast<std::size_t>(y) * surface.width + static_cast<std::size_t>(x)] = code;
    }
  }
}

void require(bool condition, const std::string& message) {
  if (!condition) throw InputError(message);
}

/// Thin lines, and thin sides of triangles, are drawn by one method, which has no colours.
bool can_draw(const Command& command, const Method& method) {
  const bool is_filled =
      command.primitive == Primitive::kTriangles && command.polygon_mode == PolygonMode::kFill;
  return is_filled || (command.draws_thin_lines() && method.name == "exact");
}

/// What the rest of this file relies on.
void check(const Frame& frame, const Options& options, const Method& method) {
  require(options.subpixel_bits >= 4 && options.subpixel_bits <= 8,
          "subpixel_bits: " + std::to_string(options.subpixel_bits) + " is not in 4 to 8");
  std::map<std::uint32_t, Target> first;
  for (const Target& t : frame.targets) {
    if (t.depth_surface == kNoSurface) continue;
    const Target& other = first.try_emplace(t.depth_surface, t).first->second;
    const std::string surface = "depth surface " + std::to_string(t.depth_surface);
    require(t.depth_format != DepthFormat{}, surface + ": a target has it without a depth format");
    require(t.width == other.width && t.height == other.height && t.depth_format == other.depth_format,
            surface + ": its targets differ in size or format");
  }
  for (std::size_t i = 0; i < frame.commands.size(); ++i) {
    const Command& c = frame.commands[i];
    const std::string where = "command " + std::to_string(i);
    require(c.target < frame.targets.size(),
            where + ": target " + std::to_string(c.target) + " does not exist");
    if (c.kind != CommandKind::kDraw) continue;
    require(can_draw(c, method),
            where +
                ": it draws lines or points; legal for a reference: triangles that are filled, and by "
                "'exact' thin lines");
    require(is_finite(c.viewport), where + ": viewport is not finite");
    require(std::uint64_t{c.first_index} + c.index_count <= frame.indices.size(),
            where + ": indices end early");
    for (std::uint32_t k = 0; k < c.index_count; ++k) {
      require(std::uint64_t{c.first_vertex} + frame.indices[c.first_index + k] < frame.vertices.size(),
              where + ": an index has no vertex");
    }
  }
}

Surface make_surface(const Target& target, std::uint32_t index, bool has_colors) {
  Surface s;
  s.index = index;
  s.width = target.width;
  s.height = target.height;
  const std::size_t pixels = static_cast<std::size_t>(s.width) * s.height;
  if (target.depth_surface != kNoSurface) {
    s.codes.assign(pixels, encode_depth(1.0, static_cast<Storage>(target.depth_format)));
  }
  s.fragments.assign(pixels, 0);
  s.survivors.assign(pixels, 0);
  if (has_colors) s.colors.assign(pixels, {});
  return s;
}

/// By target: the index of its surface. Targets that have none are not there.
std::map<std::uint32_t, std::uint32_t> index_surfaces(const Frame& frame) {
  std::map<std::uint32_t, std::uint32_t> index;
  std::uint32_t end = 0;
  for (std::uint32_t i = 0; i < frame.targets.size(); ++i) {
    const std::uint32_t surface = frame.targets[i].depth_surface;
    if (surface == kNoSurface) continue;
    index.emplace(i, surface);
    end = std::max(end, surface + 1);
  }
  std::set<std::uint32_t> without_depth;
  for (const Command& command : frame.commands) {
    if (command.kind == CommandKind::kDraw && !index.contains(command.target)) {
      without_depth.insert(command.target);
    }
  }
  for (const std::uint32_t target : without_depth) index.emplace(target, end++);
  return index;
}

}  // namespace

Counters& Counters::operator+=(const Counters& other) {
  for (const auto counter :
       {&Counters::triangles, &Counters::non_finite, &Counters::clipped_away, &Counters::degenerate,
        &Counters::culled, &Counters::drawn, &Counters::covered_fragments, &Counters::depth_tested,
        &Counters::depth_passed, &Counters::depth_written, &Counters::quads, &Counters::full_quads,
        &Counters::helper_fragments}) {
    this->*counter += other.*counter;
  }
  return *this;
}

std::vector<Surface> rasterize(const Frame& frame, const Options& options, Observer* observer) {
  require(options.pixels == Pixels::kCentres || options.method == "exact",
          "pixels: not those whose centres are covered; legal for '" + std::string(options.method) +
              "': centres, or the method 'exact'");
  return rasterize(frame, options, method_of(options.method), observer);
}

std::vector<Surface> rasterize(const Frame& frame, const Options& options, const Method& method,
                               Observer* observer) {
  check(frame, options, method);
  const bool has_colors = method.has_colors;
  Observer nobody;
  const std::map<std::uint32_t, std::uint32_t> index_of = index_surfaces(frame);
  std::map<std::uint32_t, Surface> surfaces;
  std::map<std::uint32_t, Storage> storage;
  for (const auto& [number, index] : index_of) {
    const Target& target = frame.targets[number];
    surfaces.try_emplace(index, make_surface(target, index, has_colors));
    storage.try_emplace(index, static_cast<Storage>(target.depth_format));
  }
  std::uint32_t draws = 0;
  for (const Command& command : frame.commands) {
    if (command.kind == CommandKind::kDraw) {
      draw(frame, command, draws++, options, method, surfaces.at(index_of.at(command.target)),
           observer != nullptr ? *observer : nobody);
    } else if (frame.targets[command.target].depth_surface != kNoSurface) {
      clear(frame, command, surfaces.at(index_of.at(command.target)));
    }
  }
  std::vector<Surface> result;
  for (auto& [index, surface] : surfaces) {
    for (const std::uint32_t code : surface.codes) {
      surface.depth.push_back(decode_depth(code, storage.at(index)));
    }
    result.push_back(std::move(surface));
  }
  return result;
}

}  // namespace halfspace::reference
