#include "stream_bench.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "credit_timing.hpp"
#include "handshake_monitor.hpp"
#include "random.hpp"

namespace halfspace::tb {
namespace {

constexpr std::uint64_t kMaxResetCycles = 4;  // one must do; more must not hurt
constexpr std::uint64_t kDrainCycles = 64;    // what the sink waits for packets that nobody expects
// Independent seeds from one; the words are arbitrary.
constexpr std::uint64_t kIdleSeed = 0x1d1e;
constexpr std::uint64_t kStallSeed = 0x57a11;
constexpr std::uint64_t kResetSeed = 0x4e5e7;

class Bench {
 public:
  Bench(StreamDut& dut, const UnitShape& shape, Stimulus& stimulus, const BenchOptions& options)
      : dut_(dut),
        shape_(shape),
        stimulus_(stimulus),
        options_(options),
        scoreboard_(shape.output_fields),
        timing_(shape.latency, shape.capacity),
        unit_timing_(shape.timing ? shape.timing() : nullptr),
        idle_(options.idle, options.idle_share, options.seed ^ kIdleSeed),
        stall_(options.stall, options.stall_share, options.seed ^ kStallSeed),
        resets_(options.seed ^ kResetSeed),
        shim_(options.fault, options.fault_packet),
        input_(shape.input_words) {}

  BenchResult run() {
    reset();
    while (!failure_ && !finished()) {
      if (!options_.wave_file.empty() && cycle_ == options_.wave_from) {
        dut_.trace_to(options_.wave_file);
      }
      if (options_.reset_period != 0 && resets_.below(options_.reset_period) == 0) {
        reset();
      }
      step();
    }
    if (!failure_ && options_.checks.packets) {
      failure_ = scoreboard_.finish(cycle_);
    }
    if (!failure_ && options_.full_rate_packets != 0) {
      check_rate();
    }
    if (!options_.coverage_file.empty()) {
      dut_.write_coverage(options_.coverage_file);
    }
    return {failure_, cycle_, scoreboard_.received()};
  }

 private:
  /// Everything under way is lost; the source offers its packet again after it.
  void reset() {
    dut_.set_reset(true);
    dut_.set_input(false, input_);
    dut_.set_output_ready(false);
    for (std::uint64_t left = 1 + resets_.below(kMaxResetCycles); left > 0; --left) {
      dut_.settle();
      dut_.clock_edge();
    }
    if (dut_.input_ready() || dut_.output_valid()) {
      fail(Failure{FailureKind::kHandshake, cycle_, "ready or valid in reset"});
    }
    dut_.set_reset(false);
    offered_ = false;
    scoreboard_.clear();
    timing_.clear();
    if (unit_timing_) {
      unit_timing_->clear();
    }
    stimulus_.reset();
    monitor_.clear();
  }

  [[nodiscard]] bool finished() {
    quiet_ = source_empty_ && !offered_ && scoreboard_.outstanding() == 0 ? quiet_ + 1 : 0;
    return quiet_ > kDrainCycles || gave_up_;
  }

  void step() {
    if (!offered_ && !source_empty_ && !idle_.stalled()) {
      offered_ = pending_ || stimulus_.next(input_);
      pending_ = offered_;
      source_empty_ = !offered_;
      if (offered_ && shape_.reads_ahead) {
        stimulus_.reference(input_, scoreboard_);
      }
    }
    const bool sink_ready = !stall_.stalled();
    // Outputs come from registers: they are known before the inputs of the cycle are.
    shim_.step(dut_.output_valid(), dut_.output_payload(), sink_ready, quiet_ > 1);
    if (options_.fault == FaultKind::kSourceChange && offered_ && was_refused_) {
      input_[0] ^= 1;
    }
    dut_.set_input(offered_, input_);
    dut_.set_output_ready(shim_.ready());
    dut_.settle();
    if (options_.probe_paths) {
      probe();
    }
    const bool accepted = offered_ && dut_.input_ready();
    const bool left = shim_.valid() && sink_ready;
    check(sink_ready, left);
    if (accepted) {
      if (!shape_.reads_ahead) {
        stimulus_.reference(input_, scoreboard_);
      }
      offered_ = false;
      pending_ = false;
    }
    was_refused_ = offered_;
    last_left_ = left ? cycle_ : last_left_;
    watch_for_deadlock(accepted || left);
    dut_.clock_edge();
    if (dut_.assertion_failed()) {
      fail(Failure{FailureKind::kAssertion, cycle_, "an assertion of the RTL failed: see its message above"});
    }
    ++cycle_;
  }

