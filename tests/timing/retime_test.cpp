// Re-timing a record against full runs, singly and in batches; its file; and what it refuses.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/byte_source.hpp"
#include "halfspace/scene/compression.hpp"
#include "halfspace/scene/ptf.hpp"
#include "halfspace/timing/record/frame_record_file.hpp"
#include "halfspace/timing/record/retime.hpp"
#include "halfspace/timing/recurrence/run_recurrence.hpp"
#include "random_machine.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

RetimedFrame full_run(const Frame& frame, const Config& config) {
  const FrameCycles cycles = run_recurrence(frame, config).cycles;
  RetimedFrame result{.cycles = cycles.cycles, .draw_end = {}};
  for (const DrawCycles& draw : cycles.draws) {
    result.draw_end.push_back(draw.end);
  }
  return result;
}

struct TemporaryFile {
  TemporaryFile()
      : path(std::filesystem::temp_directory_path() / ("halfspace_" + std::to_string(getpid()) + ".rec")) {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() { std::filesystem::remove(path); }
  std::filesystem::path path;
};

}  // namespace

TEST_CASE("re-timing equals a full run on random machines, one by one and in a batch", "[timing]") {
  Random random(seed());
  for (int run = 0; run < 60; ++run) {
    CAPTURE(seed(), run);
    const Config recorded = random_sampled_config(random);
    const Frame frame = random_frame(random);
    CAPTURE(difference_from_default(recorded));
    Retimer retimer(record_frame(frame, recorded));
    std::vector<Config> machines;
    for (int i = 0; i < 40; ++i) {
      machines.push_back(random_timing(random, recorded));
      if (i > 20) {  // so that some share a pass
        machines.back().z_cache.lines = recorded.z_cache.lines;
        machines.back().z_cache.ways = recorded.z_cache.ways;
        machines.back().z_cache.parts = recorded.z_cache.parts;
        machines.back().late_z.queue = recorded.late_z.queue;
        machines.back().z_cache.misses_in_flight =
            std::max(machines.back().z_cache.misses_in_flight, recorded.z_cache.parts);
        machines.back().z_cache.write_buffers =
            std::max(machines.back().z_cache.write_buffers, recorded.z_cache.parts);
      }
    }
    const std::vector<RetimedFrame> batch = retimer.retime(machines);
    for (std::size_t i = 0; i < machines.size(); ++i) {
      CAPTURE(i, difference_from_default(machines[i]));
      const RetimedFrame full = full_run(frame, machines[i]);
      REQUIRE(retimer.retime(machines[i]) == full);
      REQUIRE(batch[i] == full);
    }
  }
}

TEST_CASE("a machine too slow for 32 bits is re-timed in 64, and the bound holds", "[timing]") {
  Random random(seed());
  Config config;
  config.memory.latency = 65535;
  config.z_cache.misses_in_flight = 1;
  config.memory.read_bytes = 1;
  config.memory.write_bytes = 1;
  config.z_cache.lines = 1;
  config.z_cache.ways = 1;
  for (int run = 0; run < 20; ++run) {
    const Frame frame = random_frame(random);
    const FrameRecord record = record_frame(frame, config);
    const ZTrace trace = trace_z_cache(record, {.lines = 1, .ways = 1, .parts = 1});
    const FrameWork work = frame_work(whole_stream(record, trace), record.surfaces, trace.flush);
    const std::uint64_t bound = longest_time(work, config);
    CHECK(full_run(frame, config).cycles <= bound);
  }
  // 2^16 fetches of 2^16 cycles each: only the bound is looked at
  FrameWork work;
  work.fetched[8] = 1 << 16;
  CHECK(longest_time(work, config) > (std::uint64_t{1} << 32));
}

TEST_CASE("a frame whose bound needs 64 bits gives the same cycles", "[timing]") {
  // 70,000 bursts on a line that is never there, 65,535 cycles each: more than 2^32
  FrameRecord record;
  record.config.z_cache.lines = 1;
  record.config.z_cache.ways = 1;
  record.config.memory.latency = 65535;
  record.config.z_cache.misses_in_flight = 1;
  record.surfaces.push_back({.tiles_x = 2, .tiles = 2, .sample_bytes = 4});
  record.packets.segments.push_back({.surface = 0, .touches_depth = 1, .triangles = 1});
  record.packets.triangles.push_back({.blocks = 70000});
  for (std::uint32_t i = 0; i < 70000; ++i) {
    record.packets.blocks.emplace_back(0u, 1);
    record.packets.jobs.push_back(4);
    record.packets.accesses.emplace_back(i % 2, 0u, std::uint8_t{15}, std::uint8_t{0});
  }
  Retimer retimer(record);
  const std::vector<Config> machines{record.config, record.config};
  const std::vector<RetimedFrame> batch = retimer.retime(machines);
  // each line is asked for when the one before has been used: latency, 4 cycles of transfer, and the swap
  CHECK(batch[0].cycles > std::uint64_t{70000} * (65535 + 4));
  CHECK(batch[0].cycles < std::uint64_t{70000} * (65535 + 6) + 1000);
  CHECK(batch[0] == retimer.retime(record.config));
  CHECK(batch[1] == batch[0]);
}

