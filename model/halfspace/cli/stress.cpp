/// halfspace stress: a campaign that is hard on arithmetic, judged by exact arithmetic.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/cli/commands.hpp"
#include "halfspace/cli/exit_status.hpp"
#include "halfspace/cli/known_words.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/cli/progress.hpp"
#include "halfspace/cli/stress_sharpness.hpp"
#include "halfspace/cli/tie_rule.hpp"
#include "halfspace/config/did_you_mean.hpp"
#include "halfspace/machine/draw_state.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/reference/methods.hpp"
#include "halfspace/stress/campaign.hpp"
#include "halfspace/stress/campaign_report.hpp"
#include "halfspace/stress/engine_subject.hpp"
#include "halfspace/stress/exhaustive.hpp"
#include "halfspace/stress/line_families.hpp"
#include "halfspace/stress/reference_subject.hpp"
#include "halfspace/stress/wrong_rasterizer.hpp"

namespace halfspace {
namespace {

struct StressCommand {
  MachineOptions machine;
  CoreOption core;
  RtlOptions rtl;
  std::string fidelity = "functional";
  std::vector<std::string> families;
  std::string depth = "unorm24";
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> samples;
  std::optional<double> seconds;
  std::optional<std::uint64_t> cases;
  std::optional<double> depth_bound;
  std::string engine;
  std::string write;
  std::string out;
  bool lines = false;
  bool reports = false;
  bool sharpness = false;
  bool exhaustive = false;
  bool units = false;
  std::uint32_t every = 1;
  int threads = 1;
};

const CLI::Range kFromOne(std::uint64_t{1}, std::numeric_limits<std::uint64_t>::max());

DepthFormat format_of(const std::string& text) {
  return text == "unorm16"   ? DepthFormat::kUnorm16
         : text == "unorm24" ? DepthFormat::kUnorm24
                             : DepthFormat::kFloat32;
}

/// No draw of the campaign has a rule of its own.
stress::Precision precision_of(const StressCommand& command, const Config& config) {
  return {.sub_pixel_bits = config.raster.sub_pixel_bits,
          .format = format_of(command.depth),
          .rule = tie_rule(config).value_or(reference::TieRule::kTopLeft),
          .conservative = config.raster.conservative,
          .uncertainty = config.raster.uncertainty,
          .samples = sample_pattern(config)};
}

stress::CampaignPlan plan_of(const StressCommand& command, const Config& config) {
  stress::CampaignPlan plan{
      .precision = precision_of(command, config),
      .depth = {.interpolator = config.depth.interpolator, .bound = command.depth_bound},
      .seed = command.seed,
      .folder = command.out};
  const auto add = [&](std::span<const stress::Family> list, bool unasked) {
    const auto& wanted = command.families;
    for (const stress::Family& family : list) {
      const bool asked = wanted.empty() ? unasked : std::ranges::find(wanted, family.name) != wanted.end();
      const bool legal = config.raster.conservative == Conservative::kOff || stress::is_unclipped(family);
      if (asked && !legal && !wanted.empty()) {
        throw OptionError(fmt::format(
            "--family is {}, whose triangles are clipped; legal with raster.conservative: families that are "
            "not",
            family.name));
      }
      if (asked && legal) {
        plan.families.push_back(&family);
      }
    }
  };
  add(stress::families(), !command.reports && !command.lines);
  add(stress::line_families(), command.lines);
  add(stress::reports(), command.reports);
  if (command.samples) {
    plan.samples = *command.samples;
  }
  if (command.cases) {
    plan.cases = *command.cases;
  }
  if (command.seconds || !(command.samples || command.cases)) {
    plan.seconds = command.seconds.value_or(10);
  }
  return plan;
}

/// Of --engine, or else the engine of the fidelity. Throws InputError.
std::unique_ptr<stress::Subject> make_subject(const StressCommand& command, Fidelity fidelity,
                                              const Config& config, const RunOptions& options) {
  if (command.engine.empty()) {
    return stress::engine_subject(fidelity, config, options);
  }
  const std::size_t colon = command.engine.find(':');
  const std::string kind = command.engine.substr(0, colon);
  const std::string path = colon == std::string::npos ? "" : command.engine.substr(colon + 1);
  if (kind == "library" && !path.empty()) {
    return stress::library_subject(path, config.raster.sub_pixel_bits);
  }
  if (kind == "files" && !path.empty()) {
    return stress::files_subject(path);
  }
  if (kind == "reference") {
    const auto& known = reference::methods();
    if (std::ranges::find(known, path, &reference::Method::name) == known.end()) {
      throw OptionError(
          fmt::format("--engine is '{}'{}; legal behind 'reference:': {}", command.engine,
                      did_you_mean(path, known, &reference::Method::name),
                      fmt::join(known | std::views::transform(&reference::Method::name), ", ")));
    }
    return stress::reference_subject(path, precision_of(command, config));
  }
  if (kind == "wrong") {
    return stress::wrong_subject(stress::wrong_rasterizer(path), precision_of(command, config));
  }
  constexpr std::array<std::string_view, 4> kKinds{"library", "files", "reference", "wrong"};
  throw OptionError(
      fmt::format("--engine is '{}'{}; it must be library:FILE, files:DIR, reference:NAME or wrong:NAME",
                  command.engine, did_you_mean(kind, kKinds)));
}

/// All triangles of a small grid.
ExitStatus exhaustive_command(const StressCommand& command, Fidelity fidelity, const Config& config,
                              const RunOptions& options) {
  ProgressBar bar("exhaustive");
  const auto progress = [&](std::size_t done) { bar.update(done, stress::kGridPoints / command.every); };
  const reference::TieRule rule = precision_of(command, config).rule;
  stress::ExhaustiveTally tally;
  if (command.units) {
    tally = stress::check_units(fill_rule(Command{}, config), rule, command.every, command.threads, progress);
  } else {
    tally = stress::check_subject(*make_subject(command, fidelity, config, options), rule, command.every,
                                  progress);
  }
  fmt::print("{} triangles, {} of them without area; {} samples: {} wrong\n", tally.triangles,
             tally.without_area, tally.samples, tally.wrong);
  if (command.units) {
    fmt::print(
        "{} quads wrong; {} tiles decided, {} unsound; {} edges, {} samples on them, {} not owned once\n",
        tally.wrong_quads, tally.tiles, tally.unsound, tally.edges, tally.on_edges, tally.ownerless);
  }
  return status_of(tally.errors() == 0);
}

/// Only the families know of several samples a pixel, and only this machine has them.
void check_samples(const StressCommand& command, const Config& config) {
  for (const auto& [given, name] : {std::pair{command.reports, "--reports"},
                                    {command.sharpness, "--sharpness"},
                                    {command.exhaustive, "--exhaustive"},
                                    {command.units, "--exhaustive-units"},
                                    {!command.engine.empty(), "--engine"}}) {
    if (given) {
      require_centre(config, name);
    }
  }
}

/// Thin lines have pixels by their centres, and depth by the plane.
void check_lines(const StressCommand& command, const Config& config, const stress::CampaignPlan& plan) {
  const std::span<const stress::Family> lines = stress::line_families();
  const auto is_line = [&](const stress::Family* family) {
    return std::ranges::find(lines, family->name, &stress::Family::name) != lines.end();
  };
  const auto found = std::ranges::find_if(plan.families, is_line);
  if (found == plan.families.end()) {
    return;
  }
  const std::string what = fmt::format("family {}", (*found)->name);
  if (command.sharpness) {
    throw OptionError(fmt::format("--sharpness and {}: legal with it are families of triangles", what));
  }
  require_centre(config, what);
  if (config.raster.conservative != Conservative::kOff) {
    throw OptionError(fmt::format("raster.conservative is on; legal with {}: off", what));
  }
  if (config.depth.interpolator != DepthInterpolator::kPlane) {
    throw OptionError(fmt::format("depth.interpolator is barycentric; legal with {}: plane", what));
  }
  if (!command.engine.empty() && !command.engine.starts_with("files:")) {
    throw OptionError(fmt::format("--engine is '{}'; legal with {}: files:DIR", command.engine, what));
  }
}

ExitStatus stress_command(const StressCommand& command) {
  if (command.every != 1 && !command.exhaustive && !command.units) {
    throw OptionError(
        fmt::format("--every is {}; legal above 1: with --exhaustive or --exhaustive-units", command.every));
  }
  const Fidelity fidelity = fidelity_of(command.fidelity);
  require(fidelity, command.core.core() != Core::kAuto, "--core", &FidelityInfo::core);
  command.rtl.check(fidelity);
  RunOptions options;
  command.rtl.apply(options);
  options.watch.core = command.core.core();
  const Config config = command.machine.config(Samples::kAny);
  if (config.raster.conservative != Conservative::kOff &&
      (command.exhaustive || command.units || command.sharpness || command.reports ||
       command.engine.starts_with("reference:") || command.engine.starts_with("wrong:"))) {
    throw OptionError(
        "raster.conservative is on; legal off: with --exhaustive, --exhaustive-units, --sharpness, --reports "
        "and engines reference:NAME and wrong:NAME, which are of pixel centres");
  }
  check_samples(command, config);
  if (command.exhaustive || command.units) {
    return exhaustive_command(command, fidelity, config, options);
  }
  stress::CampaignPlan plan = plan_of(command, config);
  check_lines(command, config, plan);
  if (command.sharpness) {
    plan.folder.clear();
    return status_of(command.reports ? print_report_sharpness(plan) : print_sharpness(plan));
  }
  if (!command.write.empty()) {
    stress::write_cases(plan.families, plan.precision, plan.seed, command.cases.value_or(1), command.write);
    fmt::print("cases in {}\n", command.write);
    return ExitStatus::kDone;
  }
  const std::unique_ptr<stress::Subject> subject = make_subject(command, fidelity, config, options);
  ProgressBar bar("stress");
  const double most_samples = command.samples ? static_cast<double>(plan.samples) : 0;
  double start = -1;
  const stress::CampaignState state =
      stress::run_campaign(plan, *subject, [&](const stress::CampaignState& now) {
        start = start < 0 ? now.seconds : start;
        const double by_samples =
            most_samples == 0 ? 0 : static_cast<double>(now.sum().samples) / most_samples;
        const double done = std::max(by_samples, (now.seconds - start) / plan.seconds);
        bar.update(static_cast<std::size_t>(std::min(done, 1.0) * 1000), 1000);
      });
  if (!command.out.empty()) {
    stress::write_report(plan, state, *subject);
  }
  fmt::print("{}", stress::report_page(plan, state));
  if (!command.out.empty()) {
    fmt::print("\nresults in {}\n", command.out);
  }
  return status_of(state.sum().errors() == 0);
}

}  // namespace

void add_stress_command(CLI::App& app, ExitStatus& status) {
  auto options = std::make_shared<StressCommand>();
  CLI::App* command = app.add_subcommand("stress",
                                         "draw what is hard on arithmetic, and judge it by exact arithmetic; "
                                         "exit status 1 where a law is broken");
  options->machine.add_to(*command);
  CLI::Option* fidelity = command->add_option("--fidelity", options->fidelity, "selects the engine")
                              ->check(one_of_table(kFidelityInfo, &FidelityInfo::name))
                              ->capture_default_str();
  options->core.add_to(*command);
  CLI::Option* engine = command
                            ->add_option("--engine", options->engine,
                                         "another rasterizer: library:FILE, which has the function of "
                                         "halfspace_rasterizer.h; files:DIR, "
                                         "results for the frames of --write; reference:NAME, a textbook "
                                         "rasterizer; wrong:NAME, one that "
                                         "is wrong on purpose")
                            ->type_name("KIND:PATH")
                            ->excludes(fidelity);
  CLI::Option* write =
      command
          ->add_option("--write", options->write, "instead: write the first --cases of each family as frames")
          ->type_name("DIR");
  command
      ->add_option(
          "--depth-bound", options->depth_bound,
          "how far a depth may be off, in units of the last place (default: the bound of the interpolator)")
      ->check(CLI::Range(0.001, 1e6));
  options->rtl.add_to(*command);
  std::vector<std::string> names;
  for (const std::span<const stress::Family> list :
       {stress::families(), stress::line_families(), stress::reports()}) {
    for (const stress::Family& family : list) {
      names.emplace_back(family.name);
    }
  }
  CLI::Option* family = command
                            ->add_option("--family", options->families,
                                         "families of cases, or scenes of --reports (default: all families)")
                            ->delimiter(',')
                            ->check(one_of(names));
  CLI::Option* reports =
      command
          ->add_flag("--reports", options->reports,
                     "scenes from public reports of seams and holes instead of the families")
          ->excludes(family);
  CLI::Option* lines =
      command->add_flag("--lines", options->lines, "thin lines by every rule instead of the families")
          ->excludes(family)
          ->excludes(reports);
  command->add_option("--depth", options->depth, "depth format")
      ->check(one_of({"unorm16", "unorm24", "float32"}))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "of the cases")->capture_default_str();
  command->add_option("--samples", options->samples, "samples to judge, in all sittings")->check(kFromOne);
  command->add_option("--cases", options->cases, "cases of each family, in all sittings")->check(kFromOne);
  command
      ->add_option("--seconds", options->seconds,
                   "time of this sitting (default: 10, or what --samples and --cases take)")
      ->check(CLI::PositiveNumber);
  CLI::Option* out = command
                         ->add_option("--out", options->out,
                                      "folder for the report, its cases, and the state: the same command "
                                      "goes on where it was cut off")
                         ->type_name("DIR");
  CLI::Option* sharpness = command->add_flag(
      "--sharpness", options->sharpness,
      "instead: the campaign on rasterizers that are wrong on purpose; exit status 1 where one is not found");
  CLI::Option* exhaustive = command->add_flag("--exhaustive", options->exhaustive,
                                              "instead: all triangles with vertices on the 1/16 grid of 2x2 "
                                              "pixels, on the engine");
  CLI::Option* units = command->add_flag(
      "--exhaustive-units", options->units,
      "instead: the same through the units alone, in both windings, at two places, with all tile sizes");
  command->add_option("--every", options->every, "of --exhaustive: of the least vertices only one of so many")
      ->check(CLI::Range(1U, stress::kGridPoints))
      ->capture_default_str();
  command->add_option("--threads", options->threads, "of --exhaustive-units")
      ->needs(units)
      ->check(CLI::Range(1, kMostThreads))
      ->capture_default_str();
  // What a job does not look at is refused.
  const auto refuse = [command](CLI::Option* job, std::initializer_list<const char*> names) {
    for (const char* name : names) {
      job->excludes(command->get_option(name));
    }
  };
  refuse(write, {"--samples", "--seconds", "--depth-bound"});
  for (CLI::Option* grid : {exhaustive, units}) {
    refuse(grid, {"--family", "--depth", "--depth-bound", "--seed", "--samples", "--cases", "--seconds"});
  }
  for (CLI::Option* without_core : {engine, write, sharpness, units}) {
    refuse(without_core, {"--core"});
  }
  for (CLI::Option* instead : {write, sharpness, exhaustive, units}) {
    instead->excludes(out);
    if (instead != exhaustive) {
      instead->excludes(engine)->excludes(fidelity)->excludes(exhaustive);
    }
  }
  units->excludes(write)->excludes(sharpness);
  for (CLI::Option* list : {reports, lines}) {
    list->excludes(exhaustive)->excludes(units);
  }
  lines->excludes(sharpness);
  write->excludes(sharpness);
  command->callback([options, &status] { status = stress_command(*options); });
}

}  // namespace halfspace
