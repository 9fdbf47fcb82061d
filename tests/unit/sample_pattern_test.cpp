// Where samples are: the tables that Vulkan and Direct3D publish, the key that lists others, and what does
// not know of them.
#include <array>
#include <catch2/catch.hpp>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/numerics/sample_pattern.hpp"

using namespace halfspace;

namespace {

using Place = std::pair<double, double>;

/// Vulkan 1.3 specification, section "Multisampling", table "Standard sample locations", in its order.
const std::vector<std::vector<Place>> kVulkan{
    {{0.5, 0.5}},
    {{0.75, 0.75}, {0.25, 0.25}},
    {{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}},
    {{0.5625, 0.3125},
     {0.4375, 0.6875},
     {0.8125, 0.5625},
     {0.3125, 0.1875},
     {0.1875, 0.8125},
     {0.0625, 0.4375},
     {0.6875, 0.9375},
     {0.9375, 0.0625}},
    {{0.5625, 0.5625},
     {0.4375, 0.3125},
     {0.3125, 0.625},
     {0.75, 0.4375},
     {0.1875, 0.375},
     {0.625, 0.8125},
     {0.8125, 0.6875},
     {0.6875, 0.1875},
     {0.375, 0.875},
     {0.5, 0.0625},
     {0.25, 0.125},
     {0.125, 0.75},
     {0.0, 0.5},
     {0.9375, 0.25},
     {0.875, 0.9375},
     {0.0625, 0.0}}};

/// Direct3D 11.3 functional specification, section "Sample Positions", the standard patterns: sixteenths from
/// the pixel's centre.
const std::vector<std::vector<std::pair<int, int>>> kDirect3D{
    {{0, 0}},
    {{4, 4}, {-4, -4}},
    {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}},
    {{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}},
    {{1, 1},
     {-1, -3},
     {-3, 2},
     {4, -1},
     {-5, -2},
     {2, 5},
     {5, 3},
     {3, -5},
     {-2, 6},
     {0, -7},
     {-4, -6},
     {-6, 4},
     {-8, 0},
     {7, -4},
     {6, 7},
     {-7, -8}}};

Config with(std::initializer_list<const char*> settings) {
  Config config;
  for (const char* setting : settings) {
    set_config(config, setting);
  }
  return config;
}

}  // namespace

TEST_CASE("samples: the standard positions are those of Vulkan and Direct3D") {
  int count = 1;
  for (std::size_t n = 0; n < kVulkan.size(); ++n, count *= 2) {
    const SamplePattern pattern = standard_samples(count);
    REQUIRE(pattern.count == count);
    REQUIRE(kVulkan[n].size() == pattern.positions().size());
    REQUIRE(kDirect3D[n].size() == pattern.positions().size());
    for (std::size_t i = 0; i < kVulkan[n].size(); ++i) {
      CAPTURE(count, i);
      const SamplePosition& at = pattern.at[i];
      CHECK(at.x == kVulkan[n][i].first * 16);
      CHECK(at.y == kVulkan[n][i].second * 16);
      CHECK(at.x - 8 == kDirect3D[n][i].first);
      CHECK(at.y - 8 == kDirect3D[n][i].second);
    }
  }
}

TEST_CASE("samples: a machine without the keys has one, at the centre") {
  CHECK(sample_pattern({}).is_centre());
  CHECK(sample_pattern(with({"raster.sample_positions=8,8"})).is_centre());
  CHECK_FALSE(sample_pattern(with({"raster.sample_positions=8,7"})).is_centre());
  CHECK_FALSE(sample_pattern(with({"raster.samples=2"})).is_centre());
}

TEST_CASE("samples: the box is the least that holds them all") {
  const SampleBox box = standard_samples(4).box();
  CHECK(std::array{box.x_least, box.x_most, box.y_least, box.y_most} ==
        std::array<std::uint8_t, 4>{2, 14, 2, 14});
  const SampleBox one = SamplePattern{}.box();
  CHECK(std::array{one.x_least, one.x_most, one.y_least, one.y_most} ==
        std::array<std::uint8_t, 4>{8, 8, 8, 8});
}

