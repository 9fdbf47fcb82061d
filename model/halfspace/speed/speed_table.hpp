/// Speed: what rasterizers take for the same frames, measured in turns, and how ours compare with yardsticks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/numerics/depth.hpp"

namespace halfspace {

inline constexpr const char* kSpeedSchema = "halfspace-speed";
inline constexpr int kSpeedSchemaVersion = 1;

/// Something that rasterizes. A column of the table.
struct Contender {
  std::string name;        ///< as in the table, with _ for spaces
  bool yardstick = false;  ///< not ours: the others are compared with it
  std::string about;       ///< what it is; where it is absent, why
  bool absent = false;     ///< it is not measured
};

/// A contender on a workload.
struct ContenderRun {
  std::vector<double> milliseconds;  ///< of each pass; empty where it is absent
  std::uint64_t survivors = 0;       ///< fragments that passed the depth test
};

/// The middle one of some numbers, and the least and the greatest.
struct Spread {
  double median = 0;
  double least = 0;
  double most = 0;
};
Spread spread(std::vector<double> numbers);

/// A workload.
struct SpeedRow {
  std::string name;
  DepthFormat depth = DepthFormat::kNone;  ///< of the first target that has depth
  std::uint64_t triangles = 0;
  std::uint64_t fragments = 0;
  std::uint64_t quads = 0;
  std::vector<ContenderRun> runs;  ///< by contender
};

struct SpeedTable {
  Config config;
  int repeat = 0;
  int threads = 1;                    ///< of ours
  std::vector<Contender> contenders;  ///< ours first
  std::vector<SpeedRow> rows;

  /// How many times as fast as contender `yardstick` contender `ours` is: passes are compared one by one, so
  /// that a drift of the machine's speed falls out. Neither may be absent.
  [[nodiscard]] Spread times_as_fast(const SpeedRow& row, std::size_t ours, std::size_t yardstick) const;
};

/// "AMD EPYC ...", as the system says, or "unknown".
std::string processor_name();

/// "one thread", "2 threads".
std::string threads_text(int threads);

/// A line on how it was measured, an empty line, and a table.
std::string speed_markdown(const SpeedTable& table);

/// A line for each workload.
std::string speed_csv(const SpeedTable& table);

/// With the time of every pass.
std::string speed_json(const SpeedTable& table);

}  // namespace halfspace
