// The ledger of frames of real programs.
#include <catch2/catch.hpp>

#include "captured_frame.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/ledger/ledger.hpp"
#include "halfspace/reference/rasterizer.hpp"

namespace halfspace::testing {
namespace {

/// Survivors and all that there was are what a machine without hi_z counts; and what the textbook rasterizer
/// counts, whose guard band is another and whose depth is rounded elsewhere.
void check_ledger(const std::string& name) {
  const Frame frame = captured_frame(name);
  Config config;
  config.hi_z.enabled = true;
  config.z_cache.compression = true;
  const ledger::Accounts found = ledger::make_ledger(frame, config, run_functional(frame, config)).frame;
  const FrameResult plain = run_functional(frame, {});
  const Counters& counters = plain.counters;
  CHECK(found.fragments.all == counters.quad_generator.fragments);
  CHECK(found.quads.all == counters.quad_generator.quads);
  CHECK(found.fragments.survive == counters.early_z.survivors);
  CHECK(found.tiles.hi_z_block + found.tiles.hi_z_tile + found.tiles.empty + found.tiles.early_z +
            found.tiles.survive ==
        counters.tile_walker.tiles_accepted + counters.tile_walker.tiles_partial);
  // Only hi_z's acceptance and the parts that it rejects change which lines are touched; without both:
  Config compressed;
  compressed.z_cache.compression = true;
  const ledger::Accounts lines =
      ledger::make_ledger(frame, compressed, run_functional(frame, compressed)).frame;
  CHECK(lines.read.fetched + lines.read.compressed ==
        counters.early_z.bytes_read + plain.drawn_clears.early_z.bytes_read);
  CHECK(lines.written.all ==
        counters.early_z.bytes_written + plain.drawn_clears.early_z.bytes_written + plain.flushed_bytes);
  double covered = 0;
  double quads = 0;
  for (const reference::Surface& surface : reference::rasterize(frame, {})) {
    covered += static_cast<double>(surface.counters.covered_fragments);
    quads += static_cast<double>(surface.counters.quads);
  }
  const bool exact = name == "vkcube" || name == "glmark2_shadow";
  CHECK(static_cast<double>(found.fragments.all) == Approx(covered).epsilon(exact ? 0 : 20e-6));
  CHECK(static_cast<double>(found.quads.all) == Approx(quads).epsilon(exact ? 0 : 1e-3));
}

}  // namespace

TEST_CASE("ledger frames: vkcube", "[golden]") { check_ledger("vkcube"); }
TEST_CASE("ledger frames: cc0_truck", "[golden]") { check_ledger("cc0_truck"); }
TEST_CASE("ledger frames: glmark2_ideas", "[golden]") { check_ledger("glmark2_ideas"); }
TEST_CASE("ledger frames: glmark2_shadow", "[golden]") { check_ledger("glmark2_shadow"); }
TEST_CASE("ledger frames: stk_snowmountain", "[golden]") { check_ledger("stk_snowmountain"); }
TEST_CASE("ledger frames: openarena_gl2", "[golden]") { check_ledger("openarena_gl2"); }
TEST_CASE("ledger frames: warzone2100_vulkan", "[golden]") { check_ledger("warzone2100_vulkan"); }

}  // namespace halfspace::testing
