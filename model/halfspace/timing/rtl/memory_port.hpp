/// Memory behind the verilated pipeline, and the check that it is asked for and written as the model says.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "halfspace/timing/rtl/line_memory.hpp"
#include "halfspace/timing/rtl/run_state.hpp"

namespace halfspace::rtl {

class MemoryPort {
 public:
  explicit MemoryPort(RunState& run) : run_(run), memory_(run.config, run.result.surfaces, run.places) {}

  // What the model expects: lines, and the bytes that memory has of them.
  void expect_read(std::uint32_t line, std::uint32_t bytes) {
    reads_.push_back({.line = line, .bytes = bytes});
  }
  void expect_write(std::uint32_t line, std::uint32_t bytes) {
    writes_.push_back({.line = line, .bytes = bytes});
  }
  /// The lookup works for this draw.
  void look_up_for(DrawContext* draw) { lookup_draw_ = draw; }
  /// A line has entered the write buffer for this draw; null: for the flush.
  void buffer_write(DrawContext* draw) { written_for_.push_back(draw); }

  // What the pipeline does in the cycle.
  void offer_fill();
  void request();
  void write();

  void clear(const ZSurface& place) { memory_.clear(place); }
  /// The image of a surface is what memory holds: reads it, and reports where the model has drawn another.
  void read_surface(std::size_t surface);
  void expect_no_more();

 private:
  struct Line {
    std::uint32_t line = 0;
    std::uint32_t bytes = 0;
  };

  void check_line(const char* what, const Line& want, const Line& got, bool half);

  RunState& run_;
  LineMemory memory_;
  DrawContext* lookup_draw_ = nullptr;
  std::deque<Line> reads_;
  std::deque<Line> writes_;
  std::deque<DrawContext*> written_for_;  ///< lines in the write buffer
  std::vector<std::uint32_t> write_words_;
  bool in_write_ = false;
};

}  // namespace halfspace::rtl
