#include "hi_z/hi_z_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>
#include <utility>

#include "common/handshake_monitor.hpp"
#include "common/random.hpp"
#include "common/scoreboard.hpp"
#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/packing.hpp"
#include "hi_z/hi_z_timing.hpp"

namespace halfspace::tb {
namespace {

constexpr std::uint64_t kDrainCycles = 64;
constexpr std::uint64_t kDeadlockCycles = 4000;
constexpr std::uint64_t kMostBlocksAhead = 8;  // in block_walker's FIFO
constexpr std::uint64_t kSlotCycles = 2;       // from a triangle's slot to its first block, at least
constexpr std::uint64_t kBurstCycles = 3;      // from a coverage to its bounds, at least
// Independent seeds from one; the words are arbitrary.
constexpr std::uint64_t kIdleSeed = 0x1d1e;
constexpr std::uint64_t kStallSeed = 0x57a11;
constexpr std::uint64_t kBackSeed = 0xbac4;

class HiZRun {
 public:
  HiZRun(HiZDut& dut, const HiZShape& shape, const HiZWorkload& workload, const HiZRunOptions& options,
         HiZCoverage& coverage)
      : dut_(dut),
        shape_(shape),
        workload_(workload),
        options_(options),
        coverage_(coverage),
        scoreboard_(field_slots<BlockJob>(shape.widths)),
        timing_(shape, workload, coverage),
        idle_(options.idle, 0, options.seed ^ kIdleSeed),
        stall_(options.stall, 0, options.seed ^ kStallSeed),
        random_(options.seed ^ kBackSeed) {
    in_.equation.resize(words_for(packed_bits<DepthEquationPacket>(shape.widths)));
    in_.state.resize(words_for(packed_bits<DrawStatePacket>(shape.widths)));
    in_.block.resize(words_for(packed_bits<BlockJob>(shape.widths)));
    in_.update.resize(words_for(packed_bits<HiZUpdatePacket>(shape.widths)));
  }

  HiZRunResult run() {
    if (!options_.wave_file.empty()) {
      dut_.trace_to(options_.wave_file);
    }
    if (options_.cut != 0) {
      round(options_.cut);
    }
    if (!failure_) {
      round(0);
    }
    if (!options_.coverage_file.empty()) {
      dut_.write_coverage(options_.coverage_file);
    }
    return {failure_, cycles_, scoreboard_.received(), rejected_};
  }

 private:
  /// Bounds on their way to hi_z.
  struct Back {
    std::uint64_t cycle = 0;
    const HiZJob* job = nullptr;
    std::uint64_t number = 0;
  };

  /// Resets, and runs the workload from its start to its end, or to a cycle.
  void round(std::uint64_t cut) {
    in_.reset = true;
    in_.block_valid = in_.slot_write = in_.job_valid = in_.update_valid = in_.drain = in_.clear = in_.forget =
        false;
    in_.left_ready = false;
    for (std::uint64_t left = 1 + random_.below(3); left > 0; --left) {
      dut_.settle(in_, out_);
      dut_.clock_edge();
    }
    in_.reset = false;
    scoreboard_.clear();
    timing_.clear();
    law_.clear();
    kinds_.clear();
    updates_.clear();
    leaving_.clear();
    command_ = ahead_ = 0;
    slot_at_.clear();
    offered_ = clearing_ = false;
    covered_at_ = burst_at_ = 0;
    jobs_left_ = jobs_back_ = blocks_passed_ = blocks_left_ = 0;
    ready_.clear();
    drained_ = was_rejected_ = delayed_ = done_ = stalled_ = false;
    quiet_ = idle_cycles_ = cycle_ = 0;
    while (!failure_ && quiet_ < kDrainCycles && (cut == 0 || cycle_ < cut)) {
      step();
    }
    if (!failure_ && cut == 0 && options_.packets) {
      failure_ = scoreboard_.finish(cycle_);
    }
    cycles_ += cycle_;
  }

  void step() {
    source();
    come_back();
    const bool sink_ready = !stall_.stalled();
    in_.left_ready = sink_ready;
    dut_.settle(in_, out_);
    if (random_.below(16) == 0) {
      probe();
    }
    bool valid = out_.left_valid;
    if (options_.fault != HiZFault::kNone) {
      valid = inject(valid);
    }
    const HiZCommand* const command = in_.block_valid ? &workload_.commands[command_] : nullptr;
    if (options_.packets || options_.timing) {
      fail(law_.cycle(cycle_, valid, sink_ready, out_.left));
    }
    if (options_.timing) {
      fail(timing_.cycle(cycle_, command, in_.left_ready, in_, out_, valid));
    }
    if (valid && sink_ready && options_.packets) {
      fail(scoreboard_.receive(cycle_, out_.left));
    }
    if (out_.left_valid && in_.left_ready) {
      leave();
    }
    accept(command);
    dut_.clock_edge();
    if (dut_.assertion_failed()) {
      fail(Failure{FailureKind::kAssertion, cycle_, "an assertion of the RTL failed: see its message above"});
    }
    quiet_ = command_ == workload_.commands.size() && scoreboard_.outstanding() == 0 ? quiet_ + 1 : 0;
    if (++idle_cycles_ > kDeadlockCycles) {
      fail(Failure{
          FailureKind::kDeadlock, cycle_,
          fmt::format("nothing moved for {} cycles, in command {} of {}, {} blocks outstanding",
                      kDeadlockCycles, command_, workload_.commands.size(), scoreboard_.outstanding())});
    }
    ++cycle_;
  }

