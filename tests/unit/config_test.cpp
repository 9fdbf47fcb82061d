// Configurations that are refused: the error names the key, its value and what is legal.
#include "halfspace/config/config.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "halfspace/numerics/error.hpp"

using namespace halfspace;

namespace {

/// What is said about the defaults with these settings; empty where they are legal.
std::string error_of(std::initializer_list<const char*> settings) {
  Config config;
  try {
    for (const char* setting : settings) {
      set_config(config, setting);
    }
    validate(config);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string without(std::string text, const std::string& part) {
  const std::size_t at = text.find(part);
  return at == std::string::npos ? text : text.erase(at, part.size());
}

}  // namespace

TEST_CASE("config: no key takes a value outside its list, and the error says all three") {
  for (const ConfigKey& key : config_keys({})) {
    for (const char* value : {"0", "-1", "3.5", "", " ", "8 ", "0x8", "1e3", "99999", "99999999999999999999",
                              "TRUE", "yes", "Plane"}) {
      CAPTURE(key.name, value);
      if (key.legal.starts_with("0 to ") && value == std::string("0")) {
        continue;
      }
      std::string meant;
      for (const auto& [capitals, name] : {std::pair{"TRUE", "true"}, std::pair{"Plane", "plane"}}) {
        if (value == std::string(capitals) && key.legal.find(name) != std::string::npos) {
          meant = std::string(" (did you mean '") + name + "'?)";
        }
      }
      Config config;
      CHECK_THROWS_WITH(
          set_config(config, key.name, value),
          "configuration key '" + key.name + "' is '" + value + "'" + meant + "; legal: " + key.legal);
    }
  }
}

TEST_CASE("config: a capacity of 0, a width of 0, a size that is no power of two") {
  CHECK(error_of({"quad_generator.fifo=0"}) ==
        "configuration key 'quad_generator.fifo' is '0'; legal: 2 to 64");
  CHECK(error_of({"quad_generator.fifo=1"}) ==
        "configuration key 'quad_generator.fifo' is '1'; legal: 2 to 64");
  CHECK(error_of({"edge_evaluator.fifo=33"}) ==
        "configuration key 'edge_evaluator.fifo' is '33'; legal: 2 to 32");
  CHECK(error_of({"setup.queue=0"}) == "configuration key 'setup.queue' is '0'; legal: 2 to 64");
  CHECK(error_of({"early_z.pending=65"}) == "configuration key 'early_z.pending' is '65'; legal: 2 to 64");
  CHECK(error_of({"z_cache.write_buffers=0"}) ==
        "configuration key 'z_cache.write_buffers' is '0'; legal: 1 to 64");
  CHECK(error_of({"quad_generator.quads_per_cycle=0"}) ==
        "configuration key 'quad_generator.quads_per_cycle' is '0'; legal: 1, 2, 4, 8, 16");
  CHECK(error_of({"memory.read_bytes=0"}).find("legal: 1, 2, 4, 8,") != std::string::npos);
  for (const char* power : {"tile_walker.tile_size=12", "block_walker.block_size=24", "setup.interval=3",
                            "quad_generator.quads_per_cycle=3", "early_z.quads_per_cycle=6",
                            "z_cache.lines=100", "z_cache.ways=3", "z_cache.parts=3",
                            "z_cache.clear_tiles=48", "memory.read_bytes=48", "memory.write_bytes=96"}) {
    CAPTURE(power);
    const std::string setting(power);
    const std::string key = setting.substr(0, setting.find('='));
    const std::string value = setting.substr(key.size() + 1);
    CHECK(error_of({power}).rfind("configuration key '" + key + "' is '" + value + "'; legal: ", 0) == 0);
  }
}

TEST_CASE("config: an unknown key is answered with those that exist") {
  const std::string meant = " (did you mean 'tile_walker.tile_size'?)";
  for (const auto& [key, answer] : {std::pair<std::string, std::string>{"tile_walker.tile_sise", meant},
                                    {"tile_walker.tile_size.x", meant},
                                    {"tile_size", ""},
                                    {"walker", ""},
                                    {"", ""}}) {
    const std::string error = error_of({(key + "=8").c_str()});
    CAPTURE(key, error);
    CHECK(error.starts_with("unknown configuration key '" + key + "'" + answer + "; legal: "));
    for (const ConfigKey& each : config_keys({})) {
      CHECK(error.find(each.name) != std::string::npos);
    }
  }
  CHECK(error_of({"tile_walker.tile_size"}) ==
        "'tile_walker.tile_size' is not a setting; it must read KEY=VALUE");
}

TEST_CASE("config: a key that was renamed is refused with its new name") {
  CHECK(error_of({"tile_walker.block_size=32"}) ==
        "unknown configuration key 'tile_walker.block_size'; it is 'block_walker.block_size' now");
  CHECK(error_of({"walker.trivial_reject=true"}) ==
        "unknown configuration key 'walker.trivial_reject'; it is 'block_walker.trivial_reject' now");
  for (const ConfigKey& key : config_keys({})) {
    if (key.name.starts_with("tile_walker.")) {
      const std::string old = key.name.substr(std::string("tile_").size());
      Config config;
      CHECK_THROWS_WITH(set_config(config, old, key.value),
                        "unknown configuration key '" + old + "'; it is '" + key.name + "' now");
    }
  }
  CHECK(error_of({"walker.fofo=3"}).starts_with("unknown configuration key 'walker.fofo'; legal: "));
  CHECK_THROWS_WITH(parse_config("[walker]\nfifo = 3\n", "old.toml"),
                    "old.toml: unknown configuration key 'walker.fifo'; it is 'tile_walker.fifo' now");
}

TEST_CASE("config: keys that must fit each other") {
  CHECK(
      error_of({"block_walker.block_size=8"}) ==
      "configuration key 'block_walker.block_size' is 8; legal: 2, 4 or 8 times 'tile_walker.tile_size' (8)");
  CHECK(error_of({"tile_walker.tile_size=4", "block_walker.block_size=64"}) ==
        "configuration key 'block_walker.block_size' is 64; legal: 2, 4 or 8 times 'tile_walker.tile_size' "
        "(4)");
  CHECK(error_of({"tile_walker.tile_size=4", "quad_generator.quads_per_cycle=8"}) ==
        "configuration key 'quad_generator.quads_per_cycle' is 8; legal: at most the quads of a tile (4)");
  const std::string led = "legal: raster, boustrophedonic, morton, hilbert where ";
  CHECK(error_of({"block_walker.order=zigzag", "block_walker.levels=3"}) ==
        "configuration key 'block_walker.order' is zigzag; " + led + "'block_walker.levels' is 3");
  CHECK(error_of({"block_walker.order=backtracking", "block_walker.trivial_reject=false"}) ==
        "configuration key 'block_walker.order' is backtracking; " + led +
            "'block_walker.trivial_reject' is false");
  CHECK(error_of({"block_walker.levels=3", "block_walker.trivial_reject=false"}) ==
        "configuration key 'block_walker.levels' is 3; legal: 1, 2 where 'block_walker.trivial_reject' is "
        "false");
  CHECK(
      error_of({"block_walker.levels=1", "block_walker.sample_reject=true"}) ==
      "configuration key 'block_walker.levels' is 1; legal: 2, 3 where 'block_walker.sample_reject' is true");
  CHECK(error_of({"tile_walker.order=hilbert", "hi_z.enabled=true"}) ==
        "configuration key 'tile_walker.order' is hilbert; legal: raster where 'hi_z.enabled' is true");
  CHECK(error_of({"early_z.quads_per_cycle=8"}) ==
        "configuration key 'early_z.quads_per_cycle' is 8; legal: at most 'quad_generator.quads_per_cycle' "
        "(4)");
  CHECK(error_of({"tile_walker.tile_size=4", "z_cache.parts=4"}) ==
        "configuration key 'z_cache.parts' is 4; legal: at most the rows of quads of a tile (2)");
  CHECK(error_of({"z_cache.lines=8", "z_cache.ways=4", "z_cache.parts=4"}) ==
        "configuration key 'z_cache.lines' is 8; legal: at least 'z_cache.ways' times 'z_cache.parts' (16)");
  CHECK(error_of({"z_cache.parts=4", "z_cache.misses_in_flight=3"}) ==
        "configuration key 'z_cache.misses_in_flight' is 3; legal: at least 'z_cache.parts' (4)");
  CHECK(error_of({"z_cache.parts=4", "z_cache.write_buffers=3"}) ==
        "configuration key 'z_cache.write_buffers' is 3; legal: at least 'z_cache.parts' (4)");
  CHECK(error_of({"interpolator.bits=9"}) ==
        "configuration key 'interpolator.bits' is 9; legal: an even number");
  CHECK(error_of(
            {"interpolator.enabled=true", "raster.conservative=outer", "depth.interpolator=barycentric"}) ==
        "configuration key 'interpolator.enabled' is true; legal: false with 'raster.conservative' outer or "
        "inner");
  // 4 + 64 + 32 + 64 + 64 places before early_z's output, and a triangle under way in block_walker
  CHECK(error_of({"interpolator.enabled=true", "tile_walker.fifo=64", "edge_evaluator.fifo=32",
                  "quad_generator.fifo=64", "early_z.pending=64", "early_z.fifo=28"}) ==
        "configuration key 'early_z.fifo' is 28; legal: at most 27 with 'interpolator.enabled' and the FIFOs "
        "before it: a triangle keeps its slot of 256 until the interpolator has its last quad");
  // And the same just inside.
  CHECK(error_of({"interpolator.enabled=true", "tile_walker.fifo=64", "edge_evaluator.fifo=32",
                  "quad_generator.fifo=64", "early_z.pending=64", "early_z.fifo=27"})
            .empty());
  CHECK(error_of({"tile_walker.tile_size=4", "block_walker.block_size=8"}).empty());
  CHECK(error_of({"quad_generator.quads_per_cycle=16", "early_z.quads_per_cycle=16"}).empty());
  CHECK(error_of({"tile_walker.tile_size=4", "z_cache.parts=2"}).empty());
  CHECK(error_of({"z_cache.lines=16", "z_cache.ways=4", "z_cache.parts=4"}).empty());
  CHECK(error_of({"z_cache.parts=4", "z_cache.misses_in_flight=4", "z_cache.write_buffers=4"}).empty());
}

TEST_CASE("config: a file is refused by its name too, and one that was written is read back") {
  std::string pattern = (std::filesystem::temp_directory_path() / "halfspace_config.XXXXXX").string();
  REQUIRE(mkdtemp(pattern.data()) != nullptr);
  const std::filesystem::path folder(pattern);
  const std::filesystem::path path = folder / "machine.toml";
  const auto error_of_file = [&](const std::string& text) -> std::string {
    std::ofstream(path) << text;
    try {
      read_config(path);
    } catch (const InputError& error) {
      return without(error.what(), folder.string() + "/");
    }
    return "";
  };
  CHECK(error_of_file("[setup]\nfifo = 0\n") ==
        "machine.toml: configuration key 'setup.fifo' is '0'; legal: 2 to 64");
  CHECK(error_of_file("[setup]\nfifo = 4.0\n").find("'setup.fifo' must be an integer") != std::string::npos);
  CHECK(error_of_file("[setup]\nfifo = [4]\n").find("'setup.fifo' must be an integer") != std::string::npos);
  CHECK(
      error_of_file("[setup]\nlifo = 4\n").rfind("machine.toml: unknown configuration key 'setup.lifo'", 0) ==
      0);
  CHECK(error_of_file("[setup.fifo]\nsize = 4\n").find("unknown configuration key 'setup.fifo.size'") !=
        std::string::npos);
  CHECK(error_of_file("[setup]\nfifo = 4\nfifo = 5\n").find("line 3") != std::string::npos);
  CHECK(error_of_file("").empty());
  CHECK(error_of_file("\xEF\xBB\xBF[setup]\nfifo = 4\n").empty());  // a byte order mark
  CHECK(read_config(path).setup.fifo == 4);
  CHECK(parse_config("\xEF\xBB\xBF[setup]\nfifo = 4\n", "x").setup.fifo == 4);
  const std::string utf_16("\xFF\xFE[\0s\0", 6);
  CHECK(error_of_file(utf_16).starts_with("machine.toml: line 1: "));

  Config config;
  for (const char* setting : {"late_z=no_write", "late_z.discard=0.125", "tile_walker.tile_size=16",
                              "block_walker.trivial_reject=false", "depth.interpolator=plane",
                              "memory.latency=65535", "setup.interval=16"}) {
    set_config(config, setting);
  }
  CHECK(error_of_file(to_toml(config)).empty());
  CHECK(to_toml(read_config(path)) == to_toml(config));
  CHECK(config_hash(read_config(path)) == config_hash(config));
  CHECK(config_hash(config) != config_hash({}));
  std::filesystem::remove_all(folder);
}

TEST_CASE("config: the longest FIFOs hold fewer triangles than there are slots for them") {
  const auto longest = [](const std::string& key) {
    int most = 0;
    for (int places = 2; places < 256; ++places) {
      most = error_of({(key + "=" + std::to_string(places)).c_str()}).empty() ? places : most;
    }
    return most;
  };
  const int behind = longest("tile_walker.fifo") + longest("edge_evaluator.fifo") +
                     longest("quad_generator.fifo") + longest("early_z.pending");
  CHECK(behind + longest("hi_z.fifo") < 256);
  CHECK(behind + longest("block_walker.fifo") < 256);
  // hi_z keeps 16: also of the blocks in its first cycles, and the triangle that is written.
  CHECK(longest("block_walker.fifo") + 4 + 1 <= 16);
}
