#include "halfspace/report/diff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string_view>

#include "halfspace/numerics/error.hpp"
#include "halfspace/report/npy.hpp"
#include "halfspace/report/stats.hpp"

namespace halfspace {
namespace {

namespace fs = std::filesystem;
using StatsJson = nlohmann::json;

/// One field of a record, or the whole element of a plain array.
struct Field {
  std::string name;
  char kind = 'u';       ///< u unsigned, i signed, f float
  std::size_t size = 0;  ///< bytes of one value
  std::size_t count = 1;
  std::size_t offset = 0;
};

/// Values of a field whose type is followed by `text`: as many as ",(2,4,4)" says, else one.
std::size_t values_of(std::string_view text) {
  if (!text.starts_with(",(")) {
    return 1;
  }
  std::size_t count = 1;
  for (text.remove_prefix(2); !text.empty() && text[0] >= '0' && text[0] <= '9';) {
    std::size_t extent = 0;
    text.remove_prefix(static_cast<std::size_t>(
        std::from_chars(text.data(), text.data() + text.size(), extent).ptr - text.data()));
    count *= extent;
    text.remove_prefix(text.starts_with(',') ? 1 : 0);
  }
  return count;
}

/// Understands '<u4' and [('draw','<u4'),('depth','<u4',(4,)),...], the dtypes that a run writes.
std::vector<Field> parse_descr(const std::string& descr, const std::string& file) {
  std::vector<Field> fields;
  std::size_t offset = 0;
  const auto add = [&](std::string name, const std::string& type, std::size_t count) {
    if (type.size() != 3 || std::strchr("uif", type[1]) == nullptr ||
        std::strchr("1248", type[2]) == nullptr || count == 0) {
      throw InputError(fmt::format("{}: dtype {} is not one that a run writes", file, descr));
    }
    const auto size = static_cast<std::size_t>(type[2] - '0');
    fields.push_back({std::move(name), type[1], size, count, offset});
    offset += size * count;
  };
  std::vector<std::string> quoted;
  for (std::size_t at = descr.find('\''); at != std::string::npos; at = descr.find('\'', at)) {
    const std::size_t end = descr.find('\'', at + 1);
    if (end == std::string::npos) {
      break;
    }
    quoted.push_back(descr.substr(at + 1, end - at - 1));
    at = end + 1;
    if (quoted.size() % 2 == 0) {
      add(quoted[quoted.size() - 2], quoted.back(), values_of(std::string_view(descr).substr(at)));
    }
  }
  if (quoted.size() == 1) {
    add("", quoted[0], 1);
  }
  if (fields.empty()) {
    throw InputError(fmt::format("{}: dtype {} is not one that a run writes", file, descr));
  }
  return fields;
}

std::string value_text(const Field& field, const std::byte* record, std::size_t index) {
  const std::byte* at = record + field.offset + index * field.size;
  if (field.kind == 'f' && field.size == 4) {
    float value = 0;
    std::memcpy(&value, at, 4);
    return fmt::format("{:.9g}", value);
  }
  std::uint64_t value = 0;
  std::memcpy(&value, at, field.size);
  if (field.kind == 'i') {
    const std::size_t above = 64 - 8 * field.size;
    return std::to_string(static_cast<std::int64_t>(value << above) >> above);
  }
  return std::to_string(value);
}

/// "draw 3, triangle 17, x 8, y 4": what identifies a record, from the fields that come first.
std::string identity(const std::vector<Field>& fields, const std::byte* record) {
  std::string text;
  for (const Field& field : fields) {
    if (field.name == "draw" || field.name == "triangle" || field.name == "x" || field.name == "y" ||
        field.name == "size" || field.name == "sample") {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", field.name, value_text(field, record, 0));
    }
  }
  return text;
}

std::string place(const NpyArray& array, const std::vector<Field>& fields, std::size_t index,
                  const std::byte* record) {
  if (array.shape.size() == 2) {
    return fmt::format("pixel ({}, {})", index % array.shape[1], index / array.shape[1]);
  }
  if (array.shape.size() == 3) {
    const std::size_t row = index / array.shape[2];
    return fmt::format("sample {} of pixel ({}, {})", row / array.shape[1], index % array.shape[2],
                       row % array.shape[1]);
  }
  return fmt::format("record {} ({})", index, identity(fields, record));
}

std::uint64_t element_count(const NpyArray& array) {
  std::uint64_t count = 1;
  for (const std::uint64_t extent : array.shape) {
    count *= extent;
  }
  return count;
}

/// Sets field `name`, where there is one, of every record to 0.
void blank(const std::string& name, const std::vector<Field>& fields, std::size_t record_size,
           NpyArray& array) {
  for (const Field& field : fields) {
    for (std::size_t at = field.offset; field.name == name && at < array.data.size(); at += record_size) {
      std::memset(array.data.data() + at, 0, field.size * field.count);
    }
  }
}

std::optional<FileDifference> compare_arrays(const fs::path& a_path, const fs::path& b_path, bool with_time) {
  const std::string name = a_path.filename().string();
  NpyArray a = read_npy(a_path);
  NpyArray b = read_npy(b_path);
  if (a.descr != b.descr || a.shape.size() != b.shape.size() || (a.shape.size() >= 2 && a.shape != b.shape)) {
    return FileDifference{name, 1, fmt::format("dtype or shape: {} and {}", a.descr, b.descr)};
  }
  const std::vector<Field> fields = parse_descr(a.descr, a_path.string());
  const std::size_t size = fields.back().offset + fields.back().size * fields.back().count;
  for (const auto& [array, path] : {std::pair{&a, &a_path}, std::pair{&b, &b_path}}) {
    if (array->data.size() != size * element_count(*array)) {
      throw InputError(fmt::format("{}: holds {} bytes, not the {} elements of {} bytes of its header",
                                   path->string(), array->data.size(), element_count(*array), size));
    }
  }
  if (!with_time) {
    blank("cycle", fields, size, a);
    blank("cycle", fields, size, b);
  }
  const std::size_t common = std::min(a.data.size(), b.data.size()) / size;
  FileDifference difference{.file = name, .count = 0, .first = ""};
  for (std::size_t i = 0; i < common; ++i) {
    const std::byte* left = a.data.data() + i * size;
    const std::byte* right = b.data.data() + i * size;
    if (std::memcmp(left, right, size) == 0) {
      continue;
    }
    if (difference.count++ != 0) {
      continue;
    }
    for (const Field& field : fields) {
      for (std::size_t k = 0; k < field.count; ++k) {
        const std::string l = value_text(field, left, k);
        const std::string r = value_text(field, right, k);
        if (difference.first.empty() && l != r) {
          const std::string index = field.count > 1 ? fmt::format("[{}]", k) : "";
          const std::string label = field.name.empty() ? "value" : field.name + index;
          difference.first = fmt::format("{}: {} {} and {}", place(a, fields, i, left), label, l, r);
        }
      }
    }
  }
  if (a.data.size() != b.data.size()) {
    const std::size_t more = std::max(a.data.size(), b.data.size()) / size - common;
    const NpyArray& longer = a.data.size() > b.data.size() ? a : b;
    if (difference.count == 0) {
      difference.first =
          fmt::format("{} is only in {}", place(longer, fields, common, longer.data.data() + common * size),
                      &longer == &a ? "the first" : "the second");
    }
    difference.count += more;
  }
  return difference.count == 0 ? std::nullopt : std::optional(difference);
}

StatsJson read_stats(const fs::path& folder) {
  std::ifstream file(folder / kStatsFile);
  StatsJson stats = StatsJson::parse(file, nullptr, false);
  if (!stats.is_object() || stats.value("schema", "") != kStatsSchema ||
      stats.value("schema_version", 0) != kStatsSchemaVersion || !stats["files"].is_array()) {
    throw InputError(fmt::format("{}: is not the result of a run (no {} of schema {} version {})",
                                 folder.string(), kStatsFile, kStatsSchema, kStatsSchemaVersion));
  }
  return stats;
}

bool frame_has(const StatsJson& stats, const char* part) {
  return !stats.value("frame", StatsJson::object()).value(part, StatsJson()).is_null();
}

/// Time is compared where both have it.
bool has_time(const StatsJson& stats) { return frame_has(stats, "time"); }

/// Of the frame and of every draw.
void remove_part(StatsJson& stats, const char* part) {
  stats["frame"].erase(part);
  for (StatsJson& draw : stats["draws"]) {
    draw.erase(part);
  }
}

void remove_time(StatsJson& stats) {
  stats.erase("cycles");
  remove_part(stats, "time");
}

/// Removes from objects, at any depth, what the other does not have.
void keep_common(StatsJson& a, StatsJson& b) {
  if (a.is_array() && b.is_array() && a.size() == b.size()) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      keep_common(a[i], b[i]);
    }
  }
  if (!a.is_object() || !b.is_object()) {
    return;
  }
  const auto keep = [](StatsJson& from, const StatsJson& other) {
    for (auto at = from.begin(); at != from.end();) {
      at = other.contains(at.key()) ? std::next(at) : from.erase(at);
    }
  };
  keep(a, b);
  keep(b, a);
  for (const auto& [key, value] : a.items()) {
    keep_common(value, b[key]);
  }
}

