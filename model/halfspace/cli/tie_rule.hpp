/// The fill rule of a configuration as the references name it.
#pragma once

#include <optional>

#include "halfspace/config/config.hpp"
#include "halfspace/reference/tie_rule.hpp"

namespace halfspace {

/// None: that of each draw.
inline std::optional<reference::TieRule> tie_rule(const Config& config) {
  switch (config.setup.fill_rule) {
    case FillRuleKey::kDraw:
      break;
    case FillRuleKey::kTopLeft:
      return reference::TieRule::kTopLeft;
    case FillRuleKey::kBottomLeft:
      return reference::TieRule::kBottomLeft;
    case FillRuleKey::kTopRight:
      return reference::TieRule::kTopRight;
    case FillRuleKey::kBottomRight:
      return reference::TieRule::kBottomRight;
    case FillRuleKey::kNormalSign:
      return reference::TieRule::kNormalSign;
  }
  return std::nullopt;
}

}  // namespace halfspace
