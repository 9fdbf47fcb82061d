#include "early_z/z_timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "halfspace/timing/contract.hpp"

namespace halfspace::tb {
namespace {

using Cycle = std::uint64_t;

constexpr Cycle kDecode = 5;      // a register, and those of z_decoder
constexpr Cycle kEncode = 7;      // and those of z_encoder
constexpr Cycle kFirstReady = 1;  // after reset ready comes from a register that has yet to see the credits

/// A term of a maximum: the first cycle that it allows.
struct Term {
  const char* name;
  Cycle cycle;
};

template <std::size_t N>
const Term& latest(const std::array<Term, N>& terms) {
  return *std::ranges::max_element(terms, {}, &Term::cycle);
}

class Contract {
 public:
  Contract(const EarlyZShape& shape, Cycle latency, const Workload& workload, const RunLog& log,
           ZCoverage& coverage)
      : shape_(shape), latency_(latency), workload_(workload), log_(log), coverage_(coverage) {}

  std::optional<Failure> check() {
    for (std::size_t i = 0; i < log_.commands.size() && !failure_ && !cut_; ++i) {
      const Command& command = workload_.commands[i];
      const CommandLog& seen = log_.commands[i];
      switch (command.kind) {
        case CommandKind::kBurst:
          burst(command, seen);
          break;
        case CommandKind::kClear:
          clear(command, seen);
          break;
        case CommandKind::kFlush:
          flush(command, seen);
          break;
      }
    }
    if (!failure_ && !cut_) {
      nothing_more();
    }
    return failure_;
  }

 private:
  void expect(const char* what, std::size_t number, Cycle wanted, Cycle seen, const char* reason) {
    if (!failure_ && wanted != seen) {
      failure_ = {FailureKind::kTiming, seen,
                  fmt::format("{} of burst {} in cycle {}, not {} ({})", what, number, seen, wanted, reason)};
    }
  }

  void burst(const Command& command, const CommandLog& seen) {
    const std::size_t k = test_last_.size();
    const auto pending = static_cast<std::size_t>(shape_.pending);
    const std::array<Term, 2> ready = {
        {{"lookup", lookup_next_}, {"pending", k < pending ? 0 : test_last_[k - pending] + 1}}};
    if (seen.ready_from != 0) {
      expect("ready", k, std::max(latest(ready).cycle, watched_from_), seen.ready_from, latest(ready).name);
    }
    if (!seen.begun) {
      cut_ = true;
      return;
    }
    const Cycle f = std::max({latest(ready).cycle, seen.arrive, kFirstReady});
    expect("first beat taken", k, f, seen.begin, "arrive or ready");
    coverage_.hit(fmt::format("f decided by {}", f == latest(ready).cycle ? latest(ready).name : "arrive"));
    const Cycle moved = f + static_cast<Cycle>(beats(command.quads, shape_.widths.QuadWidth));
    Cycle there = 0;
    Cycle resolve_next = f + 1;
    Cycle resolved = 0;  // the last part
    std::size_t fetched = 0;
    for (const ZMiss& miss : command.misses.parts()) {
      const auto buffers = static_cast<std::size_t>(shape_.misses);
      const std::size_t j = swaps_.size() + fetched;
      const bool waits = miss.fetch && j >= buffers;
      if (waits && j - buffers >= swaps_.size()) {
        failure_ = {FailureKind::kTiming, f, "a burst needs more fill buffers than there are"};
        return;
      }
      const auto out = out_.find(miss.line);
      const std::array<Term, 3> terms = {{{"order", resolve_next},
                                          {"leaving", out == out_.end() ? 0 : out->second + 1},
                                          {"fill buffers", waits ? swaps_[j - buffers] + 1 : 0}}};
      const Cycle r = latest(terms).cycle;
      coverage_.hit(fmt::format("r decided by {}", latest(terms).name));
      resolved = r;
      resolve_next = r + 1;
      if (!miss.fetch) {
        there = std::max(there, r);
        continue;
      }
      if (j >= log_.requests.size()) {
        cut_ = r >= log_.cycles;
        if (!cut_) {
          failure_ = {FailureKind::kTiming, r, fmt::format("request {} should come in cycle {}", j, r)};
        }
        return;
      }
      expect("request", k, r, log_.requests[j].cycle, latest(terms).name);
      if (!failure_ && log_.requests[j].line != miss.line) {
        failure_ = {FailureKind::kPayload, r,
                    fmt::format("request {} is for line {}, not {}", j, log_.requests[j].line, miss.line)};
      }
      filled_next_ = std::max(r + latency_, filled_next_) +
                     static_cast<Cycle>(transfer_cycles(miss.bytes, shape_.read_bytes));
      there = std::max(there, filled_next_ - 1 + static_cast<Cycle>(shape_.decode()));
      ++fetched;
    }
    lookup_next_ = std::max(moved, resolved);
    test(command, seen, k, f, there);
  }

