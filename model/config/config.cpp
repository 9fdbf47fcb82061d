#include "halfspace/config/config.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <toml++/toml.h>
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

struct Key {
  std::string name;
  std::string unit;
  std::string help;
  std::variant<IntegerRange, IntegerChoice, Switch, NamedValues<DepthInterpolator>, NamedValues<LateZ>> kind;
};

const std::vector<Key>& keys() {
  static const std::vector<Key> table{
      {"late_z", "",
       "draws whose shader may discard, writes depth or has side effects: opaque = test and write, no_write "
       "= test only",
       NamedValues<LateZ>{&Config::late_z, {"opaque", "no_write"}}},
      {"raster.sub_pixel_bits", "bits", "fraction bits of a snapped window coordinate",
       IntegerRange{&Config::sub_pixel_bits, 4, 8}},
      {"walker.tile_size", "pixels", "side of the tile that the edge evaluator takes in one step",
       IntegerChoice{&Config::tile_size, {4, 8, 16}}},
      {"walker.block_size", "pixels",
       "side of the block that the walker decides before its tiles; larger than a tile",
       IntegerChoice{&Config::block_size, {8, 16, 32, 64}}},
      {"walker.block_level", "", "decide whole blocks first; off: every tile of the bounds is decided",
       Switch{&Config::block_level}},
      {"walker.trivial_reject", "", "drop blocks and tiles that are outside one edge",
       Switch{&Config::trivial_reject}},
      {"walker.trivial_accept", "", "evaluate no edge all of whose samples in the tile are inside",
       Switch{&Config::trivial_accept}},
      {"depth.interpolator", "",
       "barycentric = within one unit of the last place, plane = cheaper, wrong on slivers",
       NamedValues<DepthInterpolator>{&Config::interpolator, {"plane", "barycentric"}}},
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
    config.*s.member = text == "true";
    return text == "true" || text == "false";
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

const Key& find_key(std::string_view name) {
  for (const Key& key : keys()) {
    if (key.name == name) {
      return key;
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

}  // namespace

std::vector<ConfigKey> config_keys(const Config& config) {
  std::vector<ConfigKey> list;
  for (const Key& key : keys()) {
    list.push_back({key.name, value_text(key, config), legal_values(key), key.unit, key.help});
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

Config read_config(const std::filesystem::path& path) {
  Config config;
  try {
    apply_table(config, toml::parse_file(path.string()), "");
  } catch (const toml::parse_error& error) {
    throw InputError(
        fmt::format("{}: line {}: {}", path.string(), error.source().begin.line, error.description()));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  }
  return config;
}

void validate(const Config& config) {
  if (config.block_size <= config.tile_size) {
    throw InputError(
        fmt::format("configuration key 'walker.block_size' is {}; legal: larger than 'walker.tile_size' ({})",
                    config.block_size, config.tile_size));
  }
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
