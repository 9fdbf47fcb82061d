/// What if depth went ahead of shading?
#pragma once

#include <cstdint>

#include "halfspace/whatif/draw_ranges.hpp"

namespace halfspace::whatif {

/// The queue of a delay stream moves in this many steps, so that a frame gets few commands.
inline constexpr std::uint64_t kQueueSteps = 8;

/// A delay stream: T. Aila, V. Miettinen, P. Nordlund, "Delay Streams for Graphics Hardware", SIGGRAPH 2003.
/// A triangle waits for its shading in a queue, while the depth of those behind it goes ahead.
///
/// The triangles of each range (draw_ranges.hpp) go through a queue, in batches of an eighth of `triangles`,
/// rounded up. When a batch enters, its triangles test and write depth as before, without colour. When it
/// leaves, they are drawn again: they test EQUAL, and write colour but no depth. At least `triangles`, and
/// less than two batches more, have entered after a triangle when it leaves, or all that the range has. Draws
/// that do not shade only enter. Ranges in which nothing shades are left alone: there is nothing to save.
///
/// At the end of a range every sample has the depth that it has without the queue. A fragment is shaded where
/// its depth is that of the sample when it leaves: where nothing before the range and nothing that has
/// entered is nearer. Fragments of equal depth are all shaded, where LESS shades the first of them, and so
/// are those as deep as what was there before the range, where LESS shades none.
///
/// `triangles` is 1 to kMaxFrameTriangles (scene/validate.hpp).
Acted delay(Frame& frame, std::uint64_t triangles);

/// A depth prepass: all depth of a range first, then its shading. It is the delay stream whose queue is as
/// long as the range. Each sample then shades what it shows in the end, once, but for equal depths: above.
Acted prepass(Frame& frame);

}  // namespace halfspace::whatif
