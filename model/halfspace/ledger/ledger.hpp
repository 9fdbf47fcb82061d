/// The ledger of a frame: what became of every triangle, block, tile, quad and fragment, and of every line of
/// depth, for each draw, with a proof that nothing is missing.
///
/// Two sources that know nothing of each other have to agree. Counts come from a run that is watched, in
/// which every piece is followed to its end (fates.hpp), and totals from coverage without a walk
/// (covered.hpp). The other source is the counters of any run of the frame, in any fidelity.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/ledger/accounts.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace::ledger {

struct DrawLedger {
  std::uint32_t command = 0;  ///< index in Frame::commands
  std::uint32_t surface = kNoSurface;
  Accounts accounts;
};

struct Ledger {
  std::vector<DrawLedger> draws;
  Accounts clears;  ///< clears that are drawn: only what they ask of memory
  Accounts flush;   ///< of the z cache, at the end: only what it writes
  Accounts frame;   ///< the sum of all of these

  std::uint64_t numbers = 0;  ///< pairs that were compared
};

/// Two numbers that have to be equal are not: a bug of the model. what() names both.
class LedgerError : public DisagreementError {
 public:
  using DisagreementError::DisagreementError;
};

/// The ledger counts blocks and tiles of the bounds, each once. Throws OptionError for a machine whose steps
/// are others, or that does not come to all of them.
void check_machine(const Config& config);

/// The ledger of `frame` on the machine of `config`, both valid; `counted` is a run of them. Throws
/// LedgerError where a sum does not add up, or a counter of `counted` says otherwise.
Ledger make_ledger(const Frame& frame, const Config& config, const FrameResult& counted);

/// Every account adds up, of each draw and of the frame. Returns how many do. Throws LedgerError.
std::uint64_t check_sums(const Ledger& ledger);

/// The counters of a run of the frame say the same. Returns how many do. Throws LedgerError.
std::uint64_t check_counters(const Ledger& ledger, const FrameResult& counted);

}  // namespace halfspace::ledger
