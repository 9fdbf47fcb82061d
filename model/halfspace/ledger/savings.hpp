/// What each switch of the machine saves: a whole run with it off against a whole run with all on.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace::ledger {

/// The work of a run, in fidelity `recurrence`.
struct RunCost {
  std::uint64_t cycles = 0;
  std::uint64_t read = 0;  ///< bytes between the z cache and memory
  std::uint64_t written = 0;
};

struct Saving {
  std::string key;  ///< the switch that is off
  RunCost without;
};

struct Savings {
  RunCost all_on;
  std::vector<Saving> switches;  ///< in the order of the keys
  RunCost all_off;
};

/// The keys that switch something on or off that may save work.
std::vector<std::string> switches();

/// Runs `frame` on the machine of `config` with all switches on, with each off in turn, and with all off.
/// `done` hears of each run. Throws InputError where the machine cannot have all switches on, and LedgerError
/// where a switch changes what is stored.
Savings measure_savings(const Frame& frame, const Config& config, int threads,
                        const std::function<void(std::size_t done, std::size_t of)>& done);

}  // namespace halfspace::ledger
