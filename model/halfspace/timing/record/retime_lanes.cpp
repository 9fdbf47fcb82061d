#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "halfspace/timing/record/retime_lanes.cpp"
#include <hwy/foreach_target.h>
// after foreach_target, as Highway asks
#include <hwy/highway.h>

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <new>
#include <vector>

#include "halfspace/timing/record/retime.hpp"
#include "halfspace/timing/recurrence/replay-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

struct alignas(64) LaneNumbers : std::array<std::uint32_t, detail::kLanes> {};
using Tag = hn::CappedTag<std::uint32_t, detail::kLanes>;
using Vector = hn::Vec<Tag>;
constexpr std::size_t kVectors = detail::kLanes / hn::MaxLanes(Tag());

/// A time on each of kLanes machines.
class Lanes {
 public:
  Lanes() : Lanes(std::uint32_t{0}) {}
  HWY_INLINE explicit Lanes(std::uint32_t cycles) {
    for (Vector& vector : v_) {
      vector = hn::Set(Tag(), cycles);
    }
  }
  /// kLanes numbers, aligned to their own size.
  HWY_INLINE explicit Lanes(const std::uint32_t* cycles) {
    for (std::size_t i = 0; i < kVectors; ++i) {
      v_[i] = hn::Load(Tag(), cycles + i * hn::Lanes(Tag()));
    }
  }
  HWY_INLINE void store(std::uint32_t* cycles) const {
    for (std::size_t i = 0; i < kVectors; ++i) {
      hn::Store(v_[i], Tag(), cycles + i * hn::Lanes(Tag()));
    }
  }

  friend HWY_INLINE Lanes operator+(const Lanes& a, const Lanes& b) {
    Lanes result = a;
    for (std::size_t i = 0; i < kVectors; ++i) {
      result.v_[i] = hn::Add(a.v_[i], b.v_[i]);
    }
    return result;
  }
  friend HWY_INLINE Lanes operator&(const Lanes& a, const Lanes& b) {
    Lanes result = a;
    for (std::size_t i = 0; i < kVectors; ++i) {
      result.v_[i] = hn::And(a.v_[i], b.v_[i]);
    }
    return result;
  }
  friend HWY_INLINE Lanes operator|(const Lanes& a, const Lanes& b) {
    Lanes result = a;
    for (std::size_t i = 0; i < kVectors; ++i) {
      result.v_[i] = hn::Or(a.v_[i], b.v_[i]);
    }
    return result;
  }
  friend HWY_INLINE Lanes later(const Lanes& a, const Lanes& b) {
    Lanes result = a;
    for (std::size_t i = 0; i < kVectors; ++i) {
      result.v_[i] = hn::Max(a.v_[i], b.v_[i]);
    }
    return result;
  }
  friend HWY_INLINE Lanes operator+(const Lanes& a, std::uint32_t cycles) { return a + Lanes(cycles); }
  friend HWY_INLINE Lanes operator*(const Lanes& a, std::uint32_t times) {
    Lanes result = a;
    for (std::size_t i = 0; i < kVectors; ++i) {
      result.v_[i] = hn::Mul(a.v_[i], hn::Set(Tag(), times));
    }
    return result;
  }

 private:
  Vector v_[kVectors];
};

/// A number of every machine.
template <class Get>
Lanes gather(std::span<const Config> configs, const Get& get) {
  LaneNumbers values{};
  for (std::size_t i = 0; i < values.size(); ++i) {  // unused lanes repeat the first machine
    values[i] = static_cast<std::uint32_t>(get(configs[i < configs.size() ? i : 0]));
  }
  return Lanes(values.data());
}

void* zeroed_bytes(void* /*opaque*/, std::size_t bytes) { return std::calloc(bytes, 1); }

/// Rows of one number a lane, 0 at first; as LazyArray, rows that are not used take no memory. Memory is
/// plain numbers: code of the standard library, which is not compiled for this processor, must not move
/// vectors.
class LaneTable {
 public:
  explicit LaneTable(std::size_t rows = 0)
      : cycles_(hwy::AllocateAligned<std::uint32_t>(std::max<std::size_t>(rows, 1) * detail::kLanes,
                                                    &zeroed_bytes, nullptr, nullptr)) {
    if (cycles_ == nullptr) {
      throw std::bad_alloc();
    }
  }
  [[nodiscard]] HWY_INLINE Lanes get(std::size_t row) const {
    return Lanes(cycles_.get() + row * detail::kLanes);
  }
  HWY_INLINE void set(std::size_t row, const Lanes& cycles) {
    cycles.store(cycles_.get() + row * detail::kLanes);
  }

 private:
  hwy::AlignedFreeUniquePtr<std::uint32_t[]> cycles_;
};

/// As Credits, where each lane has a capacity of its own. A set of machines has few different ones: each is a
/// load and a mask.
class LaneCredits {
 public:
  LaneCredits() = default;
  explicit LaneCredits(const LaneNumbers& capacity) {
    std::size_t most = 1;
    for (const std::uint32_t c : capacity) {
      most = std::max<std::size_t>(most, c);
      if (std::find(capacities_.begin(), capacities_.end(), c) == capacities_.end()) {
        capacities_.push_back(c);
      }
    }
    masks_ = LaneTable(capacities_.size());
    for (std::size_t i = 0; i < capacities_.size(); ++i) {
      LaneNumbers mask{};
      for (std::size_t lane = 0; lane < mask.size(); ++lane) {
        mask[lane] = capacity[lane] == capacities_[i] ? 0xFFFFFFFFu : 0;
      }
      masks_.set(i, Lanes(mask.data()));
    }
    usable_ = LaneTable(std::bit_ceil(most));
    wrap_ = std::bit_ceil(most) - 1;
  }

