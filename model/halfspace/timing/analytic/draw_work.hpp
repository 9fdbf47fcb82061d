/// Sums of what a draw asks of the machine: all that the analytic fidelity looks at.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/timing/pipeline.hpp"

namespace halfspace {

struct DrawWork {
  std::uint64_t triangles = 0;                   ///< into setup
  std::uint64_t drawn = 0;                       ///< into the walker
  std::uint64_t steps = 0;                       ///< of the walker
  std::array<std::uint32_t, 65> tiles{};         ///< tile jobs by their quads
  std::array<std::uint32_t, 11> fetched{};       ///< lines read, by the logarithm of their bytes
  std::array<std::uint32_t, 11> written_back{};  ///< lines written, the same way

  void count(std::span<const ZMiss> misses) {
    for (const ZMiss& miss : misses) {
      fetched[static_cast<std::size_t>(std::countr_zero(miss.bytes))] += miss.fetch ? 1 : 0;
      if (miss.write_back) {
        ++written_back[static_cast<std::size_t>(std::countr_zero(miss.victim_bytes))];
      }
    }
  }

  DrawWork& operator+=(const DrawWork& other) {
    triangles += other.triangles;
    drawn += other.drawn;
    steps += other.steps;
    const auto add = [](auto& sums, const auto& more) {
      for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i] += more[i];
      }
    };
    add(tiles, other.tiles);
    add(fetched, other.fetched);
    add(written_back, other.written_back);
    return *this;
  }
};

/// What a frame asks of the machine.
struct FrameWork {
  std::vector<DrawWork> draws;
  DrawWork drawn_clears;                   ///< all of them
  std::vector<std::uint32_t> fast_clears;  ///< tiles of each
  std::vector<ZFlush> flush;
};

/// The clock that sums.
class WorkClock {
 public:
  explicit WorkClock(FrameWork& work) : work_(work) {}

  void start(std::uint32_t /*memory_lines*/) {}
  void draw(std::uint32_t index) {
    if (index != kNoDraw) {
      work_.draws.emplace_back();
    }
    at_ = index == kNoDraw ? &work_.drawn_clears : &work_.draws.back();
  }
  void dropped() { ++at_->triangles; }
  void drawn() {
    ++at_->triangles;
    ++at_->drawn;
  }
  void job(const JobWork& work) {
    at_->steps += work.steps;
    ++at_->tiles[static_cast<std::size_t>(work.quads)];
    at_->count(work.misses);
  }
  void walked(std::uint32_t steps) { at_->steps += steps; }
  [[nodiscard]] static std::uint64_t quad_cycle(int /*quad*/) { return 0; }
  void fast_clear(std::uint32_t tiles) { work_.fast_clears.push_back(tiles); }
  void flush(const std::vector<ZFlush>& lines) { work_.flush = lines; }

 private:
  FrameWork& work_;
  DrawWork* at_ = nullptr;
};

}  // namespace halfspace
