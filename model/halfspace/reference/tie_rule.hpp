/// Tie rules, also called fill rules: which of the samples that lie exactly on an edge belong to a triangle.
#pragma once

#include <array>
#include <string_view>

namespace halfspace::reference {

/// With y down. `kNormalSign` is the rule of M. D. McCool, C. Wales and K. Moule, "Incremental and
/// hierarchical Hilbert order edge equation polygon rasterization", Graphics Hardware 2001, which asks for
/// the sign of the edge's normal (A, B) alone.
enum class TieRule {
  kTopLeft,      ///< left and top edges own their samples (Direct3D, Vulkan)
  kBottomLeft,   ///< left and bottom edges (OpenGL drawing into a texture, seen with row 0 on top)
  kTopRight,     ///< right and top edges
  kBottomRight,  ///< right and bottom edges
  kNormalSign,   ///< edges with A > 0, or A = 0 and B > 0
};

struct TieRuleInfo {
  TieRule rule;
  std::string_view name;
};

inline constexpr std::array<TieRuleInfo, 5> kTieRules = {{{TieRule::kTopLeft, "top_left"},
                                                          {TieRule::kBottomLeft, "bottom_left"},
                                                          {TieRule::kTopRight, "top_right"},
                                                          {TieRule::kBottomRight, "bottom_right"},
                                                          {TieRule::kNormalSign, "normal_sign"}}};

/// Whether left edges own their samples, or right ones.
constexpr bool owns_left(TieRule rule) { return rule != TieRule::kTopRight && rule != TieRule::kBottomRight; }

/// Whether of the horizontal edges the top ones own their samples, or the bottom ones.
constexpr bool owns_top(TieRule rule) {
  return rule != TieRule::kBottomLeft && rule != TieRule::kBottomRight;
}

/// Whether an edge owns its samples, from A and B of its edge function A x + B y + C, which is positive
/// inside of the triangle. To the right of an edge with A > 0 is the inside: a left edge. Where A = 0 and B >
/// 0 the inside lies below, y being down: a top edge.
template <class Number>
constexpr bool owns_samples(const Number& a, const Number& b, TieRule rule) {
  if (rule == TieRule::kNormalSign) return a > 0 || (a == 0 && b > 0);
  if (a != 0) return (a > 0) == owns_left(rule);
  return (b > 0) == owns_top(rule);
}

}  // namespace halfspace::reference