  void test(const Command& command, const CommandLog& seen, std::size_t k, Cycle f, Cycle there) {
    std::size_t dirty = 0;
    for (const ZMiss& miss : command.misses.parts()) {
      dirty += miss.write_back ? 1 : 0;
    }
    const auto buffers = static_cast<std::size_t>(shape_.write_buffers);
    const std::size_t w = written_.size() + dirty;
    const auto fifo = static_cast<std::size_t>(shape_.fifo);
    if (k >= fifo && k - fifo >= sink_last_.size()) {
      cut_ = true;
      return;
    }
    std::optional<Cycle> late_next;
    const std::size_t late_done = command.misses.late_done;
    if (late_done > late_written_) {
      count_late_reasons(command, late_done);
      late_next = write_late(late_done, {"lookup", f + kLookupToTest}, {"test", test_next_});
      if (!late_next) {
        return;
      }
    }
    const std::array<Term, 6> terms = {
        {{"lookup", f + kLookupToTest},
         {"test", test_next_},
         {"late", late_next.value_or(0)},
         {"fill", command.misses.count == 0 ? 0 : there + 1},
         {"write buffer", dirty == 0 || w <= buffers ? 0 : written_[w - 1 - buffers] + 1},
         {"credit", k < fifo ? 0 : sink_last_[k - fifo] + 1}}};
    const Cycle b = latest(terms).cycle;
    coverage_.hit(fmt::format("b decided by {}", latest(terms).name));
    const auto beats = static_cast<Cycle>(halfspace::beats(command.quads, shape_.widths.TestWidth));
    test_next_ = b + beats;
    test_last_.push_back(b + beats - 1);
    if (shape_.hi_z) {
      update(k, b + beats - 1 + kTestToUpdate, latest(terms).name);
    }
    if (command.late.out) {
      late_.push_back({&command, beats});
    }
    for (const ZMiss& miss : command.misses.parts()) {
      if (miss.fetch) {
        swaps_.push_back(b);
      }
      if (miss.write_back) {
        write(b, miss.victim, miss.victim_bytes);
      }
      if (miss.victim != kNoZLine) {
        out_[miss.victim] = miss.write_back ? written_.back() : b;
      }
    }
    for (Cycle i = 0; i < beats && !failure_; ++i) {
      const Cycle wanted = std::max(b + kTestToSink + i, sink_next_);
      if (i >= seen.valid_from.size()) {
        cut_ = wanted >= log_.cycles;
        if (!cut_) {
          failure_ = {FailureKind::kTiming, wanted,
                      fmt::format("beat {} of burst {} should be valid since cycle {} ({})", i, k, wanted,
                                  latest(terms).name)};
        }
        return;
      }
      expect("beat valid", k, wanted, seen.valid_from[i], latest(terms).name);
      if (i >= seen.taken.size()) {
        cut_ = true;
        return;
      }
      sink_next_ = seen.taken[i] + 1;
    }
    sink_last_.push_back(sink_next_ - 1);
  }

