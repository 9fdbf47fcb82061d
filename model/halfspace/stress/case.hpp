/// A case of the stress campaign: a frame, and what must hold of its picture, whoever draws it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/numerics/conservative.hpp"
#include "halfspace/numerics/sample_pattern.hpp"
#include "halfspace/reference/exact_triangle.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace::stress {

/// What cases are made for.
struct Precision {
  int sub_pixel_bits = 8;
  DepthFormat format = DepthFormat::kUnorm24;
  reference::TieRule rule = reference::TieRule::kTopLeft;  ///< of all draws
  Conservative conservative = Conservative::kOff;          ///< which pixels triangles have
  int uncertainty = 0;                                     ///< of these, in sub-pixels
  SamplePattern samples{};                                 ///< of a pixel

  /// Sample `sample` of pixel (x, y) on the sub-pixel grid.
  [[nodiscard]] reference::GridPoint sample_of(std::int64_t x, std::int64_t y, int sample) const {
    const SamplePosition& at = samples.at[static_cast<std::size_t>(sample)];
    return reference::place_in_pixel(x, y, at.x, at.y, sub_pixel_bits);
  }
};

/// For people: "8 sub-pixel bits, unorm24, fill rule top_left".
std::string to_text(const Precision& precision);

/// A triangle whose window coordinates are on the sub-pixel grid, and arrive there unrounded: w is 1, and the
/// target's side a power of two. So the definition says which samples it covers.
struct KnownTriangle {
  reference::GridTriangle grid;
  std::array<float, 3> z{};
  std::uint32_t command = 0;  ///< in Frame::commands: the state of its draw
  std::uint32_t draw = 0;     ///< of the frame's draws, clears not counted
  std::uint32_t index = 0;    ///< in the draw
};

/// A second frame that must give the same picture as the first, moved by whole pixels.
struct Twin {
  Frame frame{};
  std::int32_t dx = 0;  ///< pixel (x, y) of the first is pixel (x + dx, y + dy) of the twin
  std::int32_t dy = 0;
  bool same_depth = true;  ///< where nothing moves depth is the same too
};

/// Counts of a pixel that rounding may decide.
inline constexpr std::int32_t kUncertain = -1;

/// The frame has one target and one depth surface. What is empty is no law of the case.
struct Case {
  Frame frame{};
  std::vector<KnownTriangle> triangles{};  ///< all of the frame, in order: coverage by definition
  bool depth = false;      ///< every draw passes and writes: a pixel has the depth of the last that covers it
  bool partition = false;  ///< the triangles tile the target: each pixel exactly once
  int sample = 0;          ///< of each pixel, of which the two that follow speak
  std::vector<std::int32_t> fragments{};  ///< of each pixel, row by row, or kUncertain
  std::vector<std::int32_t> survivors{};  ///< the same, behind the depth test
  std::optional<Twin> twin{};
};

}  // namespace halfspace::stress