std::optional<FileDifference> compare_stats(StatsJson a, StatsJson b, bool with_time) {
  if (!with_time) {
    remove_time(a);
    remove_time(b);
  }
  if (constexpr const char* kMerging = "quad_merging"; frame_has(a, kMerging) != frame_has(b, kMerging)) {
    remove_part(a, kMerging);
    remove_part(b, kMerging);
  }
  if (a.contains("reference") != b.contains("reference")) {  // a machine counts more
    for (const char* part : {"frame", "surfaces", "draws"}) {
      keep_common(a[part], b[part]);
    }
  }
  std::uint64_t count = 0;
  std::string first;
  for (const char* part : {"frame", "surfaces", "draws", "cycles"}) {
    for (const StatsJson& step : StatsJson::diff(a[part], b[part])) {
      const std::string path = step["path"].get<std::string>();
      if (count++ == 0) {
        const StatsJson::json_pointer at(path);
        const auto text = [&](const StatsJson& json) {
          return json.contains(at) ? json[at].dump() : std::string("nothing");
        };
        first = fmt::format("{}{}: {} and {}", part, path, text(a[part]), text(b[part]));
      }
    }
  }
  return count == 0 ? std::nullopt : std::optional(FileDifference{kStatsFile, count, first});
}

/// Packets come first: where they differ, everything else does too.
int rank(const std::string& file) { return file == "quads.npy" ? 0 : file == "tiles.npy" ? 1 : 2; }

