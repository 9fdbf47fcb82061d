/// A record cut into stretches, each with what it asks of the machine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/timing/record/frame_record.hpp"

namespace halfspace {

/// What is counted of a stretch. The last three depend on the shape of the z cache.
enum class StretchCount : std::uint8_t {
  kStretches,
  kJobs,
  kBlocks,
  kDrawn,
  kDropped,
  kQuads,
  kBeatsOf4,
  kBeatsOf16,
  kBursts,
  kFetches,
  kWriteBacks,
  kMisses,
};
inline constexpr std::size_t kStretchCounts = 12;
using StretchCounts = std::array<double, kStretchCounts>;

inline double& count(StretchCounts& counts, StretchCount which) {
  return counts[static_cast<std::size_t>(which)];
}

/// Consecutive packets of a record, from `first_job` to that of the next stretch.
struct Stretch {
  std::uint32_t first_job = 0;
  std::uint32_t first_access = 0;
  std::uint64_t work = 0;  ///< cycles that it takes at the least on the default machine, about
  StretchCounts counts{};
};

/// Cuts `record` into stretches of `work` or somewhat more, where a triangle ends if it is not large. An
/// empty one comes at the end.
std::vector<Stretch> cut(const FrameRecord& record, std::uint64_t work);

/// Some stretches of a record, one behind the other.
struct StretchCopy {
  PacketStream packets;                ///< each stretch a draw or several, without the fast clears in it
  std::vector<std::size_t> draws_end;  ///< by stretch that was wanted: one past its last draw
};

/// `wanted`: by stretch.
StretchCopy copy(const FrameRecord& record, const std::vector<Stretch>& stretches,
                 const std::vector<bool>& wanted);

}  // namespace halfspace
