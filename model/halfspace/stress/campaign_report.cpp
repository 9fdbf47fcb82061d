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

using Colour = std::array<std::uint8_t, 3>;

/// A picture of squares, one for each pixel; colour(pixel) is its colour.
template <class ColourOf>
halfspace::Picture zoomed(const Picture& picture, const ColourOf& colour) {
  const std::size_t rows = picture.fragments.size() / picture.width;  // samples below each other
  halfspace::Picture image(static_cast<int>(picture.width) * kZoom, static_cast<int>(rows) * kZoom);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      image.at(x, y) =
          colour(static_cast<std::size_t>(y / kZoom) * picture.width + static_cast<std::size_t>(x / kZoom));
    }
  }
  return image;
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
      "blue too many, white not judged. Where depth is judged a second picture has how far it is off: from "
      "black, exact, to white, its bound; red is beyond it, blue not judged.\n\n";
  for (const FamilyState& family : state.families) {
    each_finding(family, [&](const Finding& finding) {
      page += fmt::format("- `{}`: {}\n", case_name(plan, family, finding), errors_of(finding));
    });
  }
  return page;
}

halfspace::Picture coverage_picture(const Case& made, const Precision& precision, const Picture& picture) {
  const std::vector<std::int32_t> expected = expected_fragments(made, precision);
  return zoomed(picture, [&](std::size_t at) -> Colour {
    const std::int64_t got = picture.fragments[at];
    const std::int64_t wanted = made.partition ? 1 : at < expected.size() ? expected[at] : kUncertain;
    if (wanted == kUncertain) {
      return {255, 255, 255};
    }
    if (got != wanted) {
      return got < wanted ? Colour{255, 0, 0} : Colour{0, 0, 255};
    }
    const auto grey = static_cast<std::uint8_t>(255 - 255 / (got + 1));
    return {grey, grey, grey};
  });
}

halfspace::Picture depth_picture(const Case& made, const CampaignPlan& plan, const Picture& picture) {
  const std::vector<double> shares = depth_shares(made, plan.precision, plan.depth, picture);
  return zoomed(picture, [&](std::size_t at) -> Colour {
    const double share = shares[at];
    if (share == kNotJudged) {
      return {0, 0, 128};
    }
    if (share > 1) {
      return {255, 0, 0};
    }
    const auto grey = static_cast<std::uint8_t>(255 * share);
    return {grey, grey, grey};
  });
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
        const Picture picture = subject.draw(made.frame);
        write_png(cases / (name + ".png"), coverage_picture(made, plan.precision, picture));
        if (made.depth) {
          write_png(cases / (name + "-depth.png"), depth_picture(made, plan, picture));
        }
      }
    });
  }
  write(plan.folder / "report.md", report_page(plan, state));
}

}  // namespace halfspace::stress
