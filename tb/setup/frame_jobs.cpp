// Every triangle of a frame, as it leaves the front end.
#include <deque>

#include "halfspace/machine/frame_source.hpp"
#include "halfspace/scene/load.hpp"
#include "stimulus.hpp"

namespace halfspace::tb {

namespace {

void add_jobs(const Frame& frame, const SetupModel& model, std::vector<SetupJob>& jobs) {
  Config config;
  config.raster.sub_pixel_bits = model.dut.sub_pixel_bits;
  config.raster.samples = model.samples;
  config.tile_walker.tile_size = model.dut.tile_size;
  config.block_walker.block_size = model.block_size;
  config.raster.conservative = model.conservative();
  config.raster.uncertainty = model.uncertainty;
  FrameResult result;
  result.surfaces = make_surfaces(frame, config, Watch{.count_pixels = false});
  const std::vector<ZSurface> places = place_surfaces(result.surfaces, config);
  const std::vector<HiZSurface> block_places = place_blocks(result.surfaces, config);
  std::deque<DrawContext> draws;
  FrameSource source(frame, config, nullptr, result.surfaces, result, draws);
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
        jobs.push_back({to_packet(triangle, draw.setup), state});
      }
    }
  }
}

/// With the sides of all triangles for these.
Frame with_lines(const Frame& frame, LineRule rule) {
  Frame lines = frame;
  for (Command& command : lines.commands) {
    command.polygon_mode = PolygonMode::kLine;
    command.line_rule = rule;
  }
  return lines;
}

}  // namespace

std::vector<SetupJob> frame_jobs(const std::filesystem::path& file, const SetupModel& model) {
  const Frame frame = load(file);
  std::vector<SetupJob> jobs;
  add_jobs(frame, model, jobs);
  if (model.thin_lines && model.interpolator() == DepthInterpolator::kPlane) {
    for (std::size_t rule = 1; rule < kLineRuleName.size(); ++rule) {
      add_jobs(with_lines(frame, static_cast<LineRule>(rule)), model, jobs);
    }
  }
  return jobs;
}

}  // namespace halfspace::tb
