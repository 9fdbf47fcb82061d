// Are the sums that a run keeps those of the packets that it shows?
#include <bit>
#include <catch2/catch.hpp>
#include <map>
#include <tuple>

#include "../timing/random_machine.hpp"
#include "halfspace/machine/in_order.hpp"
#include "halfspace/machine/passage/packet_sums.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

/// Adds up what it sees, a surface, column and row each.
class Adder final : public PacketObserver {
 public:
  using Place = std::tuple<std::uint32_t, int, int>;

  [[nodiscard]] bool wants_quads() const override { return true; }
  [[nodiscard]] bool wants_decisions() const override { return true; }
  void quad(const QuadEvent& event) override {
    QuadLanes& place = quads[{event.surface, event.x / 2, event.y / 2}];
    ++place.quads;
    place.covered += static_cast<std::uint32_t>(std::popcount(event.mask));
  }
  void decision(const DecisionEvent& event) override {
    passage::count(decisions[{event.surface, event.tile_x, event.tile_y}], event.verdict);
  }

  std::map<Place, QuadLanes> quads;
  std::map<Place, TileDecisions> decisions;
};

template <class Value>
bool as_seen(const TiledImage<Value>& image, std::map<Adder::Place, Value>& seen, std::uint32_t surface) {
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (image.at(x, y) != seen[{surface, x, y}]) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

TEST_CASE("sums of random frames on random machines are those of their packets", "[property]") {
  Random random(seed());
  const std::uint64_t runs = samples(100'000) / 500;  // a frame counts as so many samples
  for (std::uint64_t run = 0; run < runs; ++run) {
    CAPTURE(seed(), run);
    const Config config = random_config(random);
    Adder adder;
    const FrameResult result =
        run_in_order(random_frame(random), config, {.keep_sums = true, .observer = &adder}, nullptr);
    for (std::uint32_t i = 0; i < result.surfaces.size(); ++i) {
      const std::uint32_t shown = result.surfaces[i].target ? kNoSurface : i;  // there is at most one without
      REQUIRE(as_seen(result.surfaces[i].sums.quads, adder.quads, shown));
      REQUIRE(as_seen(result.surfaces[i].sums.decisions, adder.decisions, shown));
    }
  }
}
