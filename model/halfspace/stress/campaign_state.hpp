/// The state of a campaign as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "halfspace/stress/campaign.hpp"

namespace halfspace::stress {

nlohmann::json to_json(const CampaignState& state);

/// Throws nlohmann's exceptions where it is not one.
CampaignState campaign_state(const nlohmann::json& json);

}  // namespace halfspace::stress
