// Depth traffic by class of line, on frames whose lines can be counted by hand.
#include <catch2/catch.hpp>

#include "../frames.hpp"
#include "halfspace/whatif/depth_traffic.hpp"

namespace halfspace::testing {
namespace {

using whatif::ClassTraffic;
using whatif::LineClass;
using whatif::LineTraffic;

/// A z cache of a single line.
Config one_line() {
  Config config;
  config.z_cache.lines = 1;
  config.z_cache.ways = 1;
  return config;
}

/// Two triangles that cover tile `n` of the first row whole.
std::vector<glm::dvec3> tile(int n, double depth) {
  const double x = 8.0 * n;
  return {{x, 0, depth},     {x + 8, 0, depth}, {x, 8, depth},
          {x + 8, 0, depth}, {x + 8, 8, depth}, {x, 8, depth}};
}

LineTraffic of(const ClassTraffic& traffic, LineClass line) {
  return traffic[static_cast<std::size_t>(line)];
}

}  // namespace

TEST_CASE("depth traffic: a line is read in the class in which it was written") {
  FrameBuilder builder(64);
  builder.draw(tile(0, 0.5));
  builder.draw(tile(1, 0.5));                                  // tile 0 leaves, flat
  builder.draw({{0, 0, 0.25}, {8, 0, 0.25}, {0, 8, 0.25}});    // comes back, and gets a second layer
  builder.draw({{8, 0, 0.25}, {16, 0, 0.25}, {8, 8, 0.375}});  // tile 0 leaves with two layers
  const whatif::DepthTraffic traffic = whatif::count_depth_traffic(builder.frame, one_line());
  CHECK(of(traffic.read, LineClass::kCleared) == LineTraffic{2, 512, 0});
  CHECK(of(traffic.read, LineClass::kPlaneEighth) == LineTraffic{2, 512, 64});
  CHECK(moved(traffic.read) == LineTraffic{2, 512, 64});
  CHECK(of(traffic.written, LineClass::kPlaneEighth) == LineTraffic{2, 512, 64});
  CHECK(of(traffic.written, LineClass::kEndsEighth) == LineTraffic{1, 256, 32});
  // The slope is too steep for two ends, and the layer behind it for a plane.
  CHECK(of(traffic.written, LineClass::kRaw) == LineTraffic{1, 256, 256});
  CHECK(moved(traffic.written) == LineTraffic{4, 1024, 352});
  CHECK(traffic.lines_overwritten == 0);
}

TEST_CASE("depth traffic: what no clear has touched is raw, and what hi_z overwrites is not read") {
  FrameBuilder builder(64);
  builder.frame.commands.clear();
  builder.draw(tile(0, 0.5));
  const auto reads = [&](const Config& config) {
    return whatif::count_depth_traffic(builder.frame, config).read;
  };
  CHECK(of(reads(one_line()), LineClass::kRaw) == LineTraffic{1, 256, 256});
  builder.draw(tile(1, 0.5)).depth_func = DepthFunc::kAlways;
  CHECK(of(reads(one_line()), LineClass::kRaw) == LineTraffic{2, 512, 512});
  builder.frame.commands.clear();
  builder.clear(1);
  // One triangle that covers the tile whole.
  builder.draw({{0, 0, 0.5}, {32, 0, 0.5}, {0, 32, 0.5}}).scissor = {0, 0, 8, 8};
  Config config = one_line();
  config.hi_z.enabled = true;
  const whatif::DepthTraffic traffic = whatif::count_depth_traffic(builder.frame, config);
  CHECK(traffic.lines_overwritten == 1);
  CHECK(traffic.read == ClassTraffic{});
  CHECK(of(traffic.written, LineClass::kPlaneEighth) == LineTraffic{1, 256, 32});
}

}  // namespace halfspace::testing
