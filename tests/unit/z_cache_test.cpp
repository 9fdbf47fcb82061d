// The z cache against a textbook one: a list of lines a set, the most recently used first.
#include <catch2/catch.hpp>
#include <list>
#include <map>
#include <optional>
#include <set>

#include "../property/random.hpp"
#include "halfspace/units/z_cache.hpp"

using namespace halfspace;
using halfspace::testing::Random;

namespace {

/// A cache that knows lines by (surface, tile, part) and keeps sets as lists.
class Textbook {
 public:
  explicit Textbook(const ZCacheShape& shape) : shape_(shape) {}

  struct Line {
    std::uint32_t line;
    std::uint32_t bytes;
    bool dirty;
  };
  struct Found {
    bool hit;
    bool fetch;
    std::optional<Line> victim;
  };

  Found access(std::uint32_t x, std::uint32_t y, int part, std::uint32_t line, std::uint32_t bytes,
               bool write) {
    std::list<Line>& set = sets_[{part, set_of(x, y)}];
    Found found{.hit = false, .fetch = false, .victim = {}};
    for (auto at = set.begin(); at != set.end(); ++at) {
      if (at->line == line) {
        set.splice(set.begin(), set, at);
        found.hit = true;
        break;
      }
    }
    if (!found.hit) {
      found.fetch = !cleared_.contains(line);
      if (set.size() == static_cast<std::size_t>(shape_.ways)) {
        found.victim = set.back();
        if (found.victim->dirty) {
          cleared_.erase(found.victim->line);
        }
        set.pop_back();
      }
      set.push_front({line, bytes, false});
    }
    set.front().dirty |= write;
    return found;
  }

  void clear(std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t line = first; line <= last; ++line) {
      cleared_.insert(line);
    }
    for (auto& [key, set] : sets_) {
      set.remove_if([&](const Line& line) { return line.line >= first && line.line <= last; });
    }
  }

  std::multiset<std::uint32_t> dirty_lines() const {
    std::multiset<std::uint32_t> lines;
    for (const auto& [key, set] : sets_) {
      for (const Line& line : set) {
        if (line.dirty) {
          lines.insert(line.line);
        }
      }
    }
    return lines;
  }

 private:
  /// Low bits of x and y, one more of x where their number is odd.
  std::uint32_t set_of(std::uint32_t x, std::uint32_t y) const {
    std::uint32_t columns = 1;
    std::uint32_t rows = 1;
    while (columns * rows < static_cast<std::uint32_t>(shape_.sets())) {
      (columns == rows ? columns : rows) *= 2;
    }
    return x % columns + columns * (y % rows);
  }

  ZCacheShape shape_;
  std::map<std::pair<int, std::uint32_t>, std::list<Line>> sets_;
  std::set<std::uint32_t> cleared_;
};

}  // namespace

