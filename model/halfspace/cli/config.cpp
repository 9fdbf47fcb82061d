/// halfspace config: every key with its value, legal range and help.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "halfspace/cli/commands.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/timing/rtl/pipeline_arguments.hpp"

namespace halfspace {

void add_config_command(CLI::App& app, int& /*status*/) {
  auto machine = std::make_shared<MachineOptions>();
  auto toml = std::make_shared<bool>(false);
  auto rtl = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("config", "show every configuration key with its help");
  machine->add_to(*command);
  CLI::Option* const as_toml = command->add_flag("--toml", *toml, "print a configuration file");
  command->add_flag("--rtl", *rtl, "print Verilator's arguments for rtl/raster_pipeline.sv")
      ->excludes(as_toml);
  command->callback([machine, toml, rtl] {
    const Config config = machine->config();
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
