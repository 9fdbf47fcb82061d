// Which late writes go before which burst, and what a shader discards.
#include "halfspace/units/late_writes.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <vector>

#include "../property/random.hpp"
#include "halfspace/config/config.hpp"
#include "halfspace/machine/draw_state.hpp"

namespace halfspace::testing {
namespace {

ZSlots slots_of(std::initializer_list<std::pair<int, std::uint32_t>> list) {
  ZSlots slots;
  for (const auto& [part, slot] : list) {
    slots.add(part, slot);
  }
  return slots;
}

}  // namespace

TEST_CASE("late writes: one goes before a burst that touches a slot of it, with all before it") {
  LateWrites late(8);
  late.add(slots_of({{0, 1}}));
  late.add(slots_of({{0, 2}, {1, 7}}));
  late.add(slots_of({{0, 3}}));
  late.make_way(slots_of({{0, 4}}), false);
  CHECK(late.done() == 0);
  late.make_way(slots_of({{1, 2}}), false);  // the same number, of another part
  CHECK(late.done() == 0);
  late.make_way(slots_of({{1, 7}}), false);
  CHECK(late.done() == 2);
  late.make_way(slots_of({{0, 1}, {1, 7}}), false);  // both are done
  CHECK(late.done() == 2);
  late.make_way(slots_of({{0, 3}}), false);
  CHECK(late.done() == 3);
}

TEST_CASE("late writes: a full queue holds back late bursts only") {
  LateWrites late(2);
  late.add(slots_of({{0, 1}}));
  late.make_way(slots_of({{0, 9}}), true);
  CHECK(late.done() == 0);
  late.add(slots_of({{0, 2}}));
  late.make_way(slots_of({{0, 9}}), false);
  CHECK(late.done() == 0);
  late.make_way(slots_of({{0, 9}}), true);
  CHECK(late.done() == 1);
  late.make_way(slots_of({{0, 9}}), true);  // nothing of the last one passed
  CHECK(late.done() == 1);
  late.finish_all();
  CHECK(late.done() == 2);
}

TEST_CASE("late writes: any order against a list of what is out") {
  Random random(seed());
  for (int run = 0; run < 200; ++run) {
    const auto capacity = static_cast<std::size_t>(random.between(1, 6));
    LateWrites late(static_cast<int>(capacity));
    std::vector<std::set<std::pair<int, std::uint32_t>>> all;
    std::size_t done = 0;
    for (int n = 0; n < 100; ++n) {
      ZSlots slots;
      std::set<std::pair<int, std::uint32_t>> touched;
      for (int part = 0; part < 2; ++part) {
        if (random.between(0, 1) == 0) {
          const auto slot = static_cast<std::uint32_t>(random.between(0, 9));
          slots.add(part, slot);
          touched.emplace(part, slot);
        }
      }
      const bool is_late = random.between(0, 1) == 0;
      for (std::size_t i = all.size(); i > done; --i) {
        const auto meets = [&](const auto& each) { return touched.contains(each); };
        if (std::ranges::any_of(all[i - 1], meets)) {
          done = i;
        }
      }
      if (is_late && all.size() - done == capacity) {
        ++done;
      }
      late.make_way(slots, is_late);
      REQUIRE(late.done() == done);
      if (is_late && random.between(0, 2) != 0) {
        late.add(slots);
        all.push_back(touched);
      }
    }
  }
}

TEST_CASE("shader discard: none, all, and the share that is asked for, of any pixels") {
  TileMask full;
  full.word[0] = ~std::uint64_t{0};
  Config config;
  const auto kept_of = [&](std::uint32_t draw, std::uint32_t triangle, int x) {
    return shader_keeps<8>(shader_discard(config), full, draw, triangle, x, 3);
  };
  CHECK(kept_of(1, 2, 3) == full);
  set_config(config, "late_z.discard=1");
  CHECK_FALSE(any(kept_of(1, 2, 3)));
  set_config(config, "late_z.discard=0.3");
  int kept = 0;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    kept += popcount<8>(kept_of(i % 7, i, static_cast<int>(i % 11)));
  }
  // five standard deviations of 64,000 throws
  CHECK(std::abs(kept - 0.7 * 64000) < 5 * std::sqrt(64000 * 0.3 * 0.7));
  CHECK_FALSE(kept_of(1, 2, 3) == kept_of(2, 2, 3));
  CHECK_FALSE(kept_of(1, 2, 3) == kept_of(1, 3, 3));
  CHECK_FALSE(kept_of(1, 2, 3) == kept_of(1, 2, 4));
  const TileMask before = kept_of(1, 2, 3);
  CHECK(before == kept_of(1, 2, 3));
  set_config(config, "late_z.seed=2");
  CHECK_FALSE(before == kept_of(1, 2, 3));
}

TEST_CASE("config: a share is a number from 0 to 1, in plain digits") {
  Config config;
  const auto text_of = [&](const char* value) {
    set_config(config, "late_z.discard", value);
    for (const ConfigKey& key : config_keys(config)) {
      if (key.name == "late_z.discard") {
        return key.value;
      }
    }
    return std::string();
  };
  for (const char* value : {"0", "1", "0.5", "0.25", "0.1", "0.3", "0.999"}) {
    CHECK(text_of(value) == value);
  }
  CHECK(text_of("1.0") == "1");
  CHECK(text_of("0.00001") == "0.00002");  // the nearest that is kept, in as few digits as mean it
  for (const char* value : {"-0.1", "1.01", "nan", "inf", "1e-1", "", "0.5 ", "a"}) {
    CAPTURE(value);
    CHECK_THROWS_WITH(set_config(config, "late_z.discard", value),
                      "configuration key 'late_z.discard' is '" + std::string(value) + "'; legal: 0 to 1");
  }
  CHECK(parse_config("[late_z]\nmode = \"late\"\ndiscard = 0.5\n", "x").late_z.discard == kWholeShare / 2);
  CHECK(parse_config("[late_z]\ndiscard = 1\n", "x").late_z.discard == kWholeShare);
  CHECK(parse_config("late_z = \"no_write\"\n", "x").late_z.mode == LateZ::kNoWrite);
}

}  // namespace halfspace::testing
