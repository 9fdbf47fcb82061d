#include "halfspace/study/precision/depth_report.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "halfspace/study/precision/depth_measure.hpp"

namespace halfspace::study {
namespace {

using nlohmann::ordered_json;

/// The same family on several targets.
ordered_json family_report(std::span<const DepthFamily> targets, std::uint64_t samples, std::uint64_t seed) {
  const auto& subjects = depth_subjects();
  ordered_json made{{"name", targets.front().name}, {"looks", targets.front().looks}};
  for (const DepthFormat format : {DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32}) {
    std::vector<std::vector<float>> errors(subjects.size());
    for (const DepthFamily& target : targets) {
      const auto more = depth_errors(target, format, samples / targets.size() + 1, seed);
      for (std::size_t i = 0; i < errors.size(); ++i) {
        errors[i].insert(errors[i].end(), more[i].begin(), more[i].end());
      }
    }
    for (std::size_t i = 0; i < errors.size(); ++i) {
      if (!errors[i].empty()) {
        const ErrorSummary sum = summary(errors[i]);
        made["formats"][std::string(name(format))][subjects[i].name] = {
            {"samples", sum.samples}, {"mean", sum.mean}, {"p999", sum.most_of_all}, {"worst", sum.worst}};
      }
    }
  }
  return made;
}

}  // namespace

ordered_json depth_report(std::uint64_t samples, std::uint64_t seed,
                          std::span<const std::filesystem::path> frames) {
  ordered_json made;
  for (const DepthSubject& subject : depth_subjects()) {
    made["arithmetics"].push_back({{"name", subject.name},
                                   {"computes", subject.computes},
                                   {"kind", subject.kind},
                                   {"bits", subject.bits},
                                   {"unit", subject.unit}});
  }
  for (const std::vector<DepthFamily>& family : depth_families(seed)) {
    made["families"].push_back(family_report(family, samples, seed));
  }
  made["frames"] = ordered_json::array();
  for (const std::filesystem::path& path : frames) {
    const DepthFamily frame = frame_depths(path);
    made["frames"].push_back(family_report({&frame, 1}, samples, seed));
  }
  return made;
}

}  // namespace halfspace::study