TEST_CASE("z_cache: hits, victims, fetches and the flush are those of a textbook cache", "[z_cache]") {
  Random random(halfspace::testing::seed());
  for (int run = 0; run < 60; ++run) {
    CAPTURE(halfspace::testing::seed(), run);
    ZCacheShape shape{.lines = 1 << random.between(2, 6), .ways = 1 << random.between(0, 2), .parts = 1};
    shape.parts = std::min(1 << random.between(0, 2), shape.lines / shape.ways);
    const auto parts = static_cast<std::uint32_t>(shape.parts);
    const ZSurface surfaces[] = {{.first_tile = 0, .tiles_x = 9, .tiles = 81, .line_bytes = 256},
                                 {.first_tile = 81, .tiles_x = 5, .tiles = 30, .line_bytes = 128}};
    ZCache cache(shape, 111 * parts);
    Textbook book(shape);
    for (int i = 0; i < 2000; ++i) {
      const ZSurface& surface = surfaces[random.between(0, 1)];
      if (random.between(0, 400) == 0) {
        cache.clear(surface);
        book.clear(surface.first_tile * parts, (surface.first_tile + surface.tiles) * parts - 1);
        continue;
      }
      const auto x = static_cast<std::uint32_t>(random.between(0, surface.tiles_x - 1));
      const auto y = static_cast<std::uint32_t>(random.between(0, surface.tiles / surface.tiles_x - 1));
      const auto touched = static_cast<std::uint8_t>(random.between(1, (1 << shape.parts) - 1));
      const auto written = static_cast<std::uint8_t>(touched & random.between(0, 15));
      const auto sure = static_cast<std::uint8_t>(random.between(0, 3) == 0 ? written : 0);
      const ZMisses misses =
          cache.access(surface, x, y, {.touched = touched, .written = written, .sure = sure});
      std::size_t next = 0;
      for (int part = 0; part < shape.parts; ++part) {
        if ((touched >> part & 1) == 0) {
          continue;
        }
        const std::uint32_t line =
            (surface.first_tile + y * surface.tiles_x + x) * parts + static_cast<std::uint32_t>(part);
        const Textbook::Found found =
            book.access(x, y, part, line, surface.line_bytes, (written >> part & 1) != 0);
        if (found.hit) {
          continue;
        }
        REQUIRE(next < misses.count);
        const ZMiss& miss = misses.part[next++];
        REQUIRE(miss.line == line);
        REQUIRE(miss.bytes == surface.line_bytes);
        const bool overwritten = (sure >> part & 1) != 0;
        REQUIRE(miss.overwritten == overwritten);
        REQUIRE(miss.fetch == (found.fetch && !overwritten));
        REQUIRE(miss.write_back == (found.victim && found.victim->dirty));
        if (miss.write_back) {
          REQUIRE(miss.victim == found.victim->line);
          REQUIRE(miss.victim_bytes == found.victim->bytes);
        }
      }
      REQUIRE(next == misses.count);
    }
    std::multiset<std::uint32_t> flushed;
    std::int64_t last_slot = -1;
    cache.flush([&](std::uint32_t slot, std::uint32_t line, std::uint32_t /*bytes*/) {
      REQUIRE(static_cast<std::int64_t>(slot) > last_slot);
      last_slot = slot;
      flushed.insert(line);
    });
    REQUIRE(flushed == book.dirty_lines());
  }
}

TEST_CASE("z_cache: a square of the screen as large as the cache fits", "[z_cache]") {
  const ZCacheShape shape{.lines = 64, .ways = 1, .parts = 1};
  const ZSurface surface{.first_tile = 0, .tiles_x = 100, .tiles = 10000, .line_bytes = 256};
  ZCache cache(shape, 10000);
  for (int round = 0; round < 2; ++round) {
    for (std::uint32_t y = 37; y < 45; ++y) {
      for (std::uint32_t x = 13; x < 21; ++x) {
        CHECK(cache.access(surface, x, y, {.touched = 1}).count == (round == 0 ? 1 : 0));
      }
    }
  }
}

TEST_CASE("z_cache: parts of a mask", "[z_cache]") {
  TileMask mask;
  set_row<8>(mask, 5, 0x10);
  CHECK(parts_of_mask<8>(mask, 1) == 1);
  CHECK(parts_of_mask<8>(mask, 2) == 2);
  CHECK(parts_of_mask<8>(mask, 4) == 4);
  TileMask large;
  set_row<16>(large, 0, 1);
  set_row<16>(large, 15, 0x8000);
  CHECK(parts_of_mask<16>(large, 1) == 1);
  CHECK(parts_of_mask<16>(large, 2) == 3);
  CHECK(parts_of_mask<16>(large, 4) == 9);
  TileMask small;
  set_row<4>(small, 2, 1);
  CHECK(parts_of_mask<4>(small, 2) == 2);
}

TEST_CASE("z_cache: who touches depth", "[z_cache]") {
  EarlyZState state{.test = true, .write = true, .func = DepthFunc::kLess};
  CHECK(touches_depth(state));
  state.func = DepthFunc::kNever;
  CHECK_FALSE(touches_depth(state));
  state.func = DepthFunc::kAlways;
  CHECK(touches_depth(state));
  state.write = false;
  CHECK_FALSE(touches_depth(state));
  state.func = DepthFunc::kGreater;
  CHECK(touches_depth(state));
  state.test = false;
  CHECK_FALSE(touches_depth(state));
}
