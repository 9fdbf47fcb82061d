/// The subcommands of `halfspace`. Each adds itself to the application; its callback throws InputError or
/// sets `status`.
#pragma once

#include "halfspace/cli/exit_status.hpp"

namespace CLI {
class App;
}

namespace halfspace {

void add_run_command(CLI::App& app, ExitStatus& status);
void add_info_command(CLI::App& app, ExitStatus& status);
void add_config_command(CLI::App& app, ExitStatus& status);
void add_diff_command(CLI::App& app, ExitStatus& status);
void add_record_command(CLI::App& app, ExitStatus& status);
void add_retime_command(CLI::App& app, ExitStatus& status);
void add_ledger_command(CLI::App& app, ExitStatus& status);
void add_stress_command(CLI::App& app, ExitStatus& status);
void add_bench_command(CLI::App& app, ExitStatus& status);

}  // namespace halfspace
