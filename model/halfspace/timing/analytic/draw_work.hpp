/// Sums of what a draw asks of the machine: all that the analytic fidelity looks at.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/machine/packet_stream.hpp"

namespace halfspace {

struct DrawWork {
  std::uint64_t triangles = 0;                   ///< into setup
  std::uint64_t drawn = 0;                       ///< into the walker
  std::uint64_t steps = 0;                       ///< of the walker
  std::array<std::uint32_t, 65> tiles{};         ///< tile jobs by their quads
  std::array<std::uint32_t, 11> fetched{};       ///< lines read, by the logarithm of their bytes
  std::array<std::uint32_t, 11> written_back{};  ///< lines written, the same way

  DrawWork& operator+=(const DrawWork& other);
};

/// What a frame asks of the machine.
struct FrameWork {
  std::vector<DrawWork> draws;
  DrawWork drawn_clears;                   ///< all of them
  std::vector<std::uint32_t> fast_clears;  ///< tiles of each
  std::vector<ZFlush> flush;

  /// Of all draws and drawn clears.
  [[nodiscard]] DrawWork sum() const;
  /// Adds a part of a stream; parts come in order.
  void add(const StreamView& part, std::span<const StreamSurface> surfaces);
};

}  // namespace halfspace
