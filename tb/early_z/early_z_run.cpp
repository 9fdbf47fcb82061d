#include "early_z/early_z_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>
#include <utility>

#include "common/handshake_monitor.hpp"
#include "common/random.hpp"
#include "common/scoreboard.hpp"
#include "early_z/shader.hpp"
#include "early_z/z_timing.hpp"
#include "halfspace/timing/contract.hpp"
#include "halfspace/units/packing.hpp"

namespace halfspace::tb {
namespace {

constexpr std::size_t kSlotsAhead = 64;  // triangles written before their first burst is offered
constexpr std::uint64_t kDrainCycles = 64;
constexpr std::uint64_t kDeadlockCycles = 4000;
constexpr std::uint64_t kResetCycles = 2;
// Independent seeds from one; the words are arbitrary.
constexpr std::uint64_t kIdleSeed = 0x1d1e;
constexpr std::uint64_t kStallSeed = 0x57a11;
constexpr std::uint64_t kMemorySeed = 0x3e3;
constexpr std::uint64_t kLateSeed = 0x1a7e;

/// Data of a request on its way.
struct Fill {
  std::uint64_t first = 0;  ///< cycle of the first beat
  std::vector<std::vector<std::uint32_t>> beats;
};

class Run {
 public:
  Run(EarlyZDut& dut, const EarlyZShape& shape, const Workload& workload, const ZRunOptions& options,
      ZCoverage& coverage)
      : dut_(dut),
        shape_(shape),
        workload_(workload),
        options_(options),
        coverage_(coverage),
        fields_(field_slots<TestedBeat>(shape.widths)),
        scoreboard_(fields_),
        update_fields_(field_slots<HiZUpdatePacket>(shape.widths)),
        updates_(update_fields_),
        idle_(options.idle, 0, options.seed ^ kIdleSeed),
        stall_(options.stall, 0, options.seed ^ kStallSeed),
        slow_(options.memory, 0, options.seed ^ kMemorySeed),
        shader_(options, shape, options.seed ^ kLateSeed),
        order_(memory_order(workload)) {
    in_.equation.resize(words_for(packed_bits<DepthEquationPacket>(shape.widths)));
    in_.state.resize(words_for(packed_bits<DrawStatePacket>(shape.widths)));
    in_.beat.resize(words_for(packed_bits<QuadBeat>(shape.widths)));
    in_.late_keep.resize(words_for(shape.widths.MaskBits));
    in_.fill.resize(words_for(8 * std::min(shape.read_bytes, shape.line_bytes())));
  }

  ZRunResult run() {
    if (!options_.wave_file.empty()) {
      dut_.trace_to(options_.wave_file);
    }
    if (options_.cut != 0) {
      round(options_.cut);
    }
    if (!failure_) {
      round(0);
    }
    if (!failure_) {
      fail(compare_memory(workload_, memory_, cycle_, lines_));
    }
    if (!options_.coverage_file.empty()) {
      dut_.write_coverage(options_.coverage_file);
    }
    return {failure_, cycles_, beats_, lines_};
  }

 private:
  /// Resets, and runs the workload from its start to its end, or to a cycle.
  void round(std::uint64_t cut) {
    in_.reset = true;
    in_.beat_valid = in_.slot_write = in_.fill_valid = in_.clear_valid = in_.flush = in_.beat_ready = false;
    in_.late_valid = false;
    for (std::uint64_t i = 0; i < kResetCycles; ++i) {
      dut_.settle(in_, out_);
      dut_.clock_edge();
    }
    in_.reset = false;
    memory_ = workload_.memory_before;
    log_ = {};
    log_.commands.resize(workload_.commands.size());
    scoreboard_.clear();
    updates_.clear();
    output_law_.clear();
    read_law_.clear();
    write_law_.clear();
    fills_.clear();
    shader_.clear();
    outstanding_.clear();
    command_ = beat_ = written_slots_ = 0;
    offered_ = waits_done_ = false;
    fill_free_ = quiet_ = idle_cycles_ = waited_ = 0;
    write_bytes_.clear();
    lines_done_ = 0;
    cycle_ = 0;
    while (!failure_ && quiet_ < kDrainCycles && (cut == 0 || cycle_ < cut)) {
      step();
    }
    if (!failure_ && cut == 0) {
      failure_ = scoreboard_.finish(cycle_);
      if (!failure_) {
        failure_ = updates_.finish(cycle_);
      }
    }
    log_.cycles = cycle_;
    cycles_ += cycle_;
    if (!failure_ && options_.timing && options_.memory == StallProfile::kNone) {
      failure_ = check_timing(shape_, options_.latency, workload_, log_, coverage_);
    }
  }