  [[nodiscard]] HWY_INLINE Lanes usable(std::size_t ahead = 0) const {
    const std::size_t at = given_ + ahead;
    Lanes result = usable_.get((at - capacities_[0]) & wrap_);
    if (capacities_.size() > 1) {
      result = result & masks_.get(0);
      for (std::size_t i = 1; i < capacities_.size(); ++i) {
        result = result | (usable_.get((at - capacities_[i]) & wrap_) & masks_.get(i));
      }
    }
    return result;
  }

  HWY_INLINE void give(const Lanes& cycle) { usable_.set(given_++ & wrap_, cycle); }

 private:
  std::vector<std::size_t> capacities_;  ///< without repetition
  LaneTable masks_;                      ///< by the position of a capacity: which lanes have it
  LaneTable usable_;
  std::size_t wrap_ = 0;
  std::size_t given_ = 0;
};

struct MachineLanes {
  using Time = Lanes;
  using Credits = LaneCredits;
  using Table = LaneTable;
};

std::array<LaneCredits, kFifos> lane_credits(std::span<const Config> configs) {
  std::array<LaneCredits, kFifos> credits;
  for (std::size_t fifo = 0; fifo < kFifos; ++fifo) {
    LaneNumbers capacity{};
    for (std::size_t i = 0; i < capacity.size(); ++i) {
      capacity[i] = static_cast<std::uint32_t>(capacities(configs[i < configs.size() ? i : 0])[fifo]);
    }
    credits[fifo] = LaneCredits(capacity);
  }
  return credits;
}

Machine<Lanes> lane_machine(std::span<const Config> configs) {
  std::vector<Machine<std::uint64_t>> machines;
  for (const Config& config : configs) {
    machines.push_back(machine(config));
  }
  const auto lanes_of = [&](const auto& get) {
    LaneNumbers values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = static_cast<std::uint32_t>(get(machines[i < machines.size() ? i : 0]));
    }
    return Lanes(values.data());
  };
  using One = Machine<std::uint64_t>;
  Machine<Lanes> all;
  for (std::size_t i = 0; i <= kMostQuads; ++i) {
    all.quad_beats[i] = lanes_of([i](const One& m) { return m.quad_beats[i]; });
    all.test_beats[i] = lanes_of([i](const One& m) { return m.test_beats[i]; });
  }
  for (std::size_t i = 0; i <= kMostLineBytesLog2; ++i) {
    all.read_cycles[i] = lanes_of([i](const One& m) { return m.read_cycles[i]; });
    all.write_cycles[i] = lanes_of([i](const One& m) { return m.write_cycles[i]; });
  }
  all.setup_interval = lanes_of([](const One& m) { return m.setup_interval; });
  all.step_interval = lanes_of([](const One& m) { return m.step_interval; });
  all.edge_latency = lanes_of([](const One& m) { return m.edge_latency; });
  all.setup_latency = lanes_of([](const One& m) { return m.setup_latency; });
  all.lookup_latency = lanes_of([](const One& m) { return m.lookup_latency; });
  all.memory_latency = lanes_of([](const One& m) { return m.memory_latency; });
  return all;
}

using Core = RecurrenceCore<MachineLanes, NoStalls, NoProbe>;

/// Notes the end of every draw on every machine.
struct DrawEnds : ReplayHooks {
  const Core& core;
  std::span<RetimedFrame> results;

  void end_segment(const StreamSegment& segment, bool bursts) {
    if (segment.kind != StreamSegment::Kind::kDraw) {
      return;
    }
    LaneNumbers next{};
    core.sink_next().store(next.data());
    for (std::size_t i = 0; i < results.size(); ++i) {
      std::vector<std::uint64_t>& ends = results[i].draw_end;
      const std::uint64_t before = ends.empty() ? 0 : ends.back();
      ends.push_back(bursts ? next[i] - 1 : before);
    }
  }
};

}  // namespace

void retime_group(const FrameRecord& record, const ZTrace& trace, std::span<const Config> configs,
                  RetimedFrame* results) {
  NoProbe probe;
  Core core(lane_machine(configs), lane_credits(configs), NoStalls{}, probe);
  DrawEnds hooks{{}, core, {results, configs.size()}};
  bool bursts = false;
  core.start(trace.memory_lines);
  replay(whole_stream(record, trace), core, hooks, bursts, [&](std::uint32_t surface) {
    return gather(configs, [&](const Config& config) {
      return fast_clear_cycles(record.surfaces[surface].tiles, config);
    });
  });
  // lanes share the shape of the z cache, so the number of its lines too
  LaneNumbers cycles{};
  core.flush(trace.flush, static_cast<std::uint32_t>(configs[0].z_cache.lines)).store(cycles.data());
  for (std::size_t i = 0; i < configs.size(); ++i) {
    results[i].cycles = cycles[i];
  }
}

}  // namespace halfspace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace halfspace::detail {

HWY_EXPORT(retime_group);

void retime_lanes(const FrameRecord& record, const ZTrace& trace, std::span<const Config> configs,
                  RetimedFrame* results) {
  HWY_DYNAMIC_DISPATCH(retime_group)(record, trace, configs, results);
}

}  // namespace halfspace::detail
#endif
