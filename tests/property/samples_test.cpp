// Several samples a pixel in whole runs. Judges: the definition, sample by sample, through the families of
// the stress campaign; and the machine with one sample a pixel, at the place of each sample in turn.
#include <array>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "../timing/random_machine.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/core/run_core.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/validate.hpp"
#include "halfspace/stress/campaign.hpp"
#include "halfspace/stress/campaign_state.hpp"
#include "halfspace/stress/depth_bound.hpp"
#include "halfspace/stress/exact_plane.hpp"
#include "halfspace/stress/family.hpp"
#include "halfspace/stress/judge.hpp"
#include "halfspace/stress/subject.hpp"
#include "random.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

/// One random machine with its samples, and the machine of one sample at the place of `sample`.
Config only_sample(const Config& config, int sample) {
  Config one = config;
  one.raster.samples = 1;
  one.raster.sample_positions = {.count = 1,
                                 .at = {{sample_pattern(config).at[static_cast<std::size_t>(sample)]}}};
  return one;
}

const Watch kWatch{.keep_visible = true, .core = Core::kReadable};

/// The units, with the walker's decisions.
class Units final : public stress::Subject {
 public:
  explicit Units(const Config& config) : config_(config) {}

  [[nodiscard]] std::string name() const override { return "units"; }

  stress::Picture draw(const Frame& frame) override {
    struct Decisions final : PacketObserver {
      [[nodiscard]] bool wants_decisions() const override { return true; }
      void decision(const DecisionEvent& event) override { all.push_back(event); }
      std::vector<DecisionEvent> all;
    } decisions;
    const FrameResult result = run_functional(frame, config_, {.observer = &decisions});
    const Surface& surface = result.surfaces.at(0);
    return {.width = static_cast<std::uint32_t>(surface.codes.width()),
            .height = static_cast<std::uint32_t>(surface.codes.height()),
            .fragments = by_plane(surface.fragments),
            .survivors = by_plane(surface.survivors),
            .codes = by_plane(surface.codes),
            .tile_size = config_.tile_walker.tile_size,
            .decisions = std::move(decisions.all)};
  }

 private:
  template <class Value>
  static std::vector<std::uint32_t> by_plane(const TiledImage<Value>& image) {
    std::vector<std::uint32_t> values;
    for (int sample = 0; sample < image.samples(); ++sample) {
      for (int i = 0; i < image.width() * image.height(); ++i) {
        values.push_back(image.at(i % image.width(), i / image.width(), sample));
      }
    }
    return values;
  }

  Config config_;
};

template <class Value>
void require_plane(const TiledImage<Value>& all, int sample, const TiledImage<Value>& one) {
  for (int y = 0; y < all.height(); ++y) {
    for (int x = 0; x < all.width(); ++x) {
      REQUIRE(all.at(x, y, sample) == one.at(x, y));
    }
  }
}

/// Counters that are sums over samples, whatever the walk leaves out.
std::vector<std::uint64_t> sums(const FrameResult& result) {
  const Counters& c = result.counters;
  return {c.quad_generator.fragments, c.quad_generator.quads, c.quad_generator.quads_full,
          c.quad_generator.helpers,   c.quad_generator.tiles, c.quad_generator.quads_empty,
          c.early_z.tested,           c.early_z.untested,     c.early_z.survivors,
          c.early_z.written,          c.early_z.tiles_killed, c.early_z.z_bursts};
}

}  // namespace

TEST_CASE("samples: each is what a machine of that sample alone draws", "[property]") {
  const std::uint64_t first = seed();
  for (std::uint64_t n = 0; n < 80; ++n) {
    Random random(first + n);
    Config config = random_config(random);
    draw_samples(random, config);
    validate(config);
    const Frame frame = random_frame(random);
    CAPTURE(first + n, difference_from_default(config));
    const FrameResult all = run_functional(frame, config, kWatch);
    std::vector<std::uint64_t> sum(sums(all).size(), 0);
    for (int sample = 0; sample < config.raster.samples; ++sample) {
      CAPTURE(sample);
      Config alone = only_sample(config, sample);
      validate(alone);
      const FrameResult one = run_functional(frame, alone, kWatch);
      REQUIRE(one.surfaces.size() == all.surfaces.size());
      for (std::size_t s = 0; s < all.surfaces.size(); ++s) {
        require_plane(all.surfaces[s].codes, sample, one.surfaces[s].codes);
        require_plane(all.surfaces[s].fragments, sample, one.surfaces[s].fragments);
        require_plane(all.surfaces[s].survivors, sample, one.surfaces[s].survivors);
        require_plane(all.surfaces[s].visible, sample, one.surfaces[s].visible);
      }
      const std::vector<std::uint64_t> part = sums(one);
      for (std::size_t i = 0; i < sum.size(); ++i) {
        sum[i] += part[i];
      }
    }
    REQUIRE(sums(all) == sum);
    const EarlyZCounters& z = all.counters.early_z;
    REQUIRE(z.tested + z.untested == all.counters.quad_generator.fragments);
  }
}

