#include "halfspace/stress/campaign_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <fstream>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/ptf.hpp"

namespace halfspace::stress {
namespace {

constexpr int kZoom = 8;  // of a pixel in a picture

std::string case_name(const CampaignPlan& plan, const FamilyState& family, const Finding& finding) {
  return fmt::format("{}-{}-{}", family.family, plan.seed, finding.index);
}

/// "3 missing, 1 extra".
std::string errors_of(const Finding& finding) {
  if (!finding.error.empty()) {
    return finding.error;
  }
  std::string text;
  const auto add = [&](std::string_view name, bool is_error, std::uint64_t count) {
    if (is_error && count != 0) {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
    }
  };
#define FIELD(name, is_error, meaning) add(#name, is_error, finding.tally.name);
  HALFSPACE_STRESS_TALLY(FIELD)
#undef FIELD
  return text.empty() ? fmt::format("{:.4g} units off, {:.0f} % of the bound", finding.tally.worst_ulps,
                                    100 * finding.tally.worst_share)
                      : text;
}

/// Calls visit(finding) for each case that is worth a look.
template <class Visit>
void each_finding(const FamilyState& family, const Visit& visit) {
  for (const Finding& finding : family.wrong) {
    visit(finding);
  }
  if (family.worst_depth &&
      std::none_of(family.wrong.begin(), family.wrong.end(),
                   [&](const Finding& finding) { return finding.index == family.worst_depth->index; })) {
    visit(*family.worst_depth);
  }
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out(path);
  out << text;
  out.close();
  if (!out) {
    throw InputError(fmt::format("{} cannot be written", path.string()));
  }
}

}  // namespace

std::string report_page(const CampaignPlan& plan, const CampaignState& state) {
  const Tally sum = state.sum();
  std::string page = fmt::format(
      "# Stress campaign\n\n{}; {}; seed {}. {:.0f} seconds in {} sitting{}.\n\n"
      "{} samples of {} triangles in {} frames: **{} errors**.\n\n",
      state.subject, state.precision, state.seed, state.seconds, state.sittings,
      state.sittings == 1 ? "" : "s", sum.samples, sum.triangles, sum.cases, sum.errors());
  page +=
      "| family | law | frames | triangles | samples | missing | extra | moved | tiles judged | unsound | "
      "mistested | depths | inexact | out of range | worst depth, units | of its bound | failed |\n";
  page += "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const FamilyState& family : state.families) {
    const Tally& t = family.tally;
    page += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.4g} | {:.0f} % | {} |\n",
        family.family, family_of(family.family).law, t.cases, t.triangles, t.samples, t.missing, t.extra,
        t.moved, t.decisions, t.unsound, t.mistested, t.depths, t.inexact, t.out_of_range, t.worst_ulps,
        100 * t.worst_share, t.failed);
  }
  page +=
      "\n## Cases\n\nThe first wrong ones of each family, and the one with the worst depth. Each is a frame "
      "in `cases/` that `halfspace run` takes, with a picture: grey as expected, red fragments missing, "
      "blue too many, white not judged.\n\n";
  for (const FamilyState& family : state.families) {
    each_finding(family, [&](const Finding& finding) {
      page += fmt::format("- `{}`: {}\n", case_name(plan, family, finding), errors_of(finding));
    });
  }
  return page;
}

halfspace::Picture coverage_picture(const Case& made, const Precision& precision, const Picture& picture) {
  const std::vector<std::int32_t> expected = expected_fragments(made, precision);
  halfspace::Picture image(static_cast<int>(picture.width) * kZoom, static_cast<int>(picture.height) * kZoom);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto at =
          static_cast<std::size_t>(y / kZoom) * picture.width + static_cast<std::size_t>(x / kZoom);
      const std::int64_t got = picture.fragments[at];
      const std::int64_t wanted = made.partition ? 1 : at < expected.size() ? expected[at] : kUncertain;
      const auto grey = static_cast<std::uint8_t>(255 - 255 / (got + 1));
      auto& colour = image.at(x, y);
      if (wanted == kUncertain) {
        colour = {255, 255, 255};
      } else if (got < wanted) {
        colour = {255, 0, 0};
      } else if (got > wanted) {
        colour = {0, 0, 255};
      } else {
        colour = {grey, grey, grey};
      }
    }
  }
  return image;
}

void write_report(const CampaignPlan& plan, const CampaignState& state, Subject& subject) {
  const std::filesystem::path cases = plan.folder / "cases";
  std::filesystem::create_directories(cases);
  for (const FamilyState& family : state.families) {
    each_finding(family, [&](const Finding& finding) {
      const Case made = make_case(family_of(family.family), plan.precision, plan.seed, finding.index);
      const std::string name = case_name(plan, family, finding);
      write_ptf(made.frame, cases / (name + ".ptf.xz"));
      if (made.twin) {
        write_ptf(made.twin->frame, cases / (name + "-twin.ptf.xz"));
      }
      if (finding.error.empty()) {
        write_png(cases / (name + ".png"), coverage_picture(made, plan.precision, subject.draw(made.frame)));
      }
    });
  }
  write(plan.folder / "report.md", report_page(plan, state));
}

}  // namespace halfspace::stress
