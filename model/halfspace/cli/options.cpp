#include "halfspace/cli/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "halfspace/cli/known_words.hpp"
#include "halfspace/cli/load_input.hpp"
#include "halfspace/config/did_you_mean.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/input_name.hpp"
#include "halfspace/scene/quote.hpp"
#include "halfspace/scene/validate.hpp"

namespace halfspace {
namespace {

/// Parses numbers separated by `separator`; an empty list where the text is anything else.
template <class Number>
std::vector<Number> parse_list(const std::string& text, char separator) {
  std::vector<Number> numbers;
  const char* at = text.data();
  const char* end = at + text.size();
  while (true) {
    Number number{};
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc{} || (next != end && *next != separator)) {
      return {};
    }
    numbers.push_back(number);
    if (next == end) {
      return numbers;
    }
    at = next + 1;
  }
}

glm::dvec3 parse_point(const char* option, const std::string& text) {
  const std::vector<double> v = parse_list<double>(text, ',');
  if (v.size() != 3) {
    throw OptionError(fmt::format("{} is '{}'; it must be three numbers X,Y,Z", option, text));
  }
  return {v[0], v[1], v[2]};
}

/// Longest a packet can be held back: as long as the slowest memory takes.
constexpr std::uint32_t kMostStallCycles = 65535;

/// Applies "POINT:PERCENT:MAX_CYCLES".
void set_stall(StallPlan& plan, const std::string& text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const auto point = std::find(kStallPointName.begin(), kStallPointName.end(), text.substr(0, colon));
  const std::vector<std::uint32_t> numbers = colon == text.size()
                                                 ? std::vector<std::uint32_t>{}
                                                 : parse_list<std::uint32_t>(text.substr(colon + 1), ':');
  if (point == kStallPointName.end() || numbers.size() != 2 || numbers[0] > 100 || numbers[1] < 1 ||
      numbers[1] > kMostStallCycles) {
    throw OptionError(fmt::format(
        "--stall is '{}'{}; it must be POINT:PERCENT:MAX_CYCLES with POINT one of {}, PERCENT 0 to "
        "100, MAX_CYCLES 1 to {}",
        text, did_you_mean(text.substr(0, colon), kStallPointName), fmt::join(kStallPointName, ", "),
        kMostStallCycles));
  }
  StallPlan::Rate& rate = plan.rate[static_cast<std::size_t>(point - kStallPointName.begin())];
  if (rate.max_cycles != 0) {
    throw OptionError(fmt::format("--stall is '{}'; '{}' was given before; legal: once", text, *point));
  }
  rate = {.percent = numbers[0], .max_cycles = numbers[1]};
}

std::optional<TimelineRange> parse_range(const char* option, const std::string& text) {
  if (text.empty()) {
    return std::nullopt;
  }
  const std::vector<std::uint64_t> v = parse_list<std::uint64_t>(text, ':');
  if (v.size() != 2 || v[0] > v[1]) {
    throw OptionError(
        fmt::format("{} is '{}'; it must be FIRST:LAST, two integers from 0, the first not after the last",
                    option, text));
  }
  return TimelineRange{.first = v[0], .last = v[1]};
}

/// 0 where the option is not given.
std::uint64_t parse_seed(const char* option, const std::string& text) {
  if (text.empty()) {
    return 0;
  }
  const std::vector<std::uint64_t> v = parse_list<std::uint64_t>(text, ':');
  if (v.size() != 1) {
    throw OptionError(fmt::format("{} is '{}'; it must be an integer, 0 to {}", option, text,
                                  std::numeric_limits<std::uint64_t>::max()));
  }
  return v[0];
}

}  // namespace

void check_config(const Config& config, const std::string& file, bool changed) {
  try {
    validate(config);
  } catch (const OptionError& error) {
    if (changed) {
      throw;
    }
    throw InputError(fmt::format("{}: {}", file, error.what()));
  }
}

