/// The packet stream of a frame, kept: enough to time it on other machines. A record serves every
/// configuration that differs from its own in keys of time only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/machine/packet_stream.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace {

struct FrameRecord {
  std::string name;
  Config config;  ///< the machine it was recorded on
  std::vector<StreamSurface> surfaces;
  PacketStream packets;
};

/// Most tiles of all surfaces together: 4 screens of 16384 x 16384 in the smallest tiles.
inline constexpr std::uint64_t kMostRecordedTiles = std::uint64_t{1} << 26;

/// Records `frame` on the machine of `config`, both valid; `watch` says who looks on, and the core. Throws
/// InputError where the core does not cover the run.
FrameRecord record_frame(const Frame& frame, const Config& config,
                         const Watch& watch = {.count_pixels = false});

}  // namespace halfspace
