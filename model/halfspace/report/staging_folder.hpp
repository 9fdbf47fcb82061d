/// A hidden folder in which a result is made.
#pragma once

#include <filesystem>

namespace halfspace {

/// Beside `place`: ".<name>.halfspace-XXXXXX". It is locked (flock) as long as this lives, so a process that
/// was killed leaves it unlocked; the next one for the same place removes it. It never removes one that is
/// locked, nor where the file system has no locks.
class StagingFolder {
 public:
  /// Throws InputError where it cannot be made.
  explicit StagingFolder(const std::filesystem::path& place);
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;
  /// Removes what is at its path.
  ~StagingFolder();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int folder_ = -1;  ///< open, and locked where that is possible
};

}  // namespace halfspace
