#include "halfspace/study/precision/edge_workloads.hpp"

#include <cmath>
#include <string_view>

#include "halfspace/machine/draw_state.hpp"
#include "halfspace/numerics/split_mix.hpp"
#include "halfspace/scene/front_end.hpp"
#include "halfspace/scene/load.hpp"
#include "halfspace/stress/family.hpp"

namespace halfspace::study {
namespace {

constexpr int kStressBits = 8;

Drawing stress_drawing(const stress::Family& family, std::uint64_t seed, std::uint64_t index) {
  const stress::Case made = stress::make_case(family, {.sub_pixel_bits = kStressBits}, seed, index);
  const Target& target = made.frame.targets.front();
  Drawing drawing{.target = {0, 0, target.width, target.height}, .triangles = {}};
  for (const stress::KnownTriangle& known : made.triangles) {
    FloatTriangle triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      triangle[i] = reference::float_point(known.grid[i], kStressBits);
    }
    drawing.triangles.push_back({triangle, drawing.target});
  }
  return drawing;
}

/// Triangles around a point of the target, to corners near the guard band: edges that are shared and long.
Drawing long_fan(std::uint64_t seed) {
  constexpr int kArms = 24;
  constexpr double kReach = 32000;
  constexpr double kTurn = 6.283185307179586;
  SplitMix64 random(seed);
  Drawing drawing{.target = {0, 0, 64, 64}, .triangles = {}};
  const auto at = [](double x, double y) {
    return reference::FloatPoint<float>{static_cast<float>(x), static_cast<float>(y)};
  };
  const reference::FloatPoint<float> middle = at(random.real(1, 63), random.real(1, 63));
  std::vector<reference::FloatPoint<float>> arms;
  for (int i = 0; i < kArms; ++i) {
    const double angle = (i + random.real(-0.4, 0.4)) * kTurn / kArms;
    arms.push_back(at(kReach * std::cos(angle), kReach * std::sin(angle)));
  }
  for (std::size_t i = 0; i < arms.size(); ++i) {
    drawing.triangles.push_back({{middle, arms[i], arms[(i + 1) % arms.size()]}, drawing.target});
  }
  return drawing;
}

/// Bits below the pixel that the front end keeps here: as many as its positions of 32 bits have room for.
constexpr int kFrameBits = 16;

PixelRect rect_of(const halfspace::PixelRect& rect) {
  return {rect.x_first, rect.y_first, std::int64_t{rect.x_last} + 1, std::int64_t{rect.y_last} + 1};
}

void add_draw(const Frame& frame, const Command& command, Drawing& drawing) {
  const Target& target = frame.targets[command.target];
  const SetupState state = setup_state(command, target, DepthFormat::kNone, Config{});
  const FrontEnd front_end(frame, command, DepthFormat::kNone, kFrameBits);
  FrontEndCounters counters;
  std::vector<ScreenTriangle> pieces;
  for (std::uint32_t index = 0; index < command.index_count / 3; ++index) {
    front_end.process(index, pieces, counters);
  }
  for (const ScreenTriangle& piece : pieces) {
    reference::GridTriangle grid;
    FloatTriangle triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      grid[i] = {piece.v[i].x, piece.v[i].y};
      triangle[i] = reference::float_point(grid[i], kFrameBits);
    }
    const reference::Int128 area = reference::twice_area(grid[0], grid[1], grid[2]);
    const bool front = (area > 0) == state.front_positive_area;
    if (area != 0 && !(front ? state.cull_front : state.cull_back)) {
      drawing.triangles.push_back({triangle, rect_of(state.bounds)});
    }
  }
}

}  // namespace

Drawing jittered_mesh(std::int64_t first, int cells, int cell, double jitter, std::uint64_t seed) {
  SplitMix64 random(seed);
  const std::int64_t end = first + std::int64_t{cells} * cell;
  Drawing drawing{.target = {first, first, end, end}, .triangles = {}};
  std::vector<reference::FloatPoint<float>> corner;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const bool inner = i > 0 && j > 0 && i < cells && j < cells;
      const auto at = [&](int n) {
        return static_cast<float>(static_cast<double>(first) +
                                  cell * (n + (inner ? random.real(-jitter, jitter) : 0)));
      };
      const float x = at(i);
      corner.push_back({x, at(j)});
    }
  }
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const auto* top = &corner[static_cast<std::size_t>(j) * static_cast<std::size_t>(cells + 1) +
                                static_cast<std::size_t>(i)];
      const auto* bottom = top + cells + 1;
      if (random.integer(0, 1) == 0) {
        drawing.triangles.push_back({{top[0], top[1], bottom[0]}, drawing.target});
        drawing.triangles.push_back({{top[1], bottom[1], bottom[0]}, drawing.target});
      } else {
        drawing.triangles.push_back({{top[0], top[1], bottom[1]}, drawing.target});
        drawing.triangles.push_back({{top[0], bottom[1], bottom[0]}, drawing.target});
      }
    }
  }
  return drawing;
}

std::vector<EdgeFamily> edge_families(std::uint64_t seed) {
  std::vector<EdgeFamily> families;
  for (const std::string_view name :
       {"sliver", "sub_pixel", "on_samples", "near_miss", "guard_band", "fan", "mesh"}) {
    const stress::Family& family = stress::family_of(name);
    families.push_back(
        {std::string(name), std::string(family.looks), name == "mesh",
         [&family, seed](std::uint64_t index) { return stress_drawing(family, seed, index); }});
  }
  families.push_back({"long_fan", "24 triangles around a point, with edges of 32,000 pixels", true,
                      [seed](std::uint64_t index) { return long_fan(seed + index); }});
  const auto add_mesh = [&](std::string name, std::string looks, std::int64_t first, int cells, int cell) {
    families.push_back({std::move(name), std::move(looks), true, [=](std::uint64_t index) {
                          return jittered_mesh(first, cells, cell, 0.25, seed + index);
                        }});
  };
  add_mesh("jittered", "a mesh of 32,768 triangles on 1024x1024 pixels", 0, 128, 8);
  add_mesh("jittered_small", "a mesh of 524,288 triangles there", 0, 512, 2);
  add_mesh("jittered_far", "the mesh of 32,768 in the last corner of 16384x16384 pixels", 15360, 128, 8);
  return families;
}

std::vector<Drawing> frame_drawings(const std::filesystem::path& path) {
  const Frame frame = load(path);
  std::vector<Drawing> drawings;
  for (const Target& target : frame.targets) {
    drawings.push_back({.target = {0, 0, target.width, target.height}, .triangles = {}});
  }
  for (const Command& command : frame.commands) {
    if (command.kind == CommandKind::kDraw) {
      add_draw(frame, command, drawings[command.target]);
    }
  }
  std::erase_if(drawings, [](const Drawing& drawing) { return drawing.triangles.empty(); });
  if (drawings.empty()) {
    throw InputError(path.string() + " has no triangle; a frame to measure edges on must have one");
  }
  return drawings;
}

}  // namespace halfspace::study
