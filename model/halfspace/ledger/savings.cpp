#include "halfspace/ledger/savings.hpp"

#include <fmt/format.h>

#include <utility>

#include "halfspace/ledger/ledger.hpp"
#include "halfspace/timing/recurrence/run_recurrence.hpp"

namespace halfspace::ledger {
namespace {

bool same_depth(const Surface& a, const Surface& b) {
  for (int y = 0; y < a.codes.height(); ++y) {
    for (int x = 0; x < a.codes.width(); ++x) {
      if (std::as_const(a.codes).at(x, y) != std::as_const(b.codes).at(x, y)) {
        return false;
      }
    }
  }
  return true;
}

RunCost cost_of(const TimedResult& run) {
  const FrameResult& frame = run.frame;
  const EarlyZCounters& draws = frame.counters.early_z;
  const EarlyZCounters& clears = frame.drawn_clears.early_z;
  return {.cycles = run.cycles.cycles,
          .read = draws.bytes_read + clears.bytes_read,
          .written = draws.bytes_written + clears.bytes_written + frame.flushed_bytes};
}

}  // namespace

std::vector<std::string> switches() {
  std::vector<std::string> keys;
  for (const ConfigKey& key : config_keys({})) {
    // What a run gives more saves no work.
    const bool saves = key.name != "interpolator.enabled" && key.name != "raster.inner_coverage";
    if (saves && (key.value == "true" || key.value == "false")) {
      keys.push_back(key.name);
    }
  }
  return keys;
}

Savings measure_savings(const Frame& frame, const Config& config, int threads,
                        const std::function<void(std::size_t done, std::size_t of)>& done) {
  const std::vector<std::string> keys = switches();
  const std::size_t runs = keys.size() + 2;
  std::size_t ran = 0;
  const auto run = [&](const Config& machine) {
    validate(machine);
    TimedResult result =
        run_recurrence(frame, machine, {.watch = {.count_pixels = false, .threads = threads}, .stalls = {}});
    done(++ran, runs);
    return result;
  };
  Config all_on = config;
  Config all_off = config;
  for (const std::string& key : keys) {
    set_config(all_on, key, "true");
    set_config(all_off, key, "false");
  }
  const TimedResult truth = run(all_on);
  const auto cost = [&](const Config& machine, const std::string& what) {
    const TimedResult result = run(machine);
    for (std::size_t s = 0; s < truth.frame.surfaces.size(); ++s) {
      if (!same_depth(result.frame.surfaces[s], truth.frame.surfaces[s])) {
        throw LedgerError(
            fmt::format("depth surface {} is another with {}, and has to be the same", s, what));
      }
    }
    return cost_of(result);
  };
  Savings savings{.all_on = cost_of(truth), .switches = {}, .all_off = {}};
  for (const std::string& key : keys) {
    Config one_off = all_on;
    set_config(one_off, key, "false");
    savings.switches.push_back({.key = key, .without = cost(one_off, key + " = false")});
  }
  savings.all_off = cost(all_off, "all switches off");
  return savings;
}

}  // namespace halfspace::ledger
