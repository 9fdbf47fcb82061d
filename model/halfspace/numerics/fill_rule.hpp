/// Fill rules: which of the samples exactly on an edge belong to the triangle.
///
/// Top-left: Direct3D 11.3 functional specification, section 3.4.2.1. An image seen upside down turns it into
/// bottom-left; its two other turns are what machines with other axes have.
#pragma once

#include <array>
#include <cstdint>

namespace halfspace {

/// Numbered as the wires carry it: bit 0, bottom edges own their samples and not top ones; bit 1, right edges
/// and not left ones.
enum class FillRule : std::uint8_t { kTopLeft, kBottomLeft, kTopRight, kBottomRight };

inline constexpr std::array kFillRules = {FillRule::kTopLeft, FillRule::kBottomLeft, FillRule::kTopRight,
                                          FillRule::kBottomRight};

constexpr bool owns_bottom(FillRule rule) { return (static_cast<unsigned>(rule) & 1U) != 0; }
constexpr bool owns_right(FillRule rule) { return (static_cast<unsigned>(rule) & 2U) != 0; }

/// Whether an edge owns the samples on it, from its steps. Going round with positive area, y down, a left
/// edge has a > 0, a top edge a = 0 and b > 0.
constexpr bool owns_its_samples(std::int64_t a, std::int64_t b, FillRule rule) {
  if (a != 0) {
    return (a < 0) == owns_right(rule);
  }
  return (b < 0) == owns_bottom(rule);
}

}  // namespace halfspace