  /// Which of the late writes that are out, up to number `end`, must be done before this burst, and why.
  void count_late_reasons(const Command& command, std::size_t end) {
    const Command& newest = *late_[end - 1].command;
    bool hit = false;
    bool replaced = false;
    for (const std::uint32_t line : newest.lines) {
      hit = hit || std::ranges::find(command.lines, line) != command.lines.end();
      replaced = replaced || std::ranges::find(command.misses.parts(), line, &ZMiss::victim) !=
                                 command.misses.parts().end();
    }
    coverage_.hit(hit        ? "late writes before a burst: line hit"
                  : replaced ? "late writes before a burst: line replaced"
                             : "late writes before a burst: queue full");
  }

  /// Late writes up to number `end`, not before `first` and `second`; gives the cycle after them, or nothing
  /// where the run ended before.
  std::optional<Cycle> write_late(std::size_t end, Term first, Term second) {
    Cycle order = 0;
    std::size_t together = 0;
    for (; late_written_ < end; ++late_written_) {
      if (late_written_ >= log_.answers.size()) {
        cut_ = true;
        return std::nullopt;
      }
      const std::array<Term, 4> terms = {
          {first, second, {"order", order}, {"shader", log_.answers[late_written_] + 1}}};
      const Term& d = latest(terms);
      coverage_.hit(fmt::format("d decided by {}", d.name));
      const LateBurst& late = late_[late_written_];
      coverage_.hit(fmt::format("late write beats {}", late.beats));
      together = d.cycle == order ? together + 1 : 1;
      if (together == 2) {
        coverage_.hit("late writes back to back");
      }
      order = d.cycle + late.beats;
    }
    return order;
  }

  void update(std::size_t k, Cycle wanted, const char* reason) {
    if (k < log_.updates.size()) {
      expect("update", k, wanted, log_.updates[k], reason);
    } else if (!failure_ && wanted < log_.cycles) {
      failure_ = {FailureKind::kTiming, wanted,
                  fmt::format("update of burst {} should come in cycle {} ({})", k, wanted, reason)};
    }
  }

  /// A line enters the write buffer in cycle `from`.
  void write(Cycle from, std::uint32_t line, std::uint32_t bytes) {
    const auto cycles = static_cast<Cycle>(transfer_cycles(static_cast<int>(bytes), shape_.write_bytes));
    const Cycle first =
        std::max(from + 1 + static_cast<Cycle>(shape_.encode()), written_.empty() ? 0 : written_.back() + 1);
    for (Cycle i = 0; i < cycles && !failure_; ++i, ++writes_seen_) {
      if (writes_seen_ >= log_.writes.size()) {
        if (first + i < log_.cycles) {
          failure_ = {FailureKind::kTiming, first + i,
                      fmt::format("line {} should be written in cycle {}", line, first + i)};
        }
        break;
      }
      const WriteLog& seen = log_.writes[writes_seen_];
      if (seen.cycle != first + i || seen.line != line || seen.last != (i + 1 == cycles)) {
        failure_ = {FailureKind::kTiming, seen.cycle,
                    fmt::format("line {} written in cycle {}, not line {} in cycle {}", seen.line, seen.cycle,
                                line, first + i)};
      }
    }
    written_.push_back(first + cycles - 1);
  }

  [[nodiscard]] Cycle idle() const {
    return std::max({lookup_next_, test_next_, sink_next_, written_.empty() ? 0 : written_.back() + 1,
                     control_next_, late_next_});
  }

  [[nodiscard]] const char* idle_reason() const { return idle() == late_next_ ? "late" : "idle"; }

  /// The late writes that are out, before a clear or a flush; false where the run ended before.
  bool drain_late(const CommandLog& seen, const char* what) {
    if (late_written_ == late_.size()) {
      return true;
    }
    coverage_.hit(fmt::format("late writes before a {}", what));
    const std::optional<Cycle> next =
        write_late(late_.size(), {"offered", seen.arrive},
                   {"stages", std::max({lookup_next_, test_next_, control_next_})});
    late_next_ = next.value_or(0);
    return next.has_value();
  }

