// The verilated pipeline against its two models: every packet on every link and every pixel against the C++
// units, and the cycle of every packet, every stage's every cycle and every credit against the recurrence.
//
// Exit status 0 when nothing differs; 1 with the first difference, 2 for bad options.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/load.hpp"
#include "halfspace/timing/contract.hpp"
#include "halfspace/timing/recurrence/run_recurrence.hpp"
#include "halfspace/timing/rtl/pipeline_library.hpp"
#include "halfspace/timing/rtl/rest_skipper.hpp"
#include "halfspace/timing/rtl/run_rtl.hpp"
#include "line_frames.hpp"
#include "raster_pipeline/fault.hpp"
#include "timing/differences.hpp"
#include "timing/random_machine.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

struct BenchOptions {
  std::string config;
  std::string folder;
  std::vector<std::string> frames;
  std::uint64_t triangles = 20000;
  std::uint64_t seed = 1;
  std::string fault = "none";
  std::uint64_t fault_at = 100;
  std::string wave;
  double bins = 0;
  double throughput = 0;
  std::string rests = "skip";
  double skipped = 0;
  bool lines = false;
};

struct Totals {
  std::uint64_t frames = 0;
  std::uint64_t triangles = 0;
  std::uint64_t cycles = 0;
  std::uint64_t compared = 0;
  double seconds = 0;                                  ///< in the verilated pipeline and its driver
  rtl::RestCounts rests;                               ///< of the pipelines that skip them
  std::set<std::pair<std::size_t, std::size_t>> seen;  ///< stage and reason to wait
};

/// What became of a tile is told by block_walker where it takes the triangle, and by tile_walker where hi_z
/// has decided the block, which is later in the RTL: the order of these events means nothing there.
void sort_decisions(Events& events) {
  using Decision = std::array<std::uint64_t, 6>;
  std::vector<Decision> sorted(events.decisions.size() / Decision{}.size());
  for (std::size_t i = 0; i < events.decisions.size(); ++i) {
    sorted[i / Decision{}.size()][i % Decision{}.size()] = events.decisions[i];
  }
  std::ranges::sort(sorted);
  events.decisions.clear();
  for (const Decision& decision : sorted) {
    events.decisions.insert(events.decisions.end(), decision.begin(), decision.end());
  }
}

/// A difference, in words.
class Difference : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Bench {
 public:
  explicit Bench(const BenchOptions& options)
      : options_(options), fault_(*tb::pipeline_fault(options.fault)), config_(read_config(options.config)) {
    validate(config_);
  }

  void run() {
    if (options_.frames.empty()) {
      random_frames();
    }
    for (const std::string& file : options_.frames) {
      const Frame frame = load(file);
      if (options_.lines) {
        as_lines(frame);
      } else {
        take(frame);
      }
    }
    print();
  }

 private:
  void take(const Frame& frame) {
    compare(frame, config_, {}, options_.seed, frame.name);
    if (options_.throughput != 0) {
      print_throughput();
      return;
    }
    Random random(options_.seed);
    compare(frame, config_, stalls(random), options_.seed + 1, frame.name + " with stalls");
  }

  /// The sides of its triangles, by every rule that the machine takes.
  void as_lines(Frame frame) {
    const std::string name = frame.name;
    for (std::size_t rule = 0; rule < kLineRuleName.size(); ++rule) {
      if (is_thin(static_cast<LineRule>(rule)) && !takes_thin_lines(config_)) {
        continue;
      }
      for (Command& command : frame.commands) {
        command.polygon_mode = PolygonMode::kLine;
        command.line_rule = static_cast<LineRule>(rule);
      }
      frame.name = fmt::format("{}, lines {}", name, kLineRuleName[rule]);
      take(frame);
    }
  }

