/// The timing contract (docs/timing.md and the *Cycles* of each unit's page) as arithmetic on packets.
///
/// All times are exclusive ends or first cycles: `..._next_` is the first cycle in which a stage could take
/// another packet. TimePolicy says what a time is: OneMachine, or one with a machine a lane; it has Time, for
/// which later() and + must exist, Credits of a FIFO, and a Table of times. Probe sees every term (NoProbe:
/// nobody looks).
///
/// A header in the manner of Highway: read once for each processor the code is compiled for, so that the
/// lanes' instructions can be inlined. For one machine include core.hpp.
#if defined(HALFSPACE_RECURRENCE_CORE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_RECURRENCE_CORE_INL
#undef HALFSPACE_RECURRENCE_CORE_INL
#else
#define HALFSPACE_RECURRENCE_CORE_INL
#endif

#include <hwy/highway.h>

#include <bit>
#include <span>
#include <utility>

#include "halfspace/machine/packet_stream.hpp"
#include "halfspace/timing/cycle_stats.hpp"
#include "halfspace/timing/recurrence/machine.hpp"
#include "halfspace/timing/stall_plan.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::HWY_NAMESPACE {

struct NoProbe {
  static constexpr bool kLooks = false;
};

/// A plan for those who inject nothing.
struct NoStalls {
  [[nodiscard]] static constexpr std::uint32_t cycles(StallPoint /*point*/, std::uint64_t /*n*/) { return 0; }
};

template <class TimePolicy, class Stalls, class Probe>
class RecurrenceCore {
 public:
  using T = typename TimePolicy::Time;
  using CreditsT = typename TimePolicy::Credits;
  using Fifos = std::array<CreditsT, kFifos>;

  RecurrenceCore(const Machine<T>& machine, Fifos&& fifos, const Stalls& stalls, Probe& probe)
      : machine_(machine), fifos_(std::move(fifos)), stalls_(stalls), probe_(probe) {}

  /// `memory_lines`: of all surfaces.
  void start(std::uint32_t memory_lines) { out_ = typename TimePolicy::Table(memory_lines); }

  void dropped() {
    const T head = cull();
    const T decide = later(head, decide_next_);
    if constexpr (Probe::kLooks) {
      decided(head, head, decide);
    }
    decide_next_ = decide + 1;
    fifo(Fifo::kSetupQueue).give(decide_next_);
  }

  void drawn() {
    const T head = cull();
    const T divider = later(head, divider_next_);
    const T decide = later(later(divider, decide_next_), fifo(Fifo::kSetup).usable());
    if constexpr (Probe::kLooks) {
      decided(head, divider, decide);
    }
    decide_next_ = decide + 1;
    divider_next_ = decide + machine_.setup_interval;
    fifo(Fifo::kSetupQueue).give(decide_next_);
    const T visible = decide + (machine_.setup_latency + stall(StallPoint::kSetup, triangles_));
    ++triangles_;
    const T taken = later(visible + 1, walk_next_);  // the cycle after accept
    if constexpr (Probe::kLooks) {
      probe_.link(Link::kSetup, decide, taken);
      if (taken > walk_next_) {
        probe_.template split<2>(Stage::kTileWalker, walk_next_, {taken - 1, taken}, 0);
      }
      probe_.note(&PacketTimes::accept, taken - 1);
    }
    fifo(Fifo::kSetup).give(taken);
    walk_next_ = taken;
  }

  void job(const JobWork& work) {
    const T stepped = walk_next_ + machine_.step_interval * work.steps;
    const T emit_next = later(stepped, fifo(Fifo::kTileWalker).usable() + 1);
    const T e =
        later(later(emit_next + (kWalkerLatency - 1 + stall(StallPoint::kTileWalker, jobs_)), e_next_),
              fifo(Fifo::kEdgeEvaluator).usable());
    const T coverage = e + machine_.edge_latency + stall(StallPoint::kEdgeEvaluator, jobs_);
    const T g = later(later(coverage, g_next_), fifo(Fifo::kQuadGenerator).usable());
    if constexpr (Probe::kLooks) {
      const T visible = emit_next + (kWalkerLatency - 1 + stall(StallPoint::kTileWalker, jobs_));
      probe_.link(Link::kTileWalker, emit_next - 1, e + 1);
      probe_.busy(Stage::kTileWalker, walk_next_, stepped);
      probe_.wait(Stage::kTileWalker, stall::kWalkerNoCredit, stepped, emit_next);
      probe_.note(&PacketTimes::emit, emit_next - 1);
      probe_.link(Link::kEdgeEvaluator, e, g + 1);
      probe_.template split<2>(Stage::kEdgeEvaluator, e_next_, {visible, e}, 1);
      probe_.note(&PacketTimes::e, e);
      probe_.template split<2>(Stage::kQuadGenerator, g_next_, {coverage, g},
                               work.quads == 0 ? T(1) : beats_of(work));
      probe_.note(&PacketTimes::g, g);
    }
    ++jobs_;
    walk_next_ = emit_next;
    e_next_ = e + 1;
    fifo(Fifo::kTileWalker).give(e_next_);
    fifo(Fifo::kEdgeEvaluator).give(g + 1);
    if (work.quads == 0) {
      g_next_ = g + 1;
      return;
    }
    g_next_ = g + beats_of(work);
    burst(work, g);
  }

