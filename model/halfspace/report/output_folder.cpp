#include "halfspace/report/output_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
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

}  // namespace

OutputFolder::OutputFolder(const fs::path& place) : place_(fs::absolute(place).lexically_normal()) {
  if (!place_.has_filename()) {
    place_ = place_.parent_path();
  }
  std::error_code error;
  if (fs::exists(place_, error) && !fs::is_directory(place_, error)) {
    throw InputError(fmt::format("{}: is a file; the output must be a folder", place.string()));
  }
  if (fs::is_directory(place_, error) && !fs::is_empty(place_, error) && !is_result(place_)) {
    throw InputError(fmt::format(
        "{}: holds files that are not of an earlier run; name a new or an empty folder", place.string()));
  }
  fs::create_directories(place_.parent_path(), error);
  std::string pattern =
      (place_.parent_path() / fmt::format(".{}.XXXXXX", place_.filename().string())).string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw InputError(fmt::format("{}: cannot be made: {}", place.string(), std::strerror(errno)));
  }
  staging_ = pattern;
  fs::permissions(staging_, fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec |
                                fs::perms::others_read | fs::perms::others_exec);
}

OutputFolder::~OutputFolder() {
  std::error_code error;
  fs::remove_all(staging_, error);
}

fs::path OutputFolder::file(const std::string& name) {
  files_.push_back(name);
  return staging_ / name;
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
  if (renameat2(AT_FDCWD, staging_.c_str(), AT_FDCWD, place_.c_str(), flags) != 0) {
    throw InputError(fmt::format("{}: cannot be put in place: {}", place_.string(), std::strerror(errno)));
  }
}

}  // namespace halfspace
