// The ledger against brute force.
#include <catch2/catch.hpp>

#include "../timing/differences.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/ledger/ledger.hpp"
#include "hard_frames.hpp"
#include "ledger_by_brute_force.hpp"

namespace halfspace::testing {
namespace {

/// Where an account of the ledger is not what brute force says.
std::string lies(const Accounts& ours, const Accounts& truth) {
  std::string text;
  Accounts::each([&](const std::string& name, auto account) {
    if (name == "lines" || name == "read" || name == "write_backs" || name == "written") {
      return;
    }
    using Account = std::remove_cvref_t<decltype(ours.*account)>;
    Account::fields([&](const char* cause, auto, auto member) {
      text += difference(name + "." + cause, (ours.*account).*member, (truth.*account).*member);
    });
  });
  return text;
}

/// A ledger and the brute force's accounts of it, compared; returns the frame's.
Accounts checked(const Frame& frame, const Config& config) {
  const ledger::Ledger found = ledger::make_ledger(frame, config, run_functional(frame, config));
  const std::vector<Accounts> truth = BruteForce(frame, config).run();
  REQUIRE(found.draws.size() == truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    CAPTURE(i);
    REQUIRE(lies(found.draws[i].accounts, truth[i]) == "");
  }
  return found.frame;
}

Config random_ledger_machine(Random& random) {
  while (true) {
    Config config = random_config(random);
    config.hi_z.enabled = random.between(0, 3) != 0;
    config.raster.conservative = Conservative::kOff;  // brute force is of centres
    config.raster.inner_coverage = false;
    config.hi_z.lag = pick(random, {1, 1, 2, 8, 128});
    keep_to_all_blocks(config);
    try {
      validate(config);
      return config;
    } catch (const InputError&) {
      // too many bounds in a block
    }
  }
}

}  // namespace

TEST_CASE("ledger: every cause is what brute force says, on random frames", "[property][exhaustive]") {
  Random random(seed());
  Accounts sum;
  for (std::uint64_t run = 0; run < samples(200'000) / 1000; ++run) {
    CAPTURE(seed(), run);
    const Config config = random_ledger_machine(random);
    CAPTURE(difference_from_default(config));
    sum += checked(run % 2 == 0 ? depth_stack(random) : hard_frame(random), config);
  }
  // No cause went unseen; of the front end's, hard frames have only some.
  Accounts::each([&](const std::string& name, auto account) {
    using Account = std::remove_cvref_t<decltype(sum.*account)>;
    Account::fields([&](const std::string& cause, auto, auto member) {
      CAPTURE(name, cause);
      if (name != "triangles") {
        CHECK((sum.*account).*member > 0);
      }
    });
  });
  CHECK(sum.triangles.set_up > 0);
  CHECK(sum.triangles.not_filled > 0);
}

}  // namespace halfspace::testing
