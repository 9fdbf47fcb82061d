// A machine that cannot work comes to rest with a list of what waits for what; it never hangs.
#include <catch2/catch.hpp>

#include "halfspace/scene/validate.hpp"
#include "halfspace/timing/systemc/raster_pipeline.hpp"
#include "halfspace/timing/systemc/run_systemc.hpp"
#include "random_machine.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

/// A draw over the whole target, twice: every tile is fetched, and written back where the cache is small.
Frame full_frame() {
  FrameBuilder builder(64);
  builder.frame.commands.clear();
  for (int n = 2; n > 0; --n) {
    const double depth = n / 4.0;
    builder
        .draw(
            {{0, 0, depth}, {64, 0, depth}, {0, 64, depth}, {64, 0, depth}, {64, 64, depth}, {0, 64, depth}})
        .flags = bits({Flag::kDepthTest, Flag::kDepthWrite});
  }
  return builder.frame;
}

std::string deadlock(const Config& config) {
  try {
    run_systemc(full_frame(), config);
  } catch (const systemc::DeadlockError& error) {
    return error.what();
  }
  return "none";
}

void check_lists_everything(const std::string& text) {
  for (const StageInfo& stage : kStageInfo) {
    CHECK_THAT(text, Catch::Contains("stage " + std::string(stage.name) + ": "));
  }
  for (const std::string_view link : kFifoName) {
    CHECK_THAT(text, Catch::Contains("link " + std::string(link) + ": "));
  }
}

}  // namespace

TEST_CASE("fewer fill buffers than parts of a tile: deadlock", "[timing]") {
  Config config;
  config.z_cache.parts = 2;
  config.z_cache.misses_in_flight = 1;
  CHECK_THROWS(validate(config));
  const std::string text = deadlock(config);
  CAPTURE(text);
  check_lists_everything(text);
  CHECK_THAT(text, Catch::Contains("deadlock in cycle "));
  CHECK_THAT(text, Catch::Contains("stage source: at the end of the frame"));
  CHECK_THAT(text, Catch::Contains("stage z_lookup: waits: fill_buffers"));
  CHECK_THAT(text,
             Catch::Contains("link early_z_pending: 1 of 32 in use, the head is under way since cycle"));
  CHECK_THAT(text, Catch::Contains("link fill_buffers: 1 of 1 in use, the head may be taken from cycle"));
}

TEST_CASE("a write buffer that cannot take all parts of a tile: deadlock", "[timing]") {
  Config config;
  config.z_cache.parts = 4;
  config.z_cache.lines = 16;
  config.z_cache.ways = 4;
  config.z_cache.write_buffers = 2;
  CHECK_THROWS(validate(config));
  const std::string text = deadlock(config);
  CAPTURE(text);
  check_lists_everything(text);
  CHECK_THAT(text, Catch::Contains("stage z_test: waits: write_buffer"));
  CHECK_THAT(text, Catch::Contains("link write_buffers: 0 of 2 in use, empty"));
}

TEST_CASE("after a deadlock the next run works", "[timing]") {
  Config config;
  config.z_cache.parts = 2;
  config.z_cache.misses_in_flight = 1;
  CHECK(deadlock(config) != "none");
  CHECK(deadlock({}) == "none");
}
