/// halfspace config: every key with its value, legal range and help.
#include <fmt/format.h>

#include <memory>

#include "halfspace/cli/commands.hpp"
#include "halfspace/cli/options.hpp"

namespace halfspace {

void add_config_command(CLI::App& app, int& /*status*/) {
  auto machine = std::make_shared<MachineOptions>();
  auto toml = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("config", "show every configuration key with its help");
  machine->add_to(*command);
  command->add_flag("--toml", *toml, "print a configuration file");
  command->callback([machine, toml] {
    const Config config = machine->config();
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
