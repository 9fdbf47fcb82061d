/// The fixed latencies of the units and the arithmetic of beats; docs/timing.md and the pages of the units
/// are the contract these belong to. Everything that can be chosen is in the configuration.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "halfspace/config/config.hpp"

namespace halfspace {

// In cycles, from the work on a packet to the cycle in which the next stage may take it.
inline constexpr int kSetupCullLatency = 4;
inline constexpr int kSetupDivideLatency = 18;
inline constexpr int kWalkerLatency = 2;
inline constexpr int kQuadLatency = 2;
inline constexpr int kLookupLatency = 12;
inline constexpr int kTestLatency = 2;

/// Largest capacity of a FIFO, and the size of the rings that remember when its packets left.
inline constexpr std::size_t kMostCredits = 64;

/// Of the edge evaluator: its pipeline and the output register.
inline int edge_latency(const Config& config) { return config.edge_evaluator.pipe_stages + 1; }

/// Beats of a burst of `quads` on a link that is `width` quads wide.
constexpr int beats(int quads, int width) { return (quads + width - 1) / width; }

/// Cycles that `bytes` take on a channel of memory.
constexpr int transfer_cycles(int bytes, int bytes_per_cycle) { return std::max(1, bytes / bytes_per_cycle); }

/// Cycles of a fast clear.
inline int fast_clear_cycles(std::uint32_t tiles, const Config& config) {
  const auto per_cycle = static_cast<std::uint32_t>(config.z_cache.clear_tiles);
  const int sets = config.z_cache.lines / (config.z_cache.ways * config.z_cache.parts);
  return std::max(static_cast<int>((tiles + per_cycle - 1) / per_cycle), sets);
}

}  // namespace halfspace
