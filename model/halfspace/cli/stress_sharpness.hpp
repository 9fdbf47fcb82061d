/// How sharp the stress campaign is: tables of who is found wrong where.
#pragma once

#include "halfspace/stress/campaign.hpp"

namespace halfspace {

/// Runs the campaign on every rasterizer that is wrong on purpose, and prints which families find it; where
/// none of all families does, which scenes of reports. Returns whether all are found.
bool print_sharpness(const stress::CampaignPlan& plan);

/// The same on the textbook rasterizers too, by the scene of a report: which of them show what was reported.
/// Returns whether each scene finds its suspect.
bool print_report_sharpness(const stress::CampaignPlan& plan);

}  // namespace halfspace
