#include "halfspace/cli/stress_sharpness.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "halfspace/reference/methods.hpp"
#include "halfspace/stress/reference_subject.hpp"
#include "halfspace/stress/wrong_rasterizer.hpp"

namespace halfspace {
namespace {

stress::CampaignState run(const stress::CampaignPlan& plan, stress::Subject& subject) {
  return stress::run_campaign(plan, subject, [](const auto&) {});
}

/// "repository#number" of the address of an issue or a pull request.
std::string short_address(std::string_view address) {
  std::vector<std::string> parts{""};
  for (const char c : address) {
    if (c == '/') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  const std::size_t n = parts.size();
  return fmt::format("{} #{}", parts[n - 3], parts[n - 1]);
}

}  // namespace

bool print_sharpness(const stress::CampaignPlan& plan) {
  stress::CampaignPlan scenes = plan;
  scenes.families.clear();
  for (const stress::Family& scene : stress::reports()) {
    scenes.families.push_back(&scene);
  }
  const bool whole = plan.families.size() == stress::families().size();
  bool all_found = true;
  fmt::print("| rasterizer | what is wrong | errors | families that find it |\n|---|---|---:|---|\n");
  for (const stress::WrongRasterizer& wrong : stress::wrong_rasterizers()) {
    const std::unique_ptr<stress::Subject> subject = stress::wrong_subject(wrong, plan.precision);
    stress::CampaignState state = run(plan, *subject);
    const bool by_families = state.sum().errors() != 0;
    if (!by_families && whole) {
      state = run(scenes, *subject);
    }
    std::vector<std::string> found;
    for (const stress::FamilyState& family : state.families) {
      if (family.tally.errors() != 0) {
        found.push_back(family.family);
      }
    }
    all_found &= !found.empty();
    fmt::print("| `{}` | {} | {} | {}{} |\n", wrong.name, wrong.wrong, state.sum().errors(),
               found.empty() ? "**none**"
               : by_families ? ""
                             : "only scenes of reports: ",
               fmt::join(found, ", "));
  }
  return all_found;
}

bool print_report_sharpness(const stress::CampaignPlan& plan) {
  std::vector<std::vector<std::string>> failing(plan.families.size());
  const auto add = [&](std::string_view name, stress::Subject& subject) {
    const stress::CampaignState state = run(plan, subject);
    for (std::size_t i = 0; i < failing.size(); ++i) {
      if (state.families[i].tally.errors() != 0) {
        failing[i].emplace_back(name);
      }
    }
  };
  for (const reference::Method& method : reference::methods()) {
    add(method.name, *stress::reference_subject(method.name, plan.precision));
  }
  for (const stress::WrongRasterizer& wrong : stress::wrong_rasterizers()) {
    if (std::ranges::none_of(reference::methods(),
                             [&](const auto& method) { return method.name == wrong.name; })) {
      add(wrong.name, *stress::wrong_subject(wrong, plan.precision));
    }
  }
  bool all_found = true;
  fmt::print(
      "| scene | report | what it draws | law | who fails as reported | others that fail |\n"
      "|---|---|---|---|---|---|\n");
  for (std::size_t i = 0; i < failing.size(); ++i) {
    const stress::Family& scene = *plan.families[i];
    const auto suspect = std::ranges::find(failing[i], scene.suspect);
    const bool found = suspect != failing[i].end();
    if (found) {
      failing[i].erase(suspect);
    }
    all_found &= found;
    fmt::print("| `{}` | [{}]({}) | {} | {} | {} | {} |\n", scene.name, short_address(scene.report),
               scene.report, scene.looks, scene.law, found ? fmt::format("`{}`", scene.suspect) : "**none**",
               fmt::join(failing[i], ", "));
  }
  return all_found;
}

}  // namespace halfspace
