/// Random machines, frames and stalls for tests of time: small enough to run by the thousand, and mostly with
/// FIFOs so short and caches so small that everything waits for everything.
#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>
#include <vector>

#include "../frames.hpp"
#include "../property/random.hpp"
#include "halfspace/config/config.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/timing/stall_plan.hpp"

namespace halfspace::testing {

template <class Value>
Value pick(Random& random, std::initializer_list<Value> values) {
  return values.begin()[random.between(0, static_cast<std::int64_t>(values.size()) - 1)];
}

/// `least` to `most`, two times of three at the low end.
inline int mostly_small(Random& random, int least, int most) {
  const int high = random.between(0, 2) != 0 ? std::min(least + 3, most) : most;
  return static_cast<int>(random.between(least, high));
}

/// Draws a walk that is legal on the machine; every other time raster, block by block.
inline void random_walk(Random& random, Config& config) {
  while (true) {
    config.block_walker.levels = 2;
    config.block_walker.order = WalkOrder::kRaster;
    config.tile_walker.order = TileOrder::kRaster;
    if (random.between(0, 1) == 0) {
      return;
    }
    config.block_walker.levels = static_cast<int>(random.between(1, 3));
    config.block_walker.order = static_cast<WalkOrder>(random.between(0, 5));
    config.tile_walker.order = static_cast<TileOrder>(random.between(0, 3));
    try {
      validate(config);
      return;
    } catch (const InputError&) {
      // a led walk with superblocks, or without the test that leads it
    }
  }
}

/// For a ledger: a walk that comes to every block of the bounds.
inline void keep_to_all_blocks(Config& config) {
  config.block_walker.levels = 2;
  if (is_led(config.block_walker.order)) {
    config.block_walker.order = WalkOrder::kRaster;
  }
}

/// A valid configuration; every key that changes time, and those that change packets, are random.
inline Config random_config(Random& random) {
  Config config;
  config.raster.sub_pixel_bits = static_cast<int>(random.between(4, 8));
  config.tile_walker.tile_size = pick(random, {4, 8, 16});
  do {
    config.block_walker.block_size = config.tile_walker.tile_size * pick(random, {2, 4, 8});
  } while (config.block_walker.block_size > 64);
  config.block_walker.trivial_reject = random.between(0, 3) != 0;
  config.block_walker.sample_reject = random.between(0, 2) == 0;
  config.tile_walker.trivial_accept = random.between(0, 3) != 0;
  config.hi_z.enabled = random.between(0, 2) == 0;
  config.hi_z.accept = random.between(0, 3) != 0;
  config.hi_z.bits = pick(random, {4, 8, 12, 32});
  config.hi_z.lag = pick(random, {1, 2, 7, 20, 128, 1024});
  config.hi_z.fifo = mostly_small(random, 4, 16);
  config.depth.interpolator = pick(random, {DepthInterpolator::kPlane, DepthInterpolator::kBarycentric});
  if (config.raster.sub_pixel_bits == 8) {  // else half a pixel may be less than the uncertainty
    config.raster.conservative =
        pick(random, {Conservative::kOff, Conservative::kOuter, Conservative::kInner});
    config.raster.uncertainty = pick(random, {0, 1, 2, 128});
    config.raster.inner_coverage =
        config.raster.conservative == Conservative::kOuter && random.between(0, 1) == 0;
  }
  config.late_z.mode = pick(random, {LateZ::kOpaque, LateZ::kNoWrite, LateZ::kLate});
  config.late_z.queue = mostly_small(random, 1, 64);
  config.late_z.latency = pick(random, {1, 2, 10, 100, 200, 3000});
  config.late_z.discard = pick(random, {0, kWholeShare / 3, kWholeShare / 2, kWholeShare});
  config.late_z.seed = static_cast<int>(random.between(1, 1000));

  config.setup.fill_rule = pick(
      random, {FillRuleKey::kDraw, FillRuleKey::kDraw, FillRuleKey::kTopRight, FillRuleKey::kBottomRight});
  config.setup.queue = mostly_small(random, 2, 64);
  config.setup.interval = pick(random, {1, 2, 4, 8, 16});
  config.setup.fifo = mostly_small(random, 2, 64);
  config.block_walker.fifo = mostly_small(random, 2, 8);
  config.tile_walker.fifo = mostly_small(random, 2, 64);
  config.edge_evaluator.pipe_stages = static_cast<int>(random.between(1, 3));
  config.edge_evaluator.fifo = mostly_small(random, 2, 32);
  do {
    config.quad_generator.quads_per_cycle = pick(random, {1, 2, 4, 8, 16});
  } while (config.quad_generator.quads_per_cycle >
           config.tile_walker.tile_size * config.tile_walker.tile_size / 4);
  config.quad_generator.fifo = mostly_small(random, 2, 64);
  do {
    config.early_z.quads_per_cycle = pick(random, {1, 2, 4, 8, 16});
  } while (config.early_z.quads_per_cycle > config.quad_generator.quads_per_cycle);
  config.early_z.pending = mostly_small(random, 2, 64);
  config.early_z.fifo = mostly_small(random, 2, 64);
  do {
    config.z_cache.parts = pick(random, {1, 2, 4});
  } while (config.z_cache.parts > config.tile_walker.tile_size / 2);
  const int row_tiles = config.block_walker.block_size / config.tile_walker.tile_size;
  config.hi_z.enabled &= row_tiles * row_tiles * config.z_cache.parts <= 64;
  config.z_cache.ways = pick(random, {1, 1, 2, 4, 8, 16});
  do {
    config.z_cache.lines = pick(random, {1, 2, 4, 4, 8, 8, 16, 32, 64, 128, 512});
  } while (config.z_cache.lines < config.z_cache.parts * config.z_cache.ways);
  config.z_cache.misses_in_flight = mostly_small(random, config.z_cache.parts, 64);
  config.z_cache.write_buffers = mostly_small(random, config.z_cache.parts, 64);
  config.z_cache.fast_clear = random.between(0, 2) != 0;
  config.z_cache.compression = random.between(0, 2) == 0;
  config.z_cache.clear_tiles = pick(random, {1, 2, 4, 64, 1024});
  config.memory.latency = pick(random, {1, 2, 5, 20, 50, 100, 400, 5000});
  config.memory.read_bytes = pick(random, {1, 4, 16, 32, 64, 128, 1024});
  config.memory.write_bytes = pick(random, {1, 4, 16, 32, 64, 128, 1024});
  random_walk(random, config);
  return config;
}

/// 1 to 16 samples a pixel, every other time at positions of their own; `config` loses what does not know of
/// samples.
inline void draw_samples(Random& random, Config& config) {
  const int row_tiles = config.block_walker.block_size / config.tile_walker.tile_size;
  config.raster.samples = pick(random, {1, 2, 4, 8, row_tiles == 8 ? 8 : 16});
  if (random.between(0, 1) == 0) {
    SamplePattern positions{.count = config.raster.samples};
    for (SamplePosition& each : positions.at) {
      each = {.x = static_cast<std::uint8_t>(random.between(0, 15)),
              .y = static_cast<std::uint8_t>(random.between(0, 15))};
    }
    config.raster.sample_positions = positions;
  }
  if (!sample_pattern(config).is_centre()) {
    config.raster.conservative = Conservative::kOff;
    config.raster.inner_coverage = false;
    config.hi_z.enabled = false;
    config.block_walker.sample_reject = false;
    config.late_z.mode = config.late_z.mode == LateZ::kLate ? LateZ::kOpaque : config.late_z.mode;
  }
}

/// The same, one time of two with several samples a pixel.
inline Config random_sampled_config(Random& random) {
  Config config = random_config(random);
  if (random.between(0, 1) == 0) {
    draw_samples(random, config);
  }
  return config;
}

/// With the interpolator behind early_z; `config` loses what is not legal with it.
inline void draw_interpolator(Random& random, Config& config) {
  config.interpolator.enabled = true;
  config.interpolator.attributes = static_cast<int>(random.between(1, 8));
  config.interpolator.bits = 2 * static_cast<int>(random.between(4, 12));
  config.interpolator.fifo = mostly_small(random, 2, 64);
  config.raster.conservative = Conservative::kOff;
  config.raster.inner_coverage = false;
  for (;;) {
    try {
      validate(config);
      return;
    } catch (const InputError&) {  // more places in FIFOs than slots for triangles
      config.early_z.fifo = mostly_small(random, 2, 64);
      config.early_z.pending = mostly_small(random, 2, 64);
      config.tile_walker.fifo = mostly_small(random, 2, 64);
      config.quad_generator.fifo = mostly_small(random, 2, 64);
    }
  }
}

/// A random machine for the packets of `recorded`.
inline Config random_timing(Random& random, const Config& recorded) {
  while (true) {
    Config config = random_config(random);
    config.raster = recorded.raster;
    config.tile_walker.tile_size = recorded.tile_walker.tile_size;
    config.block_walker.block_size = recorded.block_walker.block_size;
    config.block_walker.trivial_reject = recorded.block_walker.trivial_reject;
    config.block_walker.sample_reject = recorded.block_walker.sample_reject;
    config.block_walker.levels = recorded.block_walker.levels;
    config.block_walker.order = recorded.block_walker.order;
    config.tile_walker.order = recorded.tile_walker.order;
    config.tile_walker.trivial_accept = recorded.tile_walker.trivial_accept;
    config.hi_z.enabled = recorded.hi_z.enabled;
    config.hi_z.accept = recorded.hi_z.accept;
    config.hi_z.bits = recorded.hi_z.bits;
    config.hi_z.lag = recorded.hi_z.lag;
    config.setup.fill_rule = recorded.setup.fill_rule;
    config.depth.interpolator = recorded.depth.interpolator;
    config.late_z.mode = recorded.late_z.mode;
    config.late_z.discard = recorded.late_z.discard;
    config.late_z.seed = recorded.late_z.seed;
    config.z_cache.fast_clear = recorded.z_cache.fast_clear;
    config.z_cache.compression = recorded.z_cache.compression;
    if (config.z_cache.compression || config.hi_z.enabled) {
      config.z_cache.parts = recorded.z_cache.parts;  // of lines that are coded, and of bounds
    }
    try {
      validate(config);
      return config;
    } catch (const InputError&) {
      // widths and parts of another tile size: draw again
    }
  }
}

/// Machines that differ from `recorded` in time alone, more than go into a pass with its z cache.
inline std::vector<Config> random_machines(Random& random, const Config& recorded, std::size_t count) {
  std::vector<Config> machines;
  for (std::size_t i = 0; i < count; ++i) {
    Config config = random_timing(random, recorded);
    if (i % 8 != 0) {
      config.z_cache.lines = recorded.z_cache.lines;
      config.z_cache.ways = recorded.z_cache.ways;
      config.z_cache.parts = recorded.z_cache.parts;
      config.late_z.queue = recorded.late_z.queue;
      config.z_cache.misses_in_flight = std::max(config.z_cache.misses_in_flight, recorded.z_cache.parts);
      config.z_cache.write_buffers = std::max(config.z_cache.write_buffers, recorded.z_cache.parts);
    }
    if (random.between(0, 3) != 0) {  // fast enough for 16 bits
      config.memory.latency = std::min(config.memory.latency, 400);
    }
    machines.push_back(config);
  }
  return machines;
}

/// The keys in which `config` is not the default, one a line.
inline std::string difference_from_default(const Config& config) {
  const std::vector<ConfigKey> ours = config_keys(config);
  const std::vector<ConfigKey> defaults = config_keys({});
  std::string text;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    if (ours[i].value != defaults[i].value) {
      text += ours[i].name + " = " + ours[i].value + "\n";
    }
  }
  return text;
}

