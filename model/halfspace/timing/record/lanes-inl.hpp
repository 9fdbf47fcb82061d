/// Times of several machines at once, one a SIMD lane, for RecurrenceCore. In the manner of Highway, as
/// core-inl.hpp.
#if defined(HALFSPACE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_LANES_INL
#undef HALFSPACE_LANES_INL
#else
#define HALFSPACE_LANES_INL
#endif

#include <hwy/aligned_allocator.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#include "halfspace/timing/recurrence/core-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A number for each of so many machines, in their order.
template <std::size_t kMachines>
struct alignas(64) MachineNumbers : std::array<std::uint32_t, kMachines> {};

/// A vector of times of 16 or 32 bits, on kMachines machines.
template <class NumberType>
class Lanes {
 public:
  using Number = NumberType;
  using Tag = hn::CappedTag<Number, 64 / sizeof(Number)>;
  using Vector = hn::Vec<Tag>;
  static constexpr std::size_t kMachines = hn::MaxLanes(Tag());
  static constexpr std::size_t kRow = kMachines;  ///< numbers in memory

  Lanes() : v(hn::Zero(Tag())) {}
  HWY_INLINE explicit Lanes(Vector vector) : v(vector) {}
  HWY_INLINE explicit Lanes(std::uint32_t cycles) : v(hn::Set(Tag(), static_cast<Number>(cycles))) {}

  HWY_INLINE static Lanes load(const Number* row) { return Lanes(hn::Load(Tag(), row)); }
  HWY_INLINE void store(Number* row) const { hn::Store(v, Tag(), row); }
  static Lanes of(const MachineNumbers<kMachines>& numbers) {
    alignas(64) std::array<Number, kRow> row{};
    std::transform(numbers.begin(), numbers.end(), row.begin(),
                   [](std::uint32_t number) { return static_cast<Number>(number); });
    return load(row.data());
  }
  [[nodiscard]] MachineNumbers<kMachines> numbers() const {
    alignas(64) std::array<Number, kRow> row{};
    store(row.data());
    MachineNumbers<kMachines> all{};
    std::copy(row.begin(), row.end(), all.begin());
    return all;
  }

  friend HWY_INLINE Lanes operator+(Lanes a, Lanes b) { return Lanes(hn::Add(a.v, b.v)); }
  friend HWY_INLINE Lanes operator+(Lanes a, std::uint32_t cycles) { return a + Lanes(cycles); }
  friend HWY_INLINE Lanes operator*(Lanes a, std::uint32_t times) {
    return Lanes(hn::Mul(a.v, Lanes(times).v));
  }
  friend HWY_INLINE Lanes later(Lanes a, Lanes b) { return Lanes(hn::Max(a.v, b.v)); }
  /// `yes` where `mask` is all ones, `no` where it is 0.
  friend HWY_INLINE Lanes choose(Lanes mask, Lanes yes, Lanes no) {
    return Lanes(hn::IfVecThenElse(mask.v, yes.v, no.v));
  }

  Vector v;
};

/// Rows of times, 0 at first. Memory is plain numbers: code of the standard library, which is not compiled
/// for this processor, must not move vectors.
template <class T>
class LaneTable {
 public:
  explicit LaneTable(std::size_t rows = 1)
      : rows_(rows), times_(hwy::AllocateAligned<typename T::Number>(rows * T::kRow)) {
    if (times_ == nullptr) {
      throw std::bad_alloc();
    }
    std::fill_n(times_.get(), rows * T::kRow, typename T::Number{0});
  }
  [[nodiscard]] HWY_INLINE T get(std::size_t row) const { return T::load(times_.get() + row * T::kRow); }
  HWY_INLINE void set(std::size_t row, T time) { time.store(times_.get() + row * T::kRow); }
  HWY_INLINE void move_clock(T by) {
    for (std::size_t row = 0; row < rows_; ++row) {
      set(row, since(get(row), by));
    }
  }

 private:
  std::size_t rows_;
  hwy::AlignedFreeUniquePtr<typename T::Number[]> times_;
};