  /// Frames of all kinds, each on a pipeline of its own, with registers of its own before reset.
  void random_frames() {
    for (std::uint64_t n = 0; totals_.triangles < options_.triangles; ++n) {
      Random random(options_.seed + n);
      Frame frame = options_.lines ? random_lines(random, takes_thin_lines(config_))
                                   : crowded(random_frame(random), random);
      if (n % 4 == 3) {
        align(frame);
      }
      Config config = config_;
      config.memory.latency = pick(random, {1, 2, 20, 100, 400, config.memory.latency});
      config.z_cache.fast_clear = random.between(0, 3) != 0;
      compare(frame, config, stalls(random), options_.seed + n,
              fmt::format("random frame {}, seed {}", n, options_.seed + n));
    }
  }

  /// Vertices on a grid of 2 pixels where a target has 64, of 1/4 pixel where it has 8: edges that are level
  /// or upright, and that end on sides and corners of pixels.
  static void align(Frame& frame) {
    constexpr float kGrid = 16;  // to a half of clip space
    for (glm::vec4& vertex : frame.vertices) {
      vertex.x = std::round(vertex.x * kGrid) / kGrid;
      vertex.y = std::round(vertex.y * kGrid) / kGrid;
    }
  }

  /// More triangles in every draw that has some, most of them small.
  static Frame crowded(const Frame& frame, Random& random) {
    Frame more = frame;
    for (Command& command : more.commands) {
      if (command.kind != CommandKind::kDraw || command.index_count == 0) {
        continue;
      }
      const auto size = static_cast<int>(frame.targets[command.target].width);
      const auto count = static_cast<std::uint32_t>(random.between(0, 200));
      const std::uint32_t first = command.vertex_count;
      std::vector<glm::vec4> vertices(more.vertices.begin() + command.first_vertex,
                                      more.vertices.begin() + command.first_vertex + first);
      std::vector<std::uint32_t> indices(more.indices.begin() + command.first_index,
                                         more.indices.begin() + command.first_index + command.index_count);
      for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec2 centre{random.between(0, size * 256), random.between(0, size * 256)};
        for (int corner = 0; corner < 3; ++corner) {
          const int reach = 256 << random.between(0, 4);
          const double x = (centre.x + static_cast<double>(random.between(-reach, reach))) / 256;
          const double y = (centre.y + static_cast<double>(random.between(-reach, reach))) / 256;
          indices.push_back(static_cast<std::uint32_t>(vertices.size()));
          vertices.emplace_back(x * 2 / size - 1, y * 2 / size - 1,
                                static_cast<double>(random.between(0, 1 << 20)) / (1 << 20), 1);
        }
      }
      command.first_vertex = static_cast<std::uint32_t>(more.vertices.size());
      command.first_index = static_cast<std::uint32_t>(more.indices.size());
      command.vertex_count = static_cast<std::uint32_t>(vertices.size());
      command.index_count = static_cast<std::uint32_t>(indices.size());
      more.vertices.insert(more.vertices.end(), vertices.begin(), vertices.end());
      more.indices.insert(more.indices.end(), indices.begin(), indices.end());
    }
    return more;
  }

  /// None, or idle cycles of the source and back-pressure at the sink.
  static StallPlan stalls(Random& random) {
    StallPlan plan = random_stalls(random);
    for (std::size_t i = 0; i < kStallPoints; ++i) {
      const auto point = static_cast<StallPoint>(i);
      if (point != StallPoint::kSource && point != StallPoint::kSink) {
        plan.rate[i] = {};
      }
    }
    return plan;
  }

  /// Skips rests of the pipeline, or not, or runs both ways.
  void compare(const Frame& frame, const Config& config, const StallPlan& stalls, std::uint64_t seed,
               const std::string& name) {
    for (const bool skips : {false, true}) {
      if (options_.rests == "both" || skips == (options_.rests == "skip")) {
        compare_one(frame, config, stalls, seed, name, skips);
      }
    }
  }

  void compare_one(const Frame& frame, const Config& config, const StallPlan& stalls, std::uint64_t seed,
                   const std::string& name, bool skips) {
    std::unique_ptr<rtl::VerilatedPipeline> pipeline = rtl::load_pipeline(config, options_.folder, seed);
    if (!options_.wave.empty()) {
      pipeline->trace_to(options_.wave);
    }
    if (fault_ != tb::PipelineFault::kNone) {
      pipeline = tb::with_fault(std::move(pipeline), fault_, options_.fault_at);
    }
    rtl::RestCounts rests;
    if (skips && options_.wave.empty()) {
      pipeline = rtl::skipping_rests(std::move(pipeline), &rests);
    }
    const auto engine = [&](Events& events) {
      return EngineOptions{.watch = {.keep_visible = true, .keep_sums = true, .observer = &events},
                           .stalls = stalls,
                           .packet_times = true};
    };
    Events events;
    const auto start = std::chrono::steady_clock::now();
    const RtlResult verilated = run_rtl(frame, config, engine(events), *pipeline);
    totals_.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const rtl::PacketReport& report = verilated.report;
    if (report.different != 0) {
      throw Difference(fmt::format("{}: {} differences, first: {}", name, report.different, report.first));
    }
    Events model_events;
    const TimedResult model = run_recurrence(frame, config, engine(model_events));
    if (config.hi_z.enabled) {
      sort_decisions(events);
      sort_decisions(model_events);
    }
    const TimedResult& run = verilated.timed;
    const std::string text = difference(run.times, model.times) + difference(run.cycles, model.cycles) +
                             difference(run.frame, model.frame) + difference(events, model_events) +
                             difference("cycle of quad", events.cycles, model_events.cycles);
    if (!text.empty()) {
      throw Difference(fmt::format("{}: RTL against recurrence: {}", name, text));
    }
    quads_ = run.frame.counters.quad_generator.quads;
    from_ = run.times.decide.empty() ? 0 : run.times.decide.front() - kSetupCullLatency;
    to_ = run.cycles.draws.empty() ? 0 : run.cycles.draws.back().end;
    frame_cycles_ = run.cycles.cycles;
    ++totals_.frames;
    totals_.triangles += run.times.decide.size();
    totals_.cycles += run.cycles.cycles;
    totals_.compared += report.compared;
    totals_.rests.evaluated += rests.evaluated;
    totals_.rests.skipped += rests.skipped;
    for (std::size_t stage = 0; stage < kStages; ++stage) {
      for (std::size_t reason = 0; reason < kMostStallReasons; ++reason) {
        if (run.cycles.stats.stage[stage].stall[reason] != 0) {
          totals_.seen.insert({stage, reason});
        }
      }
    }
  }

  /// Of the last frame: from the cycle in which its first triangle was taken to that of its last beat at the
  /// sink.
  void print_throughput() const {
    const auto quads = static_cast<double>(quads_);
    const double rate = quads / static_cast<double>(to_ - from_ + 1);
    fmt::print(
        "{} quads in {} cycles from the first triangle to the last quad: {:.3f} a cycle ({:.3f} with clear "
        "and "
        "write-back, {} cycles)\n",
        quads_, to_ - from_ + 1, rate, quads / static_cast<double>(frame_cycles_), frame_cycles_);
    if (rate < options_.throughput) {
      throw Difference(fmt::format("fewer than {} quads a cycle", options_.throughput));
    }
  }

  /// Whether the machine can have this reason to wait at all.
  [[nodiscard]] bool possible(Stage stage, std::size_t reason) const {
    const bool divider = stage == Stage::kSetup && reason == stall::kSetupDivider;
    const bool request =
        stage == Stage::kZLookup && reason == stall::kLookupRequest;  // of one part before the last
    const bool hi_z = stage == Stage::kHiZ && reason != stall::kNoInput;
    const bool late = stage == Stage::kZTest && reason == stall::kTestLate;
    const bool shaded = stage == Stage::kInterpolator && reason != stall::kNoInput;
    return !(divider && config_.setup.interval == 1) && !(request && config_.z_cache.parts == 1) &&
           !(hi_z && !config_.hi_z.enabled) && !(late && config_.late_z.mode != LateZ::kLate) &&
           !(shaded && !config_.interpolator.enabled);
  }

  void print() const {
    fmt::print(
        "{}: {} frames, {} triangles, {} cycles ({:.2f} Mcycles/s), {} packets, pixels and counters "
        "compared, "
        "cycle of every packet compared: 0 differences\n",
        config_name(), totals_.frames, totals_.triangles, totals_.cycles,
        static_cast<double>(totals_.cycles) / totals_.seconds / 1e6, totals_.compared);
    const std::uint64_t edges = totals_.rests.evaluated + totals_.rests.skipped;
    const double skipped =
        edges == 0 ? 0 : 100.0 * static_cast<double>(totals_.rests.skipped) / static_cast<double>(edges);
    fmt::print("rests: {:.1f} % of {} cycles skipped\n", skipped, edges);
    if (skipped < options_.skipped) {
      throw Difference(fmt::format("fewer than {} % of the cycles were skipped", options_.skipped));
    }
    std::size_t reasons = 0;
    std::string missed;
    for (std::size_t stage = 0; stage < kStages; ++stage) {
      for (std::size_t i = 0; i < kMostStallReasons && !kStageInfo[stage].stall[i].empty(); ++i) {
        if (!possible(static_cast<Stage>(stage), i)) {
          continue;
        }
        ++reasons;
        if (!totals_.seen.contains({stage, i})) {
          missed += fmt::format(" {}.{}", kStageInfo[stage].name, kStageInfo[stage].stall[i]);
        }
      }
    }
    const double share = 100.0 * static_cast<double>(totals_.seen.size()) / static_cast<double>(reasons);
    fmt::print("functional coverage: {} of {} reasons to wait{}{}\n", totals_.seen.size(), reasons,
               missed.empty() ? "" : "; never:", missed);
    if (share < options_.bins) {
      throw Difference(fmt::format("functional coverage is below {} %", options_.bins));
    }
  }

  [[nodiscard]] std::string config_name() const {
    return std::filesystem::path(options_.config).stem().string();
  }

  const BenchOptions& options_;
  tb::PipelineFault fault_;
  Config config_;
  Totals totals_;
  // Of the last frame.
  std::uint64_t quads_ = 0;
  std::uint64_t from_ = 0;
  std::uint64_t to_ = 0;
  std::uint64_t frame_cycles_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"the verilated raster_pipeline against the C++ units and the recurrence"};
  BenchOptions options;
  app.add_option("--config", options.config, "machine, TOML")->required();
  app.add_option("--rtl-folder", options.folder, "where its verilated pipeline is")->required();
  app.add_option("--frame", options.frames,
                 "frames to run, each without and with stalls (default: random ones)");
  app.add_flag("--lines", options.lines,
               "random lines and points by every rule, or the sides of the frames' triangles");
  app.add_option("--triangles", options.triangles, "of the random frames")->capture_default_str();
  app.add_option("--seed", options.seed, "of frames, stalls and registers before reset")
      ->capture_default_str();
  app.add_option("--bins", options.bins, "percent of the reasons to wait that must have been seen")
      ->capture_default_str();
  app.add_option("--throughput", options.throughput,
                 "quads a cycle that every frame must reach, without stalls");
  app.add_option("--rests", options.rests,
                 "cycles in which nothing in the pipeline can change; both: run each frame twice")
      ->check(CLI::IsMember({"skip", "evaluate", "both"}))
      ->capture_default_str();
  app.add_option("--skipped", options.skipped, "percent of the cycles that must have been skipped")
      ->capture_default_str();
  app.add_option("--fault", options.fault, "put a fault between the pipeline and the checkers")
      ->check(CLI::IsMember(tb::pipeline_fault_names()))
      ->capture_default_str();
  app.add_option("--fault-at", options.fault_at, "packet or cycle of it")->capture_default_str();
  app.add_option("--wave", options.wave, "FST waveform of the last frame")->type_name("FILE");
  try {
    app.parse(argc, argv);
    Bench(options).run();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fflush(stdout);
    fmt::print(stderr, "raster_pipeline_bench: {}\n", error.what());
    return 1;
  }
  return 0;
}
