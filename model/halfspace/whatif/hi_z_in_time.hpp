/// hi_z beside the recurrence, which is stepped packet by packet, for a study of what time would let it see.
///
/// The recurrence knows in which cycle hi_z takes a block before anything is decided about that block: all
/// that the cycle depends on came before. So the block can be decided with the updates that are there by
/// then, and what is left of it goes on through the recurrence, whose z cache sees only that. Nothing is
/// guessed, and nothing has to be repeated.
///
/// By time, a block taken in cycle h sees the first jobs of which all are ready in h: those with a burst five
/// cycles after its last beat at z_test, the others two after quad_generator. Any number may be put in at
/// once, where hardware puts in one a cycle.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/passage/z_lookup.hpp"
#include "halfspace/timing/recurrence/core.hpp"
#include "halfspace/units/hi_z.hpp"
#include "halfspace/units/z_cache.hpp"

namespace halfspace::whatif {

class HiZInTime {
 public:
  /// The machine of `config`, which must outlive it, with bounds of `bits` and this lag; without one, by
  /// time.
  HiZInTime(const Config& config, int bits, std::optional<int> lag, const std::vector<HiZSurface>& blocks,
            const std::vector<ZSurface>& places);

  // The packets, in order. A block's jobs that are left follow it.
  void dropped() { core_.dropped(); }
  void drawn() { core_.drawn(); }
  HiZ::Verdict block(const BlockJob& block, std::uint32_t empty_before, const DepthEquation& equation,
                     const EarlyZState& state, const HiZSurface& surface);
  /// `quads` of its burst, if it has one; `access` where that touches depth.
  void job(int quads, const Coverage& coverage, const ZSurface* surface, const ZAccess& access,
           const HiZUpdate& update);
  void block_done() { core_.block_done(); }
  void walked(std::uint32_t empty_after) { core_.walked(empty_after); }
  void clear(const ZSurface& place, const HiZSurface& surface, std::uint32_t code);

  /// Ends the frame, and gives its cycles.
  std::uint64_t finish();

 private:
  const Config& config_;
  bool by_time_;
  HiZ hi_z_;
  ZCache z_cache_;
  NoProbe probe_;
  std::unique_ptr<RecurrenceMemory<OneMachine>> memory_;  ///< the core knows where it is
  RecurrenceCore<OneMachine, NoStalls, NoProbe> core_;
  std::uint64_t jobs_ = 0;           ///< through the recurrence
  std::uint64_t seen_ = 0;           ///< of these, where it goes by time
  std::deque<std::uint64_t> ready_;  ///< of the others
};

}  // namespace halfspace::whatif