/// As Credits, where each machine has a capacity of its own. The machines have few different ones, mostly
/// one: each is a load, and a choice from the second on.
template <class T>
class LaneCredits {
 public:
  void set_up(const MachineNumbers<T::kMachines>& capacity) {
    wrap_ = std::bit_ceil(std::size_t{*std::max_element(capacity.begin(), capacity.end())}) * T::kRow - 1;
    capacity_ = capacity[0] * T::kRow;
    std::vector<std::uint32_t> known{capacity[0]};
    for (const std::uint32_t c : capacity) {
      if (std::find(known.begin(), known.end(), c) != known.end()) {
        continue;
      }
      known.push_back(c);
      MachineNumbers<T::kMachines> mask{};
      std::transform(capacity.begin(), capacity.end(), mask.begin(),
                     [c](std::uint32_t other) { return c == other ? 0xFFFFFFFFu : 0; });
      T::of(mask).store(others_[other_count_].mask);
      others_[other_count_++].capacity = c * T::kRow;
    }
  }

  [[nodiscard]] HWY_INLINE T usable(std::size_t n) const {
    T result = row(n * T::kRow - capacity_);
    const auto choose_other = [&](const Other& other) HWY_ATTR {
      result = choose(T::load(other.mask), row(n * T::kRow - other.capacity), result);
    };
    // the first two written out: a tenth of the time of a pass
    if (other_count_ > 0) {
      choose_other(others_[0]);
    }
    if (other_count_ > 1) {
      choose_other(others_[1]);
      for (std::size_t i = 2; i < other_count_; ++i) {
        choose_other(others_[i]);
      }
    }
    return result;
  }

  HWY_INLINE void give(std::size_t n, T cycle) { cycle.store(usable_ + (n * T::kRow & wrap_)); }

  HWY_INLINE void move_clock(T by) {
    for (std::size_t at = 0; at <= wrap_; at += T::kRow) {
      since(row(at), by).store(usable_ + at);
    }
  }

 private:
  using Number = typename T::Number;
  struct Other {
    alignas(64) Number mask[T::kRow];  ///< all ones where a machine has it
    std::size_t capacity;              ///< in numbers, not rows
  };

  [[nodiscard]] HWY_INLINE T row(std::size_t at) const { return T::load(usable_ + (at & wrap_)); }

  alignas(64) Number usable_[kMostCredits * T::kRow]{};  ///< the first rows of it are a ring
  std::size_t wrap_ = 0;
  std::size_t capacity_ = 0;  ///< of the first machine
  std::size_t other_count_ = 0;
  Other others_[std::min(T::kMachines, kMostCredits)]{};  ///< capacities of those that have another
};

/// The recurrence with a machine in each lane of 32 bits.
struct WideLanes {
  static constexpr bool kInterpolates = false;
  using Time = Lanes<std::uint32_t>;
  using SetupTime = Time;
  using Credits = LaneCredits<Time>;
  using SetupCredits = Credits;
  using Table = LaneTable<Time>;
  using Clock = FixedClock;
};

#if HWY_TARGET != HWY_SCALAR

/// Times of setup for as many machines as a vector of 16 bits has: those of even machines, and of odd ones.
class PairLanes {
 public:
  using Half = Lanes<std::uint32_t>;
  using Number = Half::Number;
  static constexpr std::size_t kMachines = 2 * Half::kMachines;
  static constexpr std::size_t kRow = kMachines;

  PairLanes() = default;
  HWY_INLINE PairLanes(Half even_machines, Half odd_machines) : even(even_machines), odd(odd_machines) {}

  HWY_INLINE static PairLanes load(const Number* row) {
    return {Half::load(row), Half::load(row + Half::kRow)};
  }
  HWY_INLINE void store(Number* row) const {
    even.store(row);
    odd.store(row + Half::kRow);
  }
  static PairLanes of(const MachineNumbers<kMachines>& numbers) {
    MachineNumbers<kMachines> row{};
    for (std::size_t i = 0; i < kMachines; ++i) {
      row[i % 2 * Half::kRow + i / 2] = numbers[i];
    }
    return load(row.data());
  }
  [[nodiscard]] MachineNumbers<kMachines> numbers() const {
    MachineNumbers<kMachines> row{};
    store(row.data());
    MachineNumbers<kMachines> all{};
    for (std::size_t i = 0; i < kMachines; ++i) {
      all[i] = row[i % 2 * Half::kRow + i / 2];
    }
    return all;
  }

