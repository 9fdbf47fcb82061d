/// The machine of a configuration as the numbers that the recurrence works with, one or several at a time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/shape.hpp"
#include "halfspace/timing/contract.hpp"
#include "halfspace/units/lazy_array.hpp"
#include "halfspace/units/z_cache.hpp"

namespace halfspace {

/// The later of two times.
constexpr std::uint64_t later(std::uint64_t a, std::uint64_t b) { return std::max(a, b); }

/// What a tile job costs.
struct JobWork {
  int quads = 0;                    ///< 0: no sample is covered, and nothing leaves the quad generator
  std::span<const ZMiss> misses{};  ///< the parts of its tile that the z cache did not have
  std::uint32_t late_done = 0;      ///< late writes of the frame that are done before it is tested
  bool late = false;                ///< it leaves one
  std::uint64_t live = 0;           ///< quads that ask the interpolator, see StreamView::live
};

/// Quads of the largest tile.
inline constexpr std::size_t kMostQuads = 64;

/// Logarithm of the bytes of the largest line, 16x16 samples of 4 bytes.
inline constexpr std::size_t kMostLineBytesLog2 = 10;

/// Jobs that may be under way between hi_z and what it sees: the lag, and the tiles of the blocks under way.
inline constexpr std::uint64_t kHiZRing = 2048;

/// Late writes that may be out, and more.
inline constexpr std::size_t kLateRing = 64;

/// The first FIFOs are those of setup.
inline constexpr std::size_t kSetupFifos = static_cast<std::size_t>(Fifo::kSetup) + 1;

/// T is a time: a number of cycles, or one for each of several machines. S is one of setup.
template <class T, class S = T>
struct Machine {
  std::array<T, kMostQuads + 1> quad_beats;           ///< by the quads of a burst
  std::array<T, kMostQuads + 1> test_beats;           ///< the same in early_z
  std::array<T, kMostLineBytesLog2 + 1> read_cycles;  ///< by the logarithm of the bytes
  std::array<T, kMostLineBytesLog2 + 1> write_cycles;
  S setup_interval;
  S setup_latency;  ///< from the decision to the walker
  T edge_latency;
  T lookup_latency;  ///< from the lookup to the test
  T memory_latency;
  T decode_latency;  ///< from the last bytes of a line until it is there
  T late_latency;    ///< from the cycle after the last beat at the sink until a late write may be done
  T encode_latency;  ///< from the write buffer until memory may take a line
  int test_width = 1;
  int attributes = 0;  ///< of a quad
  std::uint64_t shade_latency = 0;
};

inline Machine<std::uint64_t> machine(const Config& config) {
  Machine<std::uint64_t> m{};
  for (std::size_t quads = 0; quads <= kMostQuads; ++quads) {
    m.quad_beats[quads] =
        static_cast<std::uint64_t>(beats(static_cast<int>(quads), config.quad_generator.quads_per_cycle));
    m.test_beats[quads] =
        static_cast<std::uint64_t>(beats(static_cast<int>(quads), config.early_z.quads_per_cycle));
  }
  for (std::size_t i = 0; i <= kMostLineBytesLog2; ++i) {
    m.read_cycles[i] = static_cast<std::uint64_t>(transfer_cycles(1 << i, config.memory.read_bytes));
    m.write_cycles[i] = static_cast<std::uint64_t>(transfer_cycles(1 << i, config.memory.write_bytes));
  }
  m.setup_interval = static_cast<std::uint64_t>(config.setup.interval);
  m.setup_latency = static_cast<std::uint64_t>(latency(Link::kSetup, config));
  m.edge_latency = static_cast<std::uint64_t>(latency(Link::kEdgeEvaluator, config));
  m.lookup_latency = static_cast<std::uint64_t>(latency(Link::kEarlyZPending, config));
  m.memory_latency = static_cast<std::uint64_t>(config.memory.latency);
  m.decode_latency = static_cast<std::uint64_t>(decode_cycles(config));
  m.late_latency = static_cast<std::uint64_t>(config.late_z.latency);
  m.encode_latency = static_cast<std::uint64_t>(encode_cycles(config));
  m.test_width = config.early_z.quads_per_cycle;
  m.attributes = config.interpolator.attributes;
  m.shade_latency = static_cast<std::uint64_t>(latency(Link::kInterpolator, config));
  return m;
}

/// How far a machine is.
template <class T>
struct Progress {
  std::array<T, kStages> free;                ///< by stage: first cycle in which it could take another packet
  T sink_next;                                ///< cycle after the last beat of all bursts at the sink
  std::array<std::uint64_t, kLinks> packets;  ///< by link: so many have taken a credit
};

/// The credits of a FIFO of one machine, by the packets that use them.
class Credits {
 public:
  explicit Credits(int capacity = 1) : capacity_(static_cast<std::size_t>(capacity)) {}

  /// The cycle from which on packet n finds a credit. That of packet n - capacity must have been given.
  [[nodiscard]] std::uint64_t usable(std::size_t n) const { return usable_[(n - capacity_) % kMostCredits]; }

  /// Packet n leaves, and its credit is usable again from `cycle` on.
  void give(std::size_t n, std::uint64_t cycle) { usable_[n % kMostCredits] = cycle; }

 private:
  std::array<std::uint64_t, kMostCredits> usable_{};
  std::size_t capacity_;
};

/// A time a row, 0 at first.
class TimeTable {
 public:
  explicit TimeTable(std::uint32_t rows = 0) : times_(zeroed_array<std::uint64_t>(rows)) {}
  [[nodiscard]] std::uint64_t get(std::uint32_t row) const { return times_[row]; }
  void set(std::uint32_t row, std::uint64_t time) { times_[row] = time; }

 private:
  LazyArray<std::uint64_t> times_;
};

/// A clock for times that are wide enough to count from cycle 0.
struct FixedClock {
  static constexpr bool kMoves = false;
  template <class T>
  static constexpr const T& setup(const T& time) {
    return time;
  }
  template <class T>
  static constexpr const T& jobs(const T& time) {
    return time;
  }
  template <class T>
  static constexpr const T& last(const T& time, const T& /*before*/) {
    return time;
  }
};

/// The recurrence of a single machine.
struct OneMachine {
  static constexpr bool kInterpolates = false;
  using Time = std::uint64_t;
  using SetupTime = Time;
  using Credits = halfspace::Credits;
  using SetupCredits = Credits;
  using Table = TimeTable;
  using Clock = FixedClock;
};

/// The same with the interpolator behind early_z.
struct InterpolatingMachine : OneMachine {
  static constexpr bool kInterpolates = true;
};

/// What a core reads and writes in places that it computes: apart from its times, which the compiler then
/// keeps in registers where it can.
template <class TimePolicy>
struct RecurrenceMemory {
  Machine<typename TimePolicy::Time, typename TimePolicy::SetupTime> machine;
  std::array<typename TimePolicy::SetupCredits, kSetupFifos> setup_fifos;
  std::array<typename TimePolicy::Credits, kFifos - kSetupFifos> fifos;  ///< the others
  typename TimePolicy::Table out;   ///< by line of memory: first cycle in which it may be asked for again
  typename TimePolicy::Table late;  ///< by late write, in a ring: the cycle from which it may be done
  std::array<std::uint8_t, kLateRing> late_quads{};  ///< of its burst
  std::optional<std::uint64_t> hi_z_lag;             ///< where the machine has hi_z
  typename TimePolicy::Table
      retired;  ///< where it has: by job, in a ring, the cycle in which hi_z can see it
};

}  // namespace halfspace
