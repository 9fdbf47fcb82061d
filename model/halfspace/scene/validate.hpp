/// The rules every frame obeys, whether read from a file, made from a mesh or built in memory.
#pragma once

#include <cstdint>

#include "halfspace/scene/frame.hpp"

namespace halfspace {

inline constexpr std::uint32_t kMaxDepthSurface = 1023;                      ///< highest surface number
inline constexpr std::uint64_t kMaxDepthPixels = std::uint64_t{1} << 28;     ///< over all depth surfaces
inline constexpr std::uint64_t kMaxBarePixels = std::uint64_t{1} << 28;      ///< over the targets without one
inline constexpr std::uint64_t kMaxFrameTriangles = std::uint64_t{1} << 28;  ///< over all draws

/// Throws InputError, naming the frame, the target or command, the field, its value and what is legal, unless
/// - targets: sides in 1..kMaxTargetSize, one sample, depth none, unorm16, unorm24 or float32, a depth
///   surface if and only if there is a depth format, at most kMaxDepthSurface, and the same size and format
///   wherever it is shared; all distinct depth surfaces together have at most kMaxDepthPixels pixels;
/// - commands: a known kind, an existing target, every float finite, scissor sizes not negative, on a unorm
///   surface a depth range in [0, 1];
/// - draws: a known depth_func, depth_write only with depth_test, whole triangles, indices and vertices in
///   range, at most kMaxFrameTriangles over all draws; the targets without depth that they draw to have
///   together at most kMaxBarePixels pixels.
/// Vertex positions may be anything, NaN and infinity too: such triangles are dropped and counted when drawn.
void validate(const Frame& frame);

}  // namespace halfspace
