// hi_z rejects only what the exact test would reject: nothing but its counts and the work saved may show.
#include <catch2/catch.hpp>

#include "../result_difference.hpp"
#include "halfspace/machine/in_order.hpp"
#include "halfspace/units/hi_z.hpp"
#include "hard_frames.hpp"

namespace halfspace::testing {
namespace {

/// A frame counts as so many samples.
constexpr std::uint64_t kHiZFrameSamples = 2000;

Config random_hi_z(Random& random) {
  while (true) {
    Config config = random_config(random);
    config.hi_z.enabled = true;
    config.hi_z.bits = pick(random, {4, 5, 8, 12, 16, 24, 32, 32});
    config.hi_z.lag = pick(random, {1, 2, 3, 8, 20, 64, 128, 1024});
    try {
      validate(config);
      return config;
    } catch (const InputError&) {
      // too many bounds in a block
    }
  }
}

/// Where the results of a frame with hi_z and without differ in what they must not.
std::string lost_by_hi_z(const Frame& frame, Config config) {
  const Watch watch{.keep_visible = true};
  const FrameResult with = run_in_order(frame, config, watch, nullptr);
  config.hi_z.enabled = false;
  const FrameResult without = run_in_order(frame, config, watch, nullptr);
  std::string text = picture_difference(with, without);
  for (std::size_t i = 0; text.empty() && i < with.draws.size(); ++i) {
    const Counters& ours = with.draws[i].counters;
    const Counters& other = without.draws[i].counters;
    text += difference("blocks", ours.block_walker.blocks, other.block_walker.blocks) +
            difference(
                "tiles",
                ours.hi_z.tiles_rejected + ours.tile_walker.tiles_accepted + ours.tile_walker.tiles_partial,
                other.tile_walker.tiles_accepted + other.tile_walker.tiles_partial);
  }
  return text;
}

}  // namespace

TEST_CASE("hi_z: loses nothing of random frames", "[property]") {
  Random random(seed());
  for (std::uint64_t run = 0; run < samples(6'000'000) / kHiZFrameSamples; ++run) {
    CAPTURE(seed(), run);
    const Config config = random_hi_z(random);
    CAPTURE(difference_from_default(config));
    REQUIRE(lost_by_hi_z(hard_frame(random), config) == "");
  }
}

TEST_CASE("hi_z: loses nothing of stacks of depth, one code apart", "[property]") {
  Random random(seed() + 1);
  std::uint64_t rejected = 0;
  for (std::uint64_t run = 0; run < samples(6'000'000) / kHiZFrameSamples; ++run) {
    CAPTURE(seed(), run);
    const Config config = random_hi_z(random);
    const Frame frame = depth_stack(random);
    CAPTURE(difference_from_default(config));
    REQUIRE(lost_by_hi_z(frame, config) == "");
    rejected += run_in_order(frame, config, {}, nullptr).counters.hi_z.tiles_rejected;
  }
  CHECK(rejected > 1000);
}

TEST_CASE("hi_z: loses nothing of planes that touch in a sample, and of steep slivers", "[property]") {
  Random random(seed() + 2);
  for (std::uint64_t run = 0; run < samples(6'000'000) / kHiZFrameSamples; ++run) {
    CAPTURE(seed(), run);
    Config config;
    config.hi_z.enabled = true;
    config.tile_walker.tile_size = pick(random, {4, 8, 16});
    config.hi_z.lag = pick(random, {1, 8, 128});
    config.raster.conservative =
        pick(random, {Conservative::kOff, Conservative::kOuter, Conservative::kInner});
    REQUIRE(lost_by_hi_z(touching_planes(random), config) == "");
    if (run % 8 == 0) {
      REQUIRE(lost_by_hi_z(steep_slivers(random), config) == "");
    }
  }
}

TEST_CASE("hi_z: a word holds every bound, and rounds outwards", "[property]") {
  Random random(seed() + 3);
  for (std::uint64_t run = 0; run < samples(1'000'000) / 1000; ++run) {
    const int bits = static_cast<int>(random.between(4, 32));
    const auto entries = static_cast<std::size_t>(pick(random, {1, 4, 16, 64}));
    CAPTURE(seed(), run, bits, entries);
    const auto top = static_cast<std::int64_t>(pick(random, {255u, 0xFFFFu, 0xFFFFFFu, 0x3F800000u}));
    HiZWord word = random.between(0, 1) == 0 ? cleared_word(static_cast<std::uint32_t>(top))
                                             : unknown_word(entries, bits);
    std::vector<CodeBounds> exact(entries, word.entry(0));
    for (int n = 0; n < 50; ++n) {
      const auto i = static_cast<std::size_t>(random.between(0, static_cast<std::int64_t>(entries) - 1));
      const auto middle = random.between(0, top);
      const auto reach = pick(random, {std::int64_t{0}, std::int64_t{3}, top / 50});
      const CodeBounds bounds{.least = static_cast<std::uint32_t>(std::max<std::int64_t>(middle - reach, 0)),
                              .most = static_cast<std::uint32_t>(std::min(middle + reach, top))};
      exact[i] = bounds;
      put_entries(word, entries, i, 1, std::span(&bounds, 1), bits);
      CodeBounds range = exact[0];
      for (const CodeBounds& each : exact) {
        range = unite(range, each);
      }
      for (std::size_t k = 0; k < entries; ++k) {
        REQUIRE(word.entry(k).least <= exact[k].least);
        REQUIRE(word.entry(k).most >= exact[k].most);
        REQUIRE((bits < 32 || word.entry(k) == exact[k]));
        REQUIRE((std::uint64_t{word.least[k]} >> bits) == 0);
        REQUIRE((std::uint64_t{word.most[k]} >> bits) == 0);
      }
      // the same once more changes nothing
      HiZWord again = word;
      put_entries(again, entries, i, 1, std::span(&bounds, 1), bits);
      REQUIRE(again == word);
    }
  }
}

}  // namespace halfspace::testing
