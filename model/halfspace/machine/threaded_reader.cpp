#include "halfspace/machine/threaded_reader.hpp"

namespace halfspace {

void ThreadedReader::Part::copy(const StreamView& part) {
  const auto keep = [](auto& list, auto& items) {
    list.assign(items.begin(), items.end());
    items = list;
  };
  view = part;
  keep(packets.segments, view.segments);
  keep(packets.triangles, view.triangles);
  keep(packets.blocks, view.blocks);
  keep(packets.jobs, view.jobs);
  keep(packets.accesses, view.accesses);
  keep(z.misses, view.misses);
  keep(z.burst, view.miss_burst);
  keep(z.late, view.late);
  keep(tiles, view.tiles);
  keep(live, view.live);
}

ThreadedReader::~ThreadedReader() {
  if (thread_.joinable()) {
    stop();
  }
}

void ThreadedReader::begin(std::span<const StreamSurface> surfaces, std::uint32_t memory_lines) {
  reader_.begin(surfaces, memory_lines);
  thread_ = std::jthread([this] { read_parts(); });
}

void ThreadedReader::read(const StreamView& part, std::vector<std::uint64_t>* /*burst_cycles*/) {
  if (over_) {
    stop();
    finish();
  }
  parts_.free().copy(part);
  parts_.fill(false);
}

void ThreadedReader::end(std::span<const ZFlush> dirty) {
  Part& part = parts_.free();
  part.dirty.assign(dirty.begin(), dirty.end());
  part.end = true;
  parts_.fill(true);
}

void ThreadedReader::finish() {
  thread_.join();
  if (error_) {
    std::rethrow_exception(error_);
  }
}

/// To the end of the frame whatever the reader throws: the units may be waiting for a free part.
void ThreadedReader::read_parts() {
  for (bool end = false; !end; parts_.take()) {
    const Part& part = parts_.filled();
    end = part.end;
    if (over_) {
      continue;
    }
    try {
      read_part(part);
    } catch (...) {
      error_ = std::current_exception();
      over_ = true;
    }
  }
}

void ThreadedReader::read_part(const Part& part) {
  if (part.end) {
    reader_.end(part.dirty);
  } else {
    reader_.read(part.view, nullptr);
  }
}

/// Has the thread stop without reading what is left.
void ThreadedReader::stop() {
  over_ = true;
  end({});
}

}  // namespace halfspace
