#include "halfspace/config/config.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <toml++/toml.h>
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <optional>
#include <type_traits>
#include <variant>

#include "halfspace/config/did_you_mean.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/units/hi_z_bounds.hpp"

namespace halfspace {
namespace {

/// A value of a key: a boolean is 0 or 1, a named one its place in `words`, a share is in parts of
/// kWholeShare.
using Value = std::variant<int, SamplePattern>;

/// What a key may be.
struct Legal {
  enum class Kind : std::uint8_t { kRange, kPowerOfTwo, kBoolean, kShare, kOneOf, kSampleList } kind;
  int least = 0;
  int most = 0;
  std::vector<std::string> words;  ///< as they are written; empty for integers
};

// The names that the table uses.
Legal range(int least, int most) { return {Legal::Kind::kRange, least, most, {}}; }
Legal power_of_two(int least, int most) { return {Legal::Kind::kPowerOfTwo, least, most, {}}; }
Legal share() { return {Legal::Kind::kShare, 0, kWholeShare, {}}; }
Legal sample_list() { return {Legal::Kind::kSampleList, 0, kSampleGrid - 1, {}}; }
Legal boolean() { return {Legal::Kind::kBoolean, 0, 1, {"false", "true"}}; }
Legal one_of(auto... names) {
  return {Legal::Kind::kOneOf, 0, static_cast<int>(sizeof...(names)) - 1, {names...}};
}
enum class Changes : std::uint8_t { function, time };

struct Key {
  std::string name;
  Legal legal;
  std::string unit;
  Changes changes;
  std::string help;
  std::string rtl;
  Value (*get)(const Config& config);
  void (*set)(Config& config, const Value& value);
};

/// A member of Config as a value, and back.
template <class Member>
Value to_value(const Member& member) {
  if constexpr (std::is_same_v<Member, SamplePattern>) {
    return member;
  } else {
    return static_cast<int>(member);
  }
}
template <class Member>
Member of_value(const Value& value) {
  if constexpr (std::is_same_v<Member, SamplePattern>) {
    return std::get<SamplePattern>(value);
  } else {
    return static_cast<Member>(std::get<int>(value));
  }
}

const std::vector<Key>& keys() {
  // clang-format off
#define NOTHING(...)
#define ROW(section, name, type, legal, unit, changes, help, rtl)                         \
  Key{#section #name, legal, unit, Changes::changes, help, rtl,                           \
      [](const Config& config) { return to_value(config.section name); },                 \
      [](Config& config, const Value& value) { config.section name = of_value<type>(value); }},
#define KEY(section, name, type, value, legal, unit, changes, help) \
  ROW(section, name, type, legal, unit, changes, help, "")
#define MODULE(section, name, type, value, legal, unit, changes, help, Parameter) \
  ROW(section, name, type, legal, unit, changes, help, "-G" #Parameter)
#define PACKAGE(section, name, type, value, legal, unit, changes, help, Parameter, define) \
  ROW(section, name, type, legal, unit, changes, help, "-D" #define)
  static const std::vector<Key> table{HALFSPACE_KEYS(NOTHING, NOTHING, KEY, MODULE, PACKAGE)};
#undef NOTHING
#undef ROW
#undef KEY
#undef MODULE
#undef PACKAGE
  // clang-format on
  return table;
}

std::string legal_text(const Legal& legal) {
  switch (legal.kind) {
    case Legal::Kind::kRange:
      return fmt::format("{} to {}", legal.least, legal.most);
    case Legal::Kind::kPowerOfTwo: {
      std::string text = std::to_string(legal.least);
      for (int value = 2 * legal.least; value <= legal.most; value *= 2) {
        text += fmt::format(", {}", value);
      }
      return text;
    }
    case Legal::Kind::kBoolean:
      return "true, false";
    case Legal::Kind::kShare:
      return "0 to 1";
    case Legal::Kind::kSampleList:
      return fmt::format("standard, or x,y;x,y;... with each 0 to {}", legal.most);
    case Legal::Kind::kOneOf:
      break;
  }
  return fmt::format("{}", fmt::join(legal.words, ", "));
}

/// The share that `text` says, rounded; none where it is not a number from 0 to 1 in plain digits.
std::optional<int> parse_share(std::string_view text) {
  double value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  const bool legal = error == std::errc{} && end == text.data() + text.size() && value >= 0 && value <= 1;
  return legal ? std::optional(static_cast<int>(std::lround(value * kWholeShare))) : std::nullopt;
}

/// The shortest number that means this share.
std::string share_text(int value) {
  std::string text;
  for (int digits = 0; parse_share(text) != value; ++digits) {
    text = fmt::format("{:.{}f}", static_cast<double>(value) / kWholeShare, digits);
  }
  return text;
}

constexpr std::string_view kStandardWord = "standard";

std::string sample_list_text(const SamplePattern& samples) {
  std::string text;
  for (const SamplePosition& each : samples.positions()) {
    text += fmt::format("{}{},{}", text.empty() ? "" : ";", each.x, each.y);
  }
  return samples == kStandardSamples ? std::string(kStandardWord) : text;
}

/// All of `text` as an integer; none where it is not one.
std::optional<int> parse_integer(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// "12,12;4,4", or "standard".
std::optional<SamplePattern> parse_sample_list(std::string_view text) {
  SamplePattern samples = kStandardSamples;
  if (text == kStandardWord) {
    return samples;
  }
  const auto coordinate = [](std::string_view digits) {
    const std::optional<int> value = parse_integer(digits);
    return value && *value >= 0 && *value < kSampleGrid ? value : std::nullopt;
  };
  for (bool more = true; more;) {
    const std::string_view position = text.substr(0, text.find(';'));
    const std::size_t comma = std::min(position.find(','), position.size());
    const std::optional<int> x = coordinate(position.substr(0, comma));
    const std::optional<int> y = coordinate(position.substr(std::min(comma + 1, position.size())));
    if (!x || !y || samples.count == kMostSamples) {
      return std::nullopt;
    }
    samples.at[static_cast<std::size_t>(samples.count++)] = {static_cast<std::uint8_t>(*x),
                                                             static_cast<std::uint8_t>(*y)};
    more = position.size() < text.size();
    text.remove_prefix(std::min(position.size() + 1, text.size()));
  }
  return samples;
}

std::string value_text(const Key& key, const Config& config) {
  const Value held = key.get(config);
  if (const auto* const samples = std::get_if<SamplePattern>(&held)) {
    return sample_list_text(*samples);
  }
  const int value = std::get<int>(held);
  if (key.legal.kind == Legal::Kind::kShare) {
    return share_text(value);
  }
  return key.legal.words.empty() ? std::to_string(value) : key.legal.words[static_cast<std::size_t>(value)];
}

/// The value that `text` says; none where it is not legal.
std::optional<Value> parse_value(const Legal& legal, std::string_view text) {
  if (!legal.words.empty()) {
    const auto found = std::ranges::find(legal.words, text);
    return found == legal.words.end() ? std::nullopt
                                      : std::optional<Value>(static_cast<int>(found - legal.words.begin()));
  }
  if (legal.kind == Legal::Kind::kShare) {
    return parse_share(text);
  }
  if (legal.kind == Legal::Kind::kSampleList) {
    return parse_sample_list(text);
  }
  const std::optional<int> value = parse_integer(text);
  const bool in_range = value && *value >= legal.least && *value <= legal.most;
  const bool legal_value = in_range && (legal.kind != Legal::Kind::kPowerOfTwo ||
                                        std::has_single_bit(static_cast<unsigned>(*value)));
  return legal_value ? std::optional<Value>(*value) : std::nullopt;
}

/// Keys, or whole sections, that had another name, and the one they have now.
struct Renamed {
  std::string_view was;
  std::string_view is;
};
constexpr Renamed kRenamed[] = {{"tile_walker.block_size", "block_walker.block_size"},
                                {"tile_walker.trivial_reject", "block_walker.trivial_reject"},
                                {"walker.block_size", "block_walker.block_size"},
                                {"walker.trivial_reject", "block_walker.trivial_reject"},
                                {"walker.", "tile_walker."}};

/// Short for another key.
constexpr Renamed kShort{"late_z", "late_z.mode"};

const Key& find_key(std::string_view name) {
  const auto find = [](std::string_view wanted) { return std::ranges::find(keys(), wanted, &Key::name); };
  if (name == kShort.was) {
    return *find(kShort.is);
  }
  if (const auto found = find(name); found != keys().end()) {
    return *found;
  }
  for (const Renamed& each : kRenamed) {
    if (name.starts_with(each.was)) {
      const std::string now = std::string(each.is) + std::string(name.substr(each.was.size()));
      if (find(now) != keys().end()) {
        throw OptionError(fmt::format("unknown configuration key '{}'; it is '{}' now", name, now));
      }
    }
  }
  std::vector<std::string> names;
  for (const Key& key : keys()) {
    names.push_back(key.name);
  }
  throw OptionError(fmt::format("unknown configuration key '{}'{}; legal: {}", name,
                                did_you_mean(name, names), fmt::join(names, ", ")));
}

std::string text_of_node(const toml::node& node, const Key& key, const std::string& name) {
  if (const auto* text = node.as_string()) {
    return text->get();
  }
  if (const auto* integer = node.as_integer()) {
    return std::to_string(integer->get());
  }
  const bool is_share = key.legal.kind == Legal::Kind::kShare;
  if (const auto* number = node.as_floating_point(); number != nullptr && is_share) {
    return fmt::format("{}", number->get());
  }
  if (const auto* boolean = node.as_boolean()) {
    return boolean->get() ? "true" : "false";
  }
  throw InputError(fmt::format("configuration key '{}' must be {}, a boolean or a string", name,
                               is_share ? "a number" : "an integer"));
}

void apply_table(Config& config, const toml::table& table, const std::string& prefix) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + std::string(key.str());
    if (const toml::table* section = node.as_table()) {
      apply_table(config, *section, name + ".");
    } else {
      set_config(config, name, text_of_node(node, find_key(name), name));
    }
  }
}

/// The configuration in the document that parse() gives; `name` stands for it in errors.
template <class Parse>
Config config_of(const std::string& name, const Parse& parse) {
  Config config;
  try {
    apply_table(config, parse(), "");
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}: line {}: {}", name, error.source().begin.line, error.description()));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", name, error.what()));
  }
  return config;
}

}  // namespace

