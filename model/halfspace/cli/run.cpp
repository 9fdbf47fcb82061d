/// halfspace run: the main job.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>

#include "halfspace/cli/commands.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/cli/progress.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/report/output_folder.hpp"
#include "halfspace/report/recorder.hpp"
#include "halfspace/report/result_files.hpp"
#include "halfspace/report/stats.hpp"
#include "halfspace/report/tile_job_file.hpp"
#include "halfspace/report/timeline.hpp"
#include "halfspace/timing/analytic/analytic.hpp"
#include "halfspace/timing/functional.hpp"
#include "halfspace/timing/recurrence/run_recurrence.hpp"
#include "halfspace/timing/rtl/pipeline_library.hpp"
#include "halfspace/timing/rtl/run_rtl.hpp"
#include "halfspace/timing/systemc/run_systemc.hpp"

namespace halfspace {
namespace {

struct RunOptions {
  InputOptions input;
  MachineOptions machine;
  StallOptions stalls;
  TimelineOptions timeline;
  std::string fidelity = "functional";
  std::string out;
  std::string tile_jobs;
  std::string vcd;
  RtlOptions rtl;
  bool quads = false;
  bool tiles = false;
  bool no_pictures = false;
};

/// The file that the SystemC kernel will write, which adds .vcd where it is missing. The kernel takes for
/// granted that it can: it ends the program where it cannot.
std::filesystem::path writable_vcd(std::filesystem::path path) {
  if (!path.empty()) {
    path += path.extension() == ".vcd" ? "" : ".vcd";
    if (!std::ofstream(path)) {
      throw InputError(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(errno)));
    }
  }
  return path;
}

/// What a run takes and gives beside the frame.
struct Times {
  TimedRun packets;
  std::optional<AnalyticFrame> estimate;
  std::optional<rtl::PacketReport> rtl;  ///< RTL against model
};

/// A way to have time, and what it can do beside.
struct Fidelity {
  const char* name;
  bool packets;   ///< when every packet moves: stalls can be injected
  bool timeline;  ///< tells where the cycles go
  bool vcd;
  bool rtl;  ///< verilated
  FrameResult (*run)(const Frame&, const Config&, bool keep_visible, PacketObserver*, Times&,
                     const RunOptions&);
};

constexpr std::array kFidelities{
    Fidelity{"functional", false, false, false, false,
             [](const Frame& frame, const Config& config, bool keep_visible, PacketObserver* observer, Times&,
                const RunOptions&) { return run_functional(frame, config, keep_visible, observer); }},
    Fidelity{"analytic", false, false, false, false,
             [](const Frame& frame, const Config& config, bool keep_visible, PacketObserver* observer,
                Times& times, const RunOptions&) {
               return run_analytic(frame, config, keep_visible, observer, times.estimate.emplace());
             }},
    Fidelity{"recurrence", true, true, false, false,
             [](const Frame& frame, const Config& config, bool keep_visible, PacketObserver* observer,
                Times& times, const RunOptions&) {
               return run_recurrence(frame, config, keep_visible, observer, times.packets);
             }},
    Fidelity{"systemc", true, false, true, false,
             [](const Frame& frame, const Config& config, bool keep_visible, PacketObserver* observer,
                Times& times, const RunOptions& options) {
               return run_systemc(frame, config, keep_visible, observer, times.packets,
                                  {.vcd = writable_vcd(options.vcd)});
             }},
    Fidelity{"rtl", true, false, false, true,
             [](const Frame& frame, const Config& config, bool keep_visible, PacketObserver* observer,
                Times& times, const RunOptions& options) {
               const std::unique_ptr<rtl::VerilatedPipeline> pipeline = options.rtl.pipeline(config);
               return run_rtl(frame, config, keep_visible, observer, times.packets, *pipeline,
                              times.rtl.emplace());
             }},
};

/// Refuses options that are nothing to the fidelity.
void check_fidelity(const Fidelity& fidelity, const RunOptions& options) {
  const auto demand = [&](bool given, const char* option, bool Fidelity::*needed) {
    if (!given || fidelity.*needed) {
      return;
    }
    std::vector<const char*> names;
    for (const Fidelity& each : kFidelities) {
      if (each.*needed) {
        names.push_back(each.name);
      }
    }
    throw InputError(fmt::format("--fidelity is '{}'; with {} it must be one of: {}", fidelity.name, option,
                                 fmt::join(names, ", ")));
  };
  demand(!options.stalls.stalls.empty(), "--stall", &Fidelity::packets);
  demand(!options.stalls.seed.empty(), "--seed", &Fidelity::packets);
  demand(options.timeline.wanted, "--timeline", &Fidelity::timeline);
  demand(!options.vcd.empty(), "--vcd", &Fidelity::vcd);
  demand(!options.rtl.wave.empty(), "--wave", &Fidelity::rtl);
  demand(!options.rtl.folder.empty(), "--rtl-folder", &Fidelity::rtl);
  demand(!options.rtl.seed.empty(), "--rtl-seed", &Fidelity::rtl);
}

/// Records what was asked for and shows progress. `timeline` may be null.
class RunObserver final : public Recorder {
 public:
  RunObserver(const Frame& frame, const Config& config, const Options& options, const std::string& tile_jobs,
              Timeline* timeline)
      : Recorder(frame, config.tile_walker.tile_size, options),
        bar_(frame.name),
        timeline_(timeline),
        tile_size_(static_cast<std::uint32_t>(config.tile_walker.tile_size)) {
    if (!tile_jobs.empty()) {
      jobs_.emplace(tile_jobs, Widths{.SubPixelBits = config.raster.sub_pixel_bits,
                                      .TileSize = config.tile_walker.tile_size});
    }
  }

