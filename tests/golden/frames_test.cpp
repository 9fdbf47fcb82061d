// Captured frames: counts against an independent rasterizer's, depth against the driver's and in other
// orders.
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>

#include "../result_difference.hpp"
#include "captured_frame.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/reference/rasterizer.hpp"
#include "halfspace/report/npy.hpp"
#include "halfspace/whatif/depth_ahead.hpp"
#include "halfspace/whatif/sort.hpp"

using namespace halfspace;
using halfspace::testing::captured_frame;
using halfspace::testing::folder_of;
namespace fs = std::filesystem;

namespace {

/// A row of expected.tsv.
struct Expected {
  std::string frame;
  std::uint32_t surface = 0;
  bool opaque = false;
  double covered = 0;
  double passed = 0;
  double quads = 0;
  double helpers = 0;
};

std::vector<Expected> read_expected(const fs::path& path, const std::string& frame) {
  std::vector<Expected> rows;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  REQUIRE(
      line.rfind(
          "frame\tsurface\topaque\twidth\theight\ttriangles\tclipped_away\tculled\tdrawn\tcovered_fragments\t"
          "depth_passed\tquads\thelper_fragments",
          0) == 0);
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    Expected row;
    double skipped = 0;
    fields >> row.frame >> row.surface >> row.opaque;
    for (int i = 0; i < 6; ++i) {
      fields >> skipped;
    }
    fields >> row.covered >> row.passed >> row.quads >> row.helpers;
    if (row.frame == frame) {
      rows.push_back(row);
    }
  }
  return rows;
}

bool within(double value, double expected, double share) {
  return std::abs(value - expected) <= share * expected;
}

bool agree(double ours, double theirs) { return std::abs(ours - theirs) <= std::ldexp(1.0, -16); }

/// Where a draw whose shader may discard wrote depth: the driver may have kept what we overwrote.
FrameResult discarding_draws(const Frame& frame) {
  Frame only = frame;
  std::erase_if(only.commands, [](const Command& c) {
    return c.kind == CommandKind::kDraw && !(c.has(Flag::kShaderDiscards) && c.has(Flag::kDepthWrite));
  });
  return run_functional(only, {});
}

/// Counts of both ways to take draws that would test late, on every surface.
void check_counts(const std::string& name) {
  const Frame frame = captured_frame(name);
  const std::vector<Expected> rows = read_expected(folder_of(name) / "expected.tsv", name);
  REQUIRE(!rows.empty());
  const bool exact = name == "vkcube" || name == "glmark2_shadow";
  for (const Expected& row : rows) {
    Config config;
    config.late_z.mode = row.opaque ? LateZ::kOpaque : LateZ::kNoWrite;
    const FrameResult result = run_functional(frame, config);
    const Counters& counters = result.surfaces.at(row.surface).counters;
    const auto fragments = static_cast<double>(counters.quad_generator.fragments);
    const auto survivors = static_cast<double>(counters.early_z.survivors);
    const auto quads = static_cast<double>(counters.quad_generator.quads);
    const auto helpers = static_cast<double>(counters.quad_generator.helpers);
    std::printf(
        "%s surface %u opaque %d: covered %+.0f of %.0f, quads %+.0f of %.0f, helpers %+.0f of %.0f, "
        "survivors %+.0f of %.0f\n",
        name.c_str(), row.surface, row.opaque, fragments - row.covered, row.covered, quads - row.quads,
        row.quads, helpers - row.helpers, row.helpers, survivors - row.passed, row.passed);
    CAPTURE(name, row.surface, row.opaque);
    CHECK(within(fragments, row.covered, exact ? 0 : 20e-6));
    CHECK(within(quads, row.quads, exact ? 0 : 1e-3));
    CHECK(within(helpers, row.helpers, exact ? 0 : 1e-3));
    CHECK(within(survivors, row.passed, exact ? 0 : 1e-3));
  }
}

/// Depth on every surface that the driver could read back.
void check_depth(const std::string& name) {
  const Frame frame = captured_frame(name);
  const FrameResult result = run_functional(frame, {});
  const FrameResult discarding = discarding_draws(frame);
  const std::vector<reference::Surface> unsnapped = reference::rasterize(frame, {});
  int compared = 0;
  for (std::size_t s = 0; s < result.surfaces.size(); ++s) {
    const fs::path file = folder_of(name) / (name + ".depth" + std::to_string(s) + ".npy.xz");
    if (!fs::exists(file)) {
      continue;  // the driver could not read this one back
    }
    ++compared;
    const NpyArray driver = read_npy(file);
    const Surface& surface = result.surfaces[s];
    const int width = surface.codes.width();
    const int height = surface.codes.height();
    REQUIRE(driver.descr == "'<f4'");
    REQUIRE(driver.shape == std::vector<std::uint64_t>{static_cast<std::uint64_t>(height),
                                                       static_cast<std::uint64_t>(width)});
    // Every pixel that is apart belongs to a class of docs/numerics.md.
    int apart = 0;
    int discarded = 0;  // a draw wrote there whose shader may have killed what we keep
    int snapped = 0;    // the reference, whose planes go through unsnapped vertices, agrees with the driver
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        float theirs = 0;
        std::memcpy(&theirs, driver.data.data() + 4 * at, 4);
        const double ours = depth_of_code(surface.format, surface.codes.at(x, y));
        if (agree(ours, theirs)) {
          continue;
        }
        ++apart;
        if (discarding.surfaces[s].fragments.at(x, y) != 0) {
          ++discarded;
        } else if (agree(unsnapped[s].depth[at], theirs)) {
          ++snapped;
        }
      }
    }
    std::printf(
        "%s surface %zu: %d of %d pixels beyond 2^-16 (%.4f%%): %d discarding shader, %d snapping, %d "
        "unexplained\n",
        name.c_str(), s, apart, width * height, 100.0 * apart / (width * height), discarded, snapped,
        apart - discarded - snapped);
    CHECK(apart <= 0.003 * width * height);
    CHECK(apart - discarded - snapped == 0);
  }
  REQUIRE(compared > 0);
}

