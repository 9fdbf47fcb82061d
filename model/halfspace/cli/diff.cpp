/// halfspace diff: the first difference of two runs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "halfspace/cli/commands.hpp"
#include "halfspace/cli/exit_status.hpp"
#include "halfspace/report/diff.hpp"

namespace halfspace {

void add_diff_command(CLI::App& app, ExitStatus& status) {
  auto folders = std::make_shared<std::pair<std::string, std::string>>();
  CLI::App* command =
      app.add_subcommand("diff", "compare the results of two runs; exit status 1 where they differ");
  command->add_option("A", folders->first, "result folder")->required();
  command->add_option("B", folders->second, "result folder")->required();
  command->callback([folders, &status] {
    const ResultDifference result = compare_results(folders->first, folders->second);
    for (const FileDifference& file : result.files) {
      fmt::print("{}: {} differences, first: {}\n", file.file, file.count, file.first);
    }
    for (const std::string& file : result.only_in_one) {
      fmt::print("{}: only in one of the two, not compared\n", file);
    }
    fmt::print("{} files compared, {} differ\n", result.compared.size(), result.files.size());
    status = status_of(result.files.empty());
  });
}

}  // namespace halfspace
