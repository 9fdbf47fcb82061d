/// halfspace bench speed: the functional model beside a plain loop and llvmpipe, in turns on the same
/// triangles.
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <functional>
#include <memory>

#include "halfspace/cli/bench.hpp"
#include "halfspace/cli/known_words.hpp"
#include "halfspace/cli/load_input.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/cli/progress.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/input_name.hpp"
#include "halfspace/scene/load.hpp"
#include "halfspace/scene/synthetic.hpp"
#include "halfspace/speed/llvmpipe.hpp"
#include "halfspace/speed/scalar_loop.hpp"
#include "halfspace/speed/speed_table.hpp"

namespace halfspace {
namespace {

struct SpeedOptions {
  std::vector<std::string> inputs;
  MachineOptions machine;
  CoreOption core;
  ThreadsOption threads;
  std::string depth;
  int repeat = 7;
  std::vector<std::string> without;
  std::string json;
  std::string csv;

  /// The lists of customary length where none is named.
  [[nodiscard]] std::vector<std::string> all_inputs() const {
    std::vector<std::string> all = inputs;
    for (const SyntheticInfo& info : synthetic_frames()) {
      if (inputs.empty() && info.divisor != 1) {
        all.push_back(fmt::format("{}{}:full", kSyntheticPrefix, info.name));
      }
    }
    return all;
  }

  /// `read` is load(), or load_input() to say what it leaves out.
  [[nodiscard]] Frame frame(const std::string& input,
                            Frame (*read)(const std::filesystem::path&, const Camera&)) const {
    const InputName name = input_name(input);
    if (name.kind != InputKind::kSynthetic) {
      if (!depth.empty()) {
        throw OptionError(fmt::format(
            "{}: has its own depth format, and --depth is '{}'; legal with --depth: synthetic frames", input,
            depth));
      }
      return read(input, {});
    }
    return synthetic_frame(name.stem, depth == "float32" ? DepthFormat::kFloat32 : DepthFormat::kUnorm24);
  }
};

/// A contender, and how it is run on the frame at hand.
struct Runner {
  Contender contender;
  std::function<void()> prepare;         ///< before each pass; not timed
  std::function<void()> run;             ///< a pass
  std::function<std::uint64_t()> count;  ///< once, before the passes: its survivors
};

/// All of them, on one frame after the other.
class SpeedBench {
 public:
  explicit SpeedBench(const SpeedOptions& options) : options_(options), config_(options.machine.config()) {
    std::string why;
    if (config_.setup.fill_rule != FillRuleKey::kDraw) {
      why = "it has the fill rule of each draw";
    } else if (!left_out("llvmpipe")) {
      llvmpipe_ = Llvmpipe::open(why);
    }
    const auto nothing = [] {};
    runners_.push_back({.contender = {.name = "functional", .about = "all that `run` does between its files"},
                        .prepare = nothing,
                        .run = [this] { functional_->run(frame_); },
                        .count = [this] { return count_functional(); }});
    runners_.push_back({.contender = {.name = "functional_pixels", .about = "and the counts of each pixel"},
                        .prepare = nothing,
                        .run = [this] { counts_pixels_->run(frame_); },
                        .count = [this] { return counts_pixels_->run(frame_).early_z.survivors; }});
    runners_.push_back({.contender = {.name = "scalar_loop",
                                      .yardstick = true,
                                      .about = "bounding boxes pixel by pixel, behind the front end"},
                        .prepare = [this] { loop_->clear(); },
                        .run = [this] { loop_->draw(); },
                        .count = [this] { return count_scalar(); }});
    runners_.push_back({.contender = {.name = "llvmpipe",
                                      .yardstick = true,
                                      .about = llvmpipe_ ? llvmpipe_->name() + ", depth only" : why,
                                      .absent = !llvmpipe_},
                        .prepare = [this] { llvmpipe_->clear(); },
                        .run = [this] { llvmpipe_->draw(); },
                        .count = [this] { return llvmpipe_->count(); }});
    for (Runner& runner : runners_) {
      if (left_out(runner.contender.name)) {
        runner.contender.absent = true;
        runner.contender.about = "by --without";
      }
    }
  }

  SpeedTable measure_all() {
    SpeedTable table{.config = config_,
                     .repeat = options_.repeat,
                     .threads = options_.threads.count,
                     .contenders = {},
                     .rows = {}};
    for (const Runner& runner : runners_) {
      table.contenders.push_back(runner.contender);
    }
    for (const std::string& input : options_.all_inputs()) {
      frame_ = options_.frame(input, load);
      const Watch watch{.core = options_.core.core(), .threads = options_.threads.count};
      counts_pixels_.emplace(config_, watch);
      Watch counts_none = watch;
      counts_none.count_pixels = false;
      functional_.emplace(config_, counts_none);
      if (!left_out("scalar_loop")) {
        loop_.emplace(frame_, config_);
      }
      if (llvmpipe_) {
        llvmpipe_->load(frame_, config_);
      }
      table.rows.push_back(measure());
    }
    return table;
  }

