// Quad merging changes nothing of a run, whatever runs, and counts the same in every fidelity.
#include <catch2/catch.hpp>
#include <optional>
#include <string>

#include "../property/meshed_frame.hpp"
#include "differences.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/run/run.hpp"

namespace halfspace::testing {
namespace {

std::string merging_difference(const QuadMergingCounters& ours, const QuadMergingCounters& other) {
  std::string text;
  QuadMergingCounters::fields([&](const char* name, const char* /*help*/, auto member) {
    text += difference(name, ours.*member, other.*member);
  });
  return text;
}

RunResult run_with(Fidelity fidelity, const Frame& frame, const Config& config, PacketObserver* observer,
                   std::optional<int> buffer, int threads = 1) {
  RunOptions options;
  options.watch.observer = observer;
  options.watch.threads = threads;
  options.quad_merging = buffer;
  return run(fidelity, frame, config, options);
}

}  // namespace

TEST_CASE("quad merging: changes nothing of a run, and counts the same in every fidelity", "[timing]") {
  Random random(seed());
  std::uint64_t joined = 0;
  for (int n = 0; n < 60; ++n) {
    CAPTURE(seed(), n);
    const Frame frame = meshed_frame(random);
    const Config config = random_config(random);
    CAPTURE(difference_from_default(config));
    const int buffer = random_buffer(random);
    QuadMerging merging(frame, buffer);
    run_with(Fidelity::kFunctional, frame, config, &merging, {});
    const QuadMergingResult alone = merging.finish();
    joined += alone.frame.joined;
    for (const Fidelity fidelity : {Fidelity::kFunctional, Fidelity::kRecurrence, Fidelity::kSystemc}) {
      CAPTURE(info(fidelity).name);
      Events plain;
      Events watched;
      const RunResult without = run_with(fidelity, frame, config, &plain, {});
      const RunResult with = run_with(fidelity, frame, config, &watched, buffer);
      REQUIRE(!without.quad_merging);
      REQUIRE(difference(with.frame, without.frame) == "");
      REQUIRE(difference(watched, plain) == "");
      REQUIRE(difference("cycle of quad", watched.cycles, plain.cycles) == "");
      REQUIRE(with.cycles.has_value() == without.cycles.has_value());
      if (with.cycles) {
        REQUIRE(difference(*with.cycles, *without.cycles) == "");
      }
      REQUIRE(with.quad_merging->buffer == buffer);
      REQUIRE(merging_difference(with.quad_merging->frame, alone.frame) == "");
      for (std::size_t i = 0; i < alone.draws.size(); ++i) {
        REQUIRE(merging_difference(with.quad_merging->draws.at(i), alone.draws[i]) == "");
      }
      const RunResult unobserved = run_with(fidelity, frame, config, nullptr, buffer);
      REQUIRE(merging_difference(unobserved.quad_merging->frame, alone.frame) == "");
    }
    const RunResult threads = run_with(Fidelity::kRecurrence, frame, config, nullptr, buffer, 2);
    REQUIRE(merging_difference(threads.quad_merging->frame, alone.frame) == "");
  }
  CHECK(joined > 1000);
}

TEST_CASE("quad merging: a run refuses a buffer that is not legal", "[timing]") {
  Random random(seed());
  const Frame frame = meshed_frame(random);
  CHECK_THROWS_AS(run_with(Fidelity::kFunctional, frame, {}, nullptr, -1), InputError);
}

}  // namespace halfspace::testing
