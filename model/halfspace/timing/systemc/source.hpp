/// Executes commands in order: gives the triangles of draws and drawn clears to setup, and has the z cache do
/// fast clears and the flush.
#pragma once

#include <deque>
#include <optional>
#include <systemc>

#include "halfspace/machine/frame_source.hpp"
#include "halfspace/timing/systemc/early_z.hpp"
#include "halfspace/timing/systemc/setup.hpp"

namespace halfspace::systemc {

/// The pipeline as a whole, as the source needs it.
class FrameControl {
 public:
  virtual ~FrameControl() = default;
  /// This cycle becomes cycle 0 of the bound frame.
  virtual void begin_frame() = 0;
  /// The frame had `cycles`.
  virtual void end_frame(Cycle cycles) = 0;
  /// Does the late writes that are out, in a pipe that is empty, before the clear or the flush that waits
  /// since cycle `since`.
  virtual void write_all_late(Cycle since) = 0;
  /// First cycle in which no stage has anything left to do; for when the pipe is empty.
  [[nodiscard]] virtual Cycle idle_from() const = 0;
  /// The same of the flush at the end of the frame, for which blocks must have left hi_z too.
  [[nodiscard]] virtual Cycle hi_z_out() const = 0;
  /// hi_z sees all jobs and clears the surface, in a pipe that is empty from cycle `idle` on; gives the cycle
  /// in which it is through.
  virtual Cycle clear_hi_z(std::uint32_t surface, std::uint32_t code, Cycle idle) = 0;
};

class Source : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(Source);
  Source(const sc_core::sc_module_name& name, RunState& run, FrameControl& control);

  sc_core::sc_port<TriangleInput> out;
  sc_core::sc_port<DepthControl> depth;

  /// Adds a command of the frame, by its index, or the end of the frame.
  void submit(std::uint32_t command);
  void submit_end();
  /// Suspends the calling thread until all that was submitted is done.
  void wait_until_idle();
  [[nodiscard]] bool idle() const { return commands_.empty(); }
  [[nodiscard]] std::uint32_t commands_done() const { return done_; }
  [[nodiscard]] std::string describe() const;

 private:
  static constexpr std::uint32_t kEnd = 0xFFFFFFFFu;

  void execute_commands();
  void begin_frame();
  void execute(std::uint32_t index);
  void fast_clear(std::uint32_t surface, std::uint32_t code);
  void give(DrawContext& draw, const ScreenTriangle& triangle);
  Cycle drain();
  void end_frame();

  RunState& run_;
  FrameControl& control_;
  std::deque<std::uint32_t> commands_;  ///< the first is at work
  sc_core::sc_event submitted_{"submitted"};
  sc_core::sc_event finished_{"finished"};
  std::uint32_t done_ = 0;
  bool in_frame_ = false;
  std::optional<FrameSource> frame_;
  std::uint64_t triangles_ = 0;  ///< given to setup
  Cycle next_arrival_ = 0;       ///< the triangle before is taken, and the clear before is done
};

}  // namespace halfspace::systemc
