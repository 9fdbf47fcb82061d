/// How many of the bursts that die at early-Z hi_z would stop, with any number of bits and any lag, beside an
/// oracle that knows everything.
///
/// The frame is drawn once without hi_z. Any number of units look at each block before its tiles are drawn,
/// and are told of the jobs that they would have let through. Two oracles look at each tile with the exact
/// bounds of what is stored in it, those of the tile job just before included: one knows of the triangle what
/// hi_z knows, the other the exact codes of the burst.
///
/// A unit may also decide by time, as docs/adr/0012-hi-z.md refuses: see hi_z_in_time.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace::whatif {

struct HiZChoice {
  int bits = 8;                  ///< 4 to 32
  std::optional<int> lag = 128;  ///< tile jobs, 1 or more; without one a block sees what there is in time
  bool timed = false;            ///< the cycles of the frame are wanted, too; without a lag they always are
};

struct HiZKills {
  std::uint64_t bursts = 0;            ///< that test depth
  std::uint64_t dead = 0;              ///< none of their samples passes
  std::uint64_t oracle_samples = 0;    ///< of these: known from the burst's own codes
  std::uint64_t oracle_plane = 0;      ///< known from what hi_z knows of the triangle
  std::vector<std::uint64_t> choices;  ///< stopped by hi_z, in the order of the choices
  std::vector<std::uint64_t> cycles;   ///< of the frame with such a hi_z; 0 where it is not timed
};

/// `config` is the machine; its hi_z counts for nothing. Throws InputError where a block of it has more parts
/// of tiles than hi_z can hold.
HiZKills count_hi_z_kills(const Frame& frame, const Config& config, const std::vector<HiZChoice>& choices);

}  // namespace halfspace::whatif