  [[nodiscard]] bool wants_tile_jobs() const override { return jobs_.has_value() || timeline_ != nullptr; }
  void tile_job(const TileJob& job) override {
    if (jobs_) {
      jobs_->write(job);
    }
    if (timeline_ != nullptr) {
      timeline_->tile(job.tile_x * tile_size_, job.tile_y * tile_size_);
    }
  }
  void draw_done(std::size_t done, std::size_t of) override { bar_.update(done, of); }

  void finish() {
    Recorder::finish();
    if (jobs_) {
      jobs_->close();
    }
  }

 private:
  ProgressBar bar_;
  Timeline* timeline_;
  std::uint32_t tile_size_;
  std::optional<TileJobWriter> jobs_;
};

double percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

void row(std::string_view unit, std::uint64_t value, const std::string& what) {
  fmt::print("  {:<16}{:>12}  {}\n", unit, value, what);
}

/// What bounds the draws, by the cycles of those it bounds.
void print_bounds(const AnalyticFrame& frame) {
  std::array<std::uint64_t, kBounds> cycles{};
  for (const AnalyticDraw& draw : frame.draws) {
    cycles[static_cast<std::size_t>(draw.bound)] += draw.cycles;
  }
  for (std::size_t i = 0; i < kBounds; ++i) {
    if (cycles[i] != 0) {
      row(kBoundName[i], cycles[i], "cycles of the draws that it bounds");
    }
  }
}

/// Where the cycles went: each stage's two largest reasons to wait, memory.
void print_cycles(const FrameResult& result, const FrameCycles& frame) {
  const auto share = [&frame](std::uint64_t cycles) {
    return fmt::format("{:.1f}%", percent(cycles, frame.cycles));
  };
  for (std::size_t i = 0; i < kStages; ++i) {
    const StageCycles& cycles = frame.stats.stage[i];
    std::array<std::size_t, kMostStallReasons> reasons{0, 1, 2, 3, 4};
    std::partial_sort(reasons.begin(), reasons.begin() + 2, reasons.end(),
                      [&](std::size_t l, std::size_t r) { return cycles.stall[l] > cycles.stall[r]; });
    std::string text = "busy";
    for (const std::size_t reason : {reasons[0], reasons[1]}) {
      if (cycles.stall[reason] != 0) {
        text += fmt::format(", {} {}", kStageInfo[i].stall[reason], share(cycles.stall[reason]));
      }
    }
    fmt::print("  {:<16}{:>12}  {}\n", kStageInfo[i].name, share(cycles.busy), text);
  }
  const std::uint64_t read = memory_bytes_read(result);
  const std::uint64_t written = memory_bytes_written(result);
  row("memory", read + written,
      fmt::format("bytes; {} read ({} of the cycles), {} written ({})", read, share(frame.stats.read_busy),
                  written, share(frame.stats.write_busy)));
}

void print_table(const Frame& frame, const FrameResult& result) {
  const Counters& c = result.counters;
  fmt::print("{}: {} draws on {} depth surfaces\n", frame.name, result.draws.size(), result.surfaces.size());
  row("front end", c.front_end.triangles,
      fmt::format("triangles; {} clipped away, {} cut, {} not finite", c.front_end.clipped_away,
                  c.front_end.clipped, c.front_end.non_finite + c.front_end.degenerate));
  row("setup", c.setup.drawn,
      fmt::format("drawn; {} face away, {} without area, {} hit no sample, {} outside", c.setup.culled,
                  c.setup.zero_area, c.setup.no_sample, c.setup.outside));
  const TileWalkerCounters& w = c.tile_walker;
  row("tile_walker", c.edge_evaluator.tiles + c.edge_evaluator.tiles_skipped,
      fmt::format("tiles; {} rejected, {} covered whole ({} by their block)", w.tiles_rejected,
                  c.edge_evaluator.tiles_skipped, w.tiles_by_block));
  row("edge_evaluator", c.edge_evaluator.tiles,
      fmt::format(
          "tiles evaluated; {} empty, {:.1f}% of edges skipped", c.edge_evaluator.tiles_empty,
          percent(c.edge_evaluator.edges_skipped, c.edge_evaluator.edges + c.edge_evaluator.edges_skipped)));
  row("quad_generator", c.quad_generator.quads,
      fmt::format("quads; {} fragments, {} helpers ({:.1f}% of lanes)", c.quad_generator.fragments,
                  c.quad_generator.helpers, percent(c.quad_generator.helpers, 4 * c.quad_generator.quads)));
  row("early_z", c.early_z.survivors,
      fmt::format("fragments survive ({:.1f}%); {} tested, {} written",
                  percent(c.early_z.survivors, c.quad_generator.fragments), c.early_z.tested,
                  c.early_z.written));
  if (result.draws_not_filled != 0) {
    fmt::print("  {} draws skipped: their polygons are drawn as lines or points\n", result.draws_not_filled);
  }
}

/// What the scoreboard of a verilated run says. Returns whether RTL and model agree.
bool print_report(const rtl::PacketReport& report) {
  row("model", report.compared,
      report.different == 0 ? "packets, pixels and counters compared, all equal"
                            : fmt::format("packets, pixels and counters compared, {} DIFFER; first: {}",
                                          report.different, report.first));
  return report.different == 0;
}

/// Returns the exit status.
int run(const RunOptions& options) {
  const Fidelity& fidelity = *std::find_if(kFidelities.begin(), kFidelities.end(), [&](const Fidelity& each) {
    return each.name == options.fidelity;  // one of them is: the parser has seen to it
  });
  check_fidelity(fidelity, options);
  Times times;
  times.packets.stalls = options.stalls.plan();
  const TimelineChoice choice = options.timeline.choice();
  const Config config = options.machine.config();
  const Frame frame = options.input.frame();
  std::optional<OutputFolder> folder;
  Recorder::Options record;
  if (!options.out.empty()) {
    folder.emplace(options.out);
    record.sums = !options.no_pictures;
    if (options.quads) {
      record.quads = folder->file("quads.npy");
    }
    if (options.tiles) {
      record.tiles = folder->file("tiles.npy");
    }
  }
  std::optional<Timeline> timeline;
  if (options.timeline.wanted) {
    times.packets.observer = &timeline.emplace(folder->file(kTimelineFile), frame, config, choice);
  }
  RunObserver observer(frame, config, record, options.tile_jobs, timeline ? &*timeline : nullptr);
  const FrameResult result = fidelity.run(frame, config, record.sums, &observer, times, options);
  observer.finish();
  if (timeline) {
    timeline->finish(times.packets.cycles.cycles);
  }
  const RunTime time{.packets = fidelity.packets ? &times.packets : nullptr,
                     .estimate = times.estimate ? &*times.estimate : nullptr};
  if (folder) {
    write_result_files(*folder, frame, config, fidelity.name, result, time, observer);
    folder->commit();
  }
  print_table(frame, result);
  if (const std::optional<std::uint64_t> cycles = time.cycles()) {
    const auto quads = static_cast<double>(result.counters.quad_generator.quads);
    row("cycles", *cycles, fmt::format("{:.2f} quads a cycle", quads / static_cast<double>(*cycles)));
  }
  if (time.packets != nullptr) {
    print_cycles(result, time.packets->cycles);
  } else if (time.estimate != nullptr) {
    print_bounds(*time.estimate);
  }
  const bool agree = !times.rtl || print_report(*times.rtl);
  if (folder) {
    fmt::print("  results in {}\n", options.out);
  }
  return agree ? 0 : 1;
}

}  // namespace

