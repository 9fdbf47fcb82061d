// The interpolator behind early_z on the command line: the same files from every engine that has it, and a
// line from all that has not.
#include <catch2/catch.hpp>
#include <cstring>
#include <string>
#include <vector>

#include "halfspace/report/npy.hpp"
#include "program.hpp"

using namespace halfspace::testing;

namespace {

const std::string kOn = " --set interpolator.enabled=true ";

std::int32_t number(const halfspace::NpyArray& array, std::size_t at) {
  std::int32_t value = 0;
  std::memcpy(&value, array.data.data() + at, 4);
  return value;
}

}  // namespace

TEST_CASE("interpolator: every engine but the RTL writes the same files") {
  const Place place;
  const std::string frame = scene("vkcube.ptf.xz");
  const auto folder = [&](const char* name) { return (place.path / name).string(); };
  for (const char* fidelity : {"functional", "recurrence", "systemc"}) {
    const Outcome run =
        place.run("run " + frame + kOn + "--quads --fidelity " + fidelity + " --out " + folder(fidelity));
    REQUIRE(run.status == 0);
    CHECK(run.out.find("\n  interpolator ") != std::string::npos);
  }
  CHECK(place.run("diff " + folder("functional") + " " + folder("recurrence")).status == 0);
  CHECK(place.run("diff " + folder("recurrence") + " " + folder("systemc")).status == 0);

  const Json stats = read_stats(place.path / "recurrence");
  const Json& counters = stats["frame"]["counters"]["interpolator"];
  const std::uint64_t live = counters["quads"];
  CHECK(live != 0);
  CHECK(counters["attributes"] == 2 * live);
  CHECK(stats["frame"]["time"]["links"]["interpolator"]["packets"] == 2 * live);
  CHECK(stats["frame"]["time"]["stages"]["interpolator"]["busy"] >= 2 * live);

  const halfspace::NpyArray quads = halfspace::read_npy(place.path / "systemc" / "quads.npy");
  CHECK(quads.descr.ends_with("('cycle','<u8'),('attributes','<i4',(2,4,4))]"));
  constexpr std::size_t kHead = 46;
  constexpr std::size_t kRecord = kHead + 2 * 4 * 4 * 4;
  REQUIRE(quads.data.size() == quads.shape[0] * kRecord);
  for (std::size_t at = 0; at < quads.data.size(); at += kRecord) {
    const auto passed = static_cast<unsigned>(quads.data[at + 21]);
    for (std::size_t pixel = 0; pixel < 4; ++pixel) {
      std::int32_t sum = 0;
      for (std::size_t component = 0; component < 4; ++component) {
        const std::size_t place_of = at + kHead + 16 * pixel + 4 * component;
        const std::int32_t value = number(quads, place_of);
        REQUIRE(value == number(quads, place_of + 64));  // both are the coordinates
        sum += value;
      }
      if ((passed >> pixel & 1) != 0) {
        REQUIRE(std::abs(sum - 65536) <= 2);
      }
    }
  }

  // and the difference is found
  REQUIRE(place.run("run " + frame + kOn + "--set interpolator.bits=8 --quads --out " + folder("coarse"))
              .status == 0);
  const Outcome diff = place.run("diff " + folder("functional") + " " + folder("coarse"));
  CHECK(diff.status == 1);
  CHECK(diff.out.find("attributes") != std::string::npos);
}

TEST_CASE("interpolator: the quads of a mesh have its colours") {
  const Place place;
  const std::string file = (place.path / "square.ply").string();
  // Fills a picture of 64 x 64 pixels; from red at the left to blue at the right, as light.
  std::ofstream(file) << "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                         "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                         "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                         "-1 -1 0 255 0 0\n1 -1 0 0 0 255\n1 1 0 0 0 255\n-1 1 0 255 0 0\n4 0 1 2 3\n";
  const std::string out = (place.path / "out").string();
  REQUIRE(
      place
          .run("run " + file + kOn +
               "--set interpolator.attributes=1 --size 64x64 --eye 0,0,1 --at 0,0,0 --fov 90 --no-pictures "
               "--quads --out " +
               out)
          .status == 0);
  const halfspace::NpyArray quads = halfspace::read_npy(place.path / "out" / "quads.npy");
  constexpr std::size_t kHead = 46;
  constexpr std::size_t kRecord = kHead + 64;
  std::uint64_t pixels = 0;
  for (std::size_t at = 0; at < quads.data.size(); at += kRecord) {
    const auto passed = static_cast<unsigned>(quads.data[at + 21]);
    for (std::size_t pixel = 0; pixel < 4; ++pixel) {
      if ((passed >> pixel & 1) == 0) {
        continue;
      }
      ++pixels;
      const double blue = (number(quads, at + 12) + static_cast<double>(pixel % 2) + 0.5) / 64;
      const std::size_t value = at + kHead + 16 * pixel;
      CHECK(std::abs(number(quads, value) - 65536 * (1 - blue)) <= 2);
      CHECK(number(quads, value + 4) == 0);
      CHECK(std::abs(number(quads, value + 8) - 65536 * blue) <= 2);
    }
  }
  CHECK(pixels == 64 * 64);
}

TEST_CASE("interpolator: what does not have it says so") {
  const Place place;
  const std::string refused = "'interpolator.enabled' is true; legal ";
  check_error(place.run("run " + kCube + kOn + "--fidelity rtl"), {refused.c_str(), "in the RTL: false"});
  check_error(place.run("record " + kCube + kOn + "--out " + (place.path / "record").string()),
              {refused.c_str(), "in a record: false"});
  check_error(place.run("run " + kCube + kOn + "--core fast"), {"interpolator.enabled = true"});
}
