#include "halfspace/core/run_core.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/timing/record/frame_record.hpp"

namespace halfspace {
namespace {

/// Puts the parts of a stream together.
class RecordReader final : public StreamReader {
 public:
  explicit RecordReader(FrameRecord& record) : record_(record), packets_(record.packets) {}

  [[nodiscard]] bool wants_accesses() const override { return true; }

  void begin(std::span<const StreamSurface> surfaces, std::uint32_t /*memory_lines*/) override {
    record_.surfaces.assign(surfaces.begin(), surfaces.end());
  }

  void read(const StreamView& part, std::vector<std::uint64_t>* /*burst_cycles*/) override {
    std::span<const StreamSegment> segments = part.segments;
    if (part.continues_segment) {
      StreamSegment& open = packets_.segments.back();
      open.triangles += segments[0].triangles - (part.continues_triangle ? 1 : 0);
      open.dropped_after = segments[0].dropped_after;
      segments = segments.subspan(1);
    }
    std::span<const StreamTriangle> triangles = part.triangles;
    if (part.continues_triangle) {
      StreamTriangle& open = packets_.triangles.back();
      open.blocks += triangles[0].blocks;
      open.empty_after = triangles[0].empty_after;
      triangles = triangles.subspan(1);
    }
    append(packets_.segments, segments);
    append(packets_.triangles, triangles);
    append(packets_.blocks, part.blocks);
    append(packets_.jobs, part.jobs);
    append(packets_.accesses, part.accesses);
  }

  void end(std::span<const ZFlush> /*dirty*/) override {}

 private:
  template <class Item>
  static void append(std::vector<Item>& list, std::span<const Item> more) {
    list.insert(list.end(), more.begin(), more.end());
  }

  FrameRecord& record_;
  PacketStream& packets_;
};

}  // namespace

FrameRecord record_frame(const Frame& frame, const Config& config, const Watch& watch) {
  if (config.interpolator.enabled) {
    throw OptionError("configuration key 'interpolator.enabled' is true; legal in a record: false");
  }
  FrameRecord record;
  record.name = frame.name;
  record.config = config;
  RecordReader reader(record);
  run_core(frame, config, watch, &reader);
  return record;
}

}  // namespace halfspace