  void step() {
    source();
    memory_data();
    shader();
    in_.beat_ready = !stall_.stalled();
    in_.read_ready = in_.write_ready = !slow_.stalled();
    dut_.settle(in_, out_);
    bool valid = out_.beat_valid;
    if (options_.fault != ZFault::kNone) {
      valid = inject();
    }
    check(valid);
    update();
    requests();
    writes();
    accept();
    dut_.clock_edge();
    if (dut_.assertion_failed()) {
      fail(Failure{FailureKind::kAssertion, cycle_, "an assertion of the RTL failed: see its message above"});
    }
    quiet_ = command_ == workload_.commands.size() && scoreboard_.outstanding() == 0 ? quiet_ + 1 : 0;
    if (++idle_cycles_ > kDeadlockCycles) {
      fail(Failure{
          FailureKind::kDeadlock, cycle_,
          fmt::format("nothing moved for {} cycles, in command {} of {}, {} beats outstanding",
                      kDeadlockCycles, command_, workload_.commands.size(), scoreboard_.outstanding())});
    }
    ++cycle_;
  }

  /// What the source does in this cycle: triangles ahead of their bursts, one command after the other.
  void source() {
    const bool draw_idle = idle_.stalled();
    const std::size_t known = written_slots_;  // those written before this cycle
    in_.beat_valid = in_.clear_valid = in_.flush = in_.slot_write = false;
    if (command_ < workload_.commands.size() && !waits_done_) {
      const Command& command = workload_.commands[command_];
      CommandLog& log = log_.commands[command_];
      const bool may = command.kind != CommandKind::kBurst || command.triangle < known;
      if (!offered_ && may && !draw_idle && waited_++ >= command.wait) {
        offered_ = true;
        log.arrive = cycle_;
      }
      if (offered_ && command.kind == CommandKind::kBurst) {
        in_.beat_valid = true;
        in_.beat = command.beats[beat_];
        if (options_.fault == ZFault::kGap && beat_ == 1 && command_ >= options_.fault_packet) {
          in_.beat_valid = false;
        }
      } else if (offered_) {
        in_.clear_valid = command.kind == CommandKind::kClear;
        in_.flush = command.kind == CommandKind::kFlush;
        in_.clear_first = command.first;
        in_.clear_last = command.last;
      }
      ahead_ = command.kind == CommandKind::kBurst ? command.triangle + kSlotsAhead : ahead_;
    }
    if (written_slots_ < std::min(std::max(ahead_, kSlotsAhead), workload_.triangles.size())) {
      const TriangleWords& triangle = workload_.triangles[written_slots_];
      in_.slot_write = true;
      in_.slot = static_cast<std::uint8_t>(written_slots_);
      in_.equation = triangle.equation;
      in_.state = triangle.state;
      ++written_slots_;
    }
  }

  void accept() {
    if (command_ == workload_.commands.size()) {
      return;
    }
    const Command& command = workload_.commands[command_];
    CommandLog& log = log_.commands[command_];
    if (waits_done_) {
      const bool done = command.kind == CommandKind::kClear ? out_.clear_done : out_.flush_done;
      if (done) {
        log.done = true;
        log.done_at = cycle_;
        next_command(command);
      }
      return;
    }
    if (command.kind != CommandKind::kBurst) {
      if (offered_ && out_.idle) {
        log.begun = true;
        log.begin = cycle_;
        waits_done_ = true;
        idle_cycles_ = 0;
      }
      return;
    }
    if (beat_ == 0 && out_.beat_ready && log.ready_from == 0) {
      log.ready_from = cycle_;
    } else if (log.ready_from != 0 && !out_.beat_ready) {
      fail(Failure{FailureKind::kTiming, cycle_, "input ready withdrawn"});
    }
    if (!in_.beat_valid || !out_.beat_ready) {
      return;
    }
    idle_cycles_ = 0;
    if (beat_ == 0) {
      log.begun = true;
      log.begin = cycle_;
      for (const std::vector<std::uint32_t>& tested : command.tested) {
        scoreboard_.expect(tested);
        outstanding_.push_back(command_);
      }
      if (shape_.hi_z) {
        updates_.expect(command.update);
      }
    }
    if (++beat_ == command.beats.size()) {
      next_command(command);
    }
  }