  /// The triangle is done after so many more steps.
  void walked(std::uint32_t steps) {
    const T done = walk_next_ + machine_.step_interval * steps;
    if constexpr (Probe::kLooks) {
      probe_.busy(Stage::kTileWalker, walk_next_, done);
    }
    walk_next_ = done;
  }

  /// `cycles`: of the clear itself.
  void fast_clear(T cycles) {
    clear_next_ = idle() + cycles;
    cull_next_ = later(cull_next_, clear_next_);
  }

  /// Writes back the dirty lines of the z cache, which has `lines`, and gives the cycles of the frame.
  T flush(std::span<const ZFlush> dirty, std::uint32_t lines) {
    T scan_next = idle();
    std::uint32_t seen = 0;
    for (const ZFlush& line : dirty) {
      const T scan = later(scan_next + (line.slot - seen), fifo(Fifo::kWriteBuffers).usable());
      scan_next = scan + 1;
      seen = line.slot + 1;
      write(scan_next, line.bytes);
    }
    return later(later(scan_next + (lines - seen), written_next_), y_next_);
  }

  /// First cycle of beat 0 of the last burst at the sink.
  [[nodiscard]] T sink_start() const { return y_; }
  /// Cycle after the last beat of all bursts at the sink.
  [[nodiscard]] T sink_next() const { return y_next_; }

 private:
  using Misses = std::span<const ZMiss>;

  [[nodiscard]] CreditsT& fifo(Fifo which) { return fifos_[static_cast<std::size_t>(which)]; }
  [[nodiscard]] const T& beats_of(const JobWork& work) const {
    return machine_.quad_beats[static_cast<std::size_t>(work.quads)];
  }
  [[nodiscard]] auto stall(StallPoint point, std::uint64_t n) const { return stalls_.cycles(point, n); }
  static std::size_t log2_bytes(std::uint32_t bytes) {
    return static_cast<std::size_t>(std::countr_zero(bytes));
  }

  /// Takes the next triangle from the source; gives the cycle in which its verdict is at the queue's head.
  T cull() {
    const T c = later(cull_next_ + stall(StallPoint::kSource, culled_), fifo(Fifo::kSetupQueue).usable());
    ++culled_;
    cull_next_ = c + 1;
    return c + kSetupCullLatency;
  }

  /// Tells of a decision: the verdict was at the queue's head in `head`, and the divider free in `divider`.
  void decided(const T& head, const T& divider, const T& decide) {
    probe_.link(Link::kSetupQueue, cull_next_ - 1, decide + 1);
    probe_.template split<3>(Stage::kSetup, decide_next_, {head, divider, decide}, 1);
    probe_.note(&PacketTimes::decide, decide);
  }

  /// Tells of a missing part that could be resolved from `ready` on: it was out of the cache from `out` on,
  /// and resolved in `r`, when a fill buffer was free. Of these cycles those count in which no beat moves any
  /// more, from `moved` on. In that of the last part the next burst may be taken already: it is not this
  /// one's.
  void resolved(const T& moved, const T& ready, const T& out, const T& r, bool last) {
    const auto after = [&moved](const T& cycle) { return later(cycle, moved); };
    probe_.wait(Stage::kZLookup, stall::kLookupWriteBack, after(ready), after(out));
    probe_.wait(Stage::kZLookup, stall::kLookupFillBuffers, after(out), after(r));
    probe_.wait(Stage::kZLookup, stall::kLookupRequest, after(r), after(last ? r : r + 1));
  }

  /// The first cycle in which no stage, no write to memory and no clear has anything left to do.
  [[nodiscard]] T idle() const {
    return later(later(later(decide_next_, walk_next_), later(e_next_, g_next_)),
                 later(later(f_next_, b_next_), later(y_next_, later(clear_next_, written_next_))));
  }