Widths widths(const Config& config) {
  // clang-format off
#define NOTHING(...)
#define PACKAGE(section, name, type, value, legal, unit, changes, help, Parameter, define) \
  .Parameter = config.section name,
  return {HALFSPACE_KEYS(NOTHING, NOTHING, NOTHING, NOTHING, PACKAGE)};
#undef NOTHING
#undef PACKAGE
  // clang-format on
}

SamplePattern sample_pattern(const Config& config) {
  const SamplePattern& listed = config.raster.sample_positions;
  return listed == kStandardSamples ? standard_samples(config.raster.samples) : listed;
}

bool same_packets(const Config& a, const Config& b) {
  return std::ranges::all_of(
      keys(), [&](const Key& key) { return key.changes == Changes::time || key.get(a) == key.get(b); });
}

std::vector<ConfigKey> config_keys(const Config& config) {
  std::vector<ConfigKey> list;
  for (const Key& key : keys()) {
    list.push_back({key.name, value_text(key, config), legal_text(key.legal), key.unit, key.help,
                    key.changes == Changes::time, key.rtl});
  }
  return list;
}

void set_config(Config& config, std::string_view key, std::string_view value) {
  const Key& found = find_key(key);
  const std::optional<Value> parsed = parse_value(found.legal, value);
  if (!parsed) {
    throw OptionError(fmt::format("configuration key '{}' is '{}'{}; legal: {}", key, value,
                                  did_you_mean(value, found.legal.words), legal_text(found.legal)));
  }
  found.set(config, *parsed);
}