  /// What block_walker does in this cycle, and the pipeline for a clear or the end of a frame.
  void source() {
    const bool draw_idle = idle_.stalled();
    in_.block_valid = in_.slot_write = in_.drain = in_.clear = in_.forget = false;
    if (command_ < workload_.commands.size() && !clearing_) {
      const HiZCommand& command = workload_.commands[command_];
      if (command.kind == HiZCommandKind::kBlock) {
        const bool known =
            command.triangle < slot_at_.size() && slot_at_[command.triangle] + kSlotCycles <= cycle_;
        offered_ = offered_ || (known && !draw_idle);
        in_.block_valid = offered_;
        in_.block = command.words;
        // Slots come while blocks wait in block_walker's FIFO, each of another triangle.
        ahead_ = std::max(ahead_, command.triangle + 1 + random_.below(kMostBlocksAhead));
      } else {
        // Everything else in the machine is idle.
        in_.drain = command.kind == HiZCommandKind::kClear && leaving_.empty() && kinds_.empty() &&
                    (updates_.empty() || updates_.back().cycle <= cycle_ + 2) &&
                    blocks_left_ == blocks_passed_;
        ahead_ = 0;
      }
    }
    if (slot_at_.size() < workload_.triangles.size() && slot_at_.size() <= ahead_) {
      const HiZTriangleWords& triangle = workload_.triangles[slot_at_.size()];
      in_.slot_write = true;
      in_.slot = static_cast<std::uint8_t>(slot_at_.size());
      in_.equation = triangle.equation;
      in_.state = triangle.state;
      slot_at_.push_back(cycle_);
    }
    if (options_.fault == HiZFault::kEarlyClear && blocks_passed_ > options_.fault_packet) {
      in_.clear = true;
    }
  }

  /// What comes back from quad_generator and early_z.
  void come_back() {
    in_.job_valid = !kinds_.empty() && kinds_.front().cycle <= cycle_;
    if (in_.job_valid) {
      const Back back = kinds_.front();
      kinds_.pop_front();
      in_.job_burst = back.job->burst;
      if (options_.fault == HiZFault::kFlipKind && back.number == options_.fault_packet) {
        in_.job_burst = false;
      }
      if (!back.job->burst) {
        ready_.push_back({cycle_ + 1, back.job, back.number});
      }
    }
    in_.update_valid = !updates_.empty() && updates_.front().cycle <= cycle_;
    if (in_.update_valid) {
      const Back back = updates_.front();
      const bool faulty = back.number >= options_.fault_packet;
      if (options_.fault == HiZFault::kLateUpdate && faulty && !delayed_) {
        // The checker has it in the cycle in which it should come.
        in_.update_valid = false;
        delayed_ = true;
        ready_.push_back({cycle_ + 1, back.job, back.number});
      } else {
        updates_.pop_front();
        in_.update = back.job->words;
        if (!delayed_) {
          ready_.push_back({cycle_ + 1, back.job, back.number});
        }
        delayed_ = false;
        if (options_.fault == HiZFault::kFlipUpdate && faulty) {
          for (std::uint32_t& word : in_.update) {
            word ^= 0x00f0'0ff0u;
          }
        }
        in_.update_valid = options_.fault != HiZFault::kLoseUpdate || !faulty;
      }
    }
    // In the order of jobs: an update may come before the kinds of the jobs before it.
    std::ranges::sort(ready_, {}, &Back::number);
    while (!ready_.empty() && ready_.front().number == jobs_back_) {
      timing_.ready(ready_.front().cycle);
      ready_.erase(ready_.begin());
      ++jobs_back_;
    }
  }