TEST_CASE("samples: one at the centre is the machine without samples", "[property]") {
  const std::uint64_t first = seed();
  for (std::uint64_t n = 0; n < 20; ++n) {
    Random random(first + n);
    const Config config = random_config(random);
    Config listed = config;
    set_config(listed, "raster.sample_positions=8,8");
    validate(listed);
    const Frame frame = random_frame(random);
    CAPTURE(first + n, difference_from_default(config));
    const FrameResult a = run_functional(frame, config, kWatch);
    const FrameResult b = run_functional(frame, listed, kWatch);
    REQUIRE(sums(a) == sums(b));
    REQUIRE(a.counters.block_walker.blocks == b.counters.block_walker.blocks);
    REQUIRE(a.counters.tile_walker.tiles_partial == b.counters.tile_walker.tiles_partial);
    REQUIRE(a.counters.early_z.bytes_read == b.counters.early_z.bytes_read);
    for (std::size_t s = 0; s < a.surfaces.size(); ++s) {
      require_plane(a.surfaces[s].codes, 0, b.surfaces[s].codes);
      require_plane(a.surfaces[s].fragments, 0, b.surfaces[s].fragments);
    }
  }
}

TEST_CASE("samples: a frame moved by sixteenths is what the samples opposite see", "[property]") {
  // A sample at (x, y) sixteenths sees of a frame what one at the centre sees of the frame moved by (8 - x, 8
  // - y): the whole machine, the place of samples and its sign.
  const std::uint64_t first = seed();
  for (std::uint64_t n = 0; n < 40; ++n) {
    Random random(first + n);
    const int x = static_cast<int>(random.between(0, 15));
    const int y = static_cast<int>(random.between(0, 15));
    const int size = 32;
    const std::vector<glm::dvec3> window = random_triangles(random, size, 20);
    const auto draw = [&](double dx, double dy, const std::string& positions) {
      std::vector<glm::dvec3> moved = window;
      for (glm::dvec3& v : moved) {
        v.x += dx;
        v.y += dy;
      }
      FrameBuilder builder(size, DepthFormat::kUnorm24);
      builder.draw(moved).depth_func = DepthFunc::kLess;
      Config config;
      set_config(config, "raster.sample_positions", positions);
      return run_functional(builder.frame, config, kWatch);
    };
    CAPTURE(first + n, x, y);
    const FrameResult there = draw(0, 0, std::to_string(x) + "," + std::to_string(y));
    const FrameResult here = draw((8 - x) / 16.0, (8 - y) / 16.0, "8,8");
    require_plane(there.surfaces[0].codes, 0, here.surfaces[0].codes);
    require_plane(there.surfaces[0].fragments, 0, here.surfaces[0].fragments);
    require_plane(there.surfaces[0].visible, 0, here.surfaces[0].visible);
  }
}

TEST_CASE("samples: every family of the stress campaign holds for every sample", "[property]") {
  CAPTURE(seed());
  for (const char* samples : {"1", "2", "4", "8", "16"}) {
    for (const char* interpolator : {"plane", "barycentric"}) {
      Config config;
      set_config(config, "raster.samples", samples);
      set_config(config, "depth.interpolator", interpolator);
      if (std::string(samples) == "1") {
        set_config(config, "raster.sample_positions=3,14");
      }
      for (const DepthFormat format : {DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32}) {
        stress::CampaignPlan plan{.precision = {.format = format, .samples = sample_pattern(config)},
                                  .depth = {.interpolator = config.depth.interpolator},
                                  .seed = seed(),
                                  .cases = 1};
        for (const stress::Family& family : stress::families()) {
          plan.families.push_back(&family);
        }
        Units units(config);
        const stress::CampaignState state =
            stress::run_campaign(plan, units, [](const stress::CampaignState&) {});
        for (const stress::FamilyState& family : state.families) {
          CAPTURE(samples, interpolator, name(format), family.family);
          CHECK(family.tally.samples > 0);
          CHECK(family.tally.errors() == 0);
        }
      }
    }
  }
}

