#include "halfspace/study/orientation/pipeline_orientation.hpp"

#include "halfspace/core/functional.hpp"
#include "halfspace/scene/frame_builder.hpp"
#include "halfspace/scene/front_end.hpp"
#include "halfspace/units/setup.hpp"

namespace halfspace::study {
namespace {

using reference::GridPoint;

/// A draw whose clip coordinates are those of the paper / 32, which are float32 too. Its viewport has clip 0
/// at the corner of the target.
Frame frame_of(const Grid& grid) {
  constexpr float kClip = 32;
  constexpr float kViewport = 2 * kClip * kPixels;
  FrameBuilder builder(1024, DepthFormat::kNone);
  Command& draw = builder.draw({});
  draw.viewport = {-kViewport / 2, -kViewport / 2, kViewport, kViewport};
  for (int y = 0; y < kGridSide; ++y) {
    for (int x = 0; x < kGridSide; ++x) {
      for (const Point& p : grid.at(x, y)) {
        builder.frame.vertices.emplace_back(p.x / kClip, p.y / kClip, 0.5, 1);
        builder.frame.indices.push_back(draw.vertex_count++);
      }
    }
  }
  draw.index_count = draw.vertex_count;
  return std::move(builder.frame);
}

}  // namespace

std::vector<Snapped> snapped(const Grid& grid) {
  const Frame frame = frame_of(grid);
  const FrontEnd front_end(frame, frame.commands.back(), DepthFormat::kNone, kSubPixelBits);
  FrontEndCounters counters;
  std::vector<ScreenTriangle> triangles;
  for (std::uint32_t i = 0; i < frame.indices.size() / 3; ++i) {
    front_end.process(i, triangles, counters);
  }
  const SetupState state{.sub_pixel_bits = kSubPixelBits,
                         .front_positive_area = true,
                         .bounds = {.x_last = 1023, .y_last = 1023}};
  std::vector<Snapped> result;
  for (const ScreenTriangle& triangle : triangles) {
    SetupTriangle out;
    const SetupVerdict verdict = setup(triangle, state, out);
    SnappedTriple points;
    for (std::size_t i = 0; i < 3; ++i) {
      points[i] = {triangle.v[i].x, triangle.v[i].y};
    }
    result.push_back({points, verdict == SetupVerdict::kZeroArea ? 0 : (out.front ? 1 : -1)});
  }
  return result;
}

int covered(const SnappedTriple& points) {
  const GridPoint p = points[0];
  const GridPoint q = points[1];
  const GridPoint r = points[2];
  // p lies before q on the line, so the edge must begin before p: at a point of the grid that is exactly on
  // the line.
  const GridPoint step{r.x - q.x, r.y - q.y};
  GridPoint s = q;
  while (s.x >= p.x) {
    s = {s.x - step.x, s.y - step.y};
  }
  constexpr std::int64_t kAside = 64 * 256;
  const GridPoint above{p.x + kAside, p.y - kAside};
  const GridPoint below{p.x - kAside, p.y + kAside};
  // A whole number of sub-pixels moves p to the middle of pixel (8, 8).
  FrameBuilder builder(16);
  const GridPoint middle = reference::pixel_centre(8, 8, kSubPixelBits);
  const auto moved = [&](const GridPoint& v) {
    const auto pixels = [](std::int64_t n) { return static_cast<double>(n) / 256; };
    return glm::dvec3(pixels(v.x - p.x + middle.x), pixels(v.y - p.y + middle.y), 0.5);
  };
  builder.draw({moved(s), moved(r), moved(above), moved(r), moved(s), moved(below)}).depth_func =
      DepthFunc::kAlways;
  const FrameResult result = run_functional(builder.frame, Config{}, Watch{.count_pixels = true});
  return static_cast<int>(result.surfaces.at(0).fragments.at(8, 8));
}

}  // namespace halfspace::study