  /// A block has gone to tile_walker: its jobs come back later.
  void leave() {
    idle_cycles_ = 0;
    if (leaving_.empty()) {
      return;
    }
    const auto [command, first] = leaving_.front();
    leaving_.pop_front();
    ++blocks_left_;
    std::uint64_t number = first;
    covered_at_ = std::max(covered_at_, cycle_ + 4 + random_.below(options_.delay / 4 + 1));
    for (const HiZJob& job : command->jobs) {
      covered_at_ += 1 + (random_.below(4) == 0 ? random_.below(options_.delay / 8 + 1) : 0);
      kinds_.push_back({covered_at_, &job, number});
      if (job.burst) {
        burst_at_ = std::max(burst_at_ + 1, covered_at_ + kBurstCycles + random_.below(options_.delay + 1));
        updates_.push_back({burst_at_, &job, number});
      }
      ++number;
    }
  }

  void accept(const HiZCommand* block) {
    if (command_ == workload_.commands.size()) {
      return;
    }
    const HiZCommand& command = workload_.commands[command_];
    if (clearing_) {
      const std::uint64_t blocks = command.last - command.first + 1;
      const auto per_cycle = static_cast<std::uint64_t>(shape_.clear_blocks);
      // The first mark is in the second cycle after that of the clear.
      const bool done = cycle_ == clear_begin_ + 1 + (blocks + per_cycle - 1) / per_cycle;
      if (options_.timing && out_.clear_done != done && options_.fault == HiZFault::kNone) {
        fail(Failure{FailureKind::kTiming, cycle_,
                     fmt::format("clear done is {:d} {} cycles after the clear of {} blocks", out_.clear_done,
                                 cycle_ - clear_begin_, blocks)});
      }
      if (done) {
        clearing_ = false;
        next_command();
      }
      return;
    }
    if (command.kind == HiZCommandKind::kBlock) {
      if (block != nullptr && out_.block_ready) {
        if (command.rejected == command.tiles) {
          ++rejected_;
          was_rejected_ = true;
        } else {
          was_rejected_ = false;
          scoreboard_.expect(command.left);
          leaving_.emplace_back(&command, jobs_left_);
          jobs_left_ += command.jobs.size();
          ++blocks_passed_;
        }
        offered_ = false;
        next_command();
      }
      return;
    }
    const bool nothing_left = leaving_.empty() && kinds_.empty() && blocks_left_ == blocks_passed_;
    if (command.kind == HiZCommandKind::kClear) {
      if (timing_.unapplied() != 0 && in_.drain) {
        drained_ = true;
      }
      // The clear begins in this cycle: clear_i and idle_o are of the same one.
      if (in_.drain && out_.idle) {
        in_.clear = options_.fault != HiZFault::kSkipClear;
        in_.clear_first = command.first;
        in_.clear_last = command.last;
        dut_.settle(in_, out_);
        clearing_ = true;
        clear_begin_ = cycle_;
        coverage_.hit(drained_ ? "clear with jobs to apply" : "clear with all jobs applied");
        coverage_.hit(command.first == command.last ? "clear of one block" : "clear of several blocks");
        if (was_rejected_) {
          coverage_.hit("clear after a block that was rejected");
        }
        drained_ = was_rejected_ = false;
        timing_.cleared(command);
      }
      return;
    }
    if (nothing_left && updates_.empty() && out_.idle) {
      in_.forget = options_.fault != HiZFault::kSkipForget;
      dut_.settle(in_, out_);
      timing_.forget();
      jobs_left_ = jobs_back_ = 0;
      next_command();
    }
  }

  void next_command() {
    ++command_;
    idle_cycles_ = 0;
  }

  /// Changes every input within the cycle; an output that follows is a path from pin to pin. Whether a block
  /// is taken follows from nothing but registers.
  void probe() {
    const HiZOutputs was = out_;
    HiZInputs other = in_;
    other.block_valid = !in_.block_valid;
    other.left_ready = !in_.left_ready;
    other.slot_write = !in_.slot_write;
    other.job_valid = !in_.job_valid;
    other.update_valid = !in_.update_valid;
    for (std::vector<std::uint32_t>* const words :
         {&other.block, &other.update, &other.equation, &other.state}) {
      for (std::uint32_t& word : *words) {
        word = ~word;
      }
    }
    dut_.settle(other, out_);
    if (out_.block_ready != was.block_ready || out_.left_valid != was.left_valid || out_.left != was.left ||
        out_.idle != was.idle || out_.slot_write != was.slot_write || out_.slot != was.slot ||
        out_.equation != was.equation || out_.state != was.state) {
      fail(Failure{FailureKind::kHandshake, cycle_, "an output follows an input within the cycle"});
    }
    dut_.settle(in_, out_);
  }

