/// The files of a ledger.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/ledger/ledger.hpp"
#include "halfspace/ledger/savings.hpp"
#include "halfspace/report/output_folder.hpp"
#include "halfspace/run/run_result.hpp"

namespace halfspace {

inline constexpr const char* kLedgerFile = "ledger.json";
inline constexpr const char* kLedgerSchema = "halfspace-ledger";
inline constexpr int kLedgerSchemaVersion = 1;

struct LedgerReport {
  std::string frame;  ///< its name
  Config config;
  Fidelity fidelity = Fidelity::kFunctional;  ///< whose counters the ledger was compared with
  std::optional<std::uint64_t> cycles;        ///< where it has time
  ledger::Ledger ledger;
  std::optional<ledger::Savings> savings;
};

/// `files` lists the names of all files of the result, ledger.json included.
std::string ledger_json(const LedgerReport& report, const std::vector<std::string>& files);

/// A row for each draw, for the clears, the flush and the frame; a column for each cause of each account.
std::string ledger_csv(const LedgerReport& report);

/// Writes ledger.json, ledger.csv and ledger.svg. Throws InputError.
void write_ledger_files(OutputFolder& folder, const LedgerReport& report);

}  // namespace halfspace
