// The fast core against the units: the same result of every frame, on every machine that it covers.
#include <hwy/targets.h>

#include <catch2/catch.hpp>

#include "../result_difference.hpp"
#include "../timing/random_machine.hpp"
#include "../timing/record_difference.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/fast/fast_core.hpp"
#include "halfspace/machine/in_order.hpp"
#include "halfspace/timing/recurrence/run_recurrence.hpp"

namespace halfspace::testing {
namespace {

/// A frame counts as so many samples.
constexpr std::uint64_t kFrameSamples = 2000;
std::uint64_t frames() { return samples(10'000'000) / kFrameSamples; }

/// Triangles that are hard on vectors: within a few samples, on the borders of tiles and blocks, slivers, and
/// as large as the guard band.
std::vector<glm::dvec3> hard_triangles(Random& random, int size, int count) {
  const auto coordinate = [&](double low, double high) {
    const double grid = pick(random, {1.0, 2.0, 16.0, 256.0, 4096.0});
    return static_cast<double>(random.between(static_cast<std::int64_t>(low * grid),
                                              static_cast<std::int64_t>(high * grid))) /
           grid;
  };
  const auto depth = [&] {
    return pick(random, {0.0, 0.5, 1.0, coordinate(0, 1), coordinate(0, 1), coordinate(0, 1)});
  };
  std::vector<glm::dvec3> window;
  for (int n = 0; n < count; ++n) {
    const double reach = pick(random, {1.0, 2.0, 3.0, 4.0, 9.0, 40.0, 40.0, 3000.0});
    const double middle_x = coordinate(-4, size + 4);
    const double middle_y = coordinate(-4, size + 4);
    const bool flat = random.between(0, 5) == 0;
    const double z = depth();
    for (int i = 0; i < 3; ++i) {
      window.emplace_back(middle_x + coordinate(-reach, reach), middle_y + coordinate(-reach, reach),
                          flat ? z : depth());
    }
    if (random.between(0, 5) == 0) {  // a sliver
      window.back() = (window[window.size() - 2] + window[window.size() - 3]) / 2.0;
      window.back().x += coordinate(-1, 1) / 4;
    }
  }
  return window;
}

Frame hard_frame(Random& random) {
  Frame frame = random_frame(random);
  if (random.between(0, 1) == 0) {
    return frame;
  }
  const int size = pick(random, {16, 64, 100, 200});
  FrameBuilder builder(static_cast<std::uint32_t>(size),
                       pick(random, {DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kUnorm24,
                                     DepthFormat::kFloat32}));
  for (auto n = random.between(1, 3); n > 0; --n) {
    Command& draw = builder.draw(hard_triangles(random, size, static_cast<int>(random.between(1, 300))));
    draw.depth_func =
        random.between(0, 1) == 0 ? DepthFunc::kLess : static_cast<DepthFunc>(random.between(0, 7));
    draw.flags |= random.between(0, 7) == 0 ? bits({Flag::kDepthClamp}) : 0;
    draw.flags |= random.between(0, 7) == 0 ? bits({Flag::kNdcZMinusOneToOne}) : 0;
    draw.flags |= random.between(0, 7) == 0 ? bits({Flag::kCullBack}) : 0;
    draw.flags |= random.between(0, 7) == 0 ? bits({Flag::kBottomLeftRule}) : 0;
    if (random.between(0, 7) == 0) {
      draw.flags |= bits({Flag::kPolygonOffset});
      draw.offset_units = static_cast<float>(random.between(-100, 100));
      draw.offset_factor = static_cast<float>(random.between(-4, 4));
    }
    if (random.between(0, 7) == 0) {
      draw.depth_range = {static_cast<float>(random.between(0, 4)) / 4,
                          static_cast<float>(random.between(0, 4)) / 4};
    }
    if (random.between(0, 5) == 0) {
      draw.scissor = random_scissor(random, size);
    }
  }
  return builder.frame;
}

/// Two triangles that reach far beyond a small target. In a tile one has its largest depth, and the other its
/// least, at the same sample, up to some codes apart. The first vertex of each is far away and near 0, so it
/// says little of the depths that are seen.
Frame touching_planes(Random& random) {
  FrameBuilder builder(64, pick(random, {DepthFormat::kUnorm24, DepthFormat::kFloat32}));
  const double x = static_cast<double>(random.between(0, 7)) * 8 + 0.5;  // bottom left of a tile
  const double y = static_cast<double>(random.between(0, 7)) * 8 + 7.5;
  const double z = static_cast<double>(random.between(34000, 45000)) / 65536;
  for (const double side : {-1.0, 1.0}) {  // where the first vertex is
    const double size = static_cast<double>(random.between(100, 1000)) / 1000;
    const double there = z + static_cast<double>(random.between(-6, 6)) * 0x1p-25;
    const double first = static_cast<double>(random.between(1, 1000)) / 65536;
    const glm::dvec2 corner(side * 20000 * size, -10000 * size);
    const double down = side * 5e-6 / size;
    const double across = (first - there - down * (corner.y - y)) / (corner.x - x);
    const auto vertex = [&](const glm::dvec2& at) {
      return glm::dvec3(at, there + across * (at.x - x) + down * (at.y - y));
    };
    Command& draw = builder.draw({vertex(corner), vertex({side * -5000 * size, -5000 * size}),
                                  vertex({side * 2000 * size, 8000 * size})});
    draw.depth_func = side < 0 ? DepthFunc::kAlways
                               : pick(random, {DepthFunc::kLess, DepthFunc::kLequal, DepthFunc::kGreater,
                                               DepthFunc::kGequal, DepthFunc::kEqual, DepthFunc::kNotEqual});
  }
  return builder.frame;
}

/// Slivers of some square sub-pixels that cover a sample, so steep that the change of depth from pixel to
/// pixel passes 64 bits: around one that was found, in steps of 1/128 pixel.
Frame steep_slivers(Random& random) {
  FrameBuilder builder(64,
                       pick(random, {DepthFormat::kUnorm24, DepthFormat::kUnorm24, DepthFormat::kFloat32}));
  std::vector<glm::dvec3> window;
  for (int n = 0; n < 50; ++n) {
    const glm::dvec2 moved(static_cast<double>(random.between(-57, 2)),
                           static_cast<double>(random.between(-1, 49)));
    const auto vertex = [&](int x, int y, double z) {
      const auto near = [&](int at) { return static_cast<double>(at + random.between(-1, 1)) / 128; };
      window.emplace_back(near(x) + moved.x, near(y) + moved.y, z);
    };
    vertex(7440, 1794, 0);
    vertex(7822, 250, 1.0 / 64);
    vertex(7568, 1277, 1);
  }
  builder.draw(window).depth_func = DepthFunc::kLess;
  return builder.frame;
}

/// Triangles of which a scissor leaves a window of a few samples: a tile, a part of one or of several. Some
/// cover it whole.
Frame scissored(Random& random) {
  FrameBuilder builder(64, pick(random, {DepthFormat::kUnorm24, DepthFormat::kFloat32}));
  for (int n = 0; n < 8; ++n) {
    Command& draw = builder.draw(hard_triangles(random, 64, 40));
    const std::int32_t side = pick(random, {1, 2, 3, 4, 4, 4, 8, 9});
    draw.scissor = {static_cast<std::int32_t>(random.between(0, 15)) * 4,
                    static_cast<std::int32_t>(random.between(0, 15)) * 4, side, side};
  }
  return builder.frame;
}

/// Where what the fast core makes differs from what the units make; `stalls` null: without time.
std::string core_difference(const Frame& frame, const Config& config, const Watch& watch,
                            const StallPlan* stalls) {
  if (stalls == nullptr) {
    fast::FastCore core(config, watch);
    core.run(frame);
    return result_difference(core.take(), run_in_order(frame, config, watch, nullptr));
  }
  EngineOptions options{.watch = watch, .stalls = *stalls, .packet_times = true};
  options.watch.core = Core::kFast;
  const TimedResult ours = run_recurrence(frame, config, options);
  options.watch.core = Core::kReadable;
  const TimedResult other = run_recurrence(frame, config, options);
  return result_difference(ours.frame, other.frame) + difference(ours.times, other.times) +
         difference(ours.cycles, other.cycles);
}

/// Frames and machines at random, `runs` of them, on every instruction set in turn: difference(frame, config,
/// random) must be empty.
template <class Difference>
void compare_cores(std::uint64_t runs, const Difference& difference) {
  Random random(seed());
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  std::uint64_t covered = 0;
  for (std::uint64_t run = 0; run < runs; ++run) {
    const std::int64_t target = targets[run % targets.size()];
    CAPTURE(seed(), run, hwy::TargetName(target));
    const Config config = random_config(random);
    const Frame frame = hard_frame(random);
    if (!fast::gap(config, {}, nullptr).empty()) {
      continue;
    }
    ++covered;
    INFO(difference_from_default(config));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    REQUIRE(difference(frame, config, random) == "");
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  CHECK(covered > runs / 4);
}

Watch random_watch(Random& random) {
  return {.keep_visible = random.between(0, 1) == 0,
          .count_pixels = random.between(0, 3) != 0,
          .keep_sums = random.between(0, 3) == 0,
          .threads = pick(random, {1, 1, 2, 3, 8})};
}

}  // namespace

TEST_CASE("fast core: what the units make of random frames on random machines", "[property]") {
  compare_cores(frames(), [](const Frame& frame, const Config& config, Random& random) {
    return core_difference(frame, config, random_watch(random), nullptr);
  });
}

TEST_CASE("fast core: time as the units have it, of random frames on random machines", "[property]") {
  compare_cores(frames() / 5, [](const Frame& frame, const Config& config, Random& random) {
    const StallPlan stalls = random.between(0, 1) == 0 ? StallPlan{} : random_stalls(random);
    return core_difference(frame, config, random_watch(random), &stalls);
  });
}

TEST_CASE("fast core: records as the units make them, of random frames on random machines", "[property]") {
  compare_cores(frames() / 5, [](const Frame& frame, const Config& config, Random& /*random*/) {
    return record_difference(frame, config);
  });
}

TEST_CASE("fast core: planes that touch in a sample, their first vertices far away", "[property]") {
  Random random(seed() + 3);
  const Config config;
  const Watch watch{.keep_visible = true};
  for (std::uint64_t run = 0; run < frames(); ++run) {
    CAPTURE(seed(), run);
    const Frame frame = touching_planes(random);
    REQUIRE(core_difference(frame, config, watch, nullptr) == "");
  }
}

TEST_CASE("fast core: slivers so steep that a pixel's step in depth passes 64 bits", "[property]") {
  Random random(seed() + 5);
  for (std::uint64_t run = 0; run < frames() / 10; ++run) {
    CAPTURE(seed(), run);
    Config config;
    config.raster.sub_pixel_bits = static_cast<int>(random.between(7, 8));
    const Frame frame = steep_slivers(random);
    REQUIRE(core_difference(frame, config, {.keep_visible = true}, nullptr) == "");
  }
}

TEST_CASE("fast core: windows that a scissor cuts out, in every size of tile and block", "[property]") {
  Random random(seed() + 4);
  for (std::uint64_t run = 0; run < frames() / 10; ++run) {
    CAPTURE(seed(), run);
    Config config;
    config.tile_walker.tile_size = pick(random, {4, 8});
    config.block_walker.block_size = config.tile_walker.tile_size * pick(random, {2, 4, 8});
    const Watch watch{.keep_visible = true};
    const Frame frame = scissored(random);
    REQUIRE(core_difference(frame, config, watch, nullptr) == "");
  }
}

TEST_CASE("fast core: memory of the frame before leaves no trace", "[property]") {
  Random random(seed() + 1);
  const Config config;
  const Watch watch{.keep_visible = true, .keep_sums = GENERATE(false, true), .threads = 2};
  fast::FastCore core(config, watch);
  for (std::uint64_t run = 0; run < frames() / 20; ++run) {
    CAPTURE(seed(), run);
    const Frame frame = hard_frame(random);
    core.run(frame);
    core.run(frame);
    REQUIRE(result_difference(core.take(), run_in_order(frame, config, watch, nullptr)) == "");
    core.run(hard_frame(random));  // is not taken
  }
}

TEST_CASE("fast core: a run that it does not cover is refused or left to the units", "[property]") {
  Random random(seed() + 2);
  const Frame frame = hard_frame(random);
  Config config;
  CHECK(run_functional(frame, config).core == Core::kFast);
  CHECK(run_functional(frame, config, {.core = Core::kReadable}).core == Core::kReadable);
  config.tile_walker.tile_size = 16;
  CHECK(run_functional(frame, config).core == Core::kReadable);
  CHECK_THROWS_WITH(
      run_functional(frame, config, {.core = Core::kFast}),
      Catch::Contains("tile_walker.tile_size = 16") && Catch::Contains("legal: auto, readable"));
}

}  // namespace halfspace::testing