void MachineOptions::add_to(CLI::App& command) {
  command.add_option("--config", file, "configuration file (TOML)")->type_name("FILE");
  command.add_option("--set", settings, "override one key, repeatable; see 'halfspace config'")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void require_centre(const Config& config, std::string_view what) {
  if (!sample_pattern(config).is_centre()) {
    throw OptionError(
        fmt::format("configuration key 'raster.samples' is {}, and a pixel has several samples or "
                    "one that is not at its centre; legal with {}: 1, at the centre",
                    config.raster.samples, what));
  }
}

Config MachineOptions::config(Samples taken) const {
  Config config = file.empty() ? Config{} : read_config(file);
  for (const std::string& setting : settings) {
    set_config(config, setting);
  }
  check_config(config, file, !settings.empty());
  if (taken == Samples::kCentre) {
    require_centre(config, "this command");
  }
  return config;
}

CLI::Option* InputOptions::add_input_to(CLI::App& command, const std::string& more) {
  CLI::Option* input =
      command
          .add_option(
              "INPUT", paths,
              fmt::format("frame ({}), mesh ({}), {}, or {}NAME; 'halfspace info --help' lists the names",
                          kFrameExtensions, kMeshExtensions, kPackedExtensions, kSyntheticPrefix) +
                  more)
          ->required();
  of_meshes_ = {
      command.add_option("--eye", eye, "mesh: camera position (default: sees the whole mesh)")
          ->type_name("X,Y,Z"),
      command.add_option("--at", at, "mesh: point that the camera looks at (default: the middle)")
          ->type_name("X,Y,Z"),
      command.add_option("--up", up, "mesh: direction that points up in the picture (default: 0,1,0)")
          ->type_name("X,Y,Z"),
      command.add_option("--fov", fov_degrees, "mesh: vertical field of view in degrees")
          ->capture_default_str(),
      command
          .add_option("--camera", mesh_camera,
                      "mesh: a camera of the glTF file, by its name (the node's, else the camera's) or its "
                      "number in 'halfspace info', from 0")
          ->type_name("NAME|N"),
      command.add_option("--size", size, "mesh: picture size in pixels (default: 1920x1080)")
          ->type_name("WxH")};
  for (const char* const other : {"--eye", "--at", "--up", "--fov"}) {
    command.get_option("--camera")->excludes(command.get_option(other));
  }
  draws.add_to(command);
  return input;
}

void InputOptions::add_to(CLI::App& command) { add_input_to(command, "")->expected(1); }

void InputOptions::add_several_to(CLI::App& command) {
  add_input_to(command, ". Several are drawn one after the other, as frames of one program");
}

Camera InputOptions::camera() const {
  const bool for_mesh = std::ranges::any_of(paths, [](const std::string& path) {
    const InputName name = input_name(path);
    return name.is_mesh() || !name.kind;  // load() refuses what has no kind
  });
  for (const CLI::Option* option : of_meshes_) {
    if (!for_mesh && option->count() != 0) {
      throw OptionError(fmt::format("INPUT is {}, no mesh, and {} is given; legal with it: {}, {}",
                                    quote(paths.front()), option->get_name(), kMeshExtensions,
                                    kPackedExtensions));
    }
  }
  Camera camera;
  camera.fov_degrees = fov_degrees;
  if (!eye.empty()) {
    camera.eye = parse_point("--eye", eye);
  }
  if (!at.empty()) {
    camera.at = parse_point("--at", at);
  }
  if (!up.empty()) {
    camera.up = parse_point("--up", up);
  }
  if (!mesh_camera.empty()) {
    camera.of_mesh = mesh_camera;
  }
  if (!size.empty()) {
    const std::vector<std::uint32_t> v = parse_list<std::uint32_t>(size, 'x');
    if (v.size() != 2) {
      throw OptionError(fmt::format("--size is '{}'; it must be WIDTHxHEIGHT in pixels, each 1 to {}", size,
                                    kMaxTargetSize));
    }
    camera.width = v[0];
    camera.height = v[1];
  }
  return camera;
}

Frame InputOptions::frame() const {
  Frame frame = load_input(paths.front(), camera());
  draws.apply(frame);
  return frame;
}

std::vector<Frame> InputOptions::frames(MeshContent content) const {
  const Camera seen_by = camera();
  std::vector<Frame> frames;
  frames.reserve(paths.size());
  for (const std::string& path : paths) {
    frames.push_back(load_input(path, seen_by, content));
    draws.apply(frames.back());
  }
  return frames;
}

void WhatIfOptions::add_to(CLI::App& command) {
  constexpr const char* kGroup = "What if, compared with the frame as it is";
  command.add_option("--lod", lod_pixels, "simplify meshes, by an error of at most so many pixels")
      ->type_name("PIXELS")
      ->group(kGroup);
  command.add_option("--sort", sort, "sort opaque draws by their farthest depth")
      ->check(one_of({"front-to-back", "back-to-front"}))
      ->group(kGroup);
  command.add_option("--order", order, "alternate: walk every second INPUT backwards")
      ->check(one_of({"alternate"}))
      ->group(kGroup);
  command.add_flag("--prepass", prepass, "lay the depth of opaque draws before they are shaded")
      ->group(kGroup);
  command
      .add_option("--delay", delay,
                  "delay stream: have the depth of so many triangles go ahead of the one that is shaded")
      ->check(CLI::Range(std::uint64_t{1}, kMaxFrameTriangles))
      ->type_name("TRIANGLES")
      ->group(kGroup);
}

whatif::WhatIf WhatIfOptions::what_if() const {
  whatif::WhatIf wanted{
      .lod_pixels = lod_pixels, .order = {}, .alternate = !order.empty(), .prepass = prepass, .delay = delay};
  if (!sort.empty()) {
    wanted.order =
        sort == "front-to-back" ? whatif::SortOrder::kFrontToBack : whatif::SortOrder::kBackToFront;
  }
  return wanted;
}

void CoreOption::add_to(CLI::App& command) {
  command
      .add_option("--core", name, "implementation of the units: with vectors, or one packet after the other")
      ->check(one_of_table(kCoreName))
      ->capture_default_str();
}

Core CoreOption::core() const {
  return static_cast<Core>(std::ranges::find(kCoreName, name) - kCoreName.begin());
}

void ThreadsOption::add_to(CLI::App& command, const std::string& share) {
  command.add_option("--threads", count, "number of threads; results are the same with any. " + share)
      ->check(CLI::Range(1, kMostThreads))
      ->capture_default_str();
}

void StallOptions::add_to(CLI::App& command) {
  command
      .add_option("--stall", stalls,
                  fmt::format("hold back some packets at random, repeatable; POINT: {}",
                              fmt::join(kStallPointName, ", ")))
      ->type_name("POINT:PERCENT:MAX_CYCLES")
      ->allow_extra_args(false);
  command.add_option("--seed", seed, "seed of the stalls (default: 0)")->type_name("N");
}

StallPlan StallOptions::plan() const {
  StallPlan plan;
  plan.seed = parse_seed("--seed", seed);
  for (const std::string& stall : stalls) {
    set_stall(plan, stall);
  }
  if (!seed.empty() && stalls.empty()) {
    throw OptionError(fmt::format("--seed is '{}', given without a stall; legal with --stall", seed));
  }
  return plan;
}

void RtlOptions::add_folder_to(CLI::App& command) {
  command
      .add_option("--rtl-folder", folder,
                  "folder of the verilated pipelines (default: lib/halfspace beside the program's folder)")
      ->type_name("DIR");
}

void RtlOptions::add_to(CLI::App& command) {
  add_folder_to(command);
  command.add_option("--rtl-seed", seed, "seed of the RTL's registers before reset (default: 0)")
      ->type_name("N");
  command
      .add_option("--wave", wave,
                  "write an FST waveform; needs a pipeline of the folder checked or no_dfg: --rtl-folder")
      ->type_name("FILE");
  command.add_flag(
      "--rtl-every-cycle", every_cycle,
      "evaluate the RTL also in cycles in which nothing in it can change; the result is the same");
}

void RtlOptions::check(Fidelity fidelity) const {
  require(fidelity, !folder.empty(), "--rtl-folder", &FidelityInfo::rtl);
  require(fidelity, !seed.empty(), "--rtl-seed", &FidelityInfo::rtl);
  require(fidelity, !wave.empty(), "--wave", &FidelityInfo::rtl);
  require(fidelity, every_cycle, "--rtl-every-cycle", &FidelityInfo::rtl);
}

void RtlOptions::apply(RunOptions& run) const {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  run.rtl_folder = folder.empty() ? program.parent_path().parent_path() / "lib" / "halfspace"
                                  : std::filesystem::path(folder);
  run.rtl_seed = parse_seed("--rtl-seed", seed);
  run.rtl_every_cycle = every_cycle;
  run.wave = wave;
}

std::unique_ptr<rtl::VerilatedPipeline> RtlOptions::pipeline(const Config& config) const {
  RunOptions run;
  apply(run);
  return verilated_pipeline(config, run);
}

void TimelineOptions::add_to(CLI::App& command, CLI::Option* out) {
  CLI::Option* timeline =
      command.add_flag("--timeline", wanted, "write timeline.json for Perfetto: what each stage did when")
          ->needs(out);
  command.add_option("--timeline-draws", draws, "show only these draws, LAST included")
      ->type_name("FIRST:LAST")
      ->needs(timeline);
  command.add_option("--timeline-cycles", cycles, "show only these cycles, LAST included")
      ->type_name("FIRST:LAST")
      ->needs(timeline);
}

TimelineChoice TimelineOptions::choice() const {
  return {.draws = parse_range("--timeline-draws", draws),
          .cycles = parse_range("--timeline-cycles", cycles)};
}

}  // namespace halfspace
