#include "halfspace/report/output_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "halfspace/numerics/error.hpp"
#include "halfspace/report/error_table.hpp"
#include "halfspace/report/ledger_files.hpp"
#include "halfspace/report/stats.hpp"

namespace halfspace {
namespace {

namespace fs = std::filesystem;

/// Whether every entry of the folder was written by one run, as the list in `index` says.
bool is_result(const fs::path& folder, const char* index, const char* schema) {
  std::ifstream file(folder / index);
  const nlohmann::json list = nlohmann::json::parse(file, nullptr, false);
  if (!list.is_object() || list.value("schema", "") != schema || !list["files"].is_array()) {
    return false;
  }
  const auto names = list["files"].get<std::set<std::string>>();
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!entry.is_regular_file() || names.count(entry.path().filename().string()) == 0) {
      return false;
    }
  }
  return true;
}

/// Of a run, a bench or a ledger.
bool is_result(const fs::path& folder) {
  return is_result(folder, kStatsFile, kStatsSchema) || is_result(folder, kErrorFile, kErrorSchema) ||
         is_result(folder, kLedgerFile, kLedgerSchema);
}

/// Without a slash at its end. Throws InputError where it is a file or holds other files.
fs::path checked(const fs::path& given) {
  fs::path place = fs::absolute(given).lexically_normal();
  if (!place.has_filename()) {
    place = place.parent_path();
  }
  std::error_code error;
  if (fs::exists(place, error) && !fs::is_directory(place, error)) {
    throw InputError(fmt::format("{}: is a file; the output must be a folder", given.string()));
  }
  if (fs::is_directory(place, error) && !fs::is_empty(place, error) && !is_result(place)) {
    throw InputError(fmt::format(
        "{}: holds files that are not of an earlier run; name a new or an empty folder", given.string()));
  }
  fs::create_directories(place.parent_path(), error);
  return place;
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& place) : place_(checked(place)), staging_(place_) {}

fs::path OutputFolder::file(const std::string& name) {
  files_.push_back(name);
  return staging_.path() / name;
}

void OutputFolder::write(const std::string& name, const std::string& text) {
  const fs::path path = file(name);
  std::ofstream stream(path);
  stream << text;
  stream.close();
  if (!stream) {
    throw InputError(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(errno)));
  }
}

void OutputFolder::commit() {
  // Exchanging is one step for anybody who looks; what was there before is then removed under the staging
  // name.
  const bool replace = fs::exists(place_);
  const unsigned flags = replace ? RENAME_EXCHANGE : RENAME_NOREPLACE;
  if (renameat2(AT_FDCWD, staging_.path().c_str(), AT_FDCWD, place_.c_str(), flags) != 0) {
    throw InputError(fmt::format("{}: cannot be put in place: {}", place_.string(), std::strerror(errno)));
  }
}

}  // namespace halfspace