/// Vertices of `count` triangles in and around a square of `size` pixels, half of them small.
inline std::vector<glm::dvec3> random_triangles(Random& random, int size, int count) {
  const auto point = [&](int low, int high) {
    return glm::dvec3{static_cast<double>(random.between(low * 256, high * 256)) / 256,
                      static_cast<double>(random.between(low * 256, high * 256)) / 256,
                      static_cast<double>(random.between(0, 1 << 20)) / (1 << 20)};
  };
  std::vector<glm::dvec3> window;
  for (int n = 0; n < count; ++n) {
    const bool small = random.between(0, 1) == 0;
    const glm::dvec3 centre = point(0, size);
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 v = point(small ? -6 : -size, small ? 6 : size);
      window.emplace_back(centre.x + v.x, centre.y + v.y, v.z);
    }
  }
  return window;
}

/// Anything from the whole target to nothing of it.
inline Scissor random_scissor(Random& random, int size) {
  return {.x = static_cast<std::int32_t>(random.between(-9, size)),
          .y = static_cast<std::int32_t>(random.between(-9, size)),
          .width = static_cast<std::int32_t>(random.between(0, size + 16)),
          .height = static_cast<std::int32_t>(random.between(0, size + 16))};
}

/// A target of 8 to 64 pixels, sometimes one or two more of which one has no depth, 1 to 4 draws in any state
/// and clears of all kinds between them.
inline Frame random_frame(Random& random) {
  const int size = pick(random, {8, 16, 32, 64});
  const auto format = [&] {
    return pick(random, {DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32});
  };
  FrameBuilder builder(static_cast<std::uint32_t>(size), format());
  if (random.between(0, 3) == 0) {
    builder.frame.commands.clear();
  }
  std::uint32_t targets = 1;
  if (random.between(0, 2) == 0) {
    Target second = builder.frame.targets[0];
    second.width = second.height = static_cast<std::uint32_t>(pick(random, {8, 16, 32}));
    second.depth_format = format();
    second.depth_surface = 1;
    second.presented = false;
    builder.frame.targets.push_back(second);
    ++targets;
  }
  if (random.between(0, 5) == 0) {
    Target bare = builder.frame.targets[0];
    bare.depth_format = DepthFormat::kNone;
    bare.depth_surface = kNoSurface;
    bare.presented = false;
    builder.frame.targets.push_back(bare);
    ++targets;
  }
  const auto any_target = [&] { return static_cast<std::uint32_t>(random.between(0, targets - 1)); };
  const auto draws = random.between(1, 4);
  for (int n = 0; n < draws; ++n) {
    for (auto clears = pick(random, {0, 0, 1, 2}); clears > 0; --clears) {
      Command& clear = builder.clear(static_cast<float>(random.between(0, 8)) / 8);
      clear.target = any_target();
      if (random.between(0, 1) == 0) {
        clear.scissor = random_scissor(random, size);
      }
    }
    Command& draw = builder.draw(
        random_triangles(random, size, static_cast<int>(random.between(0, 3) * random.between(1, 8))));
    draw.target = any_target();
    const bool has_depth = builder.frame.targets[draw.target].depth_surface != kNoSurface;
    const bool test = has_depth && random.between(0, 7) != 0;
    draw.depth_func =
        random.between(0, 1) == 0 ? DepthFunc::kLess : static_cast<DepthFunc>(random.between(0, 7));
    draw.flags = bits({Flag::kColorWrite}) | (test ? bits({Flag::kDepthTest}) : 0);
    for (const Flag flag : {Flag::kDepthWrite, Flag::kFrontPositiveArea, Flag::kBottomLeftRule,
                            Flag::kShaderDiscards, Flag::kEarlyTestsForced}) {
      const bool wanted = random.between(0, 3) != 0 && (flag != Flag::kDepthWrite || test);
      draw.flags |= wanted ? bits({flag}) : 0;
    }
    draw.flags |= random.between(0, 7) == 0 ? bits({Flag::kCullBack}) : 0;
    draw.flags |= random.between(0, 31) == 0 ? bits({Flag::kNotFilled}) : 0;
    if (random.between(0, 3) == 0) {
      draw.scissor = random_scissor(random, size);
    }
  }
  return builder.frame;
}

inline StallPlan::Rate random_rate(Random& random) {
  return {.percent = pick(random, {0u, 5u, 30u, 100u}), .max_cycles = pick(random, {1u, 3u, 20u, 200u})};
}

/// None, or some at any of the points but that behind the interpolator.
inline StallPlan random_stalls(Random& random) {
  StallPlan plan;
  plan.seed = static_cast<std::uint64_t>(random.between(0, 1 << 30));
  if (random.between(0, 2) == 0) {
    return plan;
  }
  for (std::size_t i = 0; i < kStallPoints; ++i) {
    if (static_cast<StallPoint>(i) != StallPoint::kInterpolator) {
      plan.rate[i] = random_rate(random);
    }
  }
  return plan;
}

}  // namespace halfspace::testing
