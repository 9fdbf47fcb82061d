/// Synthetic frames: lists of triangles of one kind, built in memory, the same on every machine. They are an
/// INPUT by the name synthetic:NAME, and synthetic:NAME:full at the length that is customary.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "halfspace/scene/frame.hpp"
#include "halfspace/scene/input_name.hpp"

namespace halfspace {

struct SyntheticInfo {
  std::string_view name;
  std::string_view help;            ///< one line: how many triangles, of what size, how drawn
  int divisor = 1;                  ///< the list that is customary for this kind is so many times as long
  std::string_view full_help = {};  ///< of that list, where it is longer
};

/// All of them.
[[nodiscard]] std::span<const SyntheticInfo> synthetic_frames();

/// "synthetic:one_triangle ...", a line each, for --help.
[[nodiscard]] std::string synthetic_help();

/// `name` is NAME or NAME:full. One target with unorm24 or float32 depth, a clear of all of it, one draw that
/// tests LESS and writes. All triangles are inside the screen, either way round, with corners on the grid of
/// 1/256 pixel. Valid (scene/validate.hpp), and named `name`. Throws InputError for a name that is none.
[[nodiscard]] Frame synthetic_frame(std::string_view name, DepthFormat depth = DepthFormat::kUnorm24);

}  // namespace halfspace
