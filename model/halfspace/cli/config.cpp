/// halfspace config: every key with its value, legal range and help.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "halfspace/cli/commands.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/timing/rtl/pipeline_arguments.hpp"

namespace halfspace {
namespace {

/// docs/config.md: a table a section, with the defaults.
std::string to_markdown() {
  std::string text =
      "# Configuration keys\n\n"
      "`halfspace config --markdown` prints this page from `model/halfspace/config/keys.hpp`. To add a\n"
      "key, add a row there and run `make generated`.\n\n"
      "Set a key with `--set KEY=VALUE` or in a TOML file (`--config FILE`, see\n"
      "[`configs/`](../configs)). A key that changes \"function\" may change packets; a key that changes\n"
      "\"time\" changes only the cycles in which they move. The column \"RTL\" names the argument of\n"
      "Verilator that sets the key, followed by `=VALUE`; a dash means that the RTL has no such\n"
      "parameter. `halfspace config --rtl` prints these arguments for a configuration.\n";
  std::string section = "-";
  for (const ConfigKey& key : config_keys({})) {
    const std::size_t dot = key.name.find('.');
    const std::string in = dot == std::string::npos ? "" : key.name.substr(0, dot);
    if (in != section) {
      text += fmt::format("\n## {}\n\n", in.empty() ? "without a section" : in);
      text += "| key | default | legal | unit | changes | RTL | what |\n";
      text += "|---|---|---|---|---|---|---|\n";
      section = in;
    }
    text += fmt::format("| `{}` | `{}` | {} | {} | {} | {} | {} |\n", key.name, key.value, key.legal,
                        key.unit.empty() ? "-" : key.unit, key.timing ? "time" : "function",
                        key.rtl.empty() ? "-" : "`" + key.rtl + "`", key.help);
  }
  return text;
}

}  // namespace

void add_config_command(CLI::App& app, ExitStatus& /*status*/) {
  auto machine = std::make_shared<MachineOptions>();
  auto toml = std::make_shared<bool>(false);
  auto rtl = std::make_shared<bool>(false);
  auto markdown = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("config", "show every configuration key with its help");
  machine->add_to(*command);
  CLI::Option* const as_toml = command->add_flag("--toml", *toml, "print a configuration file");
  CLI::Option* const as_rtl =
      command->add_flag("--rtl", *rtl, "print Verilator's arguments for rtl/raster_pipeline.sv")
          ->excludes(as_toml);
  command->add_flag("--markdown", *markdown, "print docs/config.md: every key with its default")
      ->excludes(as_toml)
      ->excludes(as_rtl)
      ->excludes("--config")
      ->excludes("--set");
  command->callback([machine, toml, rtl, markdown] {
    if (*markdown) {
      fmt::print("{}", to_markdown());
      return;
    }
    const Config config = machine->config(Samples::kAny);
    if (*rtl) {
      fmt::print("{}\n", fmt::join(rtl::pipeline_arguments(config), "\n"));
      return;
    }
    if (*toml) {
      fmt::print("{}", to_toml(config));
      return;
    }
    for (const ConfigKey& key : config_keys(config)) {
      fmt::print("{} = {}\n    {}{}\n    legal: {}\n", key.name, key.value, key.help,
                 key.unit.empty() ? "" : fmt::format(", in {}", key.unit), key.legal);
    }
    fmt::print("hash {}\n", config_hash(config));
  });
}

}  // namespace halfspace
