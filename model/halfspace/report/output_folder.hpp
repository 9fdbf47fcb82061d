/// A folder of results that appears whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "halfspace/report/staging_folder.hpp"

namespace halfspace {

/// Files are written to a hidden folder beside the final one, which commit() puts in place. Without commit()
/// nothing is left behind; what a process leaves that is killed, the next one removes. An earlier result at
/// the place is replaced as a whole; a folder that holds anything else is refused.
class OutputFolder {
 public:
  /// Throws InputError when the place cannot be written or holds other files.
  explicit OutputFolder(const std::filesystem::path& place);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  ~OutputFolder() = default;

  /// The path to write file `name` to; it becomes part of the result.
  std::filesystem::path file(const std::string& name);

  /// Writes file `name`. Throws InputError.
  void write(const std::string& name, const std::string& text);

  [[nodiscard]] const std::vector<std::string>& files() const { return files_; }

  /// Puts the result in place. Throws InputError.
  void commit();

 private:
  std::filesystem::path place_;
  StagingFolder staging_;
  std::vector<std::string> files_;
};

}  // namespace halfspace
