// Lines and points from the command line: options change the draws, and are refused where they cannot.
#include <catch2/catch.hpp>

#include "program.hpp"

using namespace halfspace::testing;

TEST_CASE("options of lines and points say how a frame is drawn") {
  const Place place;
  const Outcome filled = place.run("run " + kCube);
  const Outcome lines = place.run("run " + kCube + " --polygon-mode line --line-rule diamond_exit");
  const Outcome wide =
      place.run("run " + kCube + " --polygon-mode line --line-rule diamond_exit --line-width 3");
  const Outcome dashed =
      place.run("run " + kCube + " --polygon-mode line --line-rule diamond_exit --line-stipple 4:F0F0");
  const Outcome points = place.run("run " + kCube + " --polygon-mode point --point-size 4");
  for (const Outcome& outcome : {filled, lines, wide, dashed, points}) {
    CHECK(outcome.status == 0);
  }
  const auto fragments = [](const Outcome& outcome) {
    const std::size_t at = outcome.out.find(" quads; ");
    REQUIRE(at != std::string::npos);
    return std::stoull(outcome.out.substr(at + 8));
  };
  CHECK(fragments(wide) == 3 * fragments(lines));
  CHECK(fragments(dashed) < fragments(lines));
  CHECK(fragments(lines) < fragments(filled));
  CHECK(fragments(points) == 3 * 6 * 4 * 4);  // corners of the six faces that are not culled
}

TEST_CASE("options of lines and points are refused with what is legal") {
  const Place place;
  for (const auto& [options, part] :
       {std::pair{"--line-width 65", "--line-width is 65; legal: above 0, at most 64"},
        std::pair{"--point-size 0", "--point-size is 0; legal: above 0, at most 2048"},
        std::pair{"--line-stipple 0:FFFF", "FACTOR 1 to 256"},
        std::pair{"--line-stipple 1:10000", "four hexadecimal digits"},
        std::pair{"--line-stipple 1", "FACTOR:PATTERN"}, std::pair{"--line-rule diamond", "diamond_exit"},
        std::pair{"--polygon-mode lines", "line"}}) {
    CAPTURE(options);
    const Outcome outcome = place.run("run " + kCube + " " + options);
    CHECK(outcome.status == 2);
    check_error(outcome, {part});
  }
}

TEST_CASE("thin lines are refused by what cannot draw them, by name") {
  const Place place;
  const std::string lines = "run " + kCube + " --polygon-mode line --line-rule bresenham ";
  check_error(place.run(lines + "--set depth.interpolator=barycentric"),
              {"bresenham", "barycentric", "plane"});
  check_error(place.run(lines + "--reference scanline"), {"lines or points", "legal", "'exact' thin lines"});
  check_error(place.run("run " + kCube + " --polygon-mode line --reference exact"),
              {"lines or points", "legal"});
  check_error(place.run("run " + kCube + " --polygon-mode point --reference exact"),
              {"lines or points", "legal"});
  check_error(
      place.run("run " + kCube + " --polygon-mode line --line-rule dda --line-width 2 --reference exact"),
      {"dda", "2 pixels wide", "odd widths"});
  check_error(place.run("stress --lines --set depth.interpolator=barycentric"), {"interpolator", "plane"});
  check_error(place.run("stress --lines --set raster.samples=4"), {"raster.samples", "legal"});
  check_error(place.run("stress --lines --engine reference:exact"), {"--engine", "line_", "files:DIR"});
  check_error(place.run("stress --family line_tiny --sharpness"), {"--sharpness", "line_tiny", "triangles"});
}
