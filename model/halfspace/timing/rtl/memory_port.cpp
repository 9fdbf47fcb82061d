#include "halfspace/timing/rtl/memory_port.hpp"

#include "halfspace/timing/contract.hpp"
#include "halfspace/timing/rtl/rtl_error.hpp"

namespace halfspace::rtl {

void MemoryPort::offer_fill() { run_.in.fill_valid = memory_.fill(run_.cycle, run_.in.fill); }

/// A line of memory that the RTL works on, and its size, are those that the model says.
void MemoryPort::check_line(const char* what, const Line& want, const Line& got, bool half) {
  ++run_.report.compared;
  const std::uint32_t whole = memory_.line_bytes(got.line);
  if (whole == 0) {
    throw RtlError(fmt::format("{} in cycle {}: line {} is in no surface", what, run_.cycle, got.line));
  }
  const int tile_size = run_.config.tile_walker.tile_size;
  const auto full = static_cast<std::uint32_t>(4 * tile_size * tile_size / run_.config.z_cache.parts);
  if (got.line != want.line || got.bytes != want.bytes || half != (whole < full)) {
    run_.report.differ(fmt::format("{} in cycle {}: model line {} of {} bytes, RTL line {} of {} ({})", what,
                                   run_.cycle, want.line, want.bytes, got.line, got.bytes,
                                   half ? "2 bytes a sample" : "4 bytes a sample"));
  }
}

void MemoryPort::request() {
  run_.rest = 0;
  if (!run_.expected(reads_, "requests")) {
    return;
  }
  const PipelineOutputs& out = run_.out;
  const Line line{.line = out.read_line, .bytes = memory_.line_bytes(out.read_line) >> out.read_shift};
  check_line("request", reads_.front(), line, out.read_half);
  reads_.pop_front();
  memory_.request(run_.cycle, line.line, line.bytes);
  run_.meter.transfer(&CycleStats::read_busy, lookup_draw_,
                      static_cast<std::uint64_t>(
                          transfer_cycles(static_cast<int>(line.bytes), run_.config.memory.read_bytes)));
}

void MemoryPort::write() {
  run_.rest = 0;
  if (!run_.expected(written_for_, "writes") || !run_.expected(writes_, "writes")) {
    return;
  }
  const PipelineOutputs& out = run_.out;
  const Line line{.line = out.write_line, .bytes = memory_.line_bytes(out.write_line) >> out.write_shift};
  if (!in_write_) {
    check_line("write", writes_.front(), line, out.write_half);
  }
  run_.pipeline.write_data(write_words_);
  const bool last = memory_.write(line.line, line.bytes, write_words_);
  if (last != out.write_last) {
    run_.report.differ(fmt::format("write of line {}: write_last_o is {} in cycle {}", line.line,
                                   out.write_last ? 1 : 0, run_.cycle));
  }
  run_.meter.transfer(&CycleStats::write_busy, written_for_.front(), 1);
  in_write_ = !last;
  if (last) {
    if (written_for_.front() == nullptr) {
      ++run_.result.flushed_lines;
      run_.result.flushed_bytes += line.bytes;
    }
    written_for_.pop_front();
    writes_.pop_front();
  }
}

void MemoryPort::read_surface(std::size_t number) {
  Surface& surface = run_.result.surfaces[number];
  const TiledImage<std::uint32_t> model = surface.codes;
  memory_.read_surface(run_.places[number], run_.clear_code[number], surface);
  for (int y = 0; y < model.height(); ++y) {
    for (int x = 0; x < model.width(); ++x) {
      ++run_.report.compared;
      if (surface.codes.at(x, y) != model.at(x, y)) {
        run_.report.differ(fmt::format("surface {} at ({}, {}): model {:#x}, RTL {:#x}", number, x, y,
                                       model.at(x, y), surface.codes.at(x, y)));
      }
    }
  }
}

void MemoryPort::expect_no_more() {
  run_.expect_no_more(reads_, "requests");
  run_.expect_no_more(writes_, "writes");
}

}  // namespace halfspace::rtl
