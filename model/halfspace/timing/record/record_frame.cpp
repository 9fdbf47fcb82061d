#include <fmt/format.h>

#include "halfspace/numerics/error.hpp"
#include "halfspace/timing/pipeline.hpp"
#include "halfspace/timing/record/frame_record.hpp"

namespace halfspace {
namespace {

/// The clock that writes down what passes.
class RecordingClock {
 public:
  RecordingClock(FrameRecord& record, std::vector<RecordedSegment> segments)
      : record_(record), planned_(std::move(segments)) {}

  void start(std::uint32_t /*memory_lines*/) {}
  void draw(std::uint32_t /*index*/) { next_segment(); }
  void dropped() { ++dropped_; }
  void drawn() {
    record_.triangles.push_back({.dropped_before = dropped_, .jobs = 0, .steps_after = 0});
    dropped_ = 0;
    ++record_.segments.back().triangles;
  }
  void job(const JobWork& work) {
    if (work.steps > kMostSteps) {
      throw InputError(fmt::format("{}: {} steps of the walker without a tile job; a record holds at most {}",
                                   record_.name, work.steps, kMostSteps));
    }
    ++record_.triangles.back().jobs;
    record_.jobs.emplace_back(work.steps, work.quads);
    if (work.touched != 0) {
      record_.accesses.emplace_back(work.tile_x, work.tile_y, work.touched, work.written);
    }
  }
  void walked(std::uint32_t steps) { record_.triangles.back().steps_after = steps; }
  [[nodiscard]] static std::uint64_t quad_cycle(int /*quad*/) { return 0; }
  void fast_clear(std::uint32_t /*tiles*/) { next_segment(); }
  void flush(const std::vector<ZFlush>& /*lines*/) { close_segment(); }

 private:
  void close_segment() {
    if (!record_.segments.empty()) {
      record_.segments.back().dropped_after = dropped_;
    }
    dropped_ = 0;
  }
  void next_segment() {
    close_segment();
    record_.segments.push_back(planned_[record_.segments.size()]);
  }

  FrameRecord& record_;
  std::vector<RecordedSegment> planned_;
  std::uint32_t dropped_ = 0;
};

/// The segments of a frame before anything is known of their triangles.
std::vector<RecordedSegment> plan_segments(const Frame& frame, const Config& config,
                                           const std::vector<Surface>& surfaces) {
  using Kind = RecordedSegment::Kind;
  std::vector<RecordedSegment> segments;
  for (const Command& command : frame.commands) {
    const Target& target = frame.targets[command.target];
    const std::uint32_t number = target.depth_surface;
    if (command.kind == CommandKind::kDraw) {
      const DepthFormat format = number == kNoSurface ? DepthFormat::kNone : surfaces[number].format;
      const bool touches = touches_depth(early_z_state(command, format, config));
      segments.push_back({.kind = Kind::kDraw, .surface = number, .touches_depth = touches ? 1u : 0u});
    } else if (command.has(Flag::kClearDepth) && number != kNoSurface) {
      const PixelRect rect = drawable_rect(command.scissor, target);
      if (clears_fast(rect, surfaces[number], config)) {
        segments.push_back({.kind = Kind::kFastClear, .surface = number});
      } else if (!rect.empty()) {
        segments.push_back({.kind = Kind::kDrawnClear, .surface = number, .touches_depth = 1});
      }
    }
  }
  return segments;
}

}  // namespace

FrameRecord record_frame(const Frame& frame, const Config& config, PacketObserver* observer) {
  FrameRecord record;
  record.name = frame.name;
  record.config = config;
  const std::vector<Surface> surfaces = make_surfaces(frame, config.tile_walker.tile_size, false);
  for (const ZSurface& place : place_surfaces(surfaces, config)) {
    const Surface& surface = surfaces[record.surfaces.size()];
    record.surfaces.push_back({.tiles_x = place.tiles_x,
                               .tiles = place.tiles,
                               .sample_bytes = static_cast<std::uint32_t>(sample_bytes(surface.format))});
  }
  Config banded = config;  // so that the traversal tells all bands apart
  banded.z_cache.parts = recorded_bands(config.tile_walker.tile_size);
  banded.z_cache.lines = banded.z_cache.parts;
  banded.z_cache.ways = 1;
  RecordingClock clock(record, plan_segments(frame, config, surfaces));
  run_pipeline(frame, banded, false, observer, clock);
  return record;
}

}  // namespace halfspace
