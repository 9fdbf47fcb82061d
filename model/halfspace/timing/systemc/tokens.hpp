/// What the links carry beside the packets of machine/tokens.hpp. The tile is the smallest unit of transport:
/// a burst is one token, whatever its quads.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/machine/passage/z_test.hpp"
#include "halfspace/machine/tokens.hpp"
#include "halfspace/timing/systemc/sim_clock.hpp"
#include "halfspace/units/z_cache.hpp"

namespace halfspace::systemc {

/// In the queue of setup.
struct QueuedTriangle {
  DrawContext* draw = nullptr;
  ScreenTriangle triangle;
};

/// In the pending store of early_z: a burst and what the lookup found for the parts of its tile.
struct PendingToken {
  DrawContext* draw = nullptr;
  BurstToken burst;
  std::uint8_t touched = 0;  ///< bit i: part i has to do with stored depth
  std::uint8_t sure = 0;     ///< bit i: part i is overwritten whole
  std::uint8_t missed = 0;   ///< bit i: it was not in the cache
  std::uint8_t fetched = 0;  ///< bit i: and was asked for
  std::array<std::uint32_t, kMaxZParts> slot{};
  Cycle there = 0;  ///< first cycle in which all missing parts are filled, or known to be cleared
};

/// In a fill buffer.
struct FillToken {
  DrawContext* draw = nullptr;
  std::vector<std::uint32_t> codes;
};

/// In a slot of the write buffer.
struct WriteToken {
  DrawContext* draw = nullptr;  ///< null in the flush
  std::uint32_t line = 0;       ///< of memory
  std::uint64_t number = 0;     ///< counts the writes of the frame, from 1
  std::vector<std::uint32_t> codes;
};

/// early_z -> interpolator, or sink.
struct TestedToken {
  DrawContext* draw = nullptr;
  BurstToken burst;
  passage::Tested result;
  std::vector<std::uint32_t> codes;  ///< of the tile, where quads are recorded
};

/// interpolator -> sink: a quad with one attribute.
struct ShadedToken {
  DrawContext* draw = nullptr;
  bool ends_burst = false;
  bool ends_late = false;  ///< and the burst leaves a late write
};

}  // namespace halfspace::systemc