TEST_CASE("samples: a vertex that rounds to depth 0 has the bound of the words that its triangle takes") {
  // The bounds of docs/numerics.md, in 24-bit codes; a vertex depth has 7 bits more. Words are long with a
  // vertex of -1 units, and short with one of less than half a unit.
  const stress::Precision precision{};
  const double unit = 1.0 / 0xFFFFFF;
  const auto bound_of = [&](double units, DepthInterpolator interpolator) {
    const std::array<float, 3> z{0x1p-13F, static_cast<float>(units / 128 * unit), 1};
    const stress::ExactPlane plane({reference::GridPoint{0, 0}, {4096, 0}, {0, 4096}}, z, Command{},
                                   precision.format, precision.sub_pixel_bits);
    return stress::depth_bound(precision, interpolator, z, plane, plane.error(128, 128, 0));
  };
  const double rounding = 0.5 + 0.5 / 128;
  CHECK(bound_of(-0.4, DepthInterpolator::kPlane) == rounding + 21.5 / 128);
  CHECK(bound_of(0, DepthInterpolator::kPlane) == rounding + 21.5 / 128);
  CHECK(bound_of(-1, DepthInterpolator::kPlane) < rounding + 0x1p-30);
  CHECK(bound_of(-0.4, DepthInterpolator::kBarycentric) < rounding + 0.82 / 16);
  // A triangle with a vertex at -0.35 units that is beyond the bound of long words at 31 samples.
  const auto samples = GENERATE(1, 4);
  Config config;
  config.raster.samples = samples;
  Units units(config);
  const stress::Precision several{.samples = standard_samples(4)};
  stress::Case made = stress::make_case(stress::family_of("clamp_and_offset"), several, 1, 90);
  const stress::KnownTriangle& triangle = made.triangles[30];
  CHECK(vertex_depth_code(DepthFormat::kUnorm24, triangle.z[1]) == 0);
  CHECK(triangle.z[1] < 0);
  const stress::Precision drawn{.samples = sample_pattern(config)};
  const stress::Tally tally = stress::judge(made, drawn, {}, units.draw(made.frame), nullptr);
  CHECK(tally.depths > 0);
  CHECK(tally.errors() == 0);
}

TEST_CASE("samples: the judge finds one sample that is wrong, whichever it is", "[property]") {
  class Wrong final : public stress::Subject {
   public:
    Wrong(const Config& config, int sample) : right_(config), sample_(sample) {}
    [[nodiscard]] std::string name() const override { return "wrong"; }
    stress::Picture draw(const Frame& frame) override {
      stress::Picture picture = right_.draw(frame);
      const std::size_t pixels = std::size_t{picture.width} * picture.height;
      picture.fragments[static_cast<std::size_t>(sample_) * pixels + pixels / 2] += 1;
      return picture;
    }

   private:
    Units right_;
    int sample_;
  };
  Config config;
  set_config(config, "raster.samples=4");
  for (int sample = 0; sample < 4; ++sample) {
    Wrong wrong(config, sample);
    stress::CampaignPlan plan{.families = {&stress::family_of("sliver"), &stress::family_of("mesh")},
                              .precision = {.samples = sample_pattern(config)},
                              .seed = seed(),
                              .cases = 2};
    const stress::CampaignState state =
        stress::run_campaign(plan, wrong, [](const stress::CampaignState&) {});
    CHECK(state.sum().extra == 4);
    CHECK(state.sum().missing == 0);
  }
}

TEST_CASE("samples: a clear sets them all, drawn or fast, of all of a surface or a part") {
  for (const bool fast : {false, true}) {
    Config config;
    config.raster.samples = 8;
    config.z_cache.fast_clear = fast;
    FrameBuilder builder(20, DepthFormat::kUnorm16);
    builder.frame.commands.clear();
    builder.clear(0.5F);
    builder.clear(0.25F).scissor = {.x = 3, .y = 5, .width = 9, .height = 2};
    const FrameResult result = run_functional(builder.frame, config, kWatch);
    const TiledImage<std::uint32_t>& codes = result.surfaces[0].codes;
    for (int sample = 0; sample < 8; ++sample) {
      for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 20; ++x) {
          const bool inner = x >= 3 && x < 12 && y >= 5 && y < 7;
          REQUIRE(codes.at(x, y, sample) == code_of_depth(DepthFormat::kUnorm16, inner ? 0.25 : 0.5));
        }
      }
    }
    // 16 x 16 bits of 8 samples each: as many lines, in and out, as one sample has times 8.
    CHECK(result.flushed_bytes % 8 == 0);
  }
}

