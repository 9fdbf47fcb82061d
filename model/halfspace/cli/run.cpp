/// halfspace run: the main job.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/cli/commands.hpp"
#include "halfspace/cli/exit_status.hpp"
#include "halfspace/cli/frame_time.hpp"
#include "halfspace/cli/known_words.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/cli/progress.hpp"
#include "halfspace/cli/run_reference.hpp"
#include "halfspace/cli/run_table.hpp"
#include "halfspace/cli/supersample_options.hpp"
#include "halfspace/machine/attribute_planes.hpp"
#include "halfspace/machine/observer_pair.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/report/output_folder.hpp"
#include "halfspace/report/pixel_quad_file.hpp"
#include "halfspace/report/recorder.hpp"
#include "halfspace/report/result_files.hpp"
#include "halfspace/report/step_recorder.hpp"
#include "halfspace/report/tile_job_file.hpp"
#include "halfspace/report/timeline.hpp"
#include "halfspace/report/what_if.hpp"
#include "halfspace/run/run.hpp"
#include "halfspace/whatif/sequence.hpp"

namespace halfspace {
namespace {

struct RunCommand {
  InputOptions input;
  WhatIfOptions what_if;
  MachineOptions machine;
  CoreOption core;
  ThreadsOption threads;
  StallOptions stalls;
  TimelineOptions timeline;
  std::string fidelity = "functional";
  std::string reference;
  std::string out;
  std::string tile_jobs;
  std::optional<int> quad_merging;
  std::string vcd;
  RtlOptions rtl;
  bool quads = false;
  bool tiles = false;
  bool steps = false;
  int timed = 0;
  bool no_pictures = false;
  std::string interpolation;
  SupersampleOptions supersample;

  [[nodiscard]] bool wants_pictures() const { return !out.empty() && !no_pictures; }
  /// Pictures show attributes, and the quads that the interpolator gets.
  [[nodiscard]] MeshContent content(const Config& config) const {
    const bool interpolates = quads && config.interpolator.enabled;
    return wants_pictures() || interpolates ? MeshContent::kAttributes : MeshContent::kGeometry;
  }
};

struct InterpolationName {
  const char* name;
  Interpolation value;
};
constexpr std::array<InterpolationName, 3> kInterpolations{{{"perspective", Interpolation::kPerspective},
                                                            {"affine", Interpolation::kAffine},
                                                            {"flat", Interpolation::kFlat}}};

/// Throws OptionError where it is given and no picture shows it.
Interpolation interpolation_of(const RunCommand& command, const Frame& frame) {
  if (command.interpolation.empty()) {
    return Interpolation::kPerspective;
  }
  const auto refuse = [&](const char* why) {
    throw OptionError(
        fmt::format("--interpolation is '{}', {}; legal: for the picture of one mesh with "
                    "colours, texture coordinates, normals or materials, without a what-if",
                    command.interpolation, why));
  };
  if (!command.wants_pictures()) {
    refuse(command.out.empty() ? "given without --out" : "given with --no-pictures");
  }
  if (command.what_if.what_if().any()) {
    refuse("given with a what-if");
  }
  if (command.input.paths.size() > 1) {
    refuse("given with several inputs");
  }
  if (frame.attributes == nullptr) {
    refuse("given with an input without attributes");
  }
  return std::ranges::find(kInterpolations, command.interpolation, &InterpolationName::name)->value;
}

PictureOptions picture_options(const RunCommand& command, const Frame& frame) {
  return {.interpolation = interpolation_of(command, frame), .filter = command.supersample.picture_filter()};
}

/// As large as they are drawn.
std::vector<Frame> frames_of(const RunCommand& command, const Config& config) {
  std::vector<Frame> frames = command.input.frames(command.content(config));
  command.supersample.apply(frames, command.wants_pictures());
  return frames;
}

/// Throws OptionError where a mesh would be shaded at other samples than the centres.
void check_shading(const RunCommand& command, const Frame& frame, const Config& config) {
  if (frame.attributes != nullptr && command.wants_pictures()) {
    require_centre(config, "the shaded picture of a mesh (--no-pictures leaves it out)");
  }
}

/// Refuses options that the fidelity does not support.
void check_fidelity(Fidelity fidelity, const RunCommand& options) {
  require(fidelity, options.core.core() != Core::kAuto, "--core", &FidelityInfo::core);
  require(fidelity, options.threads.count > 1, "--threads above 1", &FidelityInfo::threads);
  require(fidelity, !options.stalls.stalls.empty(), "--stall", &FidelityInfo::packets);
  require(fidelity, !options.stalls.seed.empty(), "--seed", &FidelityInfo::packets);
  // As the core, the recorder needs units that work in order.
  require(fidelity, options.steps, "--steps", &FidelityInfo::core);
  require(fidelity, options.timeline.wanted, "--timeline", &FidelityInfo::timeline);
  require(fidelity, !options.vcd.empty(), "--vcd", &FidelityInfo::vcd);
  options.rtl.check(fidelity);
}

/// Refuses options that a reference rasterizer has no use for.
void check_reference(const RunCommand& options) {
  const RtlOptions& rtl = options.rtl;
  for (const auto& [given, name] : {std::pair{options.fidelity != "functional", "--fidelity"},
                                    {options.core.core() != Core::kAuto, "--core"},
                                    {options.threads.count > 1, "--threads above 1"},
                                    {!options.stalls.stalls.empty(), "--stall"},
                                    {!options.stalls.seed.empty(), "--seed"},
                                    {options.tiles, "--tiles"},
                                    {options.steps, "--steps"},
                                    {!options.tile_jobs.empty(), "--tile-jobs"},
                                    {options.timeline.wanted, "--timeline"},
                                    {!options.vcd.empty(), "--vcd"},
                                    {options.quad_merging.has_value(), "--quad-merging"},
                                    {!rtl.wave.empty(), "--wave"},
                                    {!rtl.folder.empty(), "--rtl-folder"},
                                    {!rtl.seed.empty(), "--rtl-seed"},
                                    {rtl.every_cycle, "--rtl-every-cycle"},
                                    {options.what_if.what_if().any(), "a what-if"}}) {
    if (given) {
      throw OptionError(fmt::format(
          "--reference is '{}', given with {}; legal with it: --config, --set, --out, --quads, "
          "--no-pictures, --time, --interpolation, --supersample, --filter, and the camera of a mesh",
          options.reference, name));
    }
  }
}

/// Records what was asked for and shows progress.
class RunObserver final : public Recorder {
 public:
  RunObserver(const Frame& frame, const Config& config, const Options& options, const std::string& tile_jobs)
      : Recorder(options), bar_(frame.name) {
    if (!tile_jobs.empty()) {
      jobs_.emplace(tile_jobs, widths(config));
    }
  }

