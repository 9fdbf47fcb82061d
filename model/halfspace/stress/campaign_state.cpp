#include "halfspace/stress/campaign_state.hpp"

namespace halfspace::stress {
namespace {

nlohmann::json to_json(const Tally& tally) {
  nlohmann::json json;
#define FIELD(name, is_error, meaning) json[#name] = tally.name;
  HALFSPACE_STRESS_TALLY(FIELD)
#undef FIELD
  json["worst_ulps"] = tally.worst_ulps;
  json["worst_share"] = tally.worst_share;
  return json;
}

Tally tally_of(const nlohmann::json& json) {
  Tally tally;
#define FIELD(name, is_error, meaning) json.at(#name).get_to(tally.name);
  HALFSPACE_STRESS_TALLY(FIELD)
#undef FIELD
  json.at("worst_ulps").get_to(tally.worst_ulps);
  json.at("worst_share").get_to(tally.worst_share);
  return tally;
}

nlohmann::json to_json(const Finding& finding) {
  return {{"case", finding.index}, {"tally", to_json(finding.tally)}, {"error", finding.error}};
}

Finding finding_of(const nlohmann::json& json) {
  return {.index = json.at("case"), .tally = tally_of(json.at("tally")), .error = json.at("error")};
}

}  // namespace

nlohmann::json to_json(const CampaignState& state) {
  nlohmann::json families = nlohmann::json::array();
  for (const FamilyState& family : state.families) {
    nlohmann::json json{{"family", family.family}, {"next", family.next}, {"tally", to_json(family.tally)}};
    json["wrong"] = nlohmann::json::array();
    for (const Finding& finding : family.wrong) {
      json["wrong"].push_back(to_json(finding));
    }
    if (family.worst_depth) {
      json["worst_depth"] = to_json(*family.worst_depth);
    }
    families.push_back(json);
  }
  return {{"schema", 2},
          {"subject", state.subject},
          {"precision", state.precision},
          {"seed", state.seed},
          {"sittings", state.sittings},
          {"seconds", state.seconds},
          {"sum", to_json(state.sum())},
          {"families", families}};
}

CampaignState campaign_state(const nlohmann::json& json) {
  CampaignState state{.subject = json.at("subject"),
                      .precision = json.at("precision"),
                      .seed = json.at("seed"),
                      .sittings = json.at("sittings"),
                      .seconds = json.at("seconds")};
  for (const nlohmann::json& family : json.at("families")) {
    FamilyState& to = state.families.emplace_back();
    to.family = family.at("family");
    to.next = family.at("next");
    to.tally = tally_of(family.at("tally"));
    for (const nlohmann::json& finding : family.at("wrong")) {
      to.wrong.push_back(finding_of(finding));
    }
    if (family.contains("worst_depth")) {
      to.worst_depth = finding_of(family.at("worst_depth"));
    }
  }
  return state;
}

}  // namespace halfspace::stress
