/// Functional coverage of early_z: which bins the bursts of a run have hit.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "early_z/models.hpp"
#include "early_z/workload.hpp"

namespace halfspace::tb {

class ZCoverage {
 public:
  explicit ZCoverage(const EarlyZShape& shape);

  void hit(const std::string& bin) { ++counts_.at(bin); }
  /// What a command alone says.
  void command(const Command& command);

  /// In percent.
  [[nodiscard]] double percent() const;
  /// Prints the bins that nothing has hit.
  void report() const;

 private:
  void late(const LateWrite& late);

  std::map<std::string, std::uint64_t> counts_;
};

}  // namespace halfspace::tb
