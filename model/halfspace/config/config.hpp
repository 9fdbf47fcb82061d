/// The configuration of a modelled machine: every key with its default, legal values and help, declared once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/units/depth_interpolator.hpp"

namespace halfspace {

/// How draws are taken whose shader may discard, writes depth or has side effects.
enum class LateZ : std::uint8_t {
  kOpaque,   ///< as if every fragment were kept: they test and write at early-Z
  kNoWrite,  ///< they test only
};

struct Config {
  int sub_pixel_bits = 8;
  int tile_size = 8;
  int block_size = 32;
  bool block_level = true;
  bool trivial_reject = true;
  bool trivial_accept = true;
  DepthInterpolator interpolator = DepthInterpolator::kBarycentric;
  LateZ late_z = LateZ::kOpaque;

  // Time; docs/timing.md and the pages of the units say what each means.
  int setup_queue = 8;
  int setup_interval = 1;
  int setup_fifo = 24;
  int walker_step_interval = 1;
  int walker_fifo = 16;
  int edge_pipe_stages = 2;
  int edge_fifo = 4;
  int quad_width = 4;
  int quad_fifo = 4;
  int early_z_width = 4;
  int early_z_pending = 32;
  int early_z_fifo = 16;
  int z_lines = 128;
  int z_ways = 4;
  int z_parts = 1;
  int z_misses_in_flight = 16;
  int z_write_buffers = 4;
  bool fast_clear = true;
  int z_clear_tiles = 64;
  int memory_latency = 100;
  int memory_read_bytes = 64;
  int memory_write_bytes = 64;
};

/// One key as a user sees it.
struct ConfigKey {
  std::string name;     ///< section.key, as in TOML and --set
  std::string value;    ///< of the configuration asked about
  std::string legal;    ///< for people: "4 to 8", "plane or barycentric"
  std::string unit;     ///< empty where there is none
  std::string help;     ///< one line
  bool timing = false;  ///< changes when, never what
};

/// Every key in the order of the reference, with its value in `config`.
std::vector<ConfigKey> config_keys(const Config& config);

/// Sets `key` from text. Throws InputError for an unknown key, with the new name of one that was renamed, or
/// an illegal value.
void set_config(Config& config, std::string_view key, std::string_view value);

/// Applies "key=value". Throws InputError.
void set_config(Config& config, std::string_view assignment);

/// Reads a TOML file over the defaults. Throws InputError that names file, key, value and what is legal.
Config read_config(const std::filesystem::path& path);

/// The same from text; `name` stands for it in errors.
Config parse_config(std::string_view toml, const std::string& name);

/// Checks what no single key can: sizes that must fit each other. Throws InputError.
void validate(const Config& config);

/// The whole configuration as a TOML document, every key with its help.
std::string to_toml(const Config& config);

/// 16 hexadecimal digits: FNV-1a of all keys and values.
std::string config_hash(const Config& config);

}  // namespace halfspace
