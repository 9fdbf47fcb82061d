// The triangles of a frame as the front end gives them to setup.
#include "halfspace/config/config.hpp"
#include "halfspace/scene/front_end.hpp"
#include "halfspace/scene/load.hpp"
#include "halfspace/timing/draw_state.hpp"
#include "stimulus.hpp"

namespace halfspace::tb {
namespace {

/// Adds the jobs of one command after the other.
class FrameJobs {
 public:
  FrameJobs(const Frame& frame, const Config& config)
      : frame_(frame),
        config_(config),
        surfaces_(make_surfaces(frame, config.tile_size, false)),
        places_(place_surfaces(surfaces_, config)) {}

  void add(const Command& command) {
    const Target& target = frame_.targets[command.target];
    if (command.kind == CommandKind::kDraw) {
      draw(command, target);
    } else if (command.has(Flag::kClearDepth) && target.depth_surface != kNoSurface) {
      clear(command, target);
    }
  }

  std::vector<SetupJob> take() { return std::move(jobs_); }

 private:
  void draw(const Command& command, const Target& target) {
    if (command.has(Flag::kNotFilled)) {
      return;
    }
    const DepthFormat format =
        target.depth_surface == kNoSurface ? DepthFormat::kNone : surfaces_[target.depth_surface].format;
    const FrontEnd front_end(frame_, command, format, config_.sub_pixel_bits);
    std::vector<ScreenTriangle> triangles;
    FrontEndCounters counters;
    for (std::uint32_t i = 0; i < command.index_count / 3; ++i) {
      front_end.process(i, triangles, counters);
    }
    add_all(
        triangles,
        state_packet(setup_state(command, target, format, config_), early_z_state(command, format, config_)),
        target);
  }

  void clear(const Command& command, const Target& target) {
    const PixelRect rect = drawable_rect(command.scissor, target);
    const Surface& surface = surfaces_[target.depth_surface];
    if (!rect.empty() && !clears_fast(rect, surface, config_)) {
      const DrawnClear drawn =
          drawn_clear(rect, clear_code(surface.format, command.clear_depth), surface.format, config_);
      add_all(drawn.triangle, state_packet(drawn.setup, drawn.early_z), target);
    }
  }

  void add_all(std::span<const ScreenTriangle> triangles, DrawStatePacket state, const Target& target) {
    if (target.depth_surface != kNoSurface) {
      state.first_tile = places_[target.depth_surface].first_tile;
      state.tiles_x = static_cast<std::uint16_t>(places_[target.depth_surface].tiles_x - 1);
    }
    for (const ScreenTriangle& triangle : triangles) {
      jobs_.push_back({to_packet(triangle), state});
    }
  }

  const Frame& frame_;
  const Config& config_;
  std::vector<Surface> surfaces_;
  std::vector<ZSurface> places_;
  std::vector<SetupJob> jobs_;
};

}  // namespace

std::vector<SetupJob> frame_jobs(const std::filesystem::path& file, const SetupModel& model) {
  const Frame frame = load(file);
  Config config;
  config.sub_pixel_bits = model.dut.sub_pixel_bits;
  config.tile_size = model.dut.tile_size;
  config.block_size = model.block_size;
  config.block_level = model.block_level;
  FrameJobs jobs(frame, config);
  for (const Command& command : frame.commands) {
    jobs.add(command);
  }
  return jobs.take();
}

}  // namespace halfspace::tb