TEST_CASE("samples: depth moves once for every sample", "[property]") {
  // A triangle that fills 64 x 64 pixels, once: each line of each sample is fetched once and written once.
  for (const int samples : {1, 2, 4, 8, 16}) {
    for (const bool compression : {false, true}) {
      Config config;
      config.raster.samples = samples;
      config.z_cache.fast_clear = false;
      config.z_cache.compression = compression;
      FrameBuilder builder(64, DepthFormat::kFloat32);
      builder.frame.commands.clear();
      builder.draw({{0, 0, 0.5}, {128, 0, 0.5}, {0, 128, 0.5}}).depth_func = DepthFunc::kLess;
      const FrameResult result = run_functional(builder.frame, config, kWatch);
      const std::uint64_t lines = 64ULL * static_cast<std::uint64_t>(samples);
      CAPTURE(samples, compression);
      CHECK(result.counters.early_z.z_bursts == lines);
      CHECK(result.counters.early_z.z_misses == lines);
      CHECK(result.counters.early_z.bytes_read == lines * 256);
      // A line of one depth is coded in the fewest bytes there are, an eighth.
      CHECK(result.counters.early_z.bytes_written + result.flushed_bytes == lines * (compression ? 32 : 256));
      CHECK(result.counters.early_z.survivors == lines * 64);
    }
  }
}

TEST_CASE("samples: a viewport that cuts through a pixel's samples is refused, one that does not is drawn") {
  const auto draw = [](float x, const char* samples) {
    FrameBuilder builder(16, DepthFormat::kUnorm24);
    builder.draw({{0, 0, 0.5}, {32, 0, 0.5}, {0, 32, 0.5}}).viewport = {x, 0, 8, 8};
    Config config;
    set_config(config, "raster.samples", samples);
    return run_functional(builder.frame, config, kWatch);
  };
  draw(0.5F, "1");
  draw(3, "16");
  CHECK_THROWS_WITH(draw(0.5F, "4"),
                    "a draw's viewport of 8 x 8 pixels at (0.5, 0) cuts through the samples of a pixel, and "
                    "raster.samples is 4; legal: viewports of whole pixels, or raster.samples = 1");
  draw(0.0625F, "2");  // samples at 4 and 12 sixteenths: none between 0 and 1
}

TEST_CASE("samples: a depth far outside its range is refused") {
  FrameBuilder builder(16, DepthFormat::kUnorm24);
  Command& draw = builder.draw({{0, 0, 0.5}, {32, 0, 1e9}, {0, 32, 0.5}});
  draw.flags |= bits({Flag::kDepthClamp});
  Config config;
  run_functional(builder.frame, config, kWatch);
  config.raster.samples = 2;
  CHECK_THROWS_WITH(
      run_functional(builder.frame, config, kWatch),
      Catch::Contains("triangle 0 of a draw of 3 indices from 0 has a vertex too far outside") &&
          Catch::Contains("legal for such draws: raster.samples = 1"));
}

TEST_CASE("samples: lines and points are refused, with one sample beside the centre too") {
  for (const Primitive primitive : {Primitive::kLines, Primitive::kPoints}) {
    FrameBuilder builder(16, DepthFormat::kUnorm24);
    Command& draw = builder.draw({{1, 1, 0.5}, {9, 4, 0.5}, {5, 9, 0.5}, {3, 2, 0.5}});
    draw.primitive = primitive;
    Config config;
    run_functional(builder.frame, config, kWatch);
    for (const char* setting : {"raster.samples=4", "raster.sample_positions=8,7"}) {
      Config several;
      set_config(several, setting);
      CHECK_THROWS_WITH(run_functional(builder.frame, several, kWatch),
                        Catch::Contains("draws lines or points, and raster.samples is") &&
                            Catch::Contains("legal for such draws: raster.samples = 1, at the pixel centre"));
    }
  }
}

TEST_CASE("samples: the fast core leaves them to the units") {
  Config config;
  config.raster.samples = 2;
  CHECK(core_of(config, {}, nullptr) == Core::kReadable);
  CHECK_THROWS_WITH(core_of(config, {.core = Core::kFast}, nullptr), Catch::Contains("raster.samples"));
  Config moved;
  set_config(moved, "raster.sample_positions=7,8");
  CHECK(core_of(moved, {}, nullptr) == Core::kReadable);
}
