/// Packets on their way through the machine, each with the draw and the triangle that it belongs to: for
/// engines in which several are under way. A burst is one token, whatever its quads.
#pragma once

#include <memory>

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/machine/passage/quad_generator.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/tile_walker.hpp"

namespace halfspace {

/// Kept as long as a token needs it; hardware has a table of them, of which TileJob::slot is the index.
using TrianglePointer = std::shared_ptr<const SetupTriangle>;

/// setup -> tile_walker. Without a triangle: one that setup drops.
struct TriangleToken {
  DrawContext* draw = nullptr;
  TrianglePointer triangle;
};

/// tile_walker -> edge_evaluator.
struct JobToken {
  DrawContext* draw = nullptr;
  TrianglePointer triangle;
  TileJob job;
  TileWork work = TileWork::kEvaluate;
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
