/// halfspace ledger: what became of everything in a frame.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/cli/commands.hpp"
#include "halfspace/cli/known_words.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/cli/percent.hpp"
#include "halfspace/cli/progress.hpp"
#include "halfspace/report/ledger_files.hpp"
#include "halfspace/run/run.hpp"

namespace halfspace {
namespace {

using ledger::Accounts;

struct LedgerOptions {
  InputOptions input;
  MachineOptions machine;
  RtlOptions rtl;
  ThreadsOption threads;
  std::string fidelity = "functional";
  std::string out;
  bool savings = false;
  bool json = false;
  bool no_draws = false;
};

/// A line for each draw: where its triangles and fragments end, and the bytes that it moves.
void print_draws(const ledger::Ledger& ledger) {
  constexpr const char* kLine = "  {:>6}{:>10}{:>10}{:>10}{:>10}{:>10}{:>11}{:>11}{:>11}{:>11}{:>11}{:>11}\n";
  fmt::print(fmt::runtime(kLine), "", "", "pieces", "", "", "", "fragments", "", "", "", "bytes", "");
  fmt::print(fmt::runtime(kLine), "draw", "triangles", "all", "drawn", "uncovered", "survive", "all", "hi_z",
             "early_z", "survive", "read", "written");
  const auto line = [&](const std::string& name, const Accounts& a) {
    const ledger::PieceAccount& p = a.pieces;
    fmt::print(fmt::runtime(kLine), name, a.triangles.all, p.all,
               p.all - p.zero_area - p.culled - p.no_sample - p.outside, p.uncovered, p.survive,
               a.fragments.all, a.fragments.hi_z_block + a.fragments.hi_z_tile, a.fragments.early_z,
               a.fragments.survive, a.read.fetched, a.written.evicted + a.written.flushed);
  };
  for (std::size_t i = 0; i < ledger.draws.size(); ++i) {
    line(fmt::format("{}", i), ledger.draws[i].accounts);
  }
  line("clears", ledger.clears);
  line("flush", ledger.flush);
  line("frame", ledger.frame);
}

void print_accounts(const Accounts& accounts) {
  Accounts::each([&](const char* account_name, auto member) {
    const auto& account = accounts.*member;
    using Account = std::remove_cvref_t<decltype(account)>;
    const std::string_view name = account_name;
    const bool bytes = name == "read" || name == "written";
    Account::fields([&](const char* cause, const char* help, auto count) {
      const std::uint64_t value = account.*count;
      if (std::string_view(cause) == "all") {
        fmt::print("  {:<16}{:>12}         {}{}\n", name, value, bytes ? "bytes " : "", help);
      } else if (value != 0) {
        fmt::print("    {:<14}{:>12} {:>6.1f}%  {}\n", cause, value, percent(value, account.all), help);
      }
    });
  });
}

void print_savings(const ledger::Savings& savings) {
  fmt::print("  {:<30}{:>12}{:>9}{:>13}{:>9}{:>13}{:>9}\n", "savings", "cycles", "", "bytes read", "",
             "written", "");
  const auto change = [](std::uint64_t value, std::uint64_t to) {
    return to == 0
               ? std::string()
               : fmt::format("{:+.1f}%", 100 * (static_cast<double>(value) / static_cast<double>(to) - 1));
  };
  const auto line = [&](const std::string& name, const ledger::RunCost& cost) {
    const ledger::RunCost& on = savings.all_on;
    fmt::print("    {:<28}{:>12}{:>9}{:>13}{:>9}{:>13}{:>9}\n", name, cost.cycles,
               change(cost.cycles, on.cycles), cost.read, change(cost.read, on.read), cost.written,
               change(cost.written, on.written));
  };
  line("all on", savings.all_on);
  for (const ledger::Saving& saving : savings.switches) {
    line(saving.key + " off", saving.without);
  }
  line("all off", savings.all_off);
}

void print_report(const LedgerReport& report, bool draws) {
  if (draws) {
    print_draws(report.ledger);
  }
  fmt::print("{}: {} draws; {} numbers compared with fidelity {}, all equal\n", report.frame,
             report.ledger.draws.size(), report.ledger.numbers, info(report.fidelity).name);
  print_accounts(report.ledger.frame);
  if (report.savings) {
    print_savings(*report.savings);
  }
}

void ledger_command(const LedgerOptions& options) {
  const Fidelity fidelity = fidelity_of(options.fidelity);
  options.rtl.check(fidelity);
  RunOptions run_options;
  run_options.watch.count_pixels = false;
  options.rtl.apply(run_options);
  const Config config = options.machine.config();
  ledger::check_machine(config);
  const Frame frame = options.input.frame();
  std::optional<OutputFolder> folder;
  if (!options.out.empty()) {
    folder.emplace(options.out);
  }
  const RunResult counted = run(fidelity, frame, config, run_options);
  if (counted.rtl && counted.rtl->different != 0) {
    throw ledger::LedgerError(fmt::format("the RTL differs from the model in {} places; first: {}",
                                          counted.rtl->different, counted.rtl->first));
  }
  LedgerReport report{.frame = frame.name,
                      .config = config,
                      .fidelity = fidelity,
                      .cycles = {},
                      .ledger = ledger::make_ledger(frame, config, counted.frame),
                      .savings = {}};
  if (counted.cycles) {
    report.cycles = counted.cycles->cycles;
  }
  if (options.savings) {
    ProgressBar bar(frame.name);
    report.savings = ledger::measure_savings(frame, config, options.threads.count,
                                             [&](std::size_t done, std::size_t of) { bar.update(done, of); });
  }
  if (folder) {
    write_ledger_files(*folder, report);
    folder->commit();
  }
  if (options.json) {
    fmt::print("{}", ledger_json(report, folder ? folder->files() : std::vector<std::string>{}));
  } else {
    print_report(report, !options.no_draws);
  }
}

}  // namespace

void add_ledger_command(CLI::App& app, ExitStatus& /*status*/) {
  auto options = std::make_shared<LedgerOptions>();
  CLI::App* command = app.add_subcommand(
      "ledger", "what became of every triangle, tile, quad, fragment and line of depth, and what saved work");
  options->input.add_to(*command);
  options->machine.add_to(*command);
  command->add_option("--fidelity", options->fidelity, "whose counters the ledger must agree with")
      ->check(one_of_table(kFidelityInfo, &FidelityInfo::name))
      ->capture_default_str();
  options->rtl.add_folder_to(*command);
  CLI::Option* savings = command->add_flag(
      "--savings", options->savings,
      "run the frame with all switches of the machine on, with each off in turn, and with all "
      "off (recurrence)");
  options->threads.add_to(*command, "With --savings: one runs the units, one times packets");
  command->get_option("--threads")->needs(savings);
  command->add_option("--out", options->out, "folder for ledger.json, ledger.csv and ledger.svg")
      ->type_name("DIR");
  CLI::Option* json = command->add_flag("--json", options->json, "print ledger.json, not the tables");
  command->add_flag("--no-draws", options->no_draws, "leave out the table of draws")->excludes(json);
  command->callback([options] { ledger_command(*options); });
}

}  // namespace halfspace