void add_run_command(CLI::App& app, int& status) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("run", "rasterize a frame or a mesh");
  options->input.add_to(*command);
  options->machine.add_to(*command);
  std::vector<std::string> fidelities;
  for (const Fidelity& fidelity : kFidelities) {
    fidelities.emplace_back(fidelity.name);
  }
  command->add_option("--fidelity", options->fidelity, "how time is had")
      ->check(CLI::IsMember(fidelities))
      ->capture_default_str();
  options->stalls.add_to(*command);
  CLI::Option* out =
      command->add_option("--out", options->out, "folder for results (default: only the table)")
          ->type_name("DIR");
  command->add_flag("--quads", options->quads, "record every quad in quads.npy")->needs(out);
  command->add_flag("--tiles", options->tiles, "record every decision of the walker in tiles.npy")
      ->needs(out);
  options->timeline.add_to(*command, out);
  command->add_flag("--no-pictures", options->no_pictures, "leave out the pictures")->needs(out);
  options->rtl.add_to(*command);
  command->add_option("--vcd", options->vcd, "write what links and stages do as a waveform (systemc)")
      ->type_name("FILE");
  command
      ->add_option("--tile-jobs", options->tile_jobs,
                   "write the tile jobs of the edge evaluator, for its bench")
      ->type_name("FILE");
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace halfspace
