/// What-ifs: a frame as it is, and the same picture asked for in another way.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/scene/frame.hpp"
#include "halfspace/whatif/draw_ranges.hpp"
#include "halfspace/whatif/sort.hpp"

namespace halfspace::whatif {

/// What is wanted, in the order in which it is done. Not both of `order` and `alternate`, nor of `prepass`
/// and `delay`: of each pair one says what the other would.
struct WhatIf {
  std::optional<double> lod_pixels;    ///< above 0 (lod.hpp)
  std::optional<SortOrder> order;      ///< (sort.hpp)
  bool alternate = false;              ///< every second frame of a sequence is walked backwards (sort.hpp)
  bool prepass = false;                ///< (depth_ahead.hpp)
  std::optional<std::uint64_t> delay;  ///< triangles, 1 to kMaxFrameTriangles (depth_ahead.hpp)

  [[nodiscard]] bool any() const { return lod_pixels || order || alternate || prepass || delay; }
};

/// What one what-if did.
struct Applied {
  std::string name;  ///< that of its option, without dashes
  Acted acted;
};

struct Sequence {
  Frame frame;
  std::vector<Applied> applied;
};

/// The frames, each changed as wanted, one after the other (sequence.hpp). Throws InputError where something
/// is out of its range, two exclude each other, or `alternate` has fewer than two frames; as join() does; and
/// where the frame becomes larger than legal (scene/validate.hpp). `frames` holds at least one.
[[nodiscard]] Sequence apply(std::vector<Frame> frames, const WhatIf& what_if);

}  // namespace halfspace::whatif