  void burst(const JobWork& work, const T& g) {
    const T visible = g + (kQuadLatency + stall(StallPoint::kQuadGenerator, bursts_));
    const T f = later(later(visible, f_next_), fifo(Fifo::kEarlyZPending).usable());
    const T moved = f + beats_of(work);
    if constexpr (Probe::kLooks) {
      probe_.link(Link::kQuadGenerator, g, moved);
      probe_.template split<2>(Stage::kZLookup, f_next_, {visible, f}, moved - f);
      probe_.note(&PacketTimes::f, f);
    }
    fifo(Fifo::kQuadGenerator).give(moved);
    f_next_ = moved;
    const Misses misses = work.misses;
    const T filled_next = misses.empty() ? T{} : resolve(misses, f, moved);
    const T slots = misses.empty() ? T{} : write_slots(misses);
    const T b = later(later(later(f + machine_.lookup_latency, b_next_), later(filled_next, slots)),
                      fifo(Fifo::kEarlyZ).usable());
    const T beats = machine_.test_beats[static_cast<std::size_t>(work.quads)];
    if constexpr (Probe::kLooks) {
      probe_.link(Link::kEarlyZPending, f, b + beats);
      probe_.template split<4>(Stage::kZTest, b_next_, {f + machine_.lookup_latency, filled_next, slots, b},
                               beats);
      probe_.note(&PacketTimes::b, b);
    }
    b_next_ = b + beats;
    fifo(Fifo::kEarlyZPending).give(b_next_);
    if (!misses.empty()) {
      swap(misses, b);
    }
    y_ = later(b + (kTestLatency + stall(StallPoint::kSink, bursts_)), y_next_);
    y_next_ = y_ + beats;
    fifo(Fifo::kEarlyZ).give(y_next_);
    if constexpr (Probe::kLooks) {
      probe_.link(Link::kEarlyZ, b, y_next_);
      probe_.burst_left(y_next_);
      probe_.note(&PacketTimes::y, y_);
    }
    ++bursts_;
  }

  /// Resolves the missing parts, one after the other, and sends the requests of those to fetch; gives the
  /// cycle from which on all of them are there.
  T resolve(Misses misses, const T& f, const T& moved) {
    T resolve_next = f + 1;
    T there{};
    T last{};
    std::size_t sent = 0;
    for (const ZMiss& part : misses) {
      const T out = later(resolve_next, out_.get(part.line));
      const T r = part.fetch ? later(out, fifo(Fifo::kFillBuffers).usable(sent)) : out;
      if constexpr (Probe::kLooks) {
        resolved(moved, resolve_next, out, r, &part == &misses.back());
      }
      last = r;
      resolve_next = r + 1;
      if (!part.fetch) {
        there = later(there, resolve_next);
        continue;
      }
      ++sent;
      there = later(r + machine_.memory_latency, filled_next_) + machine_.read_cycles[log2_bytes(part.bytes)];
      filled_next_ = there;
      if constexpr (Probe::kLooks) {
        probe_.read(machine_.read_cycles[log2_bytes(part.bytes)], there);
      }
    }
    f_next_ = later(moved, last);
    return there;
  }

  /// The cycle from which on all dirty victims find a slot of the write buffer.
  [[nodiscard]] T write_slots(Misses misses) {
    T slots{};
    std::size_t wanted = 0;
    for (const ZMiss& part : misses) {
      if (part.write_back) {
        slots = fifo(Fifo::kWriteBuffers).usable(wanted++);
      }
    }
    return slots;
  }

  /// Lines move in cycle b: fill buffers become free, victims leave.
  void swap(Misses misses, const T& b) {
    const T after = b + 1;
    for (const ZMiss& part : misses) {
      if (part.fetch) {
        fifo(Fifo::kFillBuffers).give(after);
      }
      if (part.write_back) {
        write(after, part.victim_bytes);
      }
      if (part.victim != kNoZLine) {
        out_.set(part.victim, part.write_back ? written_next_ : after);
      }
    }
  }

  /// A line enters the write buffer and may move to memory from cycle `from` on.
  void write(const T& from, std::uint32_t bytes) {
    const T cycles = machine_.write_cycles[log2_bytes(bytes)];
    written_next_ = later(from, written_next_) + cycles;
    fifo(Fifo::kWriteBuffers).give(written_next_);
    if constexpr (Probe::kLooks) {
      probe_.write(cycles, written_next_);
    }
  }

  Machine<T> machine_;
  Fifos fifos_;
  Stalls stalls_;
  Probe& probe_;
  typename TimePolicy::Table out_;  ///< by line of memory: first cycle in which it may be asked for again

  T cull_next_{};
  T decide_next_{};
  T divider_next_{};
  T walk_next_{};
  T e_next_{};
  T g_next_{};
  T f_next_{};
  T filled_next_{};
  T b_next_{};
  T written_next_{};
  T y_{};
  T y_next_{};
  T clear_next_{};

  std::uint64_t culled_ = 0;
  std::uint64_t triangles_ = 0;
  std::uint64_t jobs_ = 0;
  std::uint64_t bursts_ = 0;
};

}  // namespace halfspace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
