/// Drives the verilated pipeline cycle by cycle: reset, the source in front of it, clears, the flush at the
/// end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "halfspace/machine/frame_source.hpp"
#include "halfspace/timing/rtl/run_state.hpp"

namespace halfspace::rtl {

/// Who is told of what happens at the pipeline's ports; see Scoreboard, TestedSink and MemoryPort.
class PortListener {
 public:
  virtual ~PortListener() = default;
  // Before the cycle settles.
  virtual void offer_fill() = 0;
  [[nodiscard]] virtual bool sink_ready() = 0;
  virtual void answer_late() = 0;
  // What happens in it.
  virtual void begin_packets() = 0;
  virtual void take_triangle(const ScreenTriangle& triangle, DrawContext& draw,
                             const DrawStatePacket& state) = 0;
  virtual void clear(std::uint32_t surface, std::uint32_t code) = 0;
  virtual void flush() = 0;
  virtual void request() = 0;
  virtual void links() = 0;
  virtual void take_tested_beat() = 0;
  virtual void write() = 0;
};

class Driver {
 public:
  /// All must outlive it.
  Driver(const Frame& frame, RunState& run, PortListener& listener);

  /// The whole frame, from reset to the end of the flush. Throws RtlError where the pipeline comes to rest
  /// before, or where one of its assertions fails.
  void run();
  /// Compares the counters at the pipeline's top with what was seen on activity_o since reset.
  void check_counters();

 private:
  void reset();
  void step();
  void clock_edge();
  void offer();
  void load_triangle();
  void begin_clear_or_flush();
  void end_clear_or_flush();
  void check_counter(std::size_t stage, std::size_t activity, std::uint64_t count);

  const Frame& frame_;
  RunState& run_;
  PortListener& listener_;
  FrameSource source_;
  CycleMeter before_;  ///< of the cycles between reset and cycle 0
  RunState::Cycle longest_rest_;
  bool done_ = false;

  std::uint32_t next_command_ = 0;
  bool in_command_ = false;
  std::optional<SourceItem> item_;
  std::size_t next_in_item_ = 0;
  bool in_triangle_ = false;  ///< it is at the inputs
  DrawStatePacket state_;
  RunState::Cycle next_arrival_ = 0;
  std::uint64_t triangles_ = 0;
  bool waits_for_done_ = false;  ///< for the end of a clear or of the flush

  // Since reset.
  std::uint64_t busy_reads_ = 0;
  std::uint64_t busy_writes_ = 0;
};

}  // namespace halfspace::rtl