  [[nodiscard]] bool wants_tile_jobs() const override { return jobs_.has_value(); }
  void tile_job(const TileJob& job) override { jobs_->write(job); }
  void draw_done(std::size_t done, std::size_t of) override { bar_.update(done, of); }

  void finish() {
    Recorder::finish();
    if (jobs_) {
      jobs_->close();
    }
  }

 private:
  ProgressBar bar_;
  std::optional<TileJobWriter> jobs_;
};

/// What draws in runs of this fidelity, in words.
std::string engine_text(Fidelity fidelity, Core core) {
  return info(fidelity).core ? fmt::format("{} on the {} core", info(fidelity).name,
                                           kCoreName[static_cast<std::size_t>(core)])
                             : std::string(info(fidelity).name);
}

/// Times more runs of the frame, which keep nothing beside the image.
void time_runs(const RunCommand& command, Fidelity fidelity, const Frame& frame, const Config& config,
               const RunOptions& shown) {
  if (command.timed == 0) {
    return;
  }
  RunOptions options = shown;
  options.cycle_observer = nullptr;
  options.quad_merging.reset();
  options.pixel_rate = false;
  options.vcd.clear();
  options.wave.clear();
  options.watch = {.count_pixels = false, .core = shown.watch.core, .threads = shown.watch.threads};
  const Core core = run(fidelity, frame, config, options).frame.core;  // and warms caches and page tables
  print_time(command.timed, engine_text(fidelity, core), [&] { run(fidelity, frame, config, options); });
}

/// The same run of the frame as it is, for its work alone.
RunResult run_without(Fidelity fidelity, const Frame& frame, const Config& config, const RunOptions& with) {
  RunObserver observer(frame, config, {}, "");
  RunOptions options = with;
  options.cycle_observer = nullptr;
  options.pixel_rate = false;
  options.vcd.clear();
  options.wave.clear();
  options.watch = {
      .count_pixels = false, .observer = &observer, .core = with.watch.core, .threads = with.watch.threads};
  return run(fidelity, frame, config, options);
}

ExitStatus run_command(const RunCommand& command) {
  if (!command.reference.empty()) {
    check_reference(command);
    const Config config = command.machine.config(Samples::kAny);
    require_centre(config, "--reference");
    Frame frame = whatif::join(frames_of(command, config));
    const PictureOptions picture = picture_options(command, frame);
    run_reference({.method = command.reference,
                   .out = command.out,
                   .quads = command.quads,
                   .pictures = !command.no_pictures,
                   .timed = command.timed,
                   .picture = picture},
                  std::move(frame), config);
    return ExitStatus::kDone;
  }
  const Fidelity fidelity = fidelity_of(command.fidelity);
  check_fidelity(fidelity, command);
  RunOptions options;
  options.stalls = command.stalls.plan();
  options.quad_merging = command.quad_merging;
  options.vcd = command.vcd;
  command.rtl.apply(options);
  const TimelineChoice choice = command.timeline.choice();
  const Config config = command.machine.config(Samples::kAny);
  if (!command.tile_jobs.empty()) {
    require_centre(config, "--tile-jobs");
  }
  const whatif::WhatIf what_if = command.what_if.what_if();
  std::vector<Frame> frames = frames_of(command, config);
  const std::optional<Frame> as_it_is = what_if.any() ? std::optional(whatif::join(frames)) : std::nullopt;
  const auto [frame, applied] = whatif::apply(std::move(frames), what_if);
  const PictureOptions picture = picture_options(command, frame);
  check_shading(command, frame, config);
  std::optional<OutputFolder> folder;
  Recorder::Options record;
  record.samples = config.raster.samples;
  record.inner_coverage = config.raster.inner_coverage;
  record.attributes = config.interpolator.enabled ? config.interpolator.attributes : 0;
  if (!command.out.empty()) {
    folder.emplace(command.out);
    if (command.quads) {
      record.quads = folder->file("quads.npy");
    }
    if (command.tiles) {
      record.tiles = folder->file("tiles.npy");
    }
  }
  std::optional<Timeline> timeline;
  if (command.timeline.wanted) {
    options.cycle_observer = &timeline.emplace(folder->file(kTimelineFile), frame, config, choice);
  }
  RunObserver observer(frame, config, record, command.tile_jobs);
  std::optional<StepRecorder> steps;
  std::optional<ObserverPair> both;
  if (command.steps) {
    steps.emplace(config, folder->file("triangles.npy"), folder->file("steps.npy"));
    both.emplace(observer, *steps);
  }
  options.pixel_rate = true;
  std::optional<PixelQuadFile> pixel_quads;
  if (command.quads && config.raster.samples > 1) {
    pixel_quads.emplace(folder->file("pixel_quads.npy"));
    options.pixel_quad = [&](const PixelQuadEvent& quad) { pixel_quads->write(quad); };
  }
  const bool pictures = command.wants_pictures();
  options.watch = {.keep_visible = pictures,
                   .count_pixels = folder.has_value(),
                   .keep_sums = pictures,
                   .observer = both ? static_cast<PacketObserver*>(&*both) : &observer,
                   .core = command.core.core(),
                   .threads = command.threads.count};
  const RunResult result = run(fidelity, frame, config, options);
  observer.finish();
  if (steps) {
    steps->finish();
  }
  if (pixel_quads) {
    pixel_quads->finish();
  }
  if (timeline) {
    timeline->finish(result.cycles->cycles);
  }
  std::optional<WhatIfReport> report;
  bool agree = true;
  if (as_it_is) {
    const RunResult without = run_without(fidelity, *as_it_is, config, options);
    report = {.applied = applied, .without = work_of(*as_it_is, without), .with = work_of(frame, result)};
    agree = !without.rtl || without.rtl->different == 0;
  }
  if (folder) {
    write_result_files(*folder, frame, config, fidelity, options.stalls, result, report, picture);
    folder->commit();
  }
  agree = print_result(frame, result) && agree;
  if (report) {
    print_what_if(*report);
  }
  time_runs(command, fidelity, frame, config, options);
  if (folder) {
    fmt::print("  results in {}\n", command.out);
  }
  return status_of(agree);
}

}  // namespace

void add_run_command(CLI::App& app, ExitStatus& status) {
  auto options = std::make_shared<RunCommand>();
  CLI::App* command = app.add_subcommand("run", "rasterize a frame or a mesh");
  options->input.add_several_to(*command);
  options->what_if.add_to(*command);
  options->machine.add_to(*command);
  command->add_option("--fidelity", options->fidelity, "selects the timing engine")
      ->check(one_of_table(kFidelityInfo, &FidelityInfo::name))
      ->capture_default_str();
  add_reference_option(*command, options->reference);
  options->core.add_to(*command);
  options->threads.add_to(*command,
                          "Functional: each draws in columns of blocks of its own; recurrence: one runs the "
                          "units, one times packets; systemc and rtl have one");
  options->stalls.add_to(*command);
  CLI::Option* out =
      command->add_option("--out", options->out, "folder for results (default: print only the table)")
          ->type_name("DIR");
  command->add_flag("--quads", options->quads, "record every quad in quads.npy")->needs(out);
  command->add_flag("--tiles", options->tiles, "record every decision of the walker in tiles.npy")
      ->needs(out);
  command
      ->add_flag("--steps", options->steps,
                 "record every triangle at setup and every step of its walk in triangles.npy and steps.npy")
      ->needs(out);
  add_time_option(*command, options->timed);
  options->timeline.add_to(*command, out);
  command->add_flag("--no-pictures", options->no_pictures, "leave out the pictures")->needs(out);
  command
      ->add_option("--interpolation", options->interpolation,
                   "how the shaded picture of a mesh interpolates its attributes (default: perspective)")
      ->check(one_of_table(kInterpolations, &InterpolationName::name));
  options->supersample.add_to(*command);
  command
      ->add_option(
          "--quad-merging", options->quad_merging,
          "count what merging quads of adjacent triangles behind early_z would save of shading, with a "
          "buffer of N quads; changes nothing of the run")
      ->check(CLI::Range(0, kMostMergeQuads))
      ->type_name("N");
  options->rtl.add_to(*command);
  command->add_option("--vcd", options->vcd, "write a waveform of links and stages (systemc)")
      ->type_name("FILE");
  command
      ->add_option("--tile-jobs", options->tile_jobs,
                   "write the tile jobs of the frame, for the bench of the edge evaluator")
      ->type_name("FILE");
  command->callback([options, &status] { status = run_command(*options); });
}

}  // namespace halfspace
