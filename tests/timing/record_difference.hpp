/// Where two records of a frame differ, in words; empty where they do not.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "differences.hpp"
#include "halfspace/timing/record/frame_record.hpp"

namespace halfspace::testing {

inline std::string record_difference(const FrameRecord& ours, const FrameRecord& other) {
  const auto list = [&](const char* name, auto get, auto... numbers) {
    const auto all = [&](const FrameRecord& record) {
      std::vector<std::uint32_t> values;
      for (const auto& item : get(record)) {
        (values.push_back(static_cast<std::uint32_t>(numbers(item))), ...);
      }
      return values;
    };
    return difference(name, all(ours), all(other));
  };
  using Segment = StreamSegment;
  using Triangle = StreamTriangle;
  const auto member = [](auto pointer) { return [pointer](const auto& item) { return item.*pointer; }; };
  const auto word = [](const auto& item) { return item.word(); };
  return list(
             "surfaces", [](const FrameRecord& record) { return record.surfaces; },
             member(&StreamSurface::tiles_x), member(&StreamSurface::tiles),
             member(&StreamSurface::sample_bytes)) +
         list(
             "segments", [](const FrameRecord& record) { return record.packets.segments; },
             member(&Segment::kind), member(&Segment::surface), member(&Segment::touches_depth),
             member(&Segment::triangles), member(&Segment::dropped_after)) +
         list(
             "triangles", [](const FrameRecord& record) { return record.packets.triangles; },
             member(&Triangle::dropped_before), member(&Triangle::blocks), member(&Triangle::empty_after)) +
         list(
             "blocks", [](const FrameRecord& record) { return record.packets.blocks; }, word) +
         list(
             "jobs", [](const FrameRecord& record) { return record.packets.jobs; },
             [](StreamJob quads) { return quads; }) +
         list(
             "accesses", [](const FrameRecord& record) { return record.packets.accesses; },
             [](const StreamAccess& access) { return access.words()[0]; },
             [](const StreamAccess& access) { return access.words()[1]; });
}

/// The same frame, recorded through both cores.
inline std::string record_difference(const Frame& frame, const Config& config) {
  return record_difference(record_frame(frame, config, {.count_pixels = false, .core = Core::kFast}),
                           record_frame(frame, config, {.count_pixels = false, .core = Core::kReadable}));
}

}  // namespace halfspace::testing