  void next_command(const Command& command) {
    coverage_.command(command);
    ++command_;
    beat_ = 0;
    waited_ = 0;
    offered_ = waits_done_ = false;
    idle_cycles_ = 0;
  }

  void check(bool valid) {
    fail(output_law_.cycle(cycle_, valid, in_.beat_ready, out_.beat));
    fail(read_law_.cycle(cycle_, out_.read_valid, in_.read_ready,
                         std::array<std::uint32_t, 3>{out_.read_line, out_.read_half, out_.read_shift}));
    fail(write_law_.cycle(cycle_, out_.write_valid, in_.write_ready, out_.write));
    if (!valid) {
      return;
    }
    if (outstanding_.empty()) {
      fail(Failure{FailureKind::kExtra, cycle_, "a beat is valid, but none is expected"});
      return;
    }
    CommandLog& log = log_.commands[outstanding_.front()];
    if (log.valid_from.size() == log.taken.size()) {
      log.valid_from.push_back(cycle_);
    }
    if (in_.beat_ready) {
      log.taken.push_back(cycle_);
      const Command& command = workload_.commands[outstanding_.front()];
      outstanding_.pop_front();
      if (log.taken.size() == command.tested.size()) {
        shader_.take(command.late, cycle_);
      }
      fail(scoreboard_.receive(cycle_, out_.beat));
      ++beats_;
      idle_cycles_ = 0;
    }
  }

  void shader() {
    if (shader_.drive(in_, cycle_, log_.answers.size(), outstanding_.empty())) {
      const bool late = options_.fault == ZFault::kLateAnswer && log_.answers.size() >= options_.fault_packet;
      log_.answers.push_back(cycle_ - (late ? 1 : 0));
      idle_cycles_ = 0;
    }
  }

  /// What hi_z is told. A burst is known before its update, which comes after its test.
  void update() {
    if (!out_.update_valid) {
      return;
    }
    const bool here = log_.updates.size() == options_.fault_packet;
    if (here && options_.fault == ZFault::kFlipUpdate) {
      out_.update[0] ^= 1;
    }
    log_.updates.push_back(cycle_ + (here && options_.fault == ZFault::kLateUpdate ? 1 : 0));
    fail(updates_.receive(cycle_, out_.update));
  }

  void memory_data() {
    in_.fill_valid = false;
    if (fills_.empty() || cycle_ < fills_.front().first) {
      return;
    }
    Fill& fill = fills_.front();
    in_.fill_valid = true;
    in_.fill = fill.beats[cycle_ - fill.first];
    if (cycle_ - fill.first + 1 == fill.beats.size()) {
      fills_.pop_front();
    }
    if (fill_beats_++ >= options_.fault_packet) {
      in_.fill[0] ^= options_.fault == ZFault::kFlipFill ? 1u : 0u;
      in_.fill_valid = options_.fault != ZFault::kLoseFill;
    }
  }

  /// The data of a request is what memory holds in its cycle.
  void requests() {
    if (!out_.read_valid || !in_.read_ready) {
      return;
    }
    idle_cycles_ = 0;
    if (!is_next("request for", out_.read_line, log_.requests.size(), order_.read)) {
      return;
    }
    log_.requests.push_back({cycle_, out_.read_line});
    const std::vector<std::uint8_t>& line = memory_.at(out_.read_line);
    if (line.empty() || line.size() != whole(out_.read_line) >> out_.read_shift ||
        out_.read_half != is_half(out_.read_line)) {
      fail(Failure{FailureKind::kPayload, cycle_,
                   fmt::format("request for line {} of the wrong size", out_.read_line)});
      return;
    }
    Fill fill{.first = std::max(cycle_ + options_.latency, fill_free_), .beats = {}};
    const auto width = static_cast<std::size_t>(shape_.read_bytes);
    for (std::size_t at = 0; at < line.size(); at += width) {
      std::vector<std::uint32_t>& beat = fill.beats.emplace_back(in_.fill.size());
      for (std::size_t i = 0; i < width && at + i < line.size(); ++i) {
        insert_bits(beat, static_cast<int>(8 * i), 8, line[at + i]);
      }
    }
    fill_free_ = fill.first + fill.beats.size();
    fills_.push_back(std::move(fill));
  }

