/// Functional coverage of setup's bench: what the triangles were and what the stages did, in stated bins.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "job.hpp"

namespace halfspace::tb {

/// What happens at the head of the queue in a cycle.
enum class Decision : std::uint8_t { kDropped, kDrawn, kNoTriangle, kDivider, kNoCredit };

class SetupCoverage {
 public:
  explicit SetupCoverage(const SetupModel& model);

  void decision(Decision decision, bool refused);
  void output(bool valid, bool ready, bool full);
  void triangle(const SetupJob& job, const SetupResult& result, const SetupModel& model);

  /// How often each bin was hit that the configuration can reach.
  [[nodiscard]] std::map<std::string, std::uint64_t> bins() const;

 private:
  void add_line_bins();
  void line(const SetupJob& job, const SetupResult& result, const SetupModel& model);
  void hit(const std::string& bin);

  int interval_;
  int queue_;
  std::array<std::array<std::uint64_t, 2>, 5> decisions_{};               ///< by decision and input refused
  std::array<std::array<std::array<std::uint64_t, 2>, 2>, 2> outputs_{};  ///< by valid, ready, FIFO full
  std::map<std::string, std::uint64_t> counts_;  ///< of triangles; what is not in it is not asked for
};

}  // namespace halfspace::tb