TEST_CASE("a key that changes packets is refused by name", "[timing]") {
  Random random(seed());
  Retimer retimer(record_frame(random_frame(random), Config{}));
  const std::pair<const char*, const char*> changes[] = {{"tile_walker.tile_size", "16"},
                                                         {"raster.sub_pixel_bits", "7"},
                                                         {"raster.conservative", "outer"},
                                                         {"raster.uncertainty", "2"},
                                                         {"raster.inner_coverage", "true"},
                                                         {"raster.samples", "2"},
                                                         {"raster.sample_positions", "4,4"},
                                                         {"setup.fill_rule", "top_right"},
                                                         {"block_walker.block_size", "16"},
                                                         {"block_walker.trivial_reject", "false"},
                                                         {"block_walker.sample_reject", "true"},
                                                         {"block_walker.levels", "3"},
                                                         {"block_walker.order", "zigzag"},
                                                         {"tile_walker.order", "hilbert"},
                                                         {"tile_walker.trivial_accept", "false"},
                                                         {"hi_z.enabled", "true"},
                                                         {"hi_z.accept", "false"},
                                                         {"hi_z.bits", "9"},
                                                         {"hi_z.lag", "77"},
                                                         {"depth.interpolator", "barycentric"},
                                                         {"interpolator.enabled", "true"},
                                                         {"interpolator.attributes", "3"},
                                                         {"interpolator.bits", "12"},
                                                         {"late_z.mode", "no_write"},
                                                         {"late_z.discard", "0.5"},
                                                         {"z_cache.fast_clear", "false"},
                                                         {"z_cache.compression", "true"}};
  for (const auto& [key, value] : changes) {
    Config config;
    set_config(config, key, value);
    CHECK_THROWS_WITH(retimer.retime(config), Catch::Contains("'" + std::string(key) + "' is " + value) &&
                                                  Catch::Contains("a new record"));
    CHECK_THROWS_AS(retimer.retime(std::vector<Config>{Config{}, config}), InputError);
    CHECK_THROWS_AS(retimer.estimate(std::vector<Config>{config}), InputError);
  }
}

TEST_CASE("a record with the interpolator is refused", "[timing]") {
  Random random(seed());
  Config config;
  config.interpolator.enabled = true;
  CHECK_THROWS_WITH(record_frame(random_frame(random), config),
                    "configuration key 'interpolator.enabled' is true; legal in a record: false");
}

TEST_CASE("parts of a tile belong to a record with hi_z or coded lines", "[timing]") {
  Random random(seed());
  const Frame frame = random_frame(random);
  for (const char* key : {"hi_z.enabled", "z_cache.compression"}) {
    Config recorded;
    set_config(recorded, key, "true");
    Retimer retimer(record_frame(frame, recorded));
    Config config = recorded;
    config.z_cache.ways = 2;
    CHECK_NOTHROW(retimer.retime(config));
    config.z_cache.parts = 2;
    CHECK_THROWS_WITH(retimer.retime(config),
                      Catch::Contains("'z_cache.parts' is 2") && Catch::Contains("a new record"));
  }
}

TEST_CASE("a record comes back from its file", "[timing]") {
  Random random(seed());
  const TemporaryFile file;
  for (int run = 0; run < 20; ++run) {
    CAPTURE(seed(), run);
    const Config config = random_sampled_config(random);
    FrameRecord record = record_frame(random_frame(random), config);
    write_record(file.path, record);
    const FrameRecord back = read_record(file.path);
    CHECK(back.name == record.name);
    CHECK(to_toml(back.config) == to_toml(record.config));
    REQUIRE(back.packets.jobs.size() == record.packets.jobs.size());
    CHECK(Retimer(back).retime(config) == Retimer(std::move(record)).retime(config));
  }
}

namespace {

/// A record is cut at `cuts` places and has `flips` bits changed, one at a time: it is refused or still a
/// record.
void damage_record(std::size_t cuts, int flips) {
  Random random(seed());
  const TemporaryFile file;
  Frame frame = random_frame(random);
  while (record_frame(frame, Config{}).packets.accesses.size() < 5) {
    frame = random_frame(random);
  }
  write_record(file.path, record_frame(frame, Config{}));
  const std::vector<std::byte> good = decompress(read_raw_bytes(file.path), "record", 1 << 24);
  const auto run = [&](const std::vector<std::byte>& bytes) {
    write_bytes(file.path, bytes);
    try {
      Retimer retimer(read_record(file.path));
      retimer.retime(retimer.record().config);
    } catch (const InputError& error) {
      CHECK(std::string(error.what()).find(file.path.filename().string()) != std::string::npos);
    }
  };
  for (std::size_t size = 0; size < good.size(); size += 1 + good.size() / cuts) {
    run({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)});
  }
  for (int i = 0; i < flips; ++i) {
    std::vector<std::byte> bytes = good;
    const auto at = static_cast<std::size_t>(random.between(0, static_cast<std::int64_t>(good.size()) - 1));
    bytes[at] ^= static_cast<std::byte>(1 << random.between(0, 7));
    run(bytes);
  }
}

}  // namespace

TEST_CASE("a damaged record is refused or still a record, never more", "[timing][exhaustive]") {
  damage_record(150, 600);
}

TEST_CASE("a record damaged at a few places is refused or still a record", "[timing]") {
  damage_record(10, 40);
}

TEST_CASE("a record that is not there is refused", "[timing]") {
  CHECK_THROWS_AS(read_record("/nowhere/at.all"), InputError);
}