  void writes() {
    if (!out_.write_valid || !in_.write_ready) {
      return;
    }
    idle_cycles_ = 0;
    if (!is_next("write of", out_.write_line, lines_done_, order_.written)) {
      return;
    }
    log_.writes.push_back({cycle_, out_.write_line, out_.write_last});
    std::vector<std::uint8_t>& line = memory_.at(out_.write_line);
    const std::size_t bytes = whole(out_.write_line) >> out_.write_shift;
    const auto width = static_cast<std::size_t>(shape_.write_bytes);
    for (std::size_t i = 0; i < width && write_bytes_.size() < bytes; ++i) {
      write_bytes_.push_back(static_cast<std::uint8_t>(extract_bits(out_.write, static_cast<int>(8 * i), 8)));
    }
    if (write_beats_++ >= options_.fault_packet && options_.fault == ZFault::kFlipWrite) {
      write_bytes_.back() ^= 1;
    }
    if (out_.write_last != (write_bytes_.size() == bytes) || out_.write_half != is_half(out_.write_line)) {
      fail(Failure{FailureKind::kPayload, cycle_,
                   fmt::format("write of line {} of the wrong size", out_.write_line)});
    }
    if (out_.write_last) {
      line.swap(write_bytes_);
      write_bytes_.clear();
      ++lines_done_;
    }
  }

  /// Bytes of a line that is not coded.
  [[nodiscard]] std::size_t whole(std::uint32_t line) const { return workload_.memory_before[line].size(); }
  [[nodiscard]] bool is_half(std::uint32_t line) const {
    return whole(line) != static_cast<std::size_t>(shape_.line_bytes());
  }

  /// Whether memory is asked for what the cache of the model asks for next, whenever that is.
  bool is_next(const char* what, std::uint32_t line, std::size_t number,
               const std::vector<std::uint32_t>& expected) {
    if (number >= expected.size()) {
      fail(Failure{FailureKind::kExtra, cycle_, fmt::format("{} line {} that nobody needs", what, line)});
    } else if (line != expected[number]) {
      fail(Failure{FailureKind::kPayload, cycle_,
                   fmt::format("{} line {}, not {}, as number {}", what, line, expected[number], number)});
    }
    return number < expected.size() && line == expected[number];
  }

  /// Applies the fault to what the checkers and the unit see; returns whether a beat is valid.
  bool inject() {
    const bool here = out_.beat_valid && beats_ == options_.fault_packet;
    switch (options_.fault) {
      case ZFault::kFlipDepth:
        out_.beat[0] ^= here ? 1u : 0u;
        break;
      case ZFault::kFlipPassed:
        if (here) {
          const auto passed = std::ranges::find(fields_, "passed[0]", &FieldSlot::name);
          const auto one_quad = std::ranges::find(fields_, "passed", &FieldSlot::name);
          const int bit = passed != fields_.end() ? passed->lsb : one_quad->lsb;
          out_.beat[static_cast<std::size_t>(bit / 32)] ^= 1u << (bit % 32);
        }
        break;
      case ZFault::kDrop:
      case ZFault::kLate:
        if (here && !faulted_) {
          faulted_ = true;
          in_.beat_ready = options_.fault == ZFault::kDrop;
          EarlyZOutputs same;
          dut_.settle(in_, same);
          return false;
        }
        break;
      case ZFault::kChangePayload:
        if (beats_ >= options_.fault_packet && stalled_ && !faulted_) {
          faulted_ = true;
          out_.beat[0] ^= 1;
        }
        stalled_ = out_.beat_valid && !in_.beat_ready;
        break;
      case ZFault::kHoldRequest:
        if (out_.read_valid && log_.requests.size() == options_.fault_packet && !faulted_) {
          faulted_ = true;
          in_.read_ready = false;
          EarlyZOutputs same;
          dut_.settle(in_, same);
        }
        break;
      case ZFault::kNone:
      case ZFault::kFlipFill:
      case ZFault::kLoseFill:
      case ZFault::kFlipWrite:
      case ZFault::kFlipUpdate:
      case ZFault::kLateUpdate:
      case ZFault::kFlipKeep:
      case ZFault::kLateAnswer:
      case ZFault::kLoseAnswer:
      case ZFault::kExtraAnswer:
      case ZFault::kGap:
        break;
    }
    return out_.beat_valid;
  }

