/// A stress campaign: cases of all families in turns, judged, until there are enough. It can be cut off at
/// any time and goes on where it was.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/stress/family.hpp"
#include "halfspace/stress/judge.hpp"
#include "halfspace/stress/subject.hpp"

namespace halfspace::stress {

struct CampaignPlan {
  std::vector<const Family*> families{};
  Precision precision{};
  DepthLaw depth{};
  std::uint64_t seed = 1;
  std::uint64_t samples = std::numeric_limits<std::uint64_t>::max();  ///< in all, an equal part each family
  std::uint64_t cases = std::numeric_limits<std::uint64_t>::max();    ///< of each family
  double seconds = std::numeric_limits<double>::infinity();           ///< of this sitting
  std::filesystem::path folder{};  ///< of the state, between sittings; empty: none is kept
};

/// A case to look at again.
struct Finding {
  std::uint64_t index = 0;
  Tally tally{};
  std::string error{};  ///< of a case that failed
};

struct FamilyState {
  std::string family{};
  std::uint64_t next = 0;  ///< case that comes next
  Tally tally{};
  std::vector<Finding> wrong{};          ///< the first few
  std::optional<Finding> worst_depth{};  ///< the one whose depth took the greatest part of its bound
};

struct CampaignState {
  std::string subject{};
  std::string precision{};  ///< of the cases, for people
  std::uint64_t seed = 0;
  std::uint64_t sittings = 0;
  double seconds = 0;  ///< of all sittings
  std::vector<FamilyState> families{};

  [[nodiscard]] Tally sum() const;
};

/// Name of the state's file in the campaign's folder.
inline constexpr const char* kStateFile = "state.json";

/// Runs a campaign, or what is left of it. `progress` hears after each turn. Throws InputError where the
/// folder holds another campaign's state, or cannot be written.
CampaignState run_campaign(const CampaignPlan& plan, Subject& subject,
                           const std::function<void(const CampaignState&)>& progress);

}  // namespace halfspace::stress
