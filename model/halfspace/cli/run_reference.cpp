#include "halfspace/cli/run_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <optional>
#include <vector>

#include "halfspace/cli/frame_time.hpp"
#include "halfspace/cli/known_words.hpp"
#include "halfspace/cli/progress.hpp"
#include "halfspace/cli/run_table.hpp"
#include "halfspace/cli/tie_rule.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/reference/methods.hpp"
#include "halfspace/reference/rasterizer.hpp"
#include "halfspace/report/output_folder.hpp"
#include "halfspace/report/pictures.hpp"
#include "halfspace/report/recorder.hpp"
#include "halfspace/report/result_files.hpp"

namespace halfspace {
namespace {

/// The machine skips draws of unfilled polygons. Returns how many there are.
std::uint64_t empty_unfilled_draws(Frame& frame) {
  std::uint64_t emptied = 0;
  for (Command& command : frame.commands) {
    if (command.kind == CommandKind::kDraw && command.is_skipped()) {
      command.index_count = 0;
      ++emptied;
    }
  }
  return emptied;
}

reference::Options options_of(const ReferenceRequest& request, const Config& config) {
  reference::Options options;
  options.method = request.method;
  options.rule = tie_rule(config);
  options.subpixel_bits = config.raster.sub_pixel_bits;
  if (config.raster.conservative != Conservative::kOff) {
    const bool outer = config.raster.conservative == Conservative::kOuter;
    if (request.method != "exact") {
      throw OptionError(
          fmt::format("raster.conservative is {}; legal with --reference {}: off; with exact: any",
                      outer ? "outer" : "inner", request.method));
    }
    if (config.raster.inner_coverage) {
      throw OptionError("raster.inner_coverage is true; legal with --reference: false");
    }
    options.pixels = outer ? reference::Pixels::kTouched : reference::Pixels::kFilled;
    options.uncertainty = config.raster.uncertainty;
  }
  if (config.late_z.mode == LateZ::kLate) {
    throw OptionError("late_z.mode is 'late'; legal with --reference: opaque, no_write");
  }
  options.late_z =
      config.late_z.mode == LateZ::kOpaque ? reference::LateZ::kOpaque : reference::LateZ::kNoWrite;
  return options;
}

Counters counters_of(const reference::Counters& c) {
  Counters counters;
  counters.front_end.triangles = c.triangles;
  counters.front_end.non_finite = c.non_finite;
  counters.front_end.clipped_away = c.clipped_away;
  counters.quad_generator.quads = c.quads;
  counters.quad_generator.quads_full = c.full_quads;
  counters.quad_generator.fragments = c.covered_fragments;
  counters.quad_generator.helpers = c.helper_fragments;
  counters.early_z.tested = c.depth_tested;
  counters.early_z.untested = c.covered_fragments - c.depth_tested;
  counters.early_z.survivors = c.depth_passed;
  counters.early_z.written = c.depth_written;
  return counters;
}

/// Brings what a reference draws into the result of a run, and records its quads in the order in which the
/// machine's leave.
class ResultBuilder final : public reference::Observer {
 public:
  ResultBuilder(const Frame& frame, const Config& config, const Recorder::Options& record, bool pictures)
      : frame_(frame), config_(config), recorder_(record), bar_(frame.name) {
    const Watch watch{.keep_visible = pictures, .count_pixels = true, .keep_sums = pictures};
    result.frame.surfaces = make_surfaces(frame, config, watch);
    surfaces_of_targets_ = surfaces_of_targets(frame, result.frame.surfaces);
    depth_written_.assign(result.frame.surfaces.size(), false);
    for (std::uint32_t i = 0; i < frame.commands.size(); ++i) {
      const Command& command = frame.commands[i];
      const std::uint32_t surface = frame.targets[command.target].depth_surface;
      if (command.kind == CommandKind::kDraw) {
        result.frame.draws.push_back({.command = i, .surface = surface, .counters = {}});
        first_triangle_.push_back(triangles_);
        triangles_ += command.primitive_count();
      } else if (command.has(Flag::kClearDepth) && surface != kNoSurface) {
        ++result.frame.clears;
      }
    }
  }

  void piece(std::uint32_t draw, std::uint32_t triangle, std::span<const reference::Quad> quads) override {
    if (recorder_.wants_quads()) {
      record(draw, triangle, {quads.begin(), quads.end()});
    }
    const Command& command = frame_.commands[result.frame.draws[draw].command];
    const std::uint32_t number = surfaces_of_targets_[command.target];
    Surface& surface = result.frame.surfaces[number];
    if (surface.sums.empty()) {
      return;
    }
    const bool shows = command.has(Flag::kDepthWrite) || !depth_written_[number];
    for (const reference::Quad& quad : quads) {
      QuadLanes& lanes = surface.sums.quads.at(static_cast<int>(quad.x / 2), static_cast<int>(quad.y / 2));
      ++lanes.quads;
      lanes.covered += static_cast<std::uint32_t>(std::popcount(quad.mask));
      for (unsigned i = 0; i < 4; ++i) {
        if (shows && (quad.passed >> i & 1) != 0) {
          surface.visible.at(static_cast<int>(quad.x + i % 2), static_cast<int>(quad.y + i / 2)) =
              first_triangle_[draw] + triangle;
        }
      }
    }
  }

  void draw_done(std::uint32_t draw, const reference::Counters& counters) override {
    DrawStats& of_draw = result.frame.draws[draw];
    of_draw.counters = counters_of(counters);
    result.frame.counters += of_draw.counters;
    const Command& command = frame_.commands[of_draw.command];
    const std::uint32_t number = surfaces_of_targets_[command.target];
    result.frame.surfaces[number].counters += of_draw.counters;
    if (command.has(Flag::kDepthWrite) && of_draw.surface != kNoSurface) {
      depth_written_[number] = true;
    }
    result.reference->degenerate += counters.degenerate;
    result.reference->culled += counters.culled;
    result.reference->drawn += counters.drawn;
    bar_.update(draw + 1, result.frame.draws.size());
  }

