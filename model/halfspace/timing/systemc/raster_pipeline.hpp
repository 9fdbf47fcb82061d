/// The rasterizer as a SystemC module for a virtual platform: a command port and a memory port, both TLM-2.0.
#pragma once

#include <tlm_utils/simple_target_socket.h>

#include <memory>
#include <string>
#include <systemc>
#include <tlm>
#include <vector>

#include "halfspace/numerics/error.hpp"
#include "halfspace/timing/engine.hpp"
#include "halfspace/timing/systemc/run_state.hpp"
#include "halfspace/timing/systemc/source.hpp"
#include "halfspace/timing/systemc/timed_signal.hpp"

namespace halfspace::systemc {

/// Nothing can happen any more, and there is work left. what() lists the state of every link and stage.
class DeadlockError : public DisagreementError {
 public:
  using DisagreementError::DisagreementError;
};

/// Registers of RasterPipeline::commands: byte addresses of words of 4 bytes, little endian. An access to
/// another address is answered with TLM_ADDRESS_ERROR_RESPONSE, one of another size or of several words with
/// TLM_BURST_ERROR_RESPONSE, a read of a register that is written or the reverse with
/// TLM_COMMAND_ERROR_RESPONSE, a command that the bound frame does not have with TLM_GENERIC_ERROR_RESPONSE.
namespace registers {
/// Written: executes the command with this index in Frame::commands, after those before it. Returns at once.
inline constexpr std::uint64_t kSubmitCommand = 0x00;
/// Written, any value: submits all commands of the frame.
inline constexpr std::uint64_t kSubmitFrame = 0x04;
/// Written, any value: ends the frame; returns when all commands are done and the z cache is in memory.
inline constexpr std::uint64_t kWaitIdle = 0x08;
/// Read. Bit 0: commands are at work. Bit 1: a frame is bound and has not ended.
inline constexpr std::uint64_t kStatus = 0x0C;
/// Read: commands done since the frame began, its end included.
inline constexpr std::uint64_t kCommandsDone = 0x10;
/// Read: cycles of the last frame that ended, low and high word.
inline constexpr std::uint64_t kCyclesLow = 0x14;
inline constexpr std::uint64_t kCyclesHigh = 0x18;
}  // namespace registers

class RasterPipeline : public sc_core::sc_module, private FrameControl {
 public:
  /// `config` need not be valid as a whole: one that cannot work is found by check(). Depth lies in memory
  /// from address `base` on; see DepthLayout.
  RasterPipeline(const sc_core::sc_module_name& name, const Config& config, std::uint64_t base = 0);
  RasterPipeline(const RasterPipeline&) = delete;
  RasterPipeline& operator=(const RasterPipeline&) = delete;
  ~RasterPipeline() override;

  tlm_utils::simple_target_socket<RasterPipeline> commands;
  tlm::tlm_initiator_socket<> memory;

  /// The frame whose commands are executed next, from depth 1 on all surfaces. It and the observer must live
  /// until it has ended. Observers of cycles are ignored: only the recurrence serves them.
  void bind_frame(const Frame& frame, const EngineOptions& options = {});

  /// Records the credits in use of every link, and the state of every stage: 1 busy, 2 and up its stall
  /// reasons in order. Before the simulation starts.
  void trace_to(sc_core::sc_trace_file* file);

  /// For when the kernel has come to rest: throws what a process threw, or DeadlockError where commands are
  /// still at work.
  void check();

  /// How often the kernel has run a process of the pipeline that waited.
  [[nodiscard]] std::uint64_t activations() const { return run_.clock.activations(); }

  /// Of the frame that ended last. Reads the depth images from memory.
  TimedResult take_result();

 private:
  /// First cycle in which no stage up to `last` has anything left to do but late writes; for when the pipe is
  /// empty.
  [[nodiscard]] Cycle stages_idle_from(Stage last) const;
  void begin_frame() override;
  void end_frame(Cycle cycles) override;
  [[nodiscard]] Cycle idle_from() const override;
  void write_all_late(Cycle since) override;
  [[nodiscard]] Cycle hi_z_out() const override;
  Cycle clear_hi_z(std::uint32_t surface, std::uint32_t code, Cycle idle) override;

  void transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  tlm::tlm_response_status write_register(std::uint64_t address, std::uint32_t value);
  tlm::tlm_response_status read_register(std::uint64_t address, std::uint32_t& value) const;
  [[nodiscard]] std::string describe();

  struct Units;

  RunState run_;
  std::unique_ptr<Units> units_;
  Watch watch_;
  Cycle late_next_ = 0;  ///< after the late writes before the last clear
  FrameCycles cycles_;   ///< of the frame that ended last
  bool bound_ = false;
  std::vector<std::unique_ptr<TimedSignal>> signals_;
};

/// Bytes that the depth surfaces of a frame take in memory.
std::uint64_t depth_bytes(const Frame& frame, const Config& config);

}  // namespace halfspace::systemc
