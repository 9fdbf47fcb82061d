#include "halfspace/config/config.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <toml++/toml.h>
#include <algorithm>
#include <charconv>
#include <variant>

#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

/// A key whose legal values are a short list of names; the index in the list is the value of the enumeration.
template <class Enum>
struct NamedValues {
  Enum Config::*member;
  std::vector<std::string> names;
};

struct IntegerRange {
  int Config::*member;
  int least;
  int most;
};

struct IntegerChoice {
  int Config::*member;
  std::vector<int> values;
};

struct Switch {
  bool Config::*member;
};

/// Whether a key may change packets, or only the cycles in which they move.
enum class Changes : std::uint8_t { kFunction, kTime };

struct Key {
  std::string name;
  std::string unit;
  std::string help;
  std::variant<IntegerRange, IntegerChoice, Switch, NamedValues<DepthInterpolator>, NamedValues<LateZ>> kind;
  Changes changes = Changes::kTime;
};

/// The smallest FIFO has an output register and a slot; the largest keeps the triangles behind the walker
/// within the 256 contexts that a tile job can name.
constexpr int kLeastFifo = 2;
constexpr int kMostFifo = 64;
constexpr int kMostEdgeFifo = 32;

const std::vector<Key>& keys() {
  static const std::vector<Key> table{
      {"late_z", "",
       "draws whose shader may discard, writes depth or has side effects: opaque = test and write, no_write "
       "= test only",
       NamedValues<LateZ>{&Config::late_z, {"opaque", "no_write"}}, Changes::kFunction},
      {"raster.sub_pixel_bits", "bits", "fraction bits of a snapped window coordinate",
       IntegerRange{&Config::sub_pixel_bits, 4, 8}, Changes::kFunction},
      {"setup.queue", "triangles", "triangles whose verdict is known or under way, dropped ones included",
       IntegerRange{&Config::setup_queue, kLeastFifo, kMostFifo}},
      {"setup.interval", "cycles", "distance of drawn triangles: cycles that a stage of the divider works",
       IntegerChoice{&Config::setup_interval, {1, 2, 4, 8, 16}}},
      {"setup.fifo", "triangles", "output FIFO of setup",
       IntegerRange{&Config::setup_fifo, kLeastFifo, kMostFifo}},
      {"tile_walker.tile_size", "pixels", "side of the tile that the edge evaluator takes in one step",
       IntegerChoice{&Config::tile_size, {4, 8, 16}}, Changes::kFunction},
      {"tile_walker.block_size", "pixels",
       "side of the block that the walker decides before its tiles; larger than a tile",
       IntegerChoice{&Config::block_size, {8, 16, 32, 64}}, Changes::kFunction},
      {"tile_walker.block_level", "", "decide whole blocks first; off: every tile of the bounds is decided",
       Switch{&Config::block_level}, Changes::kFunction},
      {"tile_walker.trivial_reject", "", "drop blocks and tiles that are outside one edge",
       Switch{&Config::trivial_reject}, Changes::kFunction},
      {"tile_walker.trivial_accept", "", "evaluate no edge all of whose samples in the tile are inside",
       Switch{&Config::trivial_accept}, Changes::kFunction},
      {"tile_walker.step_interval", "cycles", "cycles a step of the walker takes",
       IntegerRange{&Config::walker_step_interval, 1, 8}},
      {"tile_walker.fifo", "tile jobs", "output FIFO of the walker",
       IntegerRange{&Config::walker_fifo, kLeastFifo, kMostFifo}},
      {"edge_evaluator.pipe_stages", "registers", "pipeline registers before the output FIFO",
       IntegerRange{&Config::edge_pipe_stages, 1, 3}},
      {"edge_evaluator.fifo", "tiles", "output FIFO of the edge evaluator",
       IntegerRange{&Config::edge_fifo, kLeastFifo, kMostEdgeFifo}},
      {"quad_generator.quads_per_cycle", "quads", "width of a beat; at most the quads of a tile",
       IntegerChoice{&Config::quad_width, {1, 2, 4, 8, 16}}},
      {"quad_generator.fifo", "bursts", "output FIFO of the quad generator; a burst is the quads of one tile",
       IntegerRange{&Config::quad_fifo, kLeastFifo, kMostFifo}},
      {"early_z.quads_per_cycle", "quads", "quads tested in a cycle; at most quad_generator.quads_per_cycle",
       IntegerChoice{&Config::early_z_width, {1, 2, 4, 8, 16}}},
      {"early_z.pending", "bursts", "bursts between the lookup of their lines and their test",
       IntegerRange{&Config::early_z_pending, kLeastFifo, kMostFifo}},
      {"early_z.fifo", "bursts", "output FIFO of early_z",
       IntegerRange{&Config::early_z_fifo, kLeastFifo, kMostFifo}},
      {"depth.interpolator", "",
       "barycentric = within one unit of the last place, plane = cheaper, wrong on slivers",
       NamedValues<DepthInterpolator>{&Config::interpolator, {"plane", "barycentric"}}, Changes::kFunction},
      {"z_cache.lines", "lines",
       "lines of the z cache, all parts and ways together; room for 4 bytes a sample",
       IntegerChoice{&Config::z_lines, {1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096}}},
      {"z_cache.ways", "lines", "lines of a set", IntegerChoice{&Config::z_ways, {1, 2, 4, 8, 16}}},
      {"z_cache.parts", "", "a line holds a tile, or this part of its rows",
       IntegerChoice{&Config::z_parts, {1, 2, 4}}},
      {"z_cache.misses_in_flight", "lines", "fill buffers; at least z_cache.parts",
       IntegerRange{&Config::z_misses_in_flight, 1, 64}},
      {"z_cache.write_buffers", "lines", "lines on their way to memory; at least z_cache.parts",
       IntegerRange{&Config::z_write_buffers, 1, 64}},
      {"z_cache.fast_clear", "", "a clear of a whole surface marks its lines; off: it is drawn",
       Switch{&Config::fast_clear}, Changes::kFunction},
      {"z_cache.clear_tiles", "tiles", "tiles that a fast clear marks in a cycle",
       IntegerChoice{&Config::z_clear_tiles, {1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024}}},
      {"memory.latency", "cycles", "from a request to the first of its data",
       IntegerRange{&Config::memory_latency, 1, 65535}},
      {"memory.read_bytes", "bytes", "read in a cycle",
       IntegerChoice{&Config::memory_read_bytes, {1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024}}},
      {"memory.write_bytes", "bytes", "written in a cycle",
       IntegerChoice{&Config::memory_write_bytes, {1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024}}},
  };
  return table;
}