  void check(bool sink_ready, bool left) {
    if (options_.checks.handshake) {
      fail(monitor_.cycle(cycle_, shim_.valid(), sink_ready, shim_.payload()));
    }
    if (left && options_.checks.packets) {
      fail(scoreboard_.receive(cycle_, shim_.payload()));
    }
    if (options_.checks.timing && unit_timing_) {
      fail(unit_timing_->cycle({cycle_, offered_, dut_.input_ready(), input_, shim_.valid(), sink_ready,
                                shim_.payload(), dut_.side_outputs()}));
    } else if (options_.checks.timing) {
      fail(timing_.cycle(cycle_, offered_, dut_.input_ready(), shim_.valid(), sink_ready));
    }
  }

  /// Changes every input within the cycle; an output that follows is a path from pin to pin.
  void probe() {
    const bool in_ready = dut_.input_ready();
    const bool out_valid = dut_.output_valid();
    const std::vector<std::uint32_t> payload(dut_.output_payload().begin(), dut_.output_payload().end());
    std::vector<std::uint32_t> other(input_);
    for (std::uint32_t& word : other) {
      word = ~word;
    }
    if (shape_.reads_ahead) {
      dut_.set_input(!offered_, input_);
      dut_.set_output_ready(!shim_.ready());
      dut_.settle();
      if (dut_.input_ready() != in_ready) {
        fail(Failure{FailureKind::kHandshake, cycle_, "ready follows a handshake within the cycle"});
      }
    }
    dut_.set_input(!offered_, other);
    dut_.set_output_ready(!shim_.ready());
    dut_.settle();
    const bool ready_follows = !shape_.reads_ahead && dut_.input_ready() != in_ready;
    if (ready_follows || dut_.output_valid() != out_valid ||
        !std::ranges::equal(dut_.output_payload(), payload)) {
      fail(Failure{FailureKind::kHandshake, cycle_, "an output follows an input within the cycle"});
    }
    dut_.set_input(offered_, input_);
    dut_.set_output_ready(shim_.ready());
    dut_.settle();
  }

  void watch_for_deadlock(bool moved) {
    idle_cycles_ = moved || quiet_ > 0 ? 0 : idle_cycles_ + 1;
    if (idle_cycles_ < shape_.deadlock_cycles) {
      return;
    }
    if (source_empty_ && !offered_ && !dut_.output_valid()) {
      gave_up_ = true;  // nothing waits for anything: what is outstanding is lost
    } else {
      fail(Failure{
          FailureKind::kDeadlock, cycle_,
          fmt::format(
              "nothing moved for {} cycles: input valid {:d} ready {:d}, output valid {:d} ready {:d}, {} "
              "packets received, {} outstanding",
              shape_.deadlock_cycles, offered_, dut_.input_ready(), dut_.output_valid(), shim_.ready(),
              scoreboard_.received(), scoreboard_.outstanding())});
    }
  }

  void check_rate() {
    // The first packet is accepted in cycle 1: ready comes from a register that reset clears.
    const std::uint64_t expected = options_.full_rate_packets + static_cast<std::uint64_t>(shape_.latency);
    if (last_left_ != expected) {
      fail(Failure{FailureKind::kTiming, last_left_,
                   fmt::format("{} packets back to back took {} cycles, not {}", options_.full_rate_packets,
                               last_left_, expected)});
    }
  }

  /// The first failure counts.
  void fail(std::optional<Failure> failure) {
    if (!failure_) {
      failure_ = std::move(failure);
    }
  }

  StreamDut& dut_;
  const UnitShape& shape_;
  Stimulus& stimulus_;
  const BenchOptions& options_;
  Scoreboard scoreboard_;
  CreditTiming timing_;
  std::unique_ptr<UnitTiming> unit_timing_;  ///< in its place
  HandshakeMonitor monitor_{"output"};
  Staller idle_;
  Staller stall_;
  Random resets_;
  FaultShim shim_;
  std::vector<std::uint32_t> input_;  ///< the packet that the source offers or has pending
  bool offered_ = false;              ///< input valid
  bool pending_ = false;              ///< input_ has yet to be accepted
  bool source_empty_ = false;
  bool was_refused_ = false;
  std::uint64_t cycle_ = 0;
  std::uint64_t last_left_ = 0;
  std::uint64_t idle_cycles_ = 0;
  bool gave_up_ = false;
  std::uint64_t quiet_ = 0;  ///< cycles since nothing was left to do
  std::optional<Failure> failure_;
};

}  // namespace

BenchResult run_bench(StreamDut& dut, const UnitShape& shape, Stimulus& stimulus,
                      const BenchOptions& options) {
  return Bench(dut, shape, stimulus, options).run();
}

}  // namespace halfspace::tb