/// No what-if of order changes the depth of any surface.
void check_orders(const std::string& name) {
  const Frame frame = captured_frame(name);
  const FrameResult plain = run_functional(frame, {});
  const auto check = [&](const char* what, const auto& act) {
    CAPTURE(name, what);
    Frame changed = frame;
    act(changed);
    const FrameResult result = run_functional(changed, {});
    REQUIRE(result.surfaces.size() == plain.surfaces.size());
    for (std::size_t s = 0; s < plain.surfaces.size(); ++s) {
      CHECK(halfspace::testing::image_difference("surface " + std::to_string(s), result.surfaces[s].codes,
                                                 plain.surfaces[s].codes) == "");
    }
  };
  check("prepass", [](Frame& f) { whatif::prepass(f); });
  check("delay", [](Frame& f) { whatif::delay(f, 1000); });
  check("front to back", [](Frame& f) { whatif::sort(f, whatif::SortOrder::kFrontToBack); });
  check("back to front", [](Frame& f) { whatif::sort(f, whatif::SortOrder::kBackToFront); });
  check("backwards", [](Frame& f) { whatif::reverse(f); });
}

/// Late draws: with no discard the depth of `opaque`, with all discarded that of `no_write`, with hi_z too.
void check_late(const std::string& name) {
  const Frame frame = captured_frame(name);
  const auto run = [&frame](LateZ mode, int discard, bool hi_z) {
    Config config;
    config.late_z.mode = mode;
    config.late_z.discard = discard;
    config.hi_z.enabled = hi_z;
    return run_functional(frame, config);
  };
  const auto check = [&name](const FrameResult& ours, const FrameResult& other) {
    CAPTURE(name);
    for (std::size_t s = 0; s < other.surfaces.size(); ++s) {
      CHECK(halfspace::testing::image_difference("surface " + std::to_string(s), ours.surfaces[s].codes,
                                                 other.surfaces[s].codes) == "");
    }
    CHECK(ours.counters.early_z.survivors == other.counters.early_z.survivors);
  };
  const FrameResult opaque = run(LateZ::kOpaque, 0, false);
  const FrameResult no_write = run(LateZ::kNoWrite, 0, false);
  for (const bool hi_z : {false, true}) {
    const FrameResult none = run(LateZ::kLate, 0, hi_z);
    check(none, opaque);
    CHECK(none.counters.early_z.written == opaque.counters.early_z.written);
    const FrameResult all = run(LateZ::kLate, kWholeShare, hi_z);
    check(all, no_write);
    CHECK(all.counters.early_z.written == no_write.counters.early_z.written);
    CHECK(all.counters.early_z.discarded != 0);
  }
}

}  // namespace

// A frame that is not there skips its own case only.
TEST_CASE("vkcube", "[golden]") {
  check_counts("vkcube");
  check_depth("vkcube");
  check_orders("vkcube");
}

TEST_CASE("cc0_truck", "[golden]") {
  check_counts("cc0_truck");  // made from a model, so there is no driver's depth
  check_orders("cc0_truck");
}

TEST_CASE("glmark2_ideas", "[golden]") {
  check_counts("glmark2_ideas");
  check_depth("glmark2_ideas");
  check_orders("glmark2_ideas");
}

TEST_CASE("glmark2_shadow", "[golden]") {
  check_counts("glmark2_shadow");
  check_depth("glmark2_shadow");
  check_orders("glmark2_shadow");
}

TEST_CASE("stk_snowmountain", "[golden]") {
  check_counts("stk_snowmountain");
  check_depth("stk_snowmountain");
  check_orders("stk_snowmountain");
}

TEST_CASE("openarena_gl2", "[golden]") {
  check_counts("openarena_gl2");
  check_depth("openarena_gl2");
  check_orders("openarena_gl2");
  check_late("openarena_gl2");
}

TEST_CASE("warzone2100_vulkan", "[golden]") {
  check_counts("warzone2100_vulkan");
  check_depth("warzone2100_vulkan");
  check_orders("warzone2100_vulkan");
  check_late("warzone2100_vulkan");
}
