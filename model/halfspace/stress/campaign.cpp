#include "halfspace/stress/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <fstream>
#include <iterator>

#include "halfspace/numerics/error.hpp"
#include "halfspace/stress/campaign_state.hpp"

namespace halfspace::stress {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kKeptWrong = 3;  // cases of a family that are kept to look at
constexpr double kSaveSeconds = 2;     // at most so much work is lost

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void check_size(const Picture& picture, const Frame& frame, int samples) {
  const Target& target = frame.targets.front();
  const std::size_t values = std::size_t{target.width} * target.height * static_cast<std::size_t>(samples);
  if (picture.width != target.width || picture.height != target.height ||
      picture.fragments.size() != values || picture.survivors.size() != values ||
      picture.codes.size() != values) {
    throw InputError(fmt::format("the picture is {}x{}; it must be that of its frame, {}x{}{}", picture.width,
                                 picture.height, target.width, target.height,
                                 samples > 1 ? fmt::format(" with {} samples a pixel", samples) : ""));
  }
}

Finding draw_and_judge(const CampaignPlan& plan, const Family& family, std::uint64_t index,
                       Subject& subject) {
  const Case made = make_case(family, plan.precision, plan.seed, index);
  Finding finding{.index = index};
  try {
    const Picture picture = subject.draw(made.frame);
    check_size(picture, made.frame, plan.precision.samples.count);
    Picture twin;
    if (made.twin) {
      twin = subject.draw(made.twin->frame);
      check_size(twin, made.twin->frame, plan.precision.samples.count);
    }
    finding.tally = judge(made, plan.precision, plan.depth, picture, made.twin ? &twin : nullptr);
  } catch (const std::exception& error) {
    finding.error = error.what();
    finding.tally = {.cases = 1, .failed = 1};
  }
  return finding;
}

CampaignState fresh_state(const CampaignPlan& plan, const Subject& subject) {
  CampaignState state{.subject = subject.name(), .precision = to_text(plan.precision), .seed = plan.seed};
  for (const Family* family : plan.families) {
    state.families.push_back({.family = std::string(family->name)});
  }
  return state;
}

/// The state that the folder holds, or a fresh one.
CampaignState found_state(const CampaignPlan& plan, const Subject& subject) {
  CampaignState state = fresh_state(plan, subject);
  const std::filesystem::path path = plan.folder / kStateFile;
  if (plan.folder.empty() || !std::filesystem::exists(path)) {
    return state;
  }
  CampaignState found;
  try {
    std::ifstream in(path);
    found = campaign_state(nlohmann::json::parse(in));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{} is not the state of a campaign: {}", path.string(), error.what()));
  }
  const auto names = [](const CampaignState& of) {
    std::string all;
    for (const FamilyState& family : of.families) {
      all += (all.empty() ? "" : ",") + family.family;
    }
    return all;
  };
  const auto refuse = [&](std::string_view what, const auto& there, const auto& here) {
    if (there != here) {
      throw OptionError(
          fmt::format("{}: the campaign's {} is '{}'; it must be '{}', or the folder another one",
                      path.string(), what, here, there));
    }
  };
  refuse("subject", found.subject, state.subject);
  refuse("precision", found.precision, state.precision);
  refuse("seed", found.seed, state.seed);
  refuse("families", names(found), names(state));
  return found;
}

/// Whole or not at all.
void save(const CampaignState& state, const std::filesystem::path& folder) {
  if (folder.empty()) {
    return;
  }
  const std::filesystem::path path = folder / kStateFile;
  std::filesystem::path staging = path;
  staging += ".new";
  std::ofstream out(staging);
  out << to_json(state).dump(1) << '\n';
  out.close();
  std::error_code error;
  std::filesystem::rename(staging, path, error);
  if (!out || error) {
    throw InputError(fmt::format("{} cannot be written", path.string()));
  }
}

void take(const Finding& finding, FamilyState& family) {
  family.next = finding.index + 1;
  family.tally += finding.tally;
  if (finding.tally.errors() != 0 && family.wrong.size() < kKeptWrong) {
    family.wrong.push_back(finding);
  }
  const double worst = family.worst_depth ? family.worst_depth->tally.worst_share : 0;
  if (finding.tally.worst_share > worst) {
    family.worst_depth = finding;
  }
}

}  // namespace

Tally CampaignState::sum() const {
  Tally sum;
  for (const FamilyState& family : families) {
    sum += family.tally;
  }
  return sum;
}

CampaignState run_campaign(const CampaignPlan& plan, Subject& subject,
                           const std::function<void(const CampaignState&)>& progress) {
  if (!plan.folder.empty()) {
    std::error_code error;
    std::filesystem::create_directories(plan.folder, error);
    if (error) {
      throw InputError(fmt::format("{} cannot be written: {}", plan.folder.string(), error.message()));
    }
  }
  CampaignState state = found_state(plan, subject);
  ++state.sittings;
  const double before = state.seconds;
  const auto start = Clock::now();
  auto saved = start;
  const std::uint64_t share = plan.samples / std::max<std::size_t>(plan.families.size(), 1);
  const auto enough = [&](const FamilyState& family) {
    // A case without a sample would never be enough of them.
    return std::max(family.tally.samples, family.tally.cases) >= share || family.tally.cases >= plan.cases;
  };
  bool more = true;
  while (more) {
    more = false;
    for (std::size_t i = 0; i < plan.families.size(); ++i) {
      FamilyState& family = state.families[i];
      if (!enough(family) && seconds_since(start) < plan.seconds) {
        take(draw_and_judge(plan, *plan.families[i], family.next, subject), family);
        more = true;
      }
    }
    state.seconds = before + seconds_since(start);
    if (seconds_since(saved) > kSaveSeconds) {
      save(state, plan.folder);
      saved = Clock::now();
    }
    progress(state);
  }
  save(state, plan.folder);
  return state;
}

}  // namespace halfspace::stress
