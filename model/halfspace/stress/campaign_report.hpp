/// What a campaign leaves for people: a page, and each case to look at as a frame with a picture.
#pragma once

#include <filesystem>
#include <string>

#include "halfspace/report/pictures.hpp"
#include "halfspace/stress/campaign.hpp"

namespace halfspace::stress {

/// The page, in Markdown.
std::string report_page(const CampaignPlan& plan, const CampaignState& state);

/// Pixels as squares: grey where the fragments are as expected, red where some are missing, blue where there
/// are too many, white where nothing is said. Brighter with more fragments.
halfspace::Picture coverage_picture(const Case& made, const Precision& precision, const Picture& picture);

/// How far depths are off: from black, exact, to white, the bound; red beyond it, blue where nothing is said.
halfspace::Picture depth_picture(const Case& made, const CampaignPlan& plan, const Picture& picture);

/// report.md, and in the folder `cases` NAME.ptf.xz and NAME.png for each case that is worth a look, and
/// NAME-depth.png where its depth is judged. Throws InputError.
void write_report(const CampaignPlan& plan, const CampaignState& state, Subject& subject);

}  // namespace halfspace::stress
