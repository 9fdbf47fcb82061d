// Thin lines by the textbook rasterizer: what the machine draws, fragment by fragment.
#include <catch2/catch.hpp>

#include "../line_frames.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/reference/rasterizer.hpp"
#include "halfspace/scene/validate.hpp"

namespace halfspace::testing::reference_line_tests {
namespace {

/// With thin lines for rectangular ones, and without points, which no reference draws.
Frame thin_only(const Frame& frame, Random& random) {
  Frame thin = frame;
  for (Command& command : thin.commands) {
    if (command.primitive == Primitive::kPoints || command.polygon_mode == PolygonMode::kPoint) {
      command.index_count = 0;
      command.primitive = Primitive::kTriangles;
      command.polygon_mode = PolygonMode::kFill;
    }
    if (!is_thin(command.line_rule)) {
      command.line_rule = static_cast<LineRule>(random.between(1, 4));
    }
  }
  return thin;
}

}  // namespace

TEST_CASE("reference lines: thin lines of whole frames have the fragments of the machine", "[property]") {
  std::uint64_t fragments = 0;
  for (std::uint64_t n = 0; n < samples(200000) / 1000; ++n) {
    CAPTURE(seed(), n);
    Random random(seed() + n);
    const Frame frame = thin_only(random_lines(random, true), random);
    validate(frame);
    const int bits = static_cast<int>(random.between(4, 8));
    Config config;
    config.raster.sub_pixel_bits = bits;
    const FrameResult machine = run_functional(frame, config, {.count_pixels = true});
    const auto reference = reference::rasterize(frame, {.method = "exact", .subpixel_bits = bits});
    REQUIRE(reference.size() == machine.surfaces.size());
    const reference::Surface& surface = reference.at(0);
    for (std::uint32_t y = 0; y < surface.height; ++y) {
      for (std::uint32_t x = 0; x < surface.width; ++x) {
        const std::uint32_t expected = surface.fragments[std::size_t{y} * surface.width + x];
        fragments += expected;
        if (machine.surfaces[0].fragments.at(static_cast<int>(x), static_cast<int>(y)) != expected) {
          FAIL("pixel (" << x << ", " << y << ") is covered "
                         << machine.surfaces[0].fragments.at(static_cast<int>(x), static_cast<int>(y))
                         << " times by the machine, " << expected << " by the reference");
        }
      }
    }
  }
  CHECK(fragments > 10000);
}

}  // namespace halfspace::testing::reference_line_tests
