// Quads of pixels behind early_z: a map over all quads of a run beside the unit that holds one tile, and the
// definition of coverage.
#include "halfspace/machine/pixel_rate.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "../timing/random_machine.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/machine/observer_pair.hpp"
#include "random.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

/// draw, triangle, piece, x, y of a pixel's quad.
using Place = std::tuple<std::uint32_t, std::uint32_t, std::uint8_t, std::uint32_t, std::uint32_t>;

struct Masks {
  std::array<std::uint16_t, 4> covered{};
  std::array<std::uint16_t, 4> passed{};
  friend bool operator==(const Masks&, const Masks&) = default;
};

/// All quads of a run by their place, whatever their order.
class ByPlace final : public PacketObserver {
 public:
  [[nodiscard]] bool wants_quads() const override { return true; }
  void quad(const QuadEvent& quad) override {
    Masks& masks = all[{quad.draw, quad.triangle, quad.piece, quad.x, quad.y}];
    for (std::size_t pixel = 0; pixel < 4; ++pixel) {
      const auto bit = static_cast<std::uint16_t>(1U << quad.sample);
      masks.covered[pixel] |= (quad.mask >> pixel & 1) != 0 ? bit : std::uint16_t{0};
      masks.passed[pixel] |= (quad.passed >> pixel & 1) != 0 ? bit : std::uint16_t{0};
    }
    sample_quads += quad.passed != 0 ? 1 : 0;
    for (std::size_t pixel = 0; pixel < 4; ++pixel) {
      survivors += quad.passed >> pixel & 1;
    }
  }

  std::map<Place, Masks> all;
  std::uint64_t sample_quads = 0;
  std::uint64_t survivors = 0;
};

/// The rule word by word: the centre where all samples are covered; else the first covered sample; the centre
/// where there is none.
SamplePosition centroid_by_rule(std::uint16_t covered, const SamplePattern& pattern) {
  std::vector<SamplePosition> inside;
  for (int sample = 0; sample < pattern.count; ++sample) {
    if ((covered & 1 << sample) != 0) {
      inside.push_back(pattern.at[static_cast<std::size_t>(sample)]);
    }
  }
  if (inside.size() == static_cast<std::size_t>(pattern.count) || inside.empty()) {
    return {.x = 8, .y = 8};
  }
  return inside.front();
}

}  // namespace

TEST_CASE("pixel rate: every quad of pixels leaves once, with all of its samples", "[property]") {
  const std::uint64_t first = seed();
  std::uint64_t quads = 0;
  for (std::uint64_t n = 0; n < 120; ++n) {
    Random random(first + n);
    Config config = random_config(random);
    draw_samples(random, config);
    validate(config);
    const Frame frame = random_frame(random);
    CAPTURE(first + n, difference_from_default(config));
    const SamplePattern pattern = sample_pattern(config);
    ByPlace expected;
    std::vector<PixelQuadEvent> left;
    PixelRate pixel_rate(frame.commands.size(), config.tile_walker.tile_size, pattern,
                         [&](const PixelQuadEvent& quad) { left.push_back(quad); });
    ObserverPair both(expected, pixel_rate);
    const FrameResult result = run_functional(frame, config, {.observer = &both, .core = Core::kReadable});
    const PixelRateCounters counters = pixel_rate.finish().frame;

    std::erase_if(expected.all, [](const auto& entry) { return entry.second.passed == Masks{}.passed; });
    // Pieces of one triangle share no sample, so what leaves is told apart by its masks.
    std::multimap<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>, Masks> wanted;
    std::uint64_t pixels = 0;
    std::uint64_t whole = 0;
    const auto all = static_cast<std::uint16_t>((1U << static_cast<unsigned>(pattern.count)) - 1);
    for (const auto& [place, masks] : expected.all) {
      const auto& [draw, triangle, piece, x, y] = place;
      wanted.emplace(std::tuple{draw, triangle, x, y}, masks);
      for (std::size_t pixel = 0; pixel < 4; ++pixel) {
        pixels += masks.passed[pixel] != 0 ? 1 : 0;
        whole += masks.passed[pixel] != 0 && masks.covered[pixel] == all ? 1 : 0;
      }
    }
    REQUIRE(left.size() == wanted.size());
    for (const PixelQuadEvent& quad : left) {
      auto [at, end] = wanted.equal_range({quad.draw, quad.triangle, quad.x, quad.y});
      while (at != end && !(at->second == Masks{quad.covered, quad.passed})) {
        ++at;
      }
      REQUIRE(at != end);
      wanted.erase(at);
      for (std::size_t pixel = 0; pixel < 4; ++pixel) {
        REQUIRE(quad.centroid[pixel] == centroid_by_rule(quad.covered[pixel], pattern));
      }
    }
    CHECK(counters.quads == left.size());
    CHECK(counters.sample_quads == expected.sample_quads);
    CHECK(counters.pixels == pixels);
    CHECK(counters.helpers == 4 * left.size() - pixels);
    CHECK(counters.at_centre == whole);
    CHECK(counters.at_sample == pixels - whole);
    CHECK(counters.samples == expected.survivors);
    CHECK(counters.samples == result.counters.early_z.survivors);
    quads += left.size();
  }
  CHECK(quads > 1000);
}

TEST_CASE("pixel rate: the centroid is covered, or the centre of a pixel that is", "[property]") {
  // A half plane through a pixel: its covered samples, by the sign of a line, and where the centroid lies.
  CAPTURE(seed());
  Random random(seed());
  int off_centre = 0;
  for (int n = 0; n < 20000; ++n) {
    const int count = 1 << random.between(0, 4);
    const SamplePattern pattern = standard_samples(count);
    const auto a = random.between(-40, 40);
    const auto b = random.between(-40, 40);
    const auto c = random.between(-600, 600);
    const auto inside = [&](const SamplePosition& p) { return a * (p.x - 8) + b * (p.y - 8) + c >= 0; };
    std::uint16_t covered = 0;
    for (int sample = 0; sample < count; ++sample) {
      covered |= inside(pattern.at[static_cast<std::size_t>(sample)])
                     ? static_cast<std::uint16_t>(1U << sample)
                     : std::uint16_t{0};
    }
    const SamplePosition at = centroid(covered, pattern);
    CHECK(at == centroid_by_rule(covered, pattern));
    if (!(at == SamplePosition{}) || count == 1) {
      CHECK((inside(at) || covered == 0));
      ++off_centre;
    }
  }
  CHECK(off_centre > 1000);
}
