/// halfspace run: the main job.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "halfspace/cli/commands.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/cli/progress.hpp"
#include "halfspace/report/output_folder.hpp"
#include "halfspace/report/recorder.hpp"
#include "halfspace/report/result_files.hpp"
#include "halfspace/report/tile_job_file.hpp"
#include "halfspace/timing/functional.hpp"

namespace halfspace {
namespace {

struct RunOptions {
  InputOptions input;
  MachineOptions machine;
  std::string fidelity = "functional";
  std::string out;
  std::string tile_jobs;
  bool quads = false;
  bool tiles = false;
  bool no_pictures = false;
};

/// Records what was asked for and shows progress.
class RunObserver final : public Recorder {
 public:
  RunObserver(const Frame& frame, const Config& config, const Options& options, const std::string& tile_jobs)
      : Recorder(frame, config.tile_size, options), bar_(frame.name) {
    if (!tile_jobs.empty()) {
      jobs_.emplace(tile_jobs, Widths{.SubPixelBits = config.sub_pixel_bits, .TileSize = config.tile_size});
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

double percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

void print_table(const Frame& frame, const FrameResult& result) {
  const Counters& c = result.counters;
  const auto row = [](const char* unit, std::uint64_t value, const std::string& what) {
    fmt::print("  {:<16}{:>12}  {}\n", unit, value, what);
  };
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

void run(const RunOptions& options) {
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
  RunObserver observer(frame, config, record, options.tile_jobs);
  const FrameResult result = run_functional(frame, config, record.sums, &observer);
  observer.finish();
  if (folder) {
    write_result_files(*folder, frame, config, options.fidelity, result, observer);
    folder->commit();
  }
  print_table(frame, result);
  if (folder) {
    fmt::print("  results in {}\n", options.out);
  }
}

}  // namespace

void add_run_command(CLI::App& app, int& /*status*/) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("run", "rasterize a frame or a mesh");
  options->input.add_to(*command);
  options->machine.add_to(*command);
  command->add_option("--fidelity", options->fidelity, "how time is had")
      ->check(CLI::IsMember({"functional"}))
      ->capture_default_str();
  CLI::Option* out =
      command->add_option("--out", options->out, "folder for results (default: only the table)")
          ->type_name("DIR");
  command->add_flag("--quads", options->quads, "record every quad in quads.npy")->needs(out);
  command->add_flag("--tiles", options->tiles, "record every decision of the walker in tiles.npy")
      ->needs(out);
  command->add_flag("--no-pictures", options->no_pictures, "leave out the pictures")->needs(out);
  command
      ->add_option("--tile-jobs", options->tile_jobs,
                   "write the tile jobs of the edge evaluator, for its bench")
      ->type_name("FILE");
  command->callback([options] { run(*options); });
}

}  // namespace halfspace
