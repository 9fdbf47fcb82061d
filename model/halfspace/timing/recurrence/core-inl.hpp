/// The timing contract (docs/timing.md and the *Cycles* of each unit's page) as arithmetic on packets.
///
/// All times are exclusive ends or first cycles: `..._next_` is the first cycle in which a stage could take
/// another packet. TimePolicy says what a time is: OneMachine, or one with a machine a lane. It has Time, for
/// which later() and + must exist, Credits of a FIFO, and a Table of times; SetupTime and SetupCredits, the
/// same for setup, which may be far ahead or behind; and a Clock, which says what the first cycle of Time is.
/// Probe sees every term (NoProbe: nobody looks).
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

#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include "halfspace/machine/packet_stream.hpp"
#include "halfspace/timing/cycle_stats.hpp"
#include "halfspace/timing/recurrence/interpolation-inl.hpp"
#include "halfspace/timing/recurrence/machine.hpp"
#include "halfspace/timing/stall_plan.hpp"
#include "halfspace/units/hi_z.hpp"

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
  static constexpr bool kInterpolates = TimePolicy::kInterpolates;
  using T = typename TimePolicy::Time;
  using S = typename TimePolicy::SetupTime;
  using Clock = typename TimePolicy::Clock;
  using Memory = RecurrenceMemory<TimePolicy>;

  /// `memory` must outlive the core.
  HWY_INLINE RecurrenceCore(Memory& memory, const Stalls& stalls, Probe& probe)
      : memory_(&memory), stalls_(stalls), probe_(&probe) {}

  HWY_INLINE void dropped() {
    const S head = cull();
    const S decide = later(head, decide_next_);
    if constexpr (Probe::kLooks) {
      decided(head, head, decide);
    }
    decide_next_ = decide + 1;
    fifo<Fifo::kSetupQueue>().give(culled_++, decide_next_);
  }

  HWY_INLINE void drawn() {
    const S head = cull();
    const S divider = later(head, divider_next_);
    const S decide = later(later(divider, decide_next_), fifo<Fifo::kSetup>().usable(triangles_));
    if constexpr (Probe::kLooks) {
      decided(head, divider, decide);
    }
    decide_next_ = decide + 1;
    divider_next_ = decide + machine().setup_interval;
    fifo<Fifo::kSetupQueue>().give(culled_++, decide_next_);
    const S visible = decide + (machine().setup_latency + stall(StallPoint::kSetup, triangles_));
    const S taken = later(visible + 1, clock_.setup(block_next_));  // the cycle after accept
    if constexpr (Probe::kLooks) {
      probe_->link(Link::kSetup, triangles_, decide, taken);
      if (taken > block_next_) {
        probe_->template split<2>(Stage::kBlockWalker, block_next_, {taken - 1, taken}, 0);
      }
      probe_->note(&PacketTimes::accept, taken - 1);
    }
    fifo<Fifo::kSetup>().give(triangles_++, taken);
    block_next_ = near(taken);
  }

  /// A block job, after `empty_before` blocks without a tile, of which hi_z leaves `jobs` tiles; where it
  /// leaves some, their jobs follow, then block_done().
  HWY_INLINE void block(std::uint32_t empty_before, int jobs) { hi_z_leaves(take_block(empty_before), jobs); }

  /// The same in two steps, for who decides what hi_z leaves when it knows the cycle in which hi_z takes the
  /// block. The first gives that, where the machine has hi_z.
  HWY_INLINE T take_block(std::uint32_t empty_before) {
    block_begun_ = steps(empty_before);
    block_next_ = block_begun_ + 1;
    block_visible_ = block_begun_ + (kBlockLatency + stall(StallPoint::kBlockWalker, blocks_));
    if constexpr (Probe::kLooks) {
      probe_->busy(Stage::kBlockWalker, block_begun_, block_next_);
      probe_->note(&PacketTimes::block, block_begun_);
    }
    return memory_->hi_z_lag ? hi_z() : T{};
  }

  HWY_INLINE void hi_z_leaves(const T& h, int jobs) {
    if (!memory_->hi_z_lag) {
      return;
    }
    hi_z_out_ = h + (jobs == 0 ? kHiZLatency - 1 : 1);
    std::shift_left(left_before_.begin(), left_before_.end(), 1);
    left_before_.back() = {.jobs = jobs_ + static_cast<std::uint64_t>(jobs),
                           .blocks = passed_ + (jobs != 0 ? 1 : 0)};
  }

  /// hi_z has seen the first `jobs`, whatever its lag.
  HWY_INLINE void hi_z_has_seen(std::uint64_t jobs) { seen_ = std::max(seen_, jobs); }

  HWY_INLINE void block_done() {
    if (memory_->hi_z_lag) {
      if constexpr (Probe::kLooks) {
        probe_->link(Link::kHiZ, passed_, hi_z_next_ - 1, tile_next_);
      }
      fifo<Fifo::kHiZ>().give(passed_++, tile_next_);
    } else {
      block_left(tile_next_);
    }
  }

  HWY_INLINE void job(const JobWork& work) {
    const T x = later(later(block_visible_, tile_next_), fifo<Fifo::kTileWalker>().usable(jobs_));
    const T visible = x + (kTileLatency + stall(StallPoint::kTileWalker, jobs_));
    const T e = later(later(visible, e_next_), fifo<Fifo::kEdgeEvaluator>().usable(jobs_));
    const T coverage = e + machine().edge_latency + stall(StallPoint::kEdgeEvaluator, jobs_);
    const T g = later(later(coverage, g_next_), fifo<Fifo::kQuadGenerator>().usable(bursts_));
    if constexpr (Probe::kLooks) {
      probe_->link(Link::kTileWalker, jobs_, x, e + 1);
      probe_->template split<2>(Stage::kTileWalker, tile_next_, {block_visible_, x}, 1);
      probe_->note(&PacketTimes::emit, x);
      probe_->link(Link::kEdgeEvaluator, jobs_, e, g + 1);
      probe_->template split<2>(Stage::kEdgeEvaluator, e_next_, {visible, e}, 1);
      probe_->note(&PacketTimes::e, e);
      probe_->template split<2>(Stage::kQuadGenerator, g_next_, {coverage, g},
                                work.quads == 0 ? T(1) : beats_of(work));
      probe_->note(&PacketTimes::g, g);
    }
    const std::uint64_t number = jobs_;
    tile_next_ = x + 1;
    e_next_ = e + 1;
    fifo<Fifo::kTileWalker>().give(jobs_, e_next_);
    fifo<Fifo::kEdgeEvaluator>().give(jobs_++, g + 1);
    if (work.quads == 0) {
      g_next_ = g + 1;
      retire(number, g + kHiZEmptyLatency);
      return;
    }
    g_next_ = g + beats_of(work);
    burst(work, g);
    retire(number, b_next_ + (kHiZUpdateLatency - 1));
  }

  /// The triangle is done after so many more blocks without a tile.
  HWY_INLINE void walked(std::uint32_t empty_after) {
    if (empty_after != 0) {
      block_next_ = steps(empty_after);
    }
  }

  /// `cycles`: of the clear itself.
  HWY_INLINE void fast_clear(S cycles) {
    write_all_late();
    clear_next_ = drained() + cycles;
    cull_next_ = later(cull_next_, clear_next_);
  }

  /// Writes back the dirty lines of the z cache, which has `lines`, and gives the cycles of the frame.
  HWY_INLINE S flush(std::span<const ZFlush> dirty, std::uint32_t lines) {
    write_all_late();
    if constexpr (Probe::kLooks) {
      tell_of_late();
    }
    T scan_next = later(near(idle()), hi_z_out_);
    std::uint32_t seen = 0;
    for (const ZFlush& line : dirty) {
      scan_next = keep_near(scan_next);
      const T scan = later(scan_next + (line.slot - seen), fifo<Fifo::kWriteBuffers>().usable(writes_));
      scan_next = scan + 1;
      seen = line.slot + 1;
      write(scan_next, line.bytes);
    }
    return later(clock_.setup(scan_next + (lines - seen)),
                 clock_.setup(later(written_next_, shaded_.taken_next(y_next_))));
  }

  /// What the probe wants to know where a draw ends.
  [[nodiscard]] Progress<T> progress() const {
    return {.free = {decide_next_, block_next_, hi_z_next_, tile_next_, e_next_, g_next_, f_next_, b_next_,
                     kInterpolates ? y_next_ : T{}},
            .sink_next = shaded_.taken_next(y_next_),
            .packets = {culled_, triangles_, blocks_, passed_, jobs_, jobs_, bursts_, bursts_, bursts_,
                        shaded_.packets()}};
  }

  /// First cycle of beat 0 of the last burst at the sink.
  [[nodiscard]] T sink_start() const { return y_; }
  /// Cycle after the last beat of all bursts at the sink.
  [[nodiscard]] HWY_INLINE S sink_next() const { return clock_.last(y_next_, y_last_); }

  // Where times are narrow, they count from a cycle that moves on: see TimePolicy::Clock.

  /// To be called so often that no time grows beyond the width from one call to the next.
  HWY_INLINE void keep_near() { block_next_ = keep_near(block_next_); }
  /// A time was beyond the width: nothing that the core says is true.
  [[nodiscard]] bool lost() const { return lost_; }

 private:
  using Misses = std::span<const ZMiss>;

  template <Fifo kWhich>
  [[nodiscard]] HWY_INLINE auto& fifo() {
    constexpr auto kAt = static_cast<std::size_t>(kWhich);
    if constexpr (kAt < kSetupFifos) {
      return memory_->setup_fifos[kAt];
    } else {
      return memory_->fifos[kAt - kSetupFifos];
    }
  }
  [[nodiscard]] HWY_INLINE const auto& machine() const { return memory_->machine; }
  [[nodiscard]] const T& beats_of(const JobWork& work) const {
    return machine().quad_beats[static_cast<std::size_t>(work.quads)];
  }
  [[nodiscard]] auto stall(StallPoint point, std::uint64_t n) const { return stalls_.cycles(point, n); }
  static std::size_t log2_bytes(std::uint32_t bytes) {
    return static_cast<std::size_t>(std::countr_zero(bytes));
  }

  /// Takes the next triangle from the source; gives the cycle in which its verdict is at the queue's head.
  HWY_INLINE S cull() {
    const S c =
        later(cull_next_ + stall(StallPoint::kSource, culled_), fifo<Fifo::kSetupQueue>().usable(culled_));
    cull_next_ = c + 1;
    return c + kSetupCullLatency;
  }

  /// The block leaves the walker's FIFO, in the cycle before `next`.
  HWY_INLINE void block_left(const T& next) {
    if constexpr (Probe::kLooks) {
      probe_->link(Link::kBlockWalker, blocks_, block_begun_, next);
    }
    fifo<Fifo::kBlockWalker>().give(blocks_++, next);
  }

  /// hi_z takes the block, when all that it must see has been applied, one job a cycle; gives the cycle.
  HWY_INLINE T hi_z() {
    const T& visible = block_visible_;
    const T updated = see(hi_z_must_see(left_before_.front().jobs, *memory_->hi_z_lag, seen_), hi_z_next_);
    const T h = later(later(later(visible, hi_z_next_), updated),
                      fifo<Fifo::kHiZ>().usable(left_before_[kDecided].blocks + kHiZUndecided));
    if constexpr (Probe::kLooks) {
      probe_->template split<3>(Stage::kHiZ, hi_z_next_, {visible, updated, h}, 1);
      probe_->note(&PacketTimes::hi_z, h);
    }
    hi_z_next_ = h + 1;
    block_left(hi_z_next_);
    block_visible_ = h + (kHiZLatency + stall(StallPoint::kHiZ, passed_));
    return h;
  }

  /// Applies jobs up to number `end`, from cycle `from` on; gives the cycle of the last.
  HWY_INLINE T see(std::uint64_t end, const T& from) {
    T updated{};
    for (; seen_ != end; ++seen_) {
      updated = later(later(memory_->retired.get(static_cast<std::uint32_t>(seen_ % kHiZRing)), update_next_),
                      from);
      update_next_ = updated + 1;
    }
    return updated;
  }

  /// Job `number` can be seen by hi_z from cycle `at` on.
  HWY_INLINE void retire(std::uint64_t number, const T& at) {
    if (memory_->hi_z_lag) {
      memory_->retired.set(static_cast<std::uint32_t>(number % kHiZRing), at);
    }
  }

  /// The first cycle in which nothing is left to do, and hi_z has seen all.
  HWY_INLINE S drained() {
    const S at = idle();
    if (!memory_->hi_z_lag) {
      return at;
    }
    // What the next block must see is applied at once, the rest when nothing else is left to do.
    see(hi_z_must_see(left_before_.front().jobs, *memory_->hi_z_lag, seen_), hi_z_next_);
    const T idle_from = near(at);
    const T from = later(idle_from, hi_z_out_);
    see(jobs_, from + 1);
    left_before_.fill({.jobs = jobs_, .blocks = passed_});
    return clock_.setup(later(from, update_next_));
  }

  /// So many blocks without a tile; gives the cycle after them. Each step waits for the credit of the next
  /// job.
  HWY_INLINE T steps(std::uint32_t empty) {
    const T begun = later(block_next_, fifo<Fifo::kBlockWalker>().usable(blocks_));
    const T next = begun + empty;
    if constexpr (Probe::kLooks) {
      probe_->wait(Stage::kBlockWalker, stall::kBlockNoCredit, block_next_, begun);
      probe_->busy(Stage::kBlockWalker, begun, next);
    }
    return next;
  }

  /// Tells of a decision: the verdict was at the queue's head in `head`, and the divider free in `divider`.
  void decided(const S& head, const S& divider, const S& decide) {
    probe_->link(Link::kSetupQueue, culled_, cull_next_ - 1, decide + 1);
    probe_->template split<3>(Stage::kSetup, decide_next_, {head, divider, decide}, 1);
    probe_->note(&PacketTimes::decide, decide);
  }

  /// Tells of a missing part that could be resolved from `ready` on: it was out of the cache from `out` on,
  /// and resolved in `r`, when a fill buffer was free. Of these cycles those count in which no beat moves any
  /// more, from `moved` on. In that of the last part the next burst may be taken already: it is not this
  /// one's.
  void resolved(const T& moved, const T& ready, const T& out, const T& r, bool last) {
    const auto after = [&moved](const T& cycle) { return later(cycle, moved); };
    probe_->wait(Stage::kZLookup, stall::kLookupWriteBack, after(ready), after(out));
    probe_->wait(Stage::kZLookup, stall::kLookupFillBuffers, after(out), after(r));
    probe_->wait(Stage::kZLookup, stall::kLookupRequest, after(r), after(last ? r : r + 1));
  }

  /// The first cycle in which no stage, no write to memory and no clear has anything left to do.
  [[nodiscard]] HWY_INLINE S idle() const {
    return later(later(decide_next_, clear_next_), clock_.setup(latest()));
  }

  /// Of all times behind setup.
  [[nodiscard]] HWY_INLINE T latest() const {
    return later(later(in_pipe(), late_next_),
                 later(shaded_.taken_next(y_next_), later(filled_next_, written_next_)));
  }

  /// Of the stages from block_walker to z_test.
  [[nodiscard]] HWY_INLINE T in_pipe() const {
    return later(later(later(later(block_next_, hi_z_next_), tile_next_), later(e_next_, g_next_)),
                 later(f_next_, b_next_));
  }

  /// Where times are far from the clock, moves it to `at`, which no packet to come is before; gives `at` on
  /// the clock as it is then.
  HWY_INLINE T keep_near(T at) {
    if constexpr (Clock::kMoves) {
      if (HWY_UNLIKELY(Clock::is_far(later(latest(), at)))) {
        move_clock(at);
        lost_ |= Clock::is_far(latest());
        return T{};
      }
    }
    return at;
  }

  /// A time of setup which no packet to come is before, on a clock that is moved there where it is far.
  HWY_INLINE T near(const S& at) {
    if constexpr (Clock::kMoves) {
      while (HWY_UNLIKELY(clock_.is_far(at))) {
        move_clock(clock_.jobs(at));
      }
    }
    return clock_.jobs(at);
  }

  /// Times count from cycle `by` on. Those before are told from it no more: nothing waits for them.
  HWY_INLINE void move_clock(T by) {
    y_last_ = clock_.last(y_next_, y_last_);
    block_next_ = Clock::since(block_next_, by);
    block_begun_ = Clock::since(block_begun_, by);
    block_visible_ = Clock::since(block_visible_, by);
    hi_z_next_ = Clock::since(hi_z_next_, by);
    hi_z_out_ = Clock::since(hi_z_out_, by);
    update_next_ = Clock::since(update_next_, by);
    tile_next_ = Clock::since(tile_next_, by);
    e_next_ = Clock::since(e_next_, by);
    g_next_ = Clock::since(g_next_, by);
    f_next_ = Clock::since(f_next_, by);
    filled_next_ = Clock::since(filled_next_, by);
    b_next_ = Clock::since(b_next_, by);
    late_begun_ = Clock::since(late_begun_, by);
    late_next_ = Clock::since(late_next_, by);
    written_next_ = Clock::since(written_next_, by);
    y_ = Clock::since(y_, by);
    y_next_ = Clock::since(y_next_, by);
    for (auto& fifo : memory_->fifos) {
      fifo.move_clock(by);
    }
    memory_->out.move_clock(by);
    memory_->retired.move_clock(by);
    memory_->late.move_clock(by);
    clock_.move(by);
  }

  HWY_INLINE void burst(const JobWork& work, const T& g) {
    const T visible = g + (kQuadLatency + stall(StallPoint::kQuadGenerator, bursts_));
    const T f = later(later(visible, f_next_), fifo<Fifo::kEarlyZPending>().usable(bursts_));
    const T moved = f + beats_of(work);
    if constexpr (Probe::kLooks) {
      probe_->link(Link::kQuadGenerator, bursts_, g, moved);
      probe_->template split<2>(Stage::kZLookup, f_next_, {visible, f}, moved - f);
      probe_->note(&PacketTimes::f, f);
    }
    fifo<Fifo::kQuadGenerator>().give(bursts_, moved);
    f_next_ = moved;
    const Misses misses = work.misses;
    const T codes = f + machine().lookup_latency;
    if constexpr (Probe::kLooks) {
      tell_of_late();
    }
    T test_next = b_next_;
    if (HWY_UNLIKELY(work.late_done != 0)) {
      test_next = write_late(work.late_done, later(codes, b_next_));
      if constexpr (Probe::kLooks) {
        probe_->wait(Stage::kZTest, stall::kNoInput, b_next_, later(codes, b_next_));
        probe_->wait(Stage::kZTest, stall::kTestLate, later(codes, b_next_), test_next);
      }
    }
    T b = later(later(codes, test_next), fifo<Fifo::kEarlyZ>().usable(bursts_));
    T filled_next{};
    T slots{};
    if (!misses.empty()) {
      filled_next = resolve(misses, f, moved);
      slots = write_slots(misses);
      b = later(b, later(filled_next, slots));
    }
    const T beats = machine().test_beats[static_cast<std::size_t>(work.quads)];
    if constexpr (Probe::kLooks) {
      probe_->link(Link::kEarlyZPending, bursts_, f, b + beats);
      probe_->template split<5>(Stage::kZTest, test_next, {codes, test_next, filled_next, slots, b}, beats);
      probe_->note(&PacketTimes::b, b);
    }
    b_next_ = b + beats;
    fifo<Fifo::kEarlyZPending>().give(bursts_, b_next_);
    if (!misses.empty()) {
      swap(misses, b);
    }
    y_ = later(b + (kTestLatency + stall(StallPoint::kSink, bursts_)), y_next_);
    y_next_ = shaded_.take(work, beats, y_next_, y_, *memory_, stalls_, *probe_);
    if constexpr (Probe::kLooks) {
      probe_->link(Link::kEarlyZ, bursts_, b, y_next_);
      probe_->note(&PacketTimes::y, y_);
    }
    fifo<Fifo::kEarlyZ>().give(bursts_++, y_next_);
    if (HWY_UNLIKELY(work.late)) {
      memory_->late.set(static_cast<std::uint32_t>(late_given_ % kLateRing),
                        (kInterpolates ? shaded_.next() : y_next_) + machine().late_latency);
      memory_->late_quads[late_given_++ % kLateRing] = static_cast<std::uint8_t>(work.quads);
    }
  }

  /// Late writes up to the frame's number `end`, from cycle `from` on; gives the cycle after them.
  HWY_INLINE T write_late(std::uint64_t end, T from) {
    for (; late_written_ < end; ++late_written_) {
      const std::size_t at = late_written_ % kLateRing;
      from = later(from, memory_->late.get(static_cast<std::uint32_t>(at))) +
             machine().test_beats[memory_->late_quads[at]];
    }
    return from;
  }

  /// All that are out, when the stages before have nothing left to do and a clear or the flush waits.
  HWY_INLINE void write_all_late() {
    if (late_given_ != late_written_) {
      const S in_stages = clock_.setup(later(in_pipe(), hi_z_out_));
      late_begun_ = near(later(later(decide_next_, clear_next_), in_stages));
      late_next_ = write_late(late_given_, late_begun_);
    }
  }

  /// Tells of what write_all_late() did since the last burst: the cycles belong to whom the next one does.
  void tell_of_late() {
    if (late_next_ > b_next_) {
      probe_->wait(Stage::kZTest, stall::kNoInput, b_next_, late_begun_);
      probe_->wait(Stage::kZTest, stall::kTestLate, late_begun_, late_next_);
      b_next_ = late_next_;
    }
  }

  /// Resolves the missing parts, one after the other, and sends the requests of those to fetch; gives the
  /// cycle from which on all of them are there.
  HWY_INLINE T resolve(Misses misses, const T& f, const T& moved) {
    T resolve_next = f + 1;
    T there{};
    T last{};
    std::size_t sent = 0;
    for (const ZMiss& part : misses) {
      const T out = later(resolve_next, memory_->out.get(part.line));
      const T r = part.fetch ? later(out, fifo<Fifo::kFillBuffers>().usable(fills_ + sent)) : out;
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
      filled_next_ =
          later(r + machine().memory_latency, filled_next_) + machine().read_cycles[log2_bytes(part.bytes)];
      there = later(there, filled_next_ + machine().decode_latency);
      if constexpr (Probe::kLooks) {
        probe_->read(machine().read_cycles[log2_bytes(part.bytes)], filled_next_);
      }
    }
    f_next_ = later(moved, last);
    return there;
  }

  /// The cycle from which on all dirty victims find a slot of the write buffer.
  [[nodiscard]] HWY_INLINE T write_slots(Misses misses) {
    T slots{};
    std::size_t wanted = 0;
    for (const ZMiss& part : misses) {
      if (part.write_back) {
        slots = fifo<Fifo::kWriteBuffers>().usable(writes_ + wanted++);
      }
    }
    return slots;
  }

  /// Lines move in cycle b: fill buffers become free, victims leave.
  HWY_INLINE void swap(Misses misses, const T& b) {
    const T after = b + 1;
    for (const ZMiss& part : misses) {
      if (part.fetch) {
        fifo<Fifo::kFillBuffers>().give(fills_++, after);
      }
      if (part.write_back) {
        write(after, part.victim_bytes);
      }
      if (part.victim != kNoZLine) {
        memory_->out.set(part.victim, part.write_back ? written_next_ : after);
      }
    }
  }

  /// A line enters the write buffer and may move to memory from cycle `from` on.
  HWY_INLINE void write(const T& from, std::uint32_t bytes) {
    const T cycles = machine().write_cycles[log2_bytes(bytes)];
    written_next_ = later(from + machine().encode_latency, written_next_) + cycles;
    fifo<Fifo::kWriteBuffers>().give(writes_++, written_next_);
    if constexpr (Probe::kLooks) {
      probe_->write(cycles, written_next_);
    }
  }

  Memory* memory_;
  Stalls stalls_;
  Probe* probe_;

  S cull_next_{};
  S decide_next_{};
  S divider_next_{};
  S clear_next_{};
  S y_last_{};
  T block_next_{};
  T block_begun_{};    ///< the step of the block at work
  T block_visible_{};  ///< to the next unit
  T hi_z_next_{};
  T hi_z_out_{};  ///< the last block that it took is out of the pipe, if nothing is left of it
  T update_next_{};
  T tile_next_{};
  T e_next_{};
  T g_next_{};
  T f_next_{};
  T filled_next_{};
  T b_next_{};
  T late_begun_{};  ///< all that was out was written before a clear: from this cycle on
  T late_next_{};   ///< the cycle after
  T written_next_{};
  T y_{};
  T y_next_{};  ///< of the sink, or of the interpolator before it
  Interpolation<TimePolicy> shaded_;
  Clock clock_{};
  bool lost_ = false;

  // packets so far
  std::uint64_t culled_ = 0;
  std::uint64_t triangles_ = 0;
  std::uint64_t blocks_ = 0;
  std::uint64_t passed_ = 0;  ///< blocks that hi_z left tiles of
  std::uint64_t seen_ = 0;    ///< jobs, by hi_z
  struct Left {
    std::uint64_t jobs = 0;
    std::uint64_t blocks = 0;
  };
  static constexpr std::size_t kDecided = kHiZDepth - kHiZUndecided - 1;  ///< the last block that is decided
  std::array<Left, kHiZDepth> left_before_{};  ///< hi_z at the ends of the last blocks, the oldest first
  std::uint64_t jobs_ = 0;
  std::uint64_t bursts_ = 0;
  std::uint64_t late_given_ = 0;
  std::uint64_t late_written_ = 0;
  std::uint64_t fills_ = 0;
  std::uint64_t writes_ = 0;
};

}  // namespace halfspace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
