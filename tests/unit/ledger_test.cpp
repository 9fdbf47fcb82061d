// The ledger on frames whose accounts are a formula, and its complaints.
#include <catch2/catch.hpp>
#include <limits>

#include "../property/hard_frames.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/ledger/ledger.hpp"

namespace halfspace::testing {

using ledger::Accounts;

TEST_CASE("ledger: triangles that the front end drops, and one that it cuts") {
  FrameBuilder builder(64);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  builder.draw({{8, 8, 0.5},
                {40, 8, 0.5},
                {8, 40, 0.5},  // goes on
                {8, 8, 0.5},
                {40, 8, 0.5},
                {8, 40, 0.5},  // a position is not a number
                {8, 8, 1.5},
                {40, 8, 1.5},
                {8, 40, 1.5},  // behind the far plane
                {8, 8, 0.5},
                {40, 8, 0.5},
                {8, 40, 1.5}});  // cut into a quadrilateral
  builder.frame.vertices[4].y = nan;
  const ledger::Ledger found = ledger::make_ledger(builder.frame, {}, run_functional(builder.frame, {}));
  const ledger::TriangleAccount& triangles = found.frame.triangles;
  CHECK(triangles.all == 4);
  CHECK(triangles.non_finite == 1);
  CHECK(triangles.clipped_away == 1);
  CHECK(triangles.set_up == 2);
  CHECK(found.frame.pieces.all == 3);
}

TEST_CASE("ledger: lines of depth by formula") {
  FrameBuilder builder(
      64);  // cleared, then covered by two triangles of one depth: 64 tiles, 8 on the diagonal
  builder.draw({{0, 0, 0.5}, {64, 0, 0.5}, {0, 64, 0.5}, {64, 0, 0.5}, {64, 64, 0.5}, {0, 64, 0.5}});
  const auto accounts = [&](const Config& config) {
    return ledger::make_ledger(builder.frame, config, run_functional(builder.frame, config)).frame;
  };
  Config config;
  const Accounts plain = accounts(config);
  CHECK(plain.lines.all == 72);
  CHECK(plain.lines.hit == 8);
  CHECK(plain.lines.cleared == 64);
  CHECK(plain.read.all == 64 * 256);
  CHECK(plain.read.cleared == 64 * 256);
  CHECK(plain.read.fetched == 0);
  CHECK(plain.write_backs.flushed == 64);
  CHECK(plain.written.flushed == 64 * 256);
  CHECK(plain.written.compressed == 0);
  config.z_cache.compression = true;  // a flat line takes an eighth
  const Accounts compressed = accounts(config);
  CHECK(compressed.written.all == 64 * 256);
  CHECK(compressed.written.flushed == 64 * 32);
  CHECK(compressed.written.compressed == 64 * 224);
  config.hi_z.enabled = true;  // knows the clear; a tile on the diagonal is not overwritten whole
  const Accounts accepted = accounts(config);
  CHECK(accepted.lines.overwritten == 56);
  CHECK(accepted.lines.cleared == 8);
  CHECK(accepted.lines.hit == 8);
  config.z_cache.fast_clear = false;  // the clear is drawn: two triangles, which compare with nothing
  config.z_cache.lines = 4;
  config.hi_z.enabled = false;
  const Accounts drawn = accounts(config);
  CHECK(drawn.lines.cleared == 0);
  CHECK(drawn.lines.fetched > 0);
  CHECK(drawn.read.compressed == drawn.lines.fetched * 256 - drawn.read.fetched);
}

TEST_CASE("ledger: a sum that does not add up is named") {
  Random random(seed());
  const Frame frame = depth_stack(random);
  Config config;
  config.hi_z.enabled = true;
  const FrameResult counted = run_functional(frame, config);
  const ledger::Ledger right = ledger::make_ledger(frame, config, counted);
  CHECK(right.numbers == ledger::check_sums(right) + ledger::check_counters(right, counted));
  const auto complaint = [](const auto& act) -> std::string {
    try {
      act();
    } catch (const ledger::LedgerError& error) {
      return error.what();
    }
    return "none";
  };
  // Every number of the first draw, each made wrong in turn.
  Accounts::each([&](const std::string& name, auto account) {
    using Account = std::remove_cvref_t<decltype(right.frame.*account)>;
    Account::fields([&](const std::string& cause, auto, auto member) {
      ledger::Ledger wrong = right;
      (wrong.draws[0].accounts.*account).*member += 1;
      CAPTURE(name, cause);
      const std::string text = complaint([&] { ledger::check_sums(wrong); });
      CHECK(text.find("the ledger of draw 0 does not add up: " + name + ".all is ") == 0);
    });
  });
  FrameResult lost = counted;
  lost.draws[0].counters.early_z.survivors -= 1;
  CHECK(complaint([&] { ledger::make_ledger(frame, config, lost); }).find("early_z.survivors") !=
        std::string::npos);
  // What a walker would lose if it rejected a tile too many, told as if the edges had it.
  ledger::Ledger moved = right;
  moved.draws[0].accounts.tiles.edges_tile += 1;
  moved.draws[0].accounts.tiles.survive -= 1;
  CHECK(ledger::check_sums(moved) > 0);
  CHECK(complaint([&] { ledger::check_counters(moved, counted); }).find("block_walker.tiles_rejected") !=
        std::string::npos);
}

}  // namespace halfspace::testing