std::string legal_values(const Key& key) {
  struct Describe {
    std::string operator()(const IntegerRange& r) const { return fmt::format("{} to {}", r.least, r.most); }
    std::string operator()(const IntegerChoice& c) const {
      return fmt::format("{}", fmt::join(c.values, ", "));
    }
    std::string operator()(const Switch&) const { return "true, false"; }
    std::string operator()(const NamedValues<DepthInterpolator>& n) const {
      return fmt::format("{}", fmt::join(n.names, ", "));
    }
    std::string operator()(const NamedValues<LateZ>& n) const {
      return fmt::format("{}", fmt::join(n.names, ", "));
    }
  };
  return std::visit(Describe{}, key.kind);
}

std::string value_text(const Key& key, const Config& config) {
  struct Print {
    const Config& config;
    std::string operator()(const IntegerRange& r) const { return std::to_string(config.*r.member); }
    std::string operator()(const IntegerChoice& c) const { return std::to_string(config.*c.member); }
    std::string operator()(const Switch& s) const { return config.*s.member ? "true" : "false"; }
    std::string operator()(const NamedValues<DepthInterpolator>& n) const {
      return n.names[static_cast<std::size_t>(config.*n.member)];
    }
    std::string operator()(const NamedValues<LateZ>& n) const {
      return n.names[static_cast<std::size_t>(config.*n.member)];
    }
  };
  return std::visit(Print{config}, key.kind);
}

