/// Packets on their way through the machine, each with the draw and the triangle that it belongs to: for
/// engines in which several are under way. A burst is one token, whatever its quads.
#pragma once

#include <memory>

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/machine/passage/quad_generator.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace {

/// Kept as long as a token needs it; hardware has a table of them, of which BlockJob::slot is the index.
using TrianglePointer = std::shared_ptr<const SetupTriangle>;

/// setup -> block_walker. Without a triangle: one that setup drops.
struct TriangleToken {
  DrawContext* draw = nullptr;
  TrianglePointer triangle;
};

/// block_walker -> tile_walker.
struct BlockToken {
  DrawContext* draw = nullptr;
  TrianglePointer triangle;
  BlockJob block;
};

/// tile_walker -> edge_evaluator.
struct JobToken {
  DrawContext* draw = nullptr;
  TrianglePointer triangle;
  TileJob job;
  bool whole = false;  ///< all samples of the tile are covered
};

/// edge_evaluator -> quad_generator.
struct CoverageToken {
  DrawContext* draw = nullptr;
  TrianglePointer triangle;
  Coverage coverage;
};

/// quad_generator -> early_z.
struct BurstToken {
  DrawContext* draw = nullptr;
  TrianglePointer triangle;
  Burst burst;
};

}  // namespace halfspace
