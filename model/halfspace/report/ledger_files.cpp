#include "halfspace/report/ledger_files.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "halfspace/report/ledger_picture.hpp"

namespace halfspace {
namespace {

using ledger::Accounts;

nlohmann::ordered_json accounts_json(const Accounts& accounts) {
  nlohmann::ordered_json json;
  Accounts::each([&](const char* account_name, auto account) {
    using Account = std::remove_cvref_t<decltype(accounts.*account)>;
    nlohmann::ordered_json& group = json[account_name];
    Account::fields([&](const char* name, auto, auto member) { group[name] = (accounts.*account).*member; });
  });
  return json;
}

nlohmann::ordered_json cost_json(const ledger::RunCost& cost) {
  return {{"cycles", cost.cycles}, {"bytes_read", cost.read}, {"bytes_written", cost.written}};
}

nlohmann::ordered_json savings_json(const ledger::Savings& savings) {
  nlohmann::ordered_json json{{"all_on", cost_json(savings.all_on)}};
  for (const ledger::Saving& saving : savings.switches) {
    json["without"][saving.key] = cost_json(saving.without);
  }
  json["all_off"] = cost_json(savings.all_off);
  return json;
}

}  // namespace

std::string ledger_json(const LedgerReport& report, const std::vector<std::string>& files) {
  nlohmann::ordered_json json{{"schema", kLedgerSchema},
                              {"schema_version", kLedgerSchemaVersion},
                              {"frame_name", report.frame},
                              {"config_hash", config_hash(report.config)},
                              {"fidelity", info(report.fidelity).name},
                              {"compared", report.ledger.numbers}};
  for (const ConfigKey& key : config_keys(report.config)) {
    json["config"][key.name] = key.value;
  }
  if (report.cycles) {
    json["cycles"] = *report.cycles;
  }
  json["frame"] = accounts_json(report.ledger.frame);
  json["clears"] = accounts_json(report.ledger.clears);
  json["flush"] = accounts_json(report.ledger.flush);
  json["draws"] = nlohmann::ordered_json::array();
  for (const ledger::DrawLedger& draw : report.ledger.draws) {
    nlohmann::ordered_json line{{"command", draw.command}, {"surface", nullptr}};
    if (draw.surface != kNoSurface) {
      line["surface"] = draw.surface;
    }
    line.update(accounts_json(draw.accounts));
    json["draws"].push_back(std::move(line));
  }
  if (report.savings) {
    json["savings"] = savings_json(*report.savings);
  }
  json["files"] = files;
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

std::string ledger_csv(const LedgerReport& report) {
  std::string text = "row,command,surface";
  Accounts::each([&](const char* account_name, auto account) {
    using Account = std::remove_cvref_t<decltype(report.ledger.frame.*account)>;
    Account::fields([&](const char* name, auto, auto) { text += fmt::format(",{}.{}", account_name, name); });
  });
  text += '\n';
  const auto row = [&](std::string_view name, const std::string& command, const std::string& surface,
                       const Accounts& accounts) {
    text += fmt::format("{},{},{}", name, command, surface);
    Accounts::each([&](auto, auto account) {
      using Account = std::remove_cvref_t<decltype(accounts.*account)>;
      Account::fields(
          [&](auto, auto, auto member) { text += fmt::format(",{}", (accounts.*account).*member); });
    });
    text += '\n';
  };
  for (std::size_t i = 0; i < report.ledger.draws.size(); ++i) {
    const ledger::DrawLedger& draw = report.ledger.draws[i];
    row(fmt::format("{}", i), fmt::format("{}", draw.command),
        draw.surface == kNoSurface ? "" : fmt::format("{}", draw.surface), draw.accounts);
  }
  row("clears", "", "", report.ledger.clears);
  row("flush", "", "", report.ledger.flush);
  row("frame", "", "", report.ledger.frame);
  return text;
}

void write_ledger_files(OutputFolder& folder, const LedgerReport& report) {
  folder.write("ledger.csv", ledger_csv(report));
  folder.write("ledger.svg", ledger_picture(report));
  std::vector<std::string> files = folder.files();
  files.emplace_back(kLedgerFile);
  folder.write(kLedgerFile, ledger_json(report, files));
}

}  // namespace halfspace