void set_config(Config& config, std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) {
    throw OptionError(fmt::format("'{}' is not a setting; it must read KEY=VALUE", assignment));
  }
  set_config(config, assignment.substr(0, equals), assignment.substr(equals + 1));
}

Config parse_config(std::string_view toml, const std::string& name) {
  return config_of(name, [&] { return toml::parse(toml, name); });
}

Config read_config(const std::filesystem::path& path) {
  return config_of(path.string(), [&] { return toml::parse_file(path.string()); });
}

namespace {

/// The walk of block_walker.
void validate_walk(const Config& config) {
  const auto demand = [](bool legal, const char* key, std::string_view value, const std::string& what) {
    if (!legal) {
      throw OptionError(fmt::format("configuration key '{}' is {}; legal: {}", key, value, what));
    }
  };
  const auto& walker = config.block_walker;
  const bool led = is_led(walker.order);
  const std::string_view order = walker.order == WalkOrder::kZigzag ? "zigzag" : "backtracking";
  demand(!led || walker.levels != 3, "block_walker.order", order,
         "raster, boustrophedonic, morton, hilbert where 'block_walker.levels' is 3");
  demand(!led || walker.trivial_reject, "block_walker.order", order,
         "raster, boustrophedonic, morton, hilbert where 'block_walker.trivial_reject' is false");
  demand(walker.levels != 3 || walker.trivial_reject, "block_walker.levels", "3",
         "1, 2 where 'block_walker.trivial_reject' is false");
  demand(walker.levels != 1 || !walker.sample_reject, "block_walker.levels", "1",
         "2, 3 where 'block_walker.sample_reject' is true");
  constexpr std::string_view kTileOrders[] = {"raster", "boustrophedonic", "morton", "hilbert"};
  demand(config.tile_walker.order == TileOrder::kRaster || !config.hi_z.enabled, "tile_walker.order",
         kTileOrders[static_cast<std::size_t>(config.tile_walker.order)],
         "raster where 'hi_z.enabled' is true");
}

/// What does not know of samples yet, or of one that is not at the centre of its pixel.
void validate_samples(const Config& config) {
  const int samples = config.raster.samples;
  const SamplePattern& listed = config.raster.sample_positions;
  if (listed != kStandardSamples && listed.count != samples) {
    throw OptionError(
        fmt::format("configuration key 'raster.sample_positions' has {} positions; legal: as many as "
                    "'raster.samples' ({}), or standard",
                    listed.count, samples));
  }
  const int row_tiles = config.block_walker.block_size / config.tile_walker.tile_size;
  const int most = row_tiles == 8 ? kMostSamples / 2 : kMostSamples;
  if (samples > most) {
    throw OptionError(
        fmt::format("configuration key 'raster.samples' is {}; legal: at most {} where a block has {} tiles",
                    samples, most, row_tiles * row_tiles));
  }
  if (sample_pattern(config).is_centre()) {
    return;
  }
  const auto refuse = [](bool is_set, const char* key, const char* value, const char* legal) {
    if (is_set) {
      throw OptionError(
          fmt::format("configuration key '{}' is {}; legal: {} where a pixel has several "
                      "samples, or one that is not at its centre ('raster.samples')",
                      key, value, legal));
    }
  };
  refuse(config.hi_z.enabled, "hi_z.enabled", "true", "false");
  refuse(config.block_walker.sample_reject, "block_walker.sample_reject", "true", "false");
  refuse(config.late_z.mode == LateZ::kLate, "late_z.mode", "late", "opaque, no_write");
  refuse(config.raster.conservative != Conservative::kOff, "raster.conservative",
         config.raster.conservative == Conservative::kOuter ? "outer" : "inner", "off");
}

/// That a tile job can name.
constexpr int kTriangleSlots = 1 << Widths{}.SlotBits;

/// Behind early_z: what the interpolator takes, and the slots that its triangles are kept in.
void validate_interpolator(const Config& config) {
  const auto demand = [](bool legal, const std::string& key, const std::string& value,
                         const std::string& what) {
    if (!legal) {
      throw OptionError(fmt::format("configuration key '{}' is {}; legal: {}", key, value, what));
    }
  };
  const int bits = config.interpolator.bits;
  demand(bits % 2 == 0, "interpolator.bits", std::to_string(bits), "an even number");
  if (!config.interpolator.enabled) {
    return;
  }
  demand(config.raster.conservative == Conservative::kOff, "interpolator.enabled", "true",
         "false with 'raster.conservative' outer or inner");
  const int kept = (config.hi_z.enabled ? config.hi_z.fifo : config.block_walker.fifo) +
                   config.tile_walker.fifo + config.edge_evaluator.fifo + config.quad_generator.fifo +
                   config.early_z.pending + config.early_z.fifo;
  demand(kept < kTriangleSlots, "early_z.fifo", std::to_string(config.early_z.fifo),
         fmt::format("at most {} with 'interpolator.enabled' and the FIFOs before it: a triangle keeps its "
                     "slot of {} until the interpolator has its last quad",
                     kTriangleSlots - 1 - (kept - config.early_z.fifo), kTriangleSlots));
}

}  // namespace