  void clear(const Command& command, const CommandLog& seen) {
    if (!seen.begun) {
      cut_ = true;
      return;
    }
    if (!drain_late(seen, "clear")) {
      return;
    }
    const Cycle begin = std::max(idle(), seen.arrive);
    expect("clear before burst", test_last_.size(), begin, seen.begin, idle_reason());
    const auto tiles = static_cast<Cycle>(command.last - command.first + 1);
    const auto width = static_cast<Cycle>(shape_.clear_tiles);
    control_next_ = begin + std::max((tiles + width - 1) / width, static_cast<Cycle>(shape_.sets()));
    if (seen.done) {
      expect("clear done before burst", test_last_.size(), control_next_, seen.done_at, "tiles or sets");
      watched_from_ = seen.done_at + 1;
    }
  }

  void flush(const Command& command, const CommandLog& seen) {
    if (!seen.begun) {
      cut_ = true;
      return;
    }
    if (!drain_late(seen, "flush")) {
      return;
    }
    Cycle scan_next = std::max(idle(), seen.arrive);
    expect("flush before burst", test_last_.size(), scan_next, seen.begin, idle_reason());
    std::uint32_t looked_at = 0;
    for (const FlushedLine& line : command.flushed) {
      const auto buffers = static_cast<std::size_t>(shape_.write_buffers);
      const Cycle next = scan_next + (line.slot - looked_at);
      const Cycle free = written_.size() < buffers ? 0 : written_[written_.size() - buffers] + 1;
      if (free > next) {
        coverage_.hit("flush waits for the write buffer");
      }
      const Cycle scan = std::max(next, free);
      scan_next = scan + 1;
      looked_at = line.slot + 1;
      write(scan, line.line, line.bytes);
    }
    control_next_ = scan_next + (static_cast<std::uint32_t>(shape_.lines) - looked_at);
    if (seen.done) {
      expect("flush done before burst", test_last_.size(), idle(), seen.done_at, "scan and writes");
      watched_from_ = seen.done_at + 1;
    }
  }

  void nothing_more() {
    if (log_.requests.size() != swaps_.size()) {
      failure_ = {FailureKind::kTiming, log_.requests[swaps_.size()].cycle, "a request that nobody needs"};
    } else if (log_.writes.size() != writes_seen_) {
      failure_ = {FailureKind::kTiming, log_.writes[writes_seen_].cycle, "a write that nobody needs"};
    }
  }

  const EarlyZShape& shape_;
  Cycle latency_;
  const Workload& workload_;
  const RunLog& log_;
  ZCoverage& coverage_;
  std::optional<Failure> failure_;
  bool cut_ = false;  ///< the run ended here

  Cycle lookup_next_ = 0;
  Cycle filled_next_ = 0;
  Cycle test_next_ = 0;
  Cycle sink_next_ = 0;
  Cycle control_next_ = 0;
  Cycle watched_from_ = kFirstReady;  ///< the source looks at ready only after the clear or flush before
  std::vector<Cycle> test_last_;      ///< by burst
  std::vector<Cycle> sink_last_;
  std::vector<Cycle> swaps_;    ///< by request
  std::vector<Cycle> written_;  ///< by write-back
  std::map<std::uint32_t, Cycle> out_;
  std::size_t writes_seen_ = 0;
  struct LateBurst {
    const Command* command;
    Cycle beats;
  };
  std::vector<LateBurst> late_;   ///< of all so far, in order
  std::size_t late_written_ = 0;  ///< of them
  Cycle late_next_ = 0;           ///< behind those before a clear or a flush
};

}  // namespace

std::optional<Failure> check_timing(const EarlyZShape& shape, std::uint64_t latency, const Workload& workload,
                                    const RunLog& log, ZCoverage& coverage) {
  return Contract(shape, latency, workload, log, coverage).check();
}

}  // namespace halfspace::tb
