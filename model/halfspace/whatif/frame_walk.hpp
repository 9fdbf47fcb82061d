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
#include "halfspace/machine/passage/setup.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace::whatif {

/// The draw at work.
struct WalkedDraw {
  DrawContext* draw = nullptr;
  Surface* surface = nullptr;  ///< null where the target has no depth
  SetupTriangle triangle;      ///< the last that was drawn
};

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
