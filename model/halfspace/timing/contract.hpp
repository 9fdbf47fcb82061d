/// The arithmetic of beats, transfers and clears, and the fixed latencies of the units; docs/timing.md and
/// the pages of the units are the contract these belong to. Everything that can be chosen is in the
/// configuration.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/shape.hpp"

namespace halfspace {

// Latencies that no key changes; the table of links has them all.
inline constexpr int kSetupCullLatency = latency(Link::kSetupQueue, {});
inline constexpr int kBlockLatency = latency(Link::kBlockWalker, {});
inline constexpr int kHiZLatency = latency(Link::kHiZ, {});
inline constexpr int kTileLatency = latency(Link::kTileWalker, {});
inline constexpr int kQuadLatency = latency(Link::kQuadGenerator, {});
inline constexpr int kTestLatency = latency(Link::kEarlyZ, {});

/// From a coverage without a sample, and from the last beat of a burst at z_test, until a block can see it.
inline constexpr int kHiZEmptyLatency = 3;
inline constexpr int kHiZUpdateLatency = 6;

/// Registers of z_encoder and z_decoder.
inline constexpr int kZEncodeLatency = 6;
inline constexpr int kZDecodeLatency = 4;

/// From a line that enters the write buffer until memory may take it, and from its last bytes from memory
/// until it is there: the codec's registers, and the one that a line waits in for it.
inline int encode_cycles(const Config& config) {
  return config.z_cache.compression ? kZEncodeLatency + 1 : 0;
}
inline int decode_cycles(const Config& config) {
  return config.z_cache.compression ? kZDecodeLatency + 1 : 0;
}

/// Largest capacity of a FIFO, and the size of the rings that remember when its packets left.
inline constexpr std::size_t kMostCredits = 64;

/// Beats of a burst of `quads` on a link that is `width` quads wide.
constexpr int beats(int quads, int width) { return (quads + width - 1) / width; }

/// Packets that the interpolator makes of a beat: the quads of a burst from number `first` on, `width` of
/// them. `live`: bit i: quad i of the burst asks for attributes.
constexpr std::uint64_t shaded_packets(std::uint64_t live, int first, int width, int attributes) {
  const std::uint64_t beat = live >> first & ((std::uint64_t{1} << width) - 1);
  return static_cast<std::uint64_t>(std::popcount(beat)) * static_cast<std::uint64_t>(attributes);
}

/// Cycles that `bytes` take on a channel of memory.
constexpr int transfer_cycles(int bytes, int bytes_per_cycle) { return std::max(1, bytes / bytes_per_cycle); }

/// Cycles of a fast clear.
inline int fast_clear_cycles(std::uint32_t tiles, const Config& config) {
  const auto per_cycle = static_cast<std::uint32_t>(config.z_cache.clear_tiles);
  const int sets = config.z_cache.lines / (config.z_cache.ways * config.z_cache.parts);
  return std::max(static_cast<int>((tiles + per_cycle - 1) / per_cycle), sets);
}

}  // namespace halfspace