 private:
  [[nodiscard]] bool left_out(const std::string& name) const {
    return std::ranges::find(options_.without, name) != options_.without.end();
  }

  std::uint64_t count_functional() {
    counters_ = functional_->run(frame_);
    return counters_.early_z.survivors;
  }

  std::uint64_t count_scalar() {
    const ScalarCounts counts = loop_->count();
    if (counts.fragments != counters_.quad_generator.fragments) {
      throw DisagreementError(fmt::format("{}: coverage differs: functional {} fragments, scalar loop {}",
                                          frame_.name, counters_.quad_generator.fragments, counts.fragments));
    }
    return counts.survivors;
  }

  SpeedRow measure() {
    SpeedRow row{.name = frame_.name, .runs = std::vector<ContenderRun>(runners_.size())};
    for (const Target& target : frame_.targets) {
      row.depth = row.depth == DepthFormat::kNone ? target.depth_format : row.depth;
    }
    ProgressBar bar(frame_.name);
    // The first turn counts, and warms caches and page tables.
    const auto turns = static_cast<std::size_t>(options_.repeat) + 1;
    for (std::size_t turn = 0; turn < turns; ++turn) {
      for (std::size_t i = 0; i < runners_.size(); ++i) {
        bar.update(turn * runners_.size() + i, turns * runners_.size());
        if (runners_[i].contender.absent) {
          continue;
        }
        if (turn == 0) {
          row.runs[i].survivors = runners_[i].count();
          continue;
        }
        runners_[i].prepare();
        row.runs[i].milliseconds.push_back(milliseconds(runners_[i].run));
      }
    }
    row.triangles = counters_.front_end.triangles;
    row.fragments = counters_.quad_generator.fragments;
    row.quads = counters_.quad_generator.quads;
    return row;
  }

  const SpeedOptions& options_;
  Config config_;
  std::unique_ptr<Llvmpipe> llvmpipe_;  ///< null where it is absent
  std::vector<Runner> runners_;         ///< ours first

  // Of the workload at hand.
  Frame frame_;
  std::optional<FunctionalRuns> functional_;
  std::optional<FunctionalRuns> counts_pixels_;
  std::optional<ScalarLoop> loop_;
  Counters counters_;  ///< of functional
};

void write_text(const std::string& path, const std::string& text) {
  if (path.empty()) {
    return;
  }
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) {
    throw InputError(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
  }
}

void bench_speed(const SpeedOptions& options) {
  // What cannot be read or written is known before minutes have passed.
  for (const std::string& input : options.all_inputs()) {
    (void)options.frame(input, load_input);
  }
  for (const std::string& path : {options.json, options.csv}) {
    write_text(path, "");
  }
  const SpeedTable table = SpeedBench(options).measure_all();
  write_text(options.json, speed_json(table));
  write_text(options.csv, speed_csv(table));
  fmt::print("{}", speed_markdown(table));
}

}  // namespace

void add_bench_speed(CLI::App& bench) {
  auto options = std::make_shared<SpeedOptions>();
  CLI::App* speed = bench.add_subcommand(
      "speed", "speed of the functional model, beside a plain scalar loop and Mesa's llvmpipe");
  speed->add_option("INPUT", options->inputs,
                    "frames, meshes or synthetic:NAME (default: the ten full lists, which take minutes)");
  options->machine.add_to(*speed);
  options->core.add_to(*speed);
  options->threads.add_to(*speed, "The model uses them");
  speed->add_option("--depth", options->depth, "depth format of synthetic frames (default: unorm24)")
      ->check(one_of({"unorm24", "float32"}))
      ->type_name("FORMAT");
  speed->add_option("--repeat", options->repeat, "number of timed passes of each")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  speed->add_option("--without", options->without, "leave contenders out")
      ->check(one_of({"functional_pixels", "scalar_loop", "llvmpipe"}))
      ->delimiter(',')
      ->allow_extra_args(false)  // what follows is INPUT
      ->type_name("NAME,...");
  speed->add_option("--json", options->json, "write the table and every pass's time as JSON too")
      ->type_name("FILE");
  speed->add_option("--csv", options->csv, "write the table as CSV too")->type_name("FILE");
  speed->callback([options] { bench_speed(*options); });
}

}  // namespace halfspace