  /// Completes the result.
  void finish(const std::vector<reference::Surface>& drawn) {
    recorder_.finish();
    for (const reference::Surface& from : drawn) {
      Surface& to = result.frame.surfaces[from.index];
      for (std::size_t i = 0; i < from.fragments.size(); ++i) {
        const auto x = static_cast<int>(i % from.width);
        const auto y = static_cast<int>(i / from.width);
        if (!from.codes.empty()) {
          to.codes.at(x, y) = from.codes[i];
        }
        to.fragments.at(x, y) = from.fragments[i];
        to.survivors.at(x, y) = from.survivors[i];
      }
    }
  }

  RunResult result{.frame = {},
                   .cycles = {},
                   .times = {},
                   .rtl = {},
                   .quad_merging = {},
                   .pixel_rate = {},
                   .reference = ReferenceRun{}};

 private:
  void record(std::uint32_t draw, std::uint32_t triangle, std::vector<reference::Quad> quads) {
    const auto block = static_cast<std::uint32_t>(config_.block_walker.block_size);
    const auto tile = static_cast<std::uint32_t>(config_.tile_walker.tile_size);
    const auto place = [&](const reference::Quad& q) {
      return std::array{q.y / block, q.x / block, q.y / tile, q.x / tile, q.y, q.x};
    };
    std::sort(quads.begin(), quads.end(),
              [&](const reference::Quad& a, const reference::Quad& b) { return place(a) < place(b); });
    for (const reference::Quad& quad : quads) {
      recorder_.quad({.draw = draw,
                      .triangle = triangle,
                      .surface = result.frame.draws[draw].surface,
                      .x = quad.x,
                      .y = quad.y,
                      .mask = quad.mask,
                      .passed = quad.passed,
                      .depth = quad.depth});
    }
  }

  const Frame& frame_;
  const Config& config_;
  Recorder recorder_;
  ProgressBar bar_;
  std::vector<std::uint32_t> first_triangle_;  ///< of each draw, counted through all draws
  std::uint32_t triangles_ = 0;
  std::vector<std::uint32_t> surfaces_of_targets_;
  std::vector<bool> depth_written_;  ///< by surface: a draw so far may have
};

void write_colors(const std::filesystem::path& path, const reference::Surface& surface, int times,
                  PictureFilter filter) {
  Picture picture(static_cast<int>(surface.width), static_cast<int>(surface.height));
  for (std::size_t i = 0; i < surface.colors.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      // Where nothing passed the colour is black. Weights add up to 1, so only rounding leaves [0, 1].
      const double value = std::clamp(surface.colors[i][k], 0.0, 1.0);
      picture.pixels[i][k] = static_cast<std::uint8_t>(std::lround(255 * value));
    }
  }
  write_png(path, times == 1 ? picture : shrink(picture, times, filter));
}

void print_table(const Frame& frame, const RunResult& result) {
  const Counters& c = result.frame.counters;
  const ReferenceRun& r = *result.reference;
  fmt::print("{}: {} draws on {}, by the reference {}\n", frame.name, result.frame.draws.size(),
             surfaces_text(result.frame), r.name);
  fmt::print("  {:<16}{:>12}  drawn of {}; {} clipped away, {} without area, {} face away, {} not finite\n",
             "triangles", r.drawn, c.front_end.triangles, c.front_end.clipped_away, r.degenerate, r.culled,
             c.front_end.non_finite);
  fmt::print("  {:<16}{:>12}  {} fragments, {} helpers\n", "quads", c.quad_generator.quads,
             c.quad_generator.fragments, c.quad_generator.helpers);
  fmt::print("  {:<16}{:>12}  fragments survive; {} tested, {} written\n", "depth", c.early_z.survivors,
             c.early_z.tested, c.early_z.written);
}

}  // namespace

void add_reference_option(CLI::App& command, std::string& method) {
  command.add_option("--reference", method, "draws by a textbook rasterizer, not by the machine")
      ->check(one_of_table(reference::methods(), &reference::Method::name));
}

void run_reference(const ReferenceRequest& request, Frame frame, const Config& config) {
  const reference::Options options = options_of(request, config);
  const std::uint64_t not_filled = empty_unfilled_draws(frame);
  std::optional<OutputFolder> folder;
  Recorder::Options record;
  if (!request.out.empty()) {
    folder.emplace(request.out);
    if (request.quads) {
      record.quads = folder->file("quads.npy");
    }
  }
  const bool pictures = folder.has_value() && request.pictures;
  ResultBuilder builder(frame, config, record, pictures);
  builder.result.reference->name = request.method;
  builder.result.frame.draws_not_filled = not_filled;
  const std::vector<reference::Surface> drawn = reference::rasterize(frame, options, &builder);
  builder.finish(drawn);
  if (folder) {
    for (const reference::Surface& surface : drawn) {
      if (pictures && !surface.colors.empty()) {
        const std::string label = surface_label(builder.result.frame, surface.index);
        write_colors(folder->file(fmt::format("colors{}.png", label)), surface, frame.magnified,
                     request.picture.filter);
      }
    }
    write_result_files(*folder, frame, config, Fidelity::kFunctional, {}, builder.result, std::nullopt,
                       request.picture);
    folder->commit();
  }
  print_table(frame, builder.result);
  print_time(request.timed, fmt::format("the reference {}", request.method),
             [&] { (void)reference::rasterize(frame, options, nullptr); });
  if (folder) {
    fmt::print("  results in {}\n", request.out);
  }
}

}  // namespace halfspace