std::set<std::string> arrays_of(const StatsJson& stats) {
  std::set<std::string> names;
  for (const StatsJson& file : stats["files"]) {
    if (file.is_string() && file.get<std::string>().ends_with(".npy")) {
      names.insert(file.get<std::string>());
    }
  }
  return names;
}

}  // namespace

ResultDifference compare_results(const fs::path& a, const fs::path& b) {
  const StatsJson a_stats = read_stats(a);
  const StatsJson b_stats = read_stats(b);
  const std::set<std::string> a_files = arrays_of(a_stats);
  const std::set<std::string> b_files = arrays_of(b_stats);
  const bool with_time = has_time(a_stats) == has_time(b_stats);
  ResultDifference result;
  std::set_intersection(a_files.begin(), a_files.end(), b_files.begin(), b_files.end(),
                        std::back_inserter(result.compared));
  std::set_symmetric_difference(a_files.begin(), a_files.end(), b_files.begin(), b_files.end(),
                                std::back_inserter(result.only_in_one));
  std::stable_sort(result.compared.begin(), result.compared.end(),
                   [](const std::string& l, const std::string& r) { return rank(l) < rank(r); });
  for (const std::string& file : result.compared) {
    if (auto difference = compare_arrays(a / file, b / file, with_time)) {
      result.files.push_back(std::move(*difference));
    }
  }
  result.compared.emplace_back(kStatsFile);
  if (auto difference = compare_stats(a_stats, b_stats, with_time)) {
    result.files.push_back(std::move(*difference));
  }
  return result;
}

}  // namespace halfspace
