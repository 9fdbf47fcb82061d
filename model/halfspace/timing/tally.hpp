/// How packets become counts: used by every engine that runs the units.
#pragma once

#include <bit>
#include <cstdint>

#include "halfspace/timing/frame_result.hpp"
#include "halfspace/units/quad_generator.hpp"
#include "halfspace/units/setup.hpp"
#include "halfspace/units/tile_mask.hpp"
#include "halfspace/units/z_cache.hpp"

namespace halfspace {

inline void tally(SetupCounters& counters, SetupVerdict verdict) {
  ++counters.triangles;
  switch (verdict) {
    case SetupVerdict::kDrawn:
      ++counters.drawn;
      break;
    case SetupVerdict::kZeroArea:
      ++counters.zero_area;
      break;
    case SetupVerdict::kCulled:
      ++counters.culled;
      break;
    case SetupVerdict::kNoSample:
      ++counters.no_sample;
      break;
    case SetupVerdict::kOutside:
      ++counters.outside;
      break;
  }
}

/// A decision on a block or a tile.
inline void tally(TileWalkerCounters& counters, TileVerdict verdict, bool block) {
  switch (verdict) {
    case TileVerdict::kReject:
      ++(block ? counters.blocks_rejected : counters.tiles_rejected);
      break;
    case TileVerdict::kAccept:
      ++(block ? counters.blocks_accepted : counters.tiles_accepted);
      break;
    case TileVerdict::kPartial:
      ++(block ? counters.blocks_partial : counters.tiles_partial);
      break;
  }
}

/// A tile job that leaves the walker, and whether it has a covered sample.
inline void tally(Counters& counters, const TileJob& job, TileWork work, bool covered) {
  EdgeEvaluatorCounters& evaluator = counters.edge_evaluator;
  counters.tile_walker.tiles_by_block += work == TileWork::kWholeByBlock ? 1 : 0;
  if (work != TileWork::kEvaluate) {
    ++evaluator.tiles_skipped;  // every edge is accepted: the evaluator has none to look at
  } else {
    ++evaluator.tiles;
    const int skipped = std::popcount(job.accept);
    evaluator.edges_skipped += static_cast<std::uint64_t>(skipped);
    evaluator.edges += static_cast<std::uint64_t>(3 - skipped);
  }
  evaluator.tiles_empty += covered ? 0 : 1;
}

/// A burst, `quads` of them with `fragments` covered samples.
template <int TileSize>
void tally(QuadGeneratorCounters& counters, const QuadBurst& burst, std::uint64_t quads,
           std::uint64_t fragments) {
  ++counters.tiles;
  counters.fragments += fragments;
  counters.quads += quads;
  counters.quads_full += static_cast<std::uint64_t>(popcount(full_quads<TileSize>(burst)));
  counters.quads_empty += TileSize * TileSize / 4 - quads;
  counters.helpers += 4 * quads - fragments;
}

/// What became of a burst's fragments.
inline void tally(EarlyZCounters& counters, const EarlyZState& state, std::uint64_t fragments,
                  std::uint64_t survivors) {
  (state.test ? counters.tested : counters.untested) += fragments;
  counters.survivors += survivors;
  counters.written += state.write ? survivors : 0;
  counters.tiles_killed += survivors == 0 ? 1 : 0;
}

/// A burst that touched `parts` lines.
inline void tally(EarlyZCounters& counters, int parts, const ZMisses& misses) {
  ++counters.z_bursts;
  counters.z_hits += static_cast<std::uint64_t>(parts) - misses.count;
  counters.z_misses += misses.count;
  for (const ZMiss& part : misses.parts()) {
    counters.z_cleared += part.fetch ? 0 : 1;
    counters.bytes_read += part.fetch ? part.bytes : 0;
    counters.z_evicted += part.write_back ? 1 : 0;
    counters.bytes_written += part.write_back ? part.victim_bytes : 0;
  }
}

/// Adds 1 where the mask is set, up to the largest value.
template <int TileSize>
void count_samples(const TileMask& mask, std::uint16_t* counts) {
  constexpr std::size_t kBits = std::min(TileSize * TileSize, 64);
  constexpr std::uint64_t kAll = ~std::uint64_t{0} >> (64 - kBits);
  const auto add = [&](std::size_t i) {
    counts[i] = static_cast<std::uint16_t>(counts[i] + (counts[i] != 0xFFFF ? 1 : 0));
  };
  for (std::size_t i = 0; i < kMaskWords<TileSize>; ++i) {
    if (mask.word[i] == kAll) {  // most words: a loop without branches
      for (std::size_t k = 0; k < kBits; ++k) {
        add(i * 64 + k);
      }
      continue;
    }
    for (std::uint64_t left = mask.word[i]; left != 0; left &= left - 1) {
      add(i * 64 + static_cast<std::size_t>(std::countr_zero(left)));
    }
  }
}

}  // namespace halfspace