  /// The first failure counts.
  void fail(std::optional<Failure> failure) {
    if (!failure_) {
      failure_ = std::move(failure);
    }
  }

  EarlyZDut& dut_;
  const EarlyZShape& shape_;
  const Workload& workload_;
  const ZRunOptions& options_;
  ZCoverage& coverage_;
  std::vector<FieldSlot> fields_;
  Scoreboard scoreboard_;
  std::vector<FieldSlot> update_fields_;
  Scoreboard updates_;  ///< for hi_z
  HandshakeMonitor output_law_{"output"};
  HandshakeMonitor read_law_{"requests"};
  HandshakeMonitor write_law_{"writes"};
  Staller idle_;
  Staller stall_;
  Staller slow_;
  EarlyZInputs in_;
  EarlyZOutputs out_;
  std::vector<std::vector<std::uint8_t>> memory_;  ///< by line
  std::deque<Fill> fills_;
  std::uint64_t fill_free_ = 0;  ///< first cycle in which the read channel is free
  std::uint64_t fill_beats_ = 0;
  Shader shader_;
  MemoryOrder order_;
  std::size_t lines_done_ = 0;             ///< of them
  std::vector<std::uint8_t> write_bytes_;  ///< of the line that is written
  std::uint64_t write_beats_ = 0;
  std::size_t command_ = 0;
  std::size_t beat_ = 0;
  bool offered_ = false;
  std::uint64_t waited_ = 0;  ///< cycles, before it was offered
  bool waits_done_ = false;   ///< for a clear or a flush
  std::size_t written_slots_ = 0;
  std::size_t ahead_ = 0;
  std::deque<std::size_t> outstanding_;  ///< the commands of the beats expected
  RunLog log_;
  std::uint64_t cycle_ = 0;
  std::uint64_t cycles_ = 0;
  std::uint64_t beats_ = 0;
  std::uint64_t lines_ = 0;
  std::uint64_t quiet_ = 0;
  std::uint64_t idle_cycles_ = 0;
  bool faulted_ = false;
  bool stalled_ = false;
  std::optional<Failure> failure_;
};

}  // namespace

std::optional<ZFault> z_fault_by_name(const std::string& name) {
  static constexpr std::array<std::pair<const char*, ZFault>, 17> kNames = {
      {{"none", ZFault::kNone},
       {"flip-depth", ZFault::kFlipDepth},
       {"flip-passed", ZFault::kFlipPassed},
       {"drop", ZFault::kDrop},
       {"late", ZFault::kLate},
       {"change-payload", ZFault::kChangePayload},
       {"flip-fill", ZFault::kFlipFill},
       {"lose-fill", ZFault::kLoseFill},
       {"flip-write", ZFault::kFlipWrite},
       {"hold-request", ZFault::kHoldRequest},
       {"flip-update", ZFault::kFlipUpdate},
       {"late-update", ZFault::kLateUpdate},
       {"flip-keep", ZFault::kFlipKeep},
       {"late-answer", ZFault::kLateAnswer},
       {"lose-answer", ZFault::kLoseAnswer},
       {"extra-answer", ZFault::kExtraAnswer},
       {"gap", ZFault::kGap}}};
  const auto* const known = std::ranges::find(kNames, name, &std::pair<const char*, ZFault>::first);
  return known == kNames.end() ? std::nullopt : std::optional(known->second);
}

ZRunResult run_early_z(EarlyZDut& dut, const EarlyZShape& shape, const Workload& workload,
                       const ZRunOptions& options, ZCoverage& coverage) {
  return Run(dut, shape, workload, options, coverage).run();
}

}  // namespace halfspace::tb