TEST_CASE("samples: the RTL is given x and y of each in 8 bits, the first in the lowest") {
  CHECK(to_hex(SamplePattern{}) == "128'h88");
  CHECK(to_hex(standard_samples(2)) == "128'h44cc");
  CHECK(to_hex(sample_pattern(with({"raster.samples=4", "raster.sample_positions=0,15;1,10;12,0;3,4"}))) ==
        "128'h34c01a0f");
  // Two digits for each of sixteen.
  CHECK(to_hex(standard_samples(16)).size() == std::string("128'h").size() + 32);
}

TEST_CASE("samples: a list of positions is read, and written as it was") {
  const Config config = with({"raster.samples=2", "raster.sample_positions=0,15;3,4"});
  const SamplePattern pattern = sample_pattern(config);
  REQUIRE(pattern.count == 2);
  CHECK(pattern.at[0] == SamplePosition{0, 15});
  CHECK(pattern.at[1] == SamplePosition{3, 4});
  validate(config);
  const Config again = parse_config(to_toml(config), "again");
  CHECK(sample_pattern(again) == pattern);
  CHECK(same_packets(config, again));
  CHECK(config_hash(config) == config_hash(again));
  CHECK_FALSE(same_packets(config, with({"raster.samples=2"})));
  CHECK(sample_pattern(parse_config(to_toml(with({"raster.samples=8"})), "again")) == standard_samples(8));
}

TEST_CASE("samples: what is no list of positions is refused in one line that says what is legal") {
  for (const char* text :
       {"", "8", "8,", ",8", "8,8;", ";8,8", "16,0", "0,16", "-1,0", "8,8,8", "a,b", "8, 8", "Standard",
        "1,1;1,1;1,1;1,1;1,1;1,1;1,1;1,1;1,1;1,1;1,1;1,1;1,1;1,1;1,1;1,1;1,1"}) {
    Config config;
    CAPTURE(text);
    CHECK_THROWS_WITH(set_config(config, "raster.sample_positions", text),
                      Catch::Equals("configuration key 'raster.sample_positions' is '" + std::string(text) +
                                    "'; legal: standard, or x,y;x,y;... with each 0 to 15"));
  }
}

TEST_CASE("samples: what does not fit them is refused by name") {
  using Catch::Contains;
  CHECK_THROWS_WITH(
      validate(with({"raster.samples=4", "raster.sample_positions=8,8"})),
      Contains("'raster.sample_positions' has 1 positions; legal: as many as 'raster.samples' (4)"));
  CHECK_THROWS_WITH(validate(with({"raster.samples=16", "block_walker.block_size=64"})),
                    Contains("'raster.samples' is 16; legal: at most 8 where a block has 64 tiles"));
  validate(with({"raster.samples=8", "block_walker.block_size=64"}));
  for (const auto& [setting, says] :
       {std::pair{"hi_z.enabled=true", "'hi_z.enabled' is true; legal: false"},
        {"block_walker.sample_reject=true", "'block_walker.sample_reject' is true; legal: false"},
        {"late_z.mode=late", "'late_z.mode' is late; legal: opaque, no_write"}}) {
    CAPTURE(setting);
    validate(with({setting}));
    CHECK_THROWS_WITH(validate(with({"raster.samples=2", setting})), Contains(says));
    CHECK_THROWS_WITH(validate(with({"raster.sample_positions=8,9", setting})), Contains(says));
  }
  for (const auto& [mode, says] :
       {std::pair{"raster.conservative=outer", "'raster.conservative' is outer; legal: off"},
        {"raster.conservative=inner", "'raster.conservative' is inner; legal: off"}}) {
    CAPTURE(mode);
    validate(with({mode, "depth.interpolator=barycentric"}));
    CHECK_THROWS_WITH(validate(with({mode, "depth.interpolator=barycentric", "raster.samples=2"})),
                      Contains(says));
    CHECK_THROWS_WITH(validate(with({mode, "depth.interpolator=barycentric", "raster.sample_positions=8,9"})),
                      Contains(says));
  }
}
