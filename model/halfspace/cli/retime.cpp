/// halfspace retime: cycles of a recorded frame on other machines.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include "halfspace/cli/commands.hpp"
#include "halfspace/cli/known_words.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/timing/record/frame_record_file.hpp"
#include "halfspace/timing/record/retime.hpp"

namespace halfspace {
namespace {

/// A sweep of more machines than this is a typing error.
constexpr std::size_t kMostMachines = 1'000'000;

struct RetimeOptions {
  std::string record;
  std::vector<std::string> configs;
  std::vector<std::string> settings;
  std::vector<std::string> sweeps;
  std::string fidelity = "recurrence";
  ThreadsOption threads;
  std::string csv;
  std::string json;
};

struct Sweep {
  std::string key;
  std::vector<std::string> values;
};

struct Row {
  std::string name;                 ///< of its configuration file, or "recorded"
  std::vector<std::string> values;  ///< by sweep
};

Sweep parse_sweep(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals + 1 == text.size()) {
    throw OptionError(fmt::format("--sweep is '{}'; it must read KEY=VALUE,VALUE,...", text));
  }
  Sweep sweep{.key = text.substr(0, equals), .values = {}};
  for (std::size_t at = equals + 1; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    sweep.values.push_back(text.substr(at, comma - at));
    at = comma + 1;
  }
  return sweep;
}

/// Every combination of configuration files and swept values, the last sweep fastest.
void make_machines(const RetimeOptions& options, const std::vector<Sweep>& sweeps, const Config& recorded,
                   std::vector<Row>& machines, std::vector<Config>& configs) {
  std::vector<std::pair<std::string, Config>> bases;
  for (const std::string& file : options.configs) {
    bases.emplace_back(file, read_config(file));
  }
  if (bases.empty()) {
    bases.emplace_back("recorded", recorded);
  }
  std::size_t combinations = 1;
  for (const Sweep& sweep : sweeps) {
    combinations *= sweep.values.size();
    if (combinations * bases.size() > kMostMachines) {
      throw OptionError(fmt::format("--sweep makes too many machines; legal: at most {}", kMostMachines));
    }
  }
  for (auto& [file, base] : bases) {
    for (const std::string& setting : options.settings) {
      set_config(base, setting);
    }
    for (std::size_t i = 0; i < combinations; ++i) {
      Config config = base;
      Row row{.name = std::filesystem::path(file).stem().string(),
              .values = std::vector<std::string>(sweeps.size())};
      std::size_t rest = i;
      for (std::size_t k = sweeps.size(); k-- > 0;) {
        row.values[k] = sweeps[k].values[rest % sweeps[k].values.size()];
        rest /= sweeps[k].values.size();
        set_config(config, sweeps[k].key, row.values[k]);
      }
      check_config(config, file, !options.settings.empty() || !sweeps.empty());
      machines.push_back(std::move(row));
      configs.push_back(config);
    }
  }
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) {
    throw InputError(fmt::format("{}: cannot be written", path));
  }
}

void retime(const RetimeOptions& options) {
  std::vector<Sweep> sweeps;
  for (const std::string& text : options.sweeps) {
    sweeps.push_back(parse_sweep(text));
  }
  Retimer retimer(read_record(options.record), options.threads.count);
  const FrameRecord& record = retimer.record();
  std::vector<Row> machines;
  std::vector<Config> configs;
  make_machines(options, sweeps, record.config, machines, configs);

  std::vector<std::uint64_t> cycles;
  if (options.fidelity == "sampled") {
    cycles = retimer.estimate(configs);
  } else {
    for (const RetimedFrame& frame : retimer.retime(configs)) {
      cycles.push_back(frame.cycles);
    }
  }
  const std::uint64_t quads =
      std::accumulate(record.packets.jobs.begin(), record.packets.jobs.end(), std::uint64_t{0});

  std::string table = fmt::format("| {} | machine |", "frame");
  std::string rule = "|---|---|";
  std::string csv = "frame,machine,";
  for (const Sweep& sweep : sweeps) {
    table += fmt::format(" {} |", sweep.key);
    rule += "---:|";
    csv += sweep.key + ",";
  }
  table += " cycles | quads a cycle |\n" + rule + "---:|---:|\n";
  csv += "cycles,quads_per_cycle\n";
  nlohmann::ordered_json json = {{"record", record.name}, {"fidelity", options.fidelity}};
  for (std::size_t i = 0; i < machines.size(); ++i) {
    const double rate =
        static_cast<double>(quads) / static_cast<double>(std::max<std::uint64_t>(cycles[i], 1));
    const std::vector<std::string>& values = machines[i].values;
    table +=
        fmt::format("| {} | {} |{} {} | {:.3f} |\n", record.name, machines[i].name,
                    values.empty() ? "" : fmt::format(" {} |", fmt::join(values, " | ")), cycles[i], rate);
    csv += fmt::format("{},{},{}{},{:.4f}\n", record.name, machines[i].name,
                       values.empty() ? "" : fmt::format("{},", fmt::join(values, ",")), cycles[i], rate);
    nlohmann::ordered_json entry = {{"machine", machines[i].name}, {"config_hash", config_hash(configs[i])}};
    for (std::size_t k = 0; k < sweeps.size(); ++k) {
      entry["set"][sweeps[k].key] = values[k];
    }
    entry["cycles"] = cycles[i];
    json["machines"].push_back(entry);
  }
  if (!options.csv.empty()) {
    write_text(options.csv, csv);
  }
  if (!options.json.empty()) {
    write_text(options.json, json.dump(1) + "\n");
  }
  fmt::print("{}", table);
}

}  // namespace

void add_retime_command(CLI::App& app, ExitStatus& /*status*/) {
  auto options = std::make_shared<RetimeOptions>();
  CLI::App* command =
      app.add_subcommand("retime", "compute the cycles of a recorded frame on other machines");
  command->add_option("RECORD", options->record, "file that `halfspace record` wrote")->required();
  command
      ->add_option("--config", options->configs,
                   "configuration file, repeatable (default: the recorded machine)")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command->add_option("--set", options->settings, "override one key on every machine, repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      ->add_option("--sweep", options->sweeps, "try each of the values, repeatable: tries all combinations")
      ->type_name("KEY=VALUE,VALUE,...")
      ->allow_extra_args(false);
  command
      ->add_option("--fidelity", options->fidelity,
                   "recurrence: exact; sampled: an estimate, ten times as fast for a large frame")
      ->check(one_of({"recurrence", "sampled"}))
      ->capture_default_str();
  options->threads.add_to(*command, "Each times other machines");
  command->add_option("--csv", options->csv, "write the table as CSV too")->type_name("FILE");
  command->add_option("--json", options->json, "write the table as JSON too")->type_name("FILE");
  command->callback([options] { retime(*options); });
}

}  // namespace halfspace
