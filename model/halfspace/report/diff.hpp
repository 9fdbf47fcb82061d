/// Compares the results of two runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace halfspace {

/// What differs in one file.
struct FileDifference {
  std::string file;
  std::uint64_t count = 0;  ///< differing records, elements or counters
  std::string first;        ///< the first of them: place, field and both values
};

struct ResultDifference {
  std::vector<FileDifference> files;  ///< only those that differ, packets first
  std::vector<std::string> compared;
  std::vector<std::string> only_in_one;  ///< not compared: the other run did not write it
};

/// Compares quads.npy, tiles.npy, the arrays of every surface, and the counters and cycles in stats.json (not
/// configuration, tool versions, pictures and timeline). Where only one run has time, what has to do with it
/// is left out, the field `cycle` of the quads too; where only one run is a reference rasterizer's, what only
/// the other counts. Throws InputError where a folder is not a result or a
/// file is damaged.
ResultDifference compare_results(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace halfspace
