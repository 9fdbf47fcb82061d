/// A frame through setup and block_walker, for studies that look at what comes behind them.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/draw_context.hpp"
#include "halfspace/machine/draw_state.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/machine/frame_source.hpp"
#include "halfspace/machine/passage/block_walker.hpp"
#include "halfspace/machine/passage/hi_z.hpp"
#include "halfspace/machine/passage/quad_generator.hpp"
#include "halfspace/machine/passage/setup.hpp"
#include "halfspace/machine/passage/z_lookup.hpp"
#include "halfspace/machine/passage/z_test.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/units/hi_z.hpp"

namespace halfspace::whatif {

/// The draw at work.
struct WalkedDraw {
  DrawContext* draw = nullptr;
  Surface* surface = nullptr;  ///< null where the target has no depth
  SetupTriangle triangle;      ///< the last that was drawn

  /// What is stored in a tile; null where the target has no depth.
  [[nodiscard]] std::uint32_t* stored(const Coverage& coverage) const {
    return surface == nullptr ? nullptr : surface->codes.tile(coverage.tile_x, coverage.tile_y);
  }
};

/// What became of a tile job of the draw at work.
struct WalkedTile {
  int quads = 0;         ///< 0: no sample is covered
  bool touches = false;  ///< its burst has to do with stored depth
  passage::Tested tested;
  HiZUpdate update;
};

/// Draws a tile job. `codes` is filled where its draw tests depth.
template <int TileSize>
WalkedTile draw_tile(const WalkedDraw& at, const Coverage& coverage, const Config& config,
                     TileCodes<TileSize>& codes) {
  WalkedTile tile;
  if (any(coverage.mask)) {
    DrawContext& draw = *at.draw;
    std::uint32_t* const stored = at.stored(coverage);
    const Burst burst = passage::quad_generator<TileSize>(coverage, draw);
    tile.quads = burst.quads;
    tile.tested = passage::z_test<TileSize>(at.triangle, burst, draw, stored, codes);
    tile.touches = touches_depth(draw.early_z);
    if (tile.touches) {
      const int parts = config.z_cache.parts;
      tile.update = passage::hi_z_update<TileSize>(
          draw, at.triangle.depth, stored, passage::touched_parts<TileSize>(coverage, draw, parts), parts);
      passage::write_late<TileSize>(tile.tested, codes, draw, stored);
    }
  }
  return tile;
}

/// Calls `study`, in order: clear(surface, code) for a clear by the z cache; dropped() and drawn() for the
/// triangles at setup; for those that are drawn block(job, empty_before), and walked(empty_after) behind the
/// last. `result` has the surfaces of the frame (make_surfaces()), which the study draws to.
template <int TileSize, class Study>
void walk_frame(const Frame& frame, const Config& config, FrameResult& result, WalkedDraw& at, Study& study) {
  std::deque<DrawContext> draws;
  passage::BlockWalker walker(walker_config(config));
  FrameSource source(frame, config, nullptr, result.surfaces, result, draws);
  for (std::uint32_t i = 0; i < frame.commands.size(); ++i) {
    at.draw = source.begin(i);
    at.surface =
        at.draw == nullptr || at.draw->surface == kNoSurface ? nullptr : &result.surfaces[at.draw->surface];
    while (const std::optional<SourceItem> item = source.next()) {
      if (item->draw == nullptr) {
        clear_surface(result.surfaces[item->surface], item->code);
        study.clear(item->surface, item->code);
        continue;
      }
      for (const ScreenTriangle& triangle : item->triangles) {
        if (!passage::setup(triangle, *at.draw, at.triangle)) {
          study.dropped();
          continue;
        }
        study.drawn();
        const auto block = [&study](const BlockJob& job, std::uint32_t empty) { study.block(job, empty); };
        study.walked(walker.walk<TileSize>(at.triangle, *at.draw, block));
      }
    }
  }
}

}  // namespace halfspace::whatif
