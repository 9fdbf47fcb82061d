// The ledger agrees with the counters of every engine, and the walk is told alike in each.
#include <bit>
#include <catch2/catch.hpp>
#include <map>
#include <tuple>

#include "differences.hpp"
#include "halfspace/ledger/ledger.hpp"
#include "halfspace/run/run.hpp"
#include "random_machine.hpp"

namespace halfspace::testing {
namespace {

/// What is told of the walk, in any order: engines have several triangles under way.
class Walk final : public PacketObserver {
 public:
  [[nodiscard]] bool wants_walk() const override { return true; }
  void set_up(const SetupEvent& event) override {
    ++told[{0, event.draw, event.triangle, static_cast<std::uint64_t>(event.verdict)}];
    CHECK((event.drawn != nullptr) == (event.verdict == SetupVerdict::kDrawn));
  }
  void block_walked(const BlockJob& job, std::uint64_t touched) override {
    ++told[{1, place(job), job.tiles, touched}];
  }
  void hi_z_decided(const BlockJob& block, std::uint64_t rejected) override {
    ++told[{2, place(block), block.tiles, rejected}];
  }
  std::map<std::tuple<int, std::uint64_t, std::uint64_t, std::uint64_t>, int> told;

 private:
  static std::uint64_t place(const BlockJob& job) {
    return std::uint64_t{job.slot} << 32 | std::uint64_t{job.block_x} << 16 | job.block_y;
  }
};

RunResult run_watched(Fidelity fidelity, const Frame& frame, const Config& config, Walk& walk) {
  RunOptions options;
  options.watch.observer = &walk;
  return run(fidelity, frame, config, options);
}

}  // namespace

TEST_CASE("ledger: agrees with the counters of every engine, which tell the same of the walk", "[timing]") {
  Random random(seed());
  std::uint64_t rejected = 0;
  for (int n = 0; n < 40; ++n) {
    CAPTURE(seed(), n);
    const Frame frame = random_frame(random);
    Config config = random_config(random);
    keep_to_all_blocks(config);
    CAPTURE(difference_from_default(config));
    Walk truth;
    run_watched(Fidelity::kFunctional, frame, config, truth);
    for (const Fidelity fidelity : {Fidelity::kRecurrence, Fidelity::kSystemc}) {
      Walk walk;
      const RunResult counted = run_watched(fidelity, frame, config, walk);
      CHECK(walk.told == truth.told);
      const ledger::Ledger found = ledger::make_ledger(frame, config, counted.frame);
      rejected += found.frame.tiles.hi_z_block + found.frame.tiles.hi_z_tile;
    }
  }
  CHECK(rejected > 0);
}

}  // namespace halfspace::testing