bool parse_integer(std::string_view text, int& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

/// Each assigns `text` and returns true, or returns false where it is not legal.
struct Assign {
  Config& config;
  std::string_view text;

  bool operator()(const IntegerRange& r) const {
    int value = 0;
    const bool legal = parse_integer(text, value) && value >= r.least && value <= r.most;
    config.*r.member = legal ? value : config.*r.member;
    return legal;
  }
  bool operator()(const IntegerChoice& c) const {
    int value = 0;
    const bool legal =
        parse_integer(text, value) && std::find(c.values.begin(), c.values.end(), value) != c.values.end();
    config.*c.member = legal ? value : config.*c.member;
    return legal;
  }
  bool operator()(const Switch& s) const {
    const bool legal = text == "true" || text == "false";
    config.*s.member = legal ? text == "true" : config.*s.member;
    return legal;
  }
  template <class Enum>
  bool operator()(const NamedValues<Enum>& n) const {
    const auto found = std::find(n.names.begin(), n.names.end(), text);
    if (found == n.names.end()) {
      return false;
    }
    config.*n.member = static_cast<Enum>(found - n.names.begin());
    return true;
  }
};

/// Sections that had another name, and the one they have now.
struct Renamed {
  std::string_view was;
  std::string_view is;
};
constexpr Renamed kRenamed[] = {{"walker.", "tile_walker."}};

const Key& find_key(std::string_view name) {
  const auto find = [](std::string_view wanted) { return std::ranges::find(keys(), wanted, &Key::name); };
  if (const auto found = find(name); found != keys().end()) {
    return *found;
  }
  for (const Renamed& section : kRenamed) {
    if (name.starts_with(section.was)) {
      const std::string now = std::string(section.is) + std::string(name.substr(section.was.size()));
      if (find(now) != keys().end()) {
        throw InputError(fmt::format("unknown configuration key '{}'; it is '{}' now", name, now));
      }
    }
  }
  std::vector<std::string> names;
  for (const Key& key : keys()) {
    names.push_back(key.name);
  }
  throw InputError(fmt::format("unknown configuration key '{}'; legal: {}", name, fmt::join(names, ", ")));
}

bool is_text(const Key& key) {
  return std::holds_alternative<NamedValues<DepthInterpolator>>(key.kind) ||
         std::holds_alternative<NamedValues<LateZ>>(key.kind);
}

std::string text_of_node(const toml::node& node, const std::string& name) {
  if (const auto* text = node.as_string()) {
    return text->get();
  }
  if (const auto* integer = node.as_integer()) {
    return std::to_string(integer->get());
  }
  if (const auto* boolean = node.as_boolean()) {
    return boolean->get() ? "true" : "false";
  }
  throw InputError(fmt::format("configuration key '{}' must be an integer, a boolean or a string", name));
}

void apply_table(Config& config, const toml::table& table, const std::string& prefix) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + std::string(key.str());
    if (const toml::table* section = node.as_table()) {
      apply_table(config, *section, name + ".");
    } else {
      find_key(name);  // an unknown key is reported as such, whatever its type
      set_config(config, name, text_of_node(node, name));
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

std::vector<ConfigKey> config_keys(const Config& config) {
  std::vector<ConfigKey> list;
  for (const Key& key : keys()) {
    list.push_back({key.name, value_text(key, config), legal_values(key), key.unit, key.help,
                    key.changes == Changes::kTime});
  }
  return list;
}

void set_config(Config& config, std::string_view key, std::string_view value) {
  const Key& found = find_key(key);
  if (!std::visit(Assign{config, value}, found.kind)) {
    throw InputError(
        fmt::format("configuration key '{}' is '{}'; legal: {}", key, value, legal_values(found)));
  }
}

void set_config(Config& config, std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) {
    throw InputError(fmt::format("'{}' is not a setting; it must read KEY=VALUE", assignment));
  }
  set_config(config, assignment.substr(0, equals), assignment.substr(equals + 1));
}

Config parse_config(std::string_view toml, const std::string& name) {
  return config_of(name, [&] { return toml::parse(toml, name); });
}

Config read_config(const std::filesystem::path& path) {
  return config_of(path.string(), [&] { return toml::parse_file(path.string()); });
}

void validate(const Config& config) {
  const auto demand = [](bool legal, const char* key, int value, const std::string& what) {
    if (!legal) {
      throw InputError(fmt::format("configuration key '{}' is {}; legal: {}", key, value, what));
    }
  };
  demand(config.block_size > config.tile_size, "tile_walker.block_size", config.block_size,
         fmt::format("larger than 'tile_walker.tile_size' ({})", config.tile_size));
  const int quads = config.tile_size * config.tile_size / 4;
  demand(config.quad_width <= quads, "quad_generator.quads_per_cycle", config.quad_width,
         fmt::format("at most the quads of a tile ({})", quads));
  demand(config.early_z_width <= config.quad_width, "early_z.quads_per_cycle", config.early_z_width,
         fmt::format("at most 'quad_generator.quads_per_cycle' ({})", config.quad_width));
  const int rows = config.tile_size / 2;
  demand(config.z_parts <= rows, "z_cache.parts", config.z_parts,
         fmt::format("at most the rows of quads of a tile ({})", rows));
  demand(config.z_lines >= config.z_parts * config.z_ways, "z_cache.lines", config.z_lines,
         fmt::format("at least 'z_cache.ways' times 'z_cache.parts' ({})", config.z_parts * config.z_ways));
  const std::string one_a_part = fmt::format("at least 'z_cache.parts' ({})", config.z_parts);
  demand(config.z_misses_in_flight >= config.z_parts, "z_cache.misses_in_flight", config.z_misses_in_flight,
         one_a_part);
  demand(config.z_write_buffers >= config.z_parts, "z_cache.write_buffers", config.z_write_buffers,
         one_a_part);
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
    text +=
        fmt::format("# {}{} ({})\n", key.help, key.unit.empty() ? "" : ", in " + key.unit, legal_values(key));
    text += fmt::format("{} = {}\n", dot == std::string::npos ? key.name : key.name.substr(dot + 1),
                        is_text(key) ? '"' + value + '"' : value);
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
