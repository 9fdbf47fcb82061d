// run shades meshes that have attributes, and --interpolation says how.
#include <png.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "program.hpp"

using namespace halfspace::testing;

namespace {

using Texel = std::array<std::uint8_t, 3>;

/// A picture, row 0 on top.
struct Png {
  int width = 0;
  std::vector<Texel> pixels;

  explicit Png(const fs::path& path) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_file(&png, path.c_str()) != 0);
    png.format = PNG_FORMAT_RGB;
    width = static_cast<int>(png.width);
    pixels.resize(std::size_t{png.width} * png.height);
    REQUIRE(png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr) != 0);
  }
  [[nodiscard]] const Texel& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y * width + x)];
  }
};

/// A square from (-1, -1) to (1, 1) that fills a picture seen from (0, 0, 1) with 90 degrees; colours of its
/// corners are stored as sRGB.
const std::string kRedToGreen =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n"
    "-1 -1 0 255 0 0\n1 -1 0 0 255 0\n1 1 0 0 255 0\n-1 1 0 255 0 0\n4 0 1 2 3\n";

const std::string kView = " --size 64x64 --eye 0,0,1 --at 0,0,0 --fov 90 ";

}  // namespace

TEST_CASE("run refuses to shade a mesh at several samples, and draws it without pictures") {
  const Place place;
  const std::string file = (place.path / "square.ply").string();
  std::ofstream(file) << kRedToGreen;
  const std::string run = "run " + file + kView + "--out " + (place.path / "out").string();
  for (const char* setting : {"raster.samples=4", "raster.sample_positions=8,7"}) {
    const std::string set = " --set " + std::string(setting);
    check_error(place.run(run + set), {"configuration key 'raster.samples'", "the shaded picture of a mesh",
                                       "--no-pictures leaves it out", "1, at the centre"});
    CHECK(place.run(run + set + " --no-pictures").status == 0);
  }
}

TEST_CASE("run shades a mesh with its colours, lit from the eye") {
  const Place place;
  const std::string file = (place.path / "square.ply").string();
  std::ofstream(file) << kRedToGreen;
  const auto picture = [&](const std::string& more) {
    const fs::path out = place.path / "out";
    const Outcome run = place.run("run " + file + kView + "--out " + out.string() + more);
    CHECK(run.status == 0);
    CHECK(run.err.empty());
    return Png(out / "shaded0.png");
  };
  const auto is_near = [](const Texel& found, const Texel& wanted) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (std::abs(found[i] - wanted[i]) > 1) return false;
    }
    return true;
  };
  // By hand: at the middle the light falls straight, and the colours are half a light each: 188 of sRGB. In
  // the corner the line of sight has 1 / sqrt(3) of the light, and 0.06 of the rest comes from all sides.
  const Png perspective = picture("");
  CHECK(is_near(perspective.at(31, 31), {189, 186, 0}));
  CHECK(is_near(perspective.at(32, 32), {186, 189, 0}));
  const double light = 0.06 + 0.94 / std::sqrt(1 + 2 * std::pow(31.5 / 32, 2));
  const auto stored = [](double l) {
    return static_cast<std::uint8_t>(std::lround(255 * (1.055 * std::pow(l, 1 / 2.4) - 0.055)));
  };
  CHECK(is_near(perspective.at(0, 0), {stored(light * (1 - 1 / 128.0)), stored(light / 128), 0}));
  // All depths are alike: affine is the same. Flat has the colour of the first vertex of each triangle.
  CHECK(picture(" --interpolation affine").pixels == perspective.pixels);
  CHECK(is_near(picture(" --interpolation flat").at(32, 32), {255, 0, 0}));
  CHECK(picture(" --reference exact").pixels == perspective.pixels);
}

TEST_CASE("interpolation is refused where no picture shows it") {
  const Place place;
  const std::string file = (place.path / "square.ply").string();
  std::ofstream(file) << kRedToGreen;
  const std::string out = (place.path / "out").string();
  const auto check = [&](const std::string& arguments, const char* why) {
    const Outcome outcome = place.run("run " + arguments);
    CHECK(outcome.status == 2);
    check_error(outcome, {"--interpolation is 'affine'", why, "legal: "});
    CHECK_FALSE(fs::exists(out));
  };
  check(file + " --interpolation affine", "given without --out");
  check(file + " --interpolation affine --no-pictures --out " + out, "given with --no-pictures");
  check(file + " --sort front-to-back --interpolation affine --out " + out, "given with a what-if");
  check(file + " " + file + " --interpolation affine --out " + out, "given with several inputs");
  check(kCube + " --interpolation affine --out " + out, "given with an input without attributes");
  const Outcome word = place.run("run " + file + " --interpolation linear --out " + out);
  CHECK(word.status == 2);
  check_error(word, {"--interpolation", "perspective", "affine", "flat"});
}
