#include "halfspace/whatif/hi_z_in_time.hpp"

#include <bit>
#include <limits>

#include "halfspace/machine/surfaces.hpp"
#include "halfspace/timing/contract.hpp"

namespace halfspace::whatif {
namespace {

/// With it no block has to see anything.
constexpr int kEndlessLag = std::numeric_limits<int>::max();

Config with_hi_z(Config config, int bits, std::optional<int> lag) {
  config.hi_z.enabled = true;
  config.hi_z.bits = bits;
  config.hi_z.lag = lag.value_or(kEndlessLag);
  return config;
}

}  // namespace

HiZInTime::HiZInTime(const Config& config, int bits, std::optional<int> lag,
                     const std::vector<HiZSurface>& blocks, const std::vector<ZSurface>& places)
    : config_(config),
      by_time_(!lag),
      hi_z_(make_hi_z(blocks, with_hi_z(config, bits, lag))),
      z_cache_(z_cache_shape(config), memory_lines(places, z_cache_shape(config))),
      memory_(std::make_unique<RecurrenceMemory<OneMachine>>(
          recurrence_memory(with_hi_z(config, bits, lag), memory_lines(places, z_cache_shape(config))))),
      core_(*memory_, NoStalls{}, probe_) {}

HiZ::Verdict HiZInTime::block(const BlockJob& block, std::uint32_t empty_before,
                              const DepthEquation& equation, const EarlyZState& state,
                              const HiZSurface& surface) {
  const std::uint64_t h = core_.take_block(empty_before);
  if (by_time_) {
    for (; !ready_.empty() && ready_.front() <= h; ready_.pop_front()) {
      ++seen_;
    }
    hi_z_.see(seen_);
  }
  const HiZ::Verdict verdict = hi_z_.decide(block, equation, state, surface);
  core_.hi_z_leaves(h, std::popcount(block.tiles & ~verdict.rejected));
  return verdict;
}

void HiZInTime::job(int quads, const Coverage& coverage, const ZSurface* surface, const ZAccess& access,
                    const HiZUpdate& update) {
  ZMisses misses;
  if (quads != 0 && surface != nullptr) {
    misses = z_cache_.access(*surface, coverage.tile_x, coverage.tile_y, access);
  }
  core_.job({.quads = quads,
             .misses = misses.parts(),
             .late_done = misses.late_done,
             .late = quads != 0 && surface != nullptr && access.late_write});
  hi_z_.retire(update);
  if (by_time_) {
    ready_.push_back(memory_->retired.get(static_cast<std::uint32_t>(jobs_ % kHiZRing)));
  }
  ++jobs_;
}

void HiZInTime::clear(const ZSurface& place, const HiZSurface& surface, std::uint32_t code) {
  if (by_time_ && jobs_ != 0) {
    core_.hi_z_has_seen(jobs_ - 1);  // and waits for the last
    seen_ = jobs_;
    ready_.clear();
  }
  core_.fast_clear(static_cast<std::uint64_t>(fast_clear_cycles(place.tiles, config_)));
  hi_z_.clear(surface, code);
  z_cache_.clear(place);
}

std::uint64_t HiZInTime::finish() {
  std::vector<ZFlush> lines;
  z_cache_.flush([&](std::uint32_t slot, std::uint32_t /*line*/, std::uint32_t bytes) {
    lines.push_back({.slot = slot, .bytes = bytes});
  });
  return core_.flush(lines, static_cast<std::uint32_t>(config_.z_cache.lines));
}

}  // namespace halfspace::whatif
