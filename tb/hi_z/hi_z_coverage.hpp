/// Functional coverage of hi_z: what the runs of a bench have met, in bins that its configuration can meet.
#pragma once

#include <cstdint>
#include <string>

#include "common/bins.hpp"
#include "hi_z/models.hpp"

namespace halfspace::tb {

class HiZCoverage {
 public:
  explicit HiZCoverage(const HiZShape& shape);

  void hit(const std::string& name) { bins_.hit(name); }
  [[nodiscard]] bool report() const { return bins_.report(); }

 private:
  Bins bins_;
};

}  // namespace halfspace::tb