  friend HWY_INLINE PairLanes operator+(PairLanes a, PairLanes b) { return {a.even + b.even, a.odd + b.odd}; }
  friend HWY_INLINE PairLanes operator+(PairLanes a, std::uint32_t cycles) {
    return {a.even + cycles, a.odd + cycles};
  }
  friend HWY_INLINE PairLanes later(PairLanes a, PairLanes b) {
    return {later(a.even, b.even), later(a.odd, b.odd)};
  }
  friend HWY_INLINE PairLanes choose(PairLanes mask, PairLanes yes, PairLanes no) {
    return {choose(mask.even, yes.even, no.even), choose(mask.odd, yes.odd, no.odd)};
  }

  Half even;
  Half odd;
};

/// Cycles from `by` to `time`; 0 where it is before.
HWY_INLINE Lanes<std::uint16_t> since(Lanes<std::uint16_t> time, Lanes<std::uint16_t> by) {
  return Lanes<std::uint16_t>(hn::SaturatedSub(time.v, by.v));
}

/// Where the 16 bits of each machine's times count from.
class LaneClock {
 public:
  static constexpr bool kMoves = true;
  using T = Lanes<std::uint16_t>;
  using Half = PairLanes::Half;

  /// Any machine's time is in the upper half of the width.
  HWY_INLINE static bool is_far(T time) { return !hn::AllFalse(T::Tag(), hn::TestBit(time.v, T(0x8000).v)); }
  [[nodiscard]] HWY_INLINE bool is_far(const PairLanes& time) const {
    const Half later_one = later(from_start(time.even, start_.even), from_start(time.odd, start_.odd));
    const auto high = hn::And(later_one.v, Half(0xFFFF8000).v);
    return !hn::AllTrue(Half::Tag(), hn::Eq(high, hn::Zero(Half::Tag())));
  }
  [[nodiscard]] HWY_INLINE PairLanes setup(T time) const { return start_ + widen(time); }
  /// 0xFFFF where it is beyond the width.
  [[nodiscard]] HWY_INLINE T jobs(const PairLanes& time) const {
    const auto limit = Half(0xFFFF).v;
    const auto even = hn::Min(from_start(time.even, start_.even).v, limit);
    const auto odd = hn::Min(from_start(time.odd, start_.odd).v, limit);
    return T(hn::BitCast(T::Tag(), hn::Or(even, hn::ShiftLeft<16>(odd))));
  }
  /// What `time` says if it is not 0; else `before` is still true.
  [[nodiscard]] HWY_INLINE PairLanes last(T time, const PairLanes& before) const {
    const PairLanes wide = widen(time);
    const auto one = [](Half now, Half added, Half old) HWY_ATTR {
      return Half(hn::IfThenElse(hn::Eq(added.v, hn::Zero(Half::Tag())), old.v, now.v));
    };
    const PairLanes now = start_ + wide;
    return {one(now.even, wide.even, before.even), one(now.odd, wide.odd, before.odd)};
  }
  HWY_INLINE static T since(T time, T by) { return HWY_NAMESPACE::since(time, by); }
  HWY_INLINE void move(T by) { start_ = start_ + widen(by); }

 private:
  HWY_INLINE static Half from_start(Half time, Half start) { return Half(hn::Sub(time.v, start.v)); }
  HWY_INLINE static PairLanes widen(T time) {
    const auto both = hn::BitCast(Half::Tag(), time.v);
    return {Half(hn::And(both, Half(0xFFFF).v)), Half(hn::ShiftRight<16>(both))};
  }

  PairLanes start_;
};

/// The recurrence with a machine in each lane of 16 bits.
struct NarrowLanes {
  static constexpr bool kInterpolates = false;
  using Time = Lanes<std::uint16_t>;
  using SetupTime = PairLanes;
  using Credits = LaneCredits<Time>;
  using SetupCredits = LaneCredits<PairLanes>;
  using Table = LaneTable<Time>;
  using Clock = LaneClock;
};

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace halfspace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
