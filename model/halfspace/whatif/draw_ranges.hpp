/// Which draws of a frame may change their order, or have their depth laid first, without changing the depth
/// that any sample has in the end.
///
/// The depth test with LESS or LEQUAL, and a write, leaves at each sample the least of what was there and of
/// all fragments that cover it; with GREATER or GEQUAL the largest. A least or largest does not depend on the
/// order of its arguments, nor on how often each is given. So a draw may move if it is all of
/// - drawn filled into a depth surface, tested with one of these four functions, and written;
/// - opaque: no blending, no alpha to coverage, and no shader that may discard or writes depth, for then only
///   the shader knows which fragments there are or how deep they are (early tests forced or not: what it
///   discards would be missing in the picture behind a depth that was laid);
/// - without effects that an order shows: no stencil test, no side effects of the shader.
/// A range is a maximal run of such draws, one after the other, on one target and with one direction (LESS
/// and LEQUAL, or GREATER and GEQUAL). Every other command ends a range, and stays where it is: a clear, a
/// draw that may not move, another target or another direction.
///
/// What may change is which of several draws at exactly the same depth a sample shows.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "halfspace/scene/frame.hpp"

namespace halfspace::whatif {

/// What a what-if acted on, counted in the frame as it was.
struct Acted {
  std::uint64_t draws = 0;
  std::uint64_t ranges = 0;  ///< that the draws were in; 0 where it takes each draw by itself

  Acted& operator+=(const Acted& other) {
    draws += other.draws;
    ranges += other.ranges;
    return *this;
  }
};

/// True where the draw may move.
[[nodiscard]] bool may_move(const Frame& frame, const Command& command);

/// True where fragments of the draw that pass the depth test are shaded: they have a colour, an effect or,
/// from the shader, a depth or a verdict.
[[nodiscard]] bool shades(const Command& draw);

/// True where a smaller depth is nearer: the draw tests LESS or LEQUAL.
[[nodiscard]] bool keeps_least(const Command& draw);

/// A range: commands first to last - 1.
struct DrawRange {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// All ranges, in order.
[[nodiscard]] std::vector<DrawRange> draw_ranges(const Frame& frame);

/// Puts what rewrite(commands of the range) -> std::vector<Command> returns in the place of each range; an
/// empty vector leaves the range alone, and it does not count as acted on. `rewrite` may add to the frame's
/// vertices and indices; the frame's commands are not there meanwhile.
template <class Rewrite>
Acted rewrite_ranges(Frame& frame, const Rewrite& rewrite) {
  const std::vector<DrawRange> ranges = draw_ranges(frame);
  const std::vector<Command> before = std::exchange(frame.commands, {});
  std::vector<Command> after;
  Acted acted;
  std::size_t done = 0;
  const std::span<const Command> all(before);
  const auto append = [&after](std::span<const Command> commands) {
    after.insert(after.end(), commands.begin(), commands.end());
  };
  for (const DrawRange& range : ranges) {
    const std::span<const Command> draws = all.subspan(range.first, range.last - range.first);
    const std::vector<Command> instead = rewrite(draws);
    append(all.subspan(done, range.first - done));
    append(instead.empty() ? draws : std::span<const Command>(instead));
    done = range.last;
    if (!instead.empty()) {
      acted += {.draws = draws.size(), .ranges = 1};
    }
  }
  append(all.subspan(done));
  frame.commands = std::move(after);
  return acted;
}

}  // namespace halfspace::whatif
