#include "fuzz_input.hpp"
#include "halfspace/timing/record/frame_record_file.hpp"
#include "halfspace/timing/record/retime.hpp"

namespace {

/// Small enough for thousands of runs a second.
bool is_small(const halfspace::FrameRecord& record) {
  std::uint64_t tiles = 0;
  for (const halfspace::StreamSurface& surface : record.surfaces) {
    tiles += surface.tiles;
  }
  std::uint64_t dropped = 0;
  for (const halfspace::StreamTriangle& triangle : record.packets.triangles) {
    dropped += triangle.dropped_before;
  }
  for (const halfspace::StreamSegment& segment : record.packets.segments) {
    dropped += segment.dropped_after;
  }
  return tiles < 65536 && dropped < 65536;
}

}  // namespace

// A record that the reader accepts can be re-timed, alone and in a batch, with the same result.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace halfspace;
  const auto record = fuzz::read_or_reject([&] { return parse_record(fuzz::as_bytes(data, size), "fuzz"); });
  if (!record || !is_small(*record)) return 0;
  Retimer retimer(*record);
  const Config machines[] = {record->config, record->config};
  if (retimer.retime(machines)[1] != retimer.retime(record->config)) std::abort();
  return 0;
}
