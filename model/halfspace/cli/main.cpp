/// halfspace: the command line.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <new>
#include <sstream>
#include <string>
#include <system_error>

#include "halfspace/cli/commands.hpp"
#include "halfspace/cli/known_words.hpp"
#include "halfspace/cli/standard_streams.hpp"
#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

void add_commands(CLI::App& app, ExitStatus& status) {
  add_run_command(app, status);
  add_info_command(app, status);
  add_config_command(app, status);
  add_diff_command(app, status);
  add_record_command(app, status);
  add_retime_command(app, status);
  add_ledger_command(app, status);
  add_stress_command(app, status);
  add_bench_command(app, status);
}

/// "halfspace bench speed", as far as subcommands were named.
std::string command_of(const CLI::App& app) {
  std::string command = app.get_name();
  for (const CLI::App* at = &app; !at->get_subcommands().empty();) {
    at = at->get_subcommands().front();
    command += " " + at->get_name();
  }
  return command;
}

ExitStatus fail(ExitStatus status, const std::string& message) {
  std::fputs(fmt::format("halfspace: {}\n", message).c_str(), stderr);
  return status;
}

ExitStatus print_help(const CLI::App& app, const CLI::Success& help_or_version) {
  std::ostringstream text;
  app.exit(help_or_version, text);
  fmt::print("{}", text.str());
  return ExitStatus::kDone;
}

ExitStatus parse_and_run(CLI::App& app, int argc, char** argv) {
  ExitStatus status = ExitStatus::kDone;
  add_commands(app, status);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) {  // after parse(), which names a word that is no subcommand
      throw CLI::RequiredError("A subcommand");
    }
  } catch (const CLI::Success& help_or_version) {
    return print_help(app, help_or_version);
  } catch (const CLI::ParseError& error) {
    const std::string unknown = unknown_word(app);
    return fail(ExitStatus::kUsage, fmt::format("{}; see '{} --help'",
                                                unknown.empty() ? error.what() : unknown, command_of(app)));
  }
  return status;
}

ExitStatus run_program(int argc, char** argv) {
  CLI::App app{"halfspace: a cycle-approximate hardware rasterizer model", "halfspace"};
  app.set_version_flag("--version", HALFSPACE_VERSION);
  app.footer(kExitStatusHelp);
  try {
    const ExitStatus status = parse_and_run(app, argc, argv);
    flush_standard_output();
    return status;
  } catch (const OptionError& error) {
    return fail(ExitStatus::kUsage, error.what());
  } catch (const DisagreementError& error) {
    return fail(ExitStatus::kDifferent, error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitStatus::kTrouble, "not enough memory for this input");
  } catch (const std::system_error& error) {
    return fail(ExitStatus::kTrouble, std::ferror(stdout) == 0
                                          ? error.what()
                                          : "standard output: cannot be written: " + error.code().message());
  } catch (const std::exception& error) {
    return fail(ExitStatus::kTrouble, error.what());
  }
}

}  // namespace
}  // namespace halfspace

int main(int argc, char** argv) {
  halfspace::hold_standard_streams();
  return static_cast<int>(halfspace::run_program(argc, argv));
}
