#include "halfspace/speed/surface_cost.hpp"

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <initializer_list>
#include <stdexcept>
#include <utility>

namespace halfspace {
namespace {

/// A frame with a draw, which triangles are added to.
class DrawnFrame {
 public:
  explicit DrawnFrame(const SurfaceFrames& frames) : frame_(frames.cleared(1)) {
    const auto side = static_cast<float>(frames.side);
    Command draw;
    draw.flags = bits({Flag::kDepthTest, Flag::kDepthWrite, Flag::kColorWrite});
    draw.depth_func = DepthFunc::kLess;
    draw.viewport = {0, 0, side, side};
    frame_.commands.push_back(draw);
  }

  /// With a right angle at (x, y), and legs of dx and dy, which may point anywhere.
  void add(std::uint32_t x, std::uint32_t y, std::int32_t dx, std::int32_t dy) {
    const double side = frame_.targets[0].width;
    for (const auto& [cx, cy] :
         {std::array<double, 2>{0, 0}, std::array<double, 2>{1, 0}, std::array<double, 2>{0, 1}}) {
      frame_.indices.push_back(static_cast<std::uint32_t>(frame_.vertices.size()));
      frame_.vertices.emplace_back((x + cx * dx) * 2 / side - 1, (y + cy * dy) * 2 / side - 1, 0.5, 1);
    }
  }

  Frame take() {
    Command& draw = frame_.commands.back();
    draw.index_count = static_cast<std::uint32_t>(frame_.indices.size());
    draw.vertex_count = draw.index_count;
    return std::move(frame_);
  }

 private:
  Frame frame_;
};

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
}

RunCost cost_of(const std::function<void()>& run) {
  const double before = peak_megabytes();
  const auto start = std::chrono::steady_clock::now();
  run();
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  return {.milliseconds = time.count(), .megabytes = peak_megabytes() - before};
}

}  // namespace

Frame SurfaceFrames::cleared(int clears) const {
  Frame frame;
  frame.name = "cleared";
  frame.targets.push_back({.width = side,
                           .height = side,
                           .samples = 1,
                           .depth_format = DepthFormat::kUnorm24,
                           .color_count = 1,
                           .presented = true,
                           .depth_surface = 0});
  Command clear;
  clear.kind = CommandKind::kClear;
  clear.flags = bits({Flag::kClearDepth});
  frame.commands.assign(static_cast<std::size_t>(clears), clear);
  return frame;
}

Frame SurfaceFrames::block(std::uint32_t tiles) const {
  DrawnFrame frame(*this);
  const std::uint32_t length = tiles * tile_side;
  const std::uint32_t first = (side / tile_side - tiles) / 2 * tile_side;
  const auto leg = static_cast<std::int32_t>(length);
  frame.add(first, first, leg, leg);
  frame.add(first + length, first + length, -leg, -leg);
  return frame.take();
}

Frame SurfaceFrames::scattered(std::uint32_t tiles) const {
  DrawnFrame frame(*this);
  const std::uint64_t row = side / tile_side;
  const auto leg = static_cast<std::int32_t>(tile_side) - 2;
  for (std::uint64_t i = 0; i < tiles; ++i) {
    const std::uint64_t tile = i * row * row / tiles;
    frame.add(static_cast<std::uint32_t>(tile % row) * tile_side + 1,
              static_cast<std::uint32_t>(tile / row) * tile_side + 1, leg, leg);
  }
  return frame.take();
}

RunCost cost_of_fresh_run(const std::function<void()>& run) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) {
    throw std::runtime_error("no pipe to a process to measure in");
  }
#ifdef __GLIBC__
  malloc_trim(0);  // what earlier runs left is no memory for this one
#endif
  std::fflush(nullptr);  // or the child would write it again
  const pid_t child = fork();
  if (child == 0) {
    try {
      const RunCost cost = cost_of(run);
      _exit(write(ends[1], &cost, sizeof cost) == sizeof cost ? 0 : 1);
    } catch (...) {
      _exit(1);
    }
  }
  close(ends[1]);
  RunCost cost;
  const bool told = child > 0 && read(ends[0], &cost, sizeof cost) == sizeof cost;
  close(ends[0]);
  if (child > 0) {
    waitpid(child, nullptr, 0);
  }
  if (!told) {
    throw std::runtime_error("a run to measure failed in its process");
  }
  return cost;
}

}  // namespace halfspace
