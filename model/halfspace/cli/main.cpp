/// halfspace: the command line.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "halfspace/cli/commands.hpp"

int main(int argc, char** argv) {
  CLI::App app{"halfspace: a cycle-approximate hardware rasterizer model", "halfspace"};
  app.set_version_flag("--version", HALFSPACE_VERSION);
  app.failure_message([&app](const CLI::App*, const CLI::Error& error) {
    std::string command = app.get_name();
    for (const CLI::App* at = &app; !at->get_subcommands().empty();) {
      at = at->get_subcommands().front();
      command += " " + at->get_name();
    }
    return fmt::format("halfspace: {}; see '{} --help'\n", error.what(), command);
  });
  int status = 0;
  try {
    halfspace::add_run_command(app, status);
    halfspace::add_info_command(app, status);
    halfspace::add_config_command(app, status);
    halfspace::add_diff_command(app, status);
    halfspace::add_record_command(app, status);
    halfspace::add_retime_command(app, status);
    halfspace::add_ledger_command(app, status);
    halfspace::add_stress_command(app, status);
    halfspace::add_bench_command(app, status);
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) {  // after parse(), which names a word that is no subcommand
      throw CLI::RequiredError("A subcommand");
    }
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "halfspace: not enough memory for this input\n");
    return 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "halfspace: {}\n", error.what());
    return 1;
  }
  return status;
}
