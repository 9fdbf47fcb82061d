/// What the links carry. The tile is the smallest unit of transport: a burst is one token, whatever its
/// quads.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "halfspace/timing/systemc/run_state.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/tile_walker.hpp"
#include "halfspace/units/z_cache.hpp"

namespace halfspace::systemc {

/// Kept as long as a token needs it; hardware has a table of them, of which TileJob::slot is the index.
using TrianglePointer = std::shared_ptr<const SetupTriangle>;

/// In the queue of setup.
struct QueuedTriangle {
  DrawWork* work = nullptr;
  ScreenTriangle triangle;
};

/// setup -> tile_walker.
struct TriangleToken {
  DrawWork* work = nullptr;
  TrianglePointer triangle;
};

/// tile_walker -> edge_evaluator.
struct JobToken {
  DrawWork* work = nullptr;
  TrianglePointer triangle;
  TileJob job;
  TileWork tile_work = TileWork::kEvaluate;
};

/// edge_evaluator -> quad_generator.
struct CoverageToken {
  DrawWork* work = nullptr;
  TrianglePointer triangle;
  Coverage coverage;
};

/// quad_generator -> early_z.
struct BurstToken {
  DrawWork* work = nullptr;
  TrianglePointer triangle;
  QuadBurst burst;
  int quads = 0;
};

/// In the pending store of early_z: a burst and what the lookup found for the parts of its tile.
struct PendingToken {
  DrawWork* work = nullptr;
  BurstToken burst;
  std::uint8_t touched = 0;  ///< bit i: part i has to do with stored depth
  std::uint8_t missed = 0;   ///< bit i: it was not in the cache
  std::uint8_t fetched = 0;  ///< bit i: and was asked for
  std::array<std::uint32_t, kMaxZParts> slot{};
  Cycle there = 0;  ///< first cycle in which all missing parts are filled, or known to be cleared
};

/// In a fill buffer.
struct FillToken {
  DrawWork* work = nullptr;
  std::vector<std::uint32_t> codes;
};

/// In a slot of the write buffer.
struct WriteToken {
  DrawWork* work = nullptr;  ///< null in the flush
  std::uint32_t line = 0;    ///< of memory
  std::uint64_t number = 0;  ///< counts the writes of the frame, from 1
  std::vector<std::uint32_t> codes;
};

/// early_z -> sink.
struct TestedToken {
  DrawWork* work = nullptr;
  TrianglePointer triangle;
  QuadBurst burst;
  int quads = 0;
  TileMask passed;
  std::vector<std::uint32_t> codes;  ///< of the tile, where quads are recorded
};

}  // namespace halfspace::systemc
