// Every triangle of a frame, as it leaves the front end.
#include <deque>

#include "halfspace/machine/frame_source.hpp"
#include "halfspace/scene/load.hpp"
#include "stimulus.hpp"

namespace halfspace::tb {

std::vector<SetupJob> frame_jobs(const std::filesystem::path& file, const SetupModel& model) {
  const Frame frame = load(file);
  Config config;
  config.raster.sub_pixel_bits = model.dut.sub_pixel_bits;
  config.raster.samples = model.samples;
  config.tile_walker.tile_size = model.dut.tile_size;
  config.block_walker.block_size = model.block_size;
  FrameResult result;
  result.surfaces = make_surfaces(frame, config, Watch{.count_pixels = false});
  const std::vector<ZSurface> places = place_surfaces(result.surfaces, config);
  const std::vector<HiZSurface> block_places = place_blocks(result.surfaces, config);
  std::deque<DrawContext> draws;
  FrameSource source(frame, config, nullptr, result.surfaces, result, draws);
  std::vector<SetupJob> jobs;
  for (std::uint32_t command = 0; command < frame.commands.size(); ++command) {
    source.begin(command);
    while (const std::optional<SourceItem> item = source.next()) {
      if (item->draw == nullptr) {
        continue;  // a clear by the z cache
      }
      const DrawContext& draw = *item->draw;
      const ZSurface place = draw.surface == kNoSurface ? ZSurface{} : places[draw.surface];
      const HiZSurface blocks = draw.surface == kNoSurface ? HiZSurface{} : block_places[draw.surface];
      for (const ScreenTriangle& triangle : item->triangles) {
        const DrawStatePacket state =
            draw_state_packet(setup_state(draw.setup, triangle), draw.early_z, place, blocks, 0);
        jobs.push_back({to_packet(triangle), state});
      }
    }
  }
  return jobs;
}

}  // namespace halfspace::tb
