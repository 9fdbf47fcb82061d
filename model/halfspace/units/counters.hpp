/// What the front end and the units count. One list a unit declares, names and explains its counters.
#pragma once

#include "halfspace/units/counter_struct.hpp"

namespace halfspace {

// clang-format off
#define HALFSPACE_FRONT_END_COUNTERS(C)                                                   \
  C(triangles,         "taken from the draw")                                             \
  C(non_finite,        "dropped: a position is NaN or infinite")                          \
  C(clipped_away,      "dropped: nothing is left inside the clip volume")                 \
  C(degenerate,        "dropped: w is not positive after clipping")                       \
  C(clipped,           "cut by a plane of the clip volume or the guard band")             \
  C(far_depth,         "resolved sample by sample: a vertex is too far outside [0, 1]")    \
  C(tiny_depth,        "resolved by sample where float32 depth is far below the largest vertex") \
  C(emitted,           "given to setup; cutting makes several of one")

#define HALFSPACE_SETUP_COUNTERS(C)                                          \
  C(triangles,         "taken")                                              \
  C(zero_area,         "dropped: no area on the sub-pixel grid")             \
  C(culled,            "dropped: faces away")                                \
  C(no_sample,         "dropped: the bounding box holds no pixel centre")    \
  C(outside,           "dropped: the bounding box misses scissor, viewport or target") \
  C(drawn,             "given to the walker")

#define HALFSPACE_BLOCK_WALKER_COUNTERS(C)                                   \
  C(blocks,            "of the bounds, looked at; with one level tiles")     \
  C(blocks_empty,      "left without a tile: nothing leaves for them")       \
  C(tiles_rejected,    "tiles of the bounds outside one edge")               \
  C(passes,            "steps that only lead the walk: they decide no tile")

#define HALFSPACE_HI_Z_COUNTERS(C)                                           \
  C(blocks_rejected,   "no sample of them can pass: nothing leaves for them") \
  C(tiles_rejected,    "no sample of them can pass")                          \
  C(tiles_sure,        "every sample of them passes and writes")

#define HALFSPACE_TILE_WALKER_COUNTERS(C)                                    \
  C(tiles_accepted,    "tiles covered whole")                                \
  C(tiles_partial,     "tiles left to the edge evaluator")

#define HALFSPACE_EDGE_EVALUATOR_COUNTERS(C)                                \
  C(tiles_skipped,     "covered whole: nothing to evaluate")                \
  C(tiles,             "evaluated")                                         \
  C(tiles_empty,       "evaluated, and no sample was covered")              \
  C(edges,             "edges evaluated")                                   \
  C(edges_skipped,     "edges of evaluated tiles skipped by an accept bit")

#define HALFSPACE_QUAD_GENERATOR_COUNTERS(C)                     \
  C(tiles,             "tiles with a covered sample")            \
  C(quads,             "quads with a covered sample")            \
  C(quads_full,        "quads with all four samples covered")    \
  C(quads_empty,       "quads of those tiles squeezed out")      \
  C(fragments,         "covered samples")                        \
  C(helpers,           "samples of the quads that are not covered")

#define HALFSPACE_EARLY_Z_COUNTERS(C)                                         \
  C(tested,            "fragments whose depth was interpolated and compared") \
  C(untested,          "fragments that passed because the test is off")       \
  C(survivors,         "fragments that passed")                               \
  C(written,           "fragments that wrote their depth")                    \
  C(discarded,         "survivors that the shader of a late draw discarded")  \
  C(tiles_killed,      "tiles none of whose fragments passed")              \
  C(inner,             "fragments whose pixel the triangle fills; counted with raster.inner_coverage") \
  C(z_bursts,          "tiles that had to do with stored depth")            \
  C(z_hits,            "their parts that were in the z cache")              \
  C(z_misses,          "their parts that were not")                         \
  C(z_overwritten,     "misses that the tile overwrites whole, not fetched") \
  C(z_cleared,         "other misses made from the clear value, not fetched") \
  C(z_evicted,         "lines written back because others took their place") \
  C(bytes_read,        "fetched from memory")                               \
  C(bytes_written,     "written back, the flush at the end not counted")

#define HALFSPACE_INTERPOLATOR_COUNTERS(C)                                    \
  C(quads,             "quads with a sample that passed: interpolated")       \
  C(quads_killed,      "quads without: nothing leaves for them")              \
  C(attributes,        "packets: a quad with one attribute each")             \
  C(helpers,           "samples of the interpolated quads that did not pass")
// clang-format on

HALFSPACE_COUNTER_STRUCT(FrontEndCounters, HALFSPACE_FRONT_END_COUNTERS)
HALFSPACE_COUNTER_STRUCT(SetupCounters, HALFSPACE_SETUP_COUNTERS)
HALFSPACE_COUNTER_STRUCT(BlockWalkerCounters, HALFSPACE_BLOCK_WALKER_COUNTERS)
HALFSPACE_COUNTER_STRUCT(HiZCounters, HALFSPACE_HI_Z_COUNTERS)
HALFSPACE_COUNTER_STRUCT(TileWalkerCounters, HALFSPACE_TILE_WALKER_COUNTERS)
HALFSPACE_COUNTER_STRUCT(EdgeEvaluatorCounters, HALFSPACE_EDGE_EVALUATOR_COUNTERS)
HALFSPACE_COUNTER_STRUCT(QuadGeneratorCounters, HALFSPACE_QUAD_GENERATOR_COUNTERS)
HALFSPACE_COUNTER_STRUCT(EarlyZCounters, HALFSPACE_EARLY_Z_COUNTERS)
HALFSPACE_COUNTER_STRUCT(InterpolatorCounters, HALFSPACE_INTERPOLATOR_COUNTERS)

/// All counters of a draw, a surface or a frame.
struct Counters {
  FrontEndCounters front_end;
  SetupCounters setup;
  BlockWalkerCounters block_walker;
  HiZCounters hi_z;
  TileWalkerCounters tile_walker;
  EdgeEvaluatorCounters edge_evaluator;
  QuadGeneratorCounters quad_generator;
  EarlyZCounters early_z;
  InterpolatorCounters interpolator;

  /// Calls visit(unit, member) for each unit.
  template <class Visit>
  static void units(Visit&& visit) {
    visit("front_end", &Counters::front_end);
    visit("setup", &Counters::setup);
    visit("block_walker", &Counters::block_walker);
    visit("hi_z", &Counters::hi_z);
    visit("tile_walker", &Counters::tile_walker);
    visit("edge_evaluator", &Counters::edge_evaluator);
    visit("quad_generator", &Counters::quad_generator);
    visit("early_z", &Counters::early_z);
    visit("interpolator", &Counters::interpolator);
  }

  Counters& operator+=(const Counters& other) {
    units([&](auto, auto unit) { this->*unit += other.*unit; });
    return *this;
  }
};

}  // namespace halfspace