  /// What the checkers see of the output in this cycle.
  bool inject(bool valid) {
    const bool here = scoreboard_.received() == options_.fault_packet;
    switch (options_.fault) {
      case HiZFault::kFlipTile:
        if (valid && here) {
          insert_bits(out_.left, tiles_at(), 1, extract_bits(out_.left, tiles_at(), 1) ^ 1);
        }
        return valid;
      case HiZFault::kDrop:
        if (valid && here && in_.left_ready && !done_) {
          done_ = true;
          leave();
          return false;
        }
        return valid;
      case HiZFault::kLate:
        if (valid && here && !done_) {
          done_ = true;
          in_.left_ready = false;
          dut_.settle(in_, out_);
          return false;
        }
        return valid;
      case HiZFault::kChangePayload:
        if (valid && !in_.left_ready && scoreboard_.received() >= options_.fault_packet) {
          out_.left[0] ^= stalled_ ? 1u : 0u;
          stalled_ = !stalled_;
        }
        return valid;
      case HiZFault::kOtherSlot:
        out_.slot ^= out_.slot_write && scoreboard_.received() >= options_.fault_packet ? 1 : 0;
        return valid;
      case HiZFault::kOtherTriangle:
        out_.equation[0] ^= out_.slot_write && scoreboard_.received() >= options_.fault_packet ? 1u : 0u;
        return valid;
      case HiZFault::kLoseSlot:
        out_.slot_write = out_.slot_write && scoreboard_.received() < options_.fault_packet;
        return valid;
      default:
        return valid;
    }
  }

  [[nodiscard]] int tiles_at() const {
    for (const FieldSlot& field : field_slots<BlockJob>(shape_.widths)) {
      if (field.name == "tiles") {
        return field.lsb;
      }
    }
    return 0;
  }

  /// The first failure counts.
  void fail(std::optional<Failure> failure) {
    if (!failure_) {
      failure_ = std::move(failure);
    }
  }

  HiZDut& dut_;
  HiZShape shape_;
  const HiZWorkload& workload_;
  HiZRunOptions options_;
  HiZCoverage& coverage_;
  Scoreboard scoreboard_;
  HiZTiming timing_;
  HandshakeMonitor law_{"output"};
  Staller idle_;
  Staller stall_;
  Random random_;
  HiZInputs in_;
  HiZOutputs out_;
  std::optional<Failure> failure_;
  std::uint64_t cycle_ = 0;
  std::uint64_t cycles_ = 0;
  std::uint64_t rejected_ = 0;
  std::size_t command_ = 0;
  bool offered_ = false;
  std::size_t ahead_ = 0;               ///< triangles up to this one are written
  std::vector<std::uint64_t> slot_at_;  ///< by triangle, the cycle of its slot
  std::deque<std::pair<const HiZCommand*, std::uint64_t>>
      leaving_;  ///< not at tile_walker yet; number of its first job
  std::deque<Back> kinds_;
  std::deque<Back> updates_;
  std::vector<Back> ready_;      ///< not told to the checker yet
  std::uint64_t jobs_left_ = 0;  ///< of the frame
  std::uint64_t jobs_back_ = 0;
  std::uint64_t blocks_passed_ = 0;
  std::uint64_t blocks_left_ = 0;
  std::uint64_t covered_at_ = 0;
  std::uint64_t burst_at_ = 0;
  bool clearing_ = false;
  std::uint64_t clear_begin_ = 0;
  bool drained_ = false;
  bool was_rejected_ = false;
  bool delayed_ = false;
  bool done_ = false;
  bool stalled_ = false;
  std::uint64_t quiet_ = 0;
  std::uint64_t idle_cycles_ = 0;
};

}  // namespace

std::optional<HiZFault> hi_z_fault_by_name(const std::string& name) {
  static constexpr std::array<std::pair<const char*, HiZFault>, 15> kFaults = {
      {{"none", HiZFault::kNone},
       {"flip-tile", HiZFault::kFlipTile},
       {"drop", HiZFault::kDrop},
       {"late", HiZFault::kLate},
       {"change-payload", HiZFault::kChangePayload},
       {"other-slot", HiZFault::kOtherSlot},
       {"other-triangle", HiZFault::kOtherTriangle},
       {"lose-slot", HiZFault::kLoseSlot},
       {"flip-update", HiZFault::kFlipUpdate},
       {"flip-kind", HiZFault::kFlipKind},
       {"lose-update", HiZFault::kLoseUpdate},
       {"late-update", HiZFault::kLateUpdate},
       {"skip-clear", HiZFault::kSkipClear},
       {"skip-forget", HiZFault::kSkipForget},
       {"early-clear", HiZFault::kEarlyClear}}};
  const auto found = std::ranges::find_if(kFaults, [&](const auto& fault) { return name == fault.first; });
  return found == kFaults.end() ? std::nullopt : std::optional(found->second);
}

HiZRunResult run_hi_z(HiZDut& dut, const HiZShape& shape, const HiZWorkload& workload,
                      const HiZRunOptions& options, HiZCoverage& coverage) {
  return HiZRun(dut, shape, workload, options, coverage).run();
}

}  // namespace halfspace::tb
