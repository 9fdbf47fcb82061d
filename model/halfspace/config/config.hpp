/// The configuration of a modelled machine, from the table of keys.hpp: reading, checking and printing it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/config/keys.hpp"
#include "halfspace/numerics/conservative.hpp"
#include "halfspace/numerics/sample_pattern.hpp"
#include "halfspace/numerics/widths.hpp"
#include "halfspace/units/depth_interpolator.hpp"
#include "halfspace/units/walk_order.hpp"

namespace halfspace {

/// A share of 1, as keys keep it.
inline constexpr int kWholeShare = 1 << 16;

/// Which fill rule draws have.
enum class FillRuleKey : std::uint8_t {
  kDraw,  ///< that of the draw, top-left or bottom-left
  kTopLeft,
  kBottomLeft,
  kTopRight,
  kBottomRight,
  kNormalSign,  ///< A > 0, or A = 0 and B > 0; with y down and E positive inside it is top-left
};

/// How draws are taken whose shader may discard, writes depth or has side effects.
enum class LateZ : std::uint8_t {
  kOpaque,   ///< as if every fragment were kept: they test and write at early-Z
  kNoWrite,  ///< they test only
  kLate,     ///< they test at early-Z, and write what the shader keeps when it is through
};

/// The machine: a member for each key, in a struct for each section, as keys.hpp lists and explains them:
/// `config.setup.queue`. Time: docs/timing.md and the pages of the units say what each key means.
struct Config {
#define BEGIN(section) struct {
#define KEY(section, name, type, value, ...) type name = value;
// clang-format off
#define END(section) } section;  // NOLINT(bugprone-macro-parentheses): it is a name
  // clang-format on
  HALFSPACE_KEYS(BEGIN, END, KEY, KEY, KEY)
#undef BEGIN
#undef KEY
#undef END
};

/// The widths of the packets of this machine.
[[nodiscard]] Widths widths(const Config& config);

/// The samples of a pixel of this machine.
[[nodiscard]] SamplePattern sample_pattern(const Config& config);

/// One key as a user sees it.
struct ConfigKey {
  std::string name;     ///< section.key, as in TOML and --set
  std::string value;    ///< of the configuration asked about
  std::string legal;    ///< for people: "4 to 8", "plane or barycentric"
  std::string unit;     ///< empty where there is none
  std::string help;     ///< one line
  bool timing = false;  ///< changes when, never what
  std::string rtl;      ///< Verilator's option that sets it, "-GSetupQueue"; empty where the RTL has none
};

/// Every key in the order of the reference, with its value in `config`.
std::vector<ConfigKey> config_keys(const Config& config);

/// Whether both differ in keys of time only: then the same packets pass through both machines.
[[nodiscard]] bool same_packets(const Config& a, const Config& b);

/// Sets `key` from text. Throws OptionError for an unknown key, with the new name of one that was renamed, or
/// an illegal value.
void set_config(Config& config, std::string_view key, std::string_view value);

/// Applies "key=value". Throws OptionError.
void set_config(Config& config, std::string_view assignment);

/// Reads a TOML file over the defaults. Throws InputError that names file, key, value and what is legal.
Config read_config(const std::filesystem::path& path);

/// The same from text; `name` stands for it in errors.
Config parse_config(std::string_view toml, const std::string& name);

/// Checks what no single key can: sizes that must fit each other. Throws OptionError.
void validate(const Config& config);

/// The whole configuration as a TOML document, every key with its help.
std::string to_toml(const Config& config);

/// 16 hexadecimal digits: FNV-1a of all keys and values.
std::string config_hash(const Config& config);

}  // namespace halfspace