void validate(const Config& config) {
  const auto demand = [](bool legal, const char* key, int value, const std::string& what) {
    if (!legal) {
      throw OptionError(fmt::format("configuration key '{}' is {}; legal: {}", key, value, what));
    }
  };
  const int row_tiles = config.block_walker.block_size / config.tile_walker.tile_size;
  demand(row_tiles >= 2 && row_tiles <= 8, "block_walker.block_size", config.block_walker.block_size,
         fmt::format("2, 4 or 8 times 'tile_walker.tile_size' ({})", config.tile_walker.tile_size));
  validate_walk(config);
  const int bounds = row_tiles * row_tiles * config.z_cache.parts;
  demand(!config.hi_z.enabled || bounds <= static_cast<int>(kMostHiZEntries), "hi_z.enabled", 1,
         fmt::format("false where a block has more than {} parts of tiles (these have {})", kMostHiZEntries,
                     bounds));
  const bool by_centres = config.raster.conservative == Conservative::kOff;
  demand(!config.raster.inner_coverage || config.raster.conservative == Conservative::kOuter,
         "raster.inner_coverage", 1, "false where 'raster.conservative' is not outer");
  const int half_pixel = 1 << (config.raster.sub_pixel_bits - 1);
  demand(by_centres || config.raster.uncertainty <= half_pixel, "raster.uncertainty",
         config.raster.uncertainty, fmt::format("at most half a pixel ({})", half_pixel));
  const int quads = config.tile_walker.tile_size * config.tile_walker.tile_size / 4;
  demand(config.quad_generator.quads_per_cycle <= quads, "quad_generator.quads_per_cycle",
         config.quad_generator.quads_per_cycle, fmt::format("at most the quads of a tile ({})", quads));
  demand(config.early_z.quads_per_cycle <= config.quad_generator.quads_per_cycle, "early_z.quads_per_cycle",
         config.early_z.quads_per_cycle,
         fmt::format("at most 'quad_generator.quads_per_cycle' ({})", config.quad_generator.quads_per_cycle));
  const int rows = config.tile_walker.tile_size / 2;
  demand(config.z_cache.parts <= rows, "z_cache.parts", config.z_cache.parts,
         fmt::format("at most the rows of quads of a tile ({})", rows));
  demand(config.z_cache.lines >= config.z_cache.parts * config.z_cache.ways, "z_cache.lines",
         config.z_cache.lines,
         fmt::format("at least 'z_cache.ways' times 'z_cache.parts' ({})",
                     config.z_cache.parts * config.z_cache.ways));
  const std::string one_a_part = fmt::format("at least 'z_cache.parts' ({})", config.z_cache.parts);
  demand(config.z_cache.misses_in_flight >= config.z_cache.parts, "z_cache.misses_in_flight",
         config.z_cache.misses_in_flight, one_a_part);
  demand(config.z_cache.write_buffers >= config.z_cache.parts, "z_cache.write_buffers",
         config.z_cache.write_buffers, one_a_part);
  validate_samples(config);
  validate_interpolator(config);
}

std::string to_toml(const Config& config) {
  std::string text;
  std::string section;
  for (const Key& key : keys()) {
    const std::size_t dot = key.name.find('.');
    const std::string in = dot == std::string::npos ? "" : key.name.substr(0, dot);
    if (in != section) {
      text += fmt::format("\n[{}]\n", in);
      section = in;
    }
    const std::string value = value_text(key, config);
    const bool in_quotes =
        key.legal.kind == Legal::Kind::kOneOf || key.legal.kind == Legal::Kind::kSampleList;
    text += fmt::format("# {}{} ({})\n", key.help, key.unit.empty() ? "" : ", in " + key.unit,
                        legal_text(key.legal));
    text += fmt::format("{} = {}\n", dot == std::string::npos ? key.name : key.name.substr(dot + 1),
                        in_quotes ? '"' + value + '"' : value);
  }
  return text;
}

std::string config_hash(const Config& config) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const Key& key : keys()) {
    for (const char c : key.name + "=" + value_text(key, config) + "\n") {
      hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    }
  }
  return fmt::format("{:016x}", hash);
}

}  // namespace halfspace
