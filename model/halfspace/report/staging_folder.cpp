#include "halfspace/report/staging_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

namespace fs = std::filesystem;

/// What mkdtemp() replaces.
constexpr std::string_view kUnique = "XXXXXX";

std::string prefix_of(const fs::path& place) {
  return fmt::format(".{}.halfspace-", place.filename().string());
}

int open_folder(const fs::path& path) {
  return open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

bool lock(int folder) { return flock(folder, LOCK_EX | LOCK_NB) == 0; }

/// Whether the open folder is still what the path names.
bool is_at(int folder, const fs::path& path) {
  struct stat opened {};
  struct stat named {};
  return fstat(folder, &opened) == 0 && stat(path.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

/// Removes the folders of processes that are no more.
void remove_left_over(const fs::path& place) {
  const std::string prefix = prefix_of(place);
  std::error_code error;
  for (fs::directory_iterator entry(place.parent_path(), error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(prefix) || name.size() != prefix.size() + kUnique.size()) {
      continue;
    }
    const int folder = open_folder(entry->path());
    if (folder < 0) {
      continue;
    }
    if (lock(folder)) {
      std::error_code ignored;
      fs::remove_all(entry->path(), ignored);
    }
    close(folder);
  }
}

}  // namespace

StagingFolder::StagingFolder(const fs::path& place) {
  remove_left_over(place);
  while (true) {
    std::string pattern = (place.parent_path() / prefix_of(place)).string() + std::string(kUnique);
    const bool made = mkdtemp(pattern.data()) != nullptr;
    folder_ = made ? open_folder(pattern) : -1;
    // Until it is locked, another process may take the folder for one that was left behind, and remove it.
    const bool removed = made && folder_ < 0 && errno == ENOENT;
    if (folder_ < 0 && !removed) {
      throw InputError(fmt::format("{}: cannot be made: {}", place.string(), std::strerror(errno)));
    }
    if (removed) {
      continue;
    }
    path_ = pattern;
    const bool taken = !lock(folder_) && errno == EWOULDBLOCK;
    if (!taken && is_at(folder_, path_)) {
      break;
    }
    close(folder_);
  }
  fs::permissions(path_, fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec |
                             fs::perms::others_read | fs::perms::others_exec);
}

StagingFolder::~StagingFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
  close(folder_);
}

}  // namespace halfspace
