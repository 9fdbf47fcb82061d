#include "halfspace/whatif/quad_merging.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <iterator>
#include <utility>

#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

constexpr std::uint8_t kWhole = 0xF;

std::size_t checked(int buffer) {
  if (buffer < 0 || buffer > kMostMergeQuads) {
    throw OptionError(fmt::format("quads held for merging are {}; legal: 0 to {}", buffer, kMostMergeQuads));
  }
  return static_cast<std::size_t>(buffer);
}

/// Whether fragments of the draw are shaded: it writes colour, or its shader does something else that cannot
/// be left out.
bool runs_shader(const Command& draw) {
  return draw.has(Flag::kColorWrite) || draw.has(Flag::kShaderDiscards) ||
         draw.has(Flag::kShaderWritesDepth) || draw.has(Flag::kShaderSideEffects) ||
         draw.has(Flag::kAlphaToCoverage);
}

template <class At>
std::uint64_t place_of(const At& at) {
  return std::uint64_t{at.y} << 32 | at.x;
}

QuadGroup group_of(const QuadEvent& quad) {
  return {.draw = quad.draw,
          .x = quad.x,
          .y = quad.y,
          .front = quad.front,
          .mask = quad.passed,
          .size = 1,
          .triangles = {quad.triangle}};
}

}  // namespace

QuadMerging::QuadMerging(const Frame& frame, int buffer, Shade shade)
    : frame_(frame), buffer_(checked(buffer)), shade_(std::move(shade)) {
  for (const Command& command : frame.commands) {
    if (command.kind == CommandKind::kDraw) {
      commands_.push_back(&command);
    }
  }
  draws_.resize(commands_.size());
}

void QuadMerging::quad(const QuadEvent& quad) {
  if (quad.passed == 0) {
    return;
  }
  if (quad.draw != draw_) {
    end_draw();
    begin_draw(quad.draw);
  }
  if (!mesh_) {
    return;
  }
  QuadMergingCounters& counters = draws_[draw_];
  ++counters.quads;
  counters.survivors += static_cast<std::uint64_t>(std::popcount(quad.passed));
  if (quad.passed == kWhole) {
    ++counters.whole;
    leave(group_of(quad));
    return;
  }
  Place& place = places_[place_of(quad)];
  Fit closest = Fit::kNotAdjacent;
  for (auto group = place.held.begin(); group != place.held.end(); ++group) {
    closest = std::max(closest, fit(quad, **group));
    if (closest == Fit::kJoins) {
      join(quad, place, group);
      return;
    }
  }
  if (place.evicted && fit(quad, *place.evicted) == Fit::kJoins) {
    ++counters.missed;
  } else if (place.held.empty()) {
    ++counters.alone;
  } else if (closest == Fit::kNotAdjacent) {
    ++counters.not_adjacent;
  } else if (closest == Fit::kOtherFacing) {
    ++counters.other_facing;
  } else {
    ++counters.overlap;
  }
  hold(group_of(quad), place);
}

QuadMergingResult QuadMerging::finish() {
  end_draw();
  QuadMergingResult result{.buffer = static_cast<int>(buffer_), .draws = draws_, .frame = {}};
  for (const QuadMergingCounters& draw : draws_) {
    result.frame += draw;
  }
  return result;
}

void QuadMerging::begin_draw(std::uint32_t draw) {
  draw_ = draw;
  mesh_.reset();
  if (runs_shader(*commands_[draw])) {
    mesh_.emplace(frame_, *commands_[draw]);
  }
}

void QuadMerging::end_draw() {
  for (const QuadGroup& group : held_) {
    leave(group);
  }
  held_.clear();
  places_ = {};
}

QuadMerging::Fit QuadMerging::fit(const QuadEvent& quad, const QuadGroup& group) const {
  const bool adjacent =
      std::any_of(group.triangles.begin(), group.triangles.begin() + group.size,
                  [&](std::uint32_t triangle) { return mesh_->share_edge(triangle, quad.triangle); });
  if (!adjacent) {
    return Fit::kNotAdjacent;
  }
  if (group.front != quad.front) {
    return Fit::kOtherFacing;
  }
  return (group.mask & quad.passed) != 0 ? Fit::kOverlap : Fit::kJoins;
}

void QuadMerging::join(const QuadEvent& quad, Place& place, std::vector<Held::iterator>::iterator group) {
  QuadGroup& joined = **group;
  joined.triangles[joined.size++] = quad.triangle;
  joined.mask |= quad.passed;
  ++draws_[draw_].joined;
  if (joined.mask == kWhole) {
    leave(joined);
    held_.erase(*group);
    place.held.erase(group);
  }
}

void QuadMerging::hold(const QuadGroup& group, Place& place) {
  held_.push_back(group);
  place.held.push_back(std::prev(held_.end()));
  if (held_.size() > buffer_) {
    Place& of_oldest = places_[place_of(held_.front())];
    of_oldest.evicted = held_.front();
    of_oldest.held.erase(of_oldest.held.begin());
    ++draws_[draw_].evictions;
    leave(held_.front());
    held_.pop_front();
  }
}

void QuadMerging::leave(const QuadGroup& group) {
  QuadMergingCounters& counters = draws_[group.draw];
  counters.pairs += group.size == 2 ? 1 : 0;
  counters.triples += group.size == 3 ? 1 : 0;
  counters.quadruples += group.size == 4 ? 1 : 0;
  if (shade_) {
    shade_(group);
  }
}

}  // namespace halfspace
