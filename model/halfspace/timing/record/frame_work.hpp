/// Sums of what a frame asks of the machine: enough for a bound on its cycles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/packet_stream.hpp"

namespace halfspace {

struct FrameWork {
  std::uint64_t triangles = 0;                   ///< into setup
  std::uint64_t blocks = 0;                      ///< that the walker visits
  std::uint32_t most_empty = 0;                  ///< of them one after the other without a tile
  std::array<std::uint64_t, 65> jobs{};          ///< tile jobs by their quads
  std::array<std::uint64_t, 11> fetched{};       ///< lines read, by the logarithm of their bytes
  std::array<std::uint64_t, 11> written_back{};  ///< lines written, the same way
  std::vector<std::uint32_t> fast_clears;        ///< tiles of each
  std::uint64_t flushed = 0;                     ///< lines written at the end of the frame
};

/// Of a whole stream, of which `dirty` lines are left in the z cache.
FrameWork frame_work(const StreamView& stream, std::span<const StreamSurface> surfaces,
                     std::span<const ZFlush> dirty);

/// A bound on the cycles of a frame: no packet overlaps with another.
std::uint64_t longest_time(const FrameWork& work, const Config& config);

}  // namespace halfspace
