/// Every triangle with vertices on the grid of 1/16 pixel of a square of 2x2 pixels: 1024 points, so C(1024,
/// 3) = 178,433,024 triangles.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "halfspace/numerics/fill_rule.hpp"
#include "halfspace/reference/tie_rule.hpp"
#include "halfspace/stress/subject.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace::stress {

inline constexpr int kGridBits = 4;
inline constexpr std::uint32_t kGridSide = 2U << kGridBits;          ///< points of a row
inline constexpr std::uint32_t kGridPoints = kGridSide * kGridSide;  ///< numbered row by row

/// Which samples of the square a triangle covers, by the definition: looked up by its edges.
class GridDefinition {
 public:
  explicit GridDefinition(reference::TieRule rule);

  /// Of three points that make a triangle of positive area: bit y * 2 + x.
  [[nodiscard]] std::uint8_t covered(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return static_cast<std::uint8_t>(edge(a, b) & edge(b, c) & edge(c, a));
  }
  /// The samples that are inside the edge from one point to another, those that it owns on it included.
  [[nodiscard]] std::uint8_t edge(std::uint32_t from, std::uint32_t to) const {
    return inside_[from * kGridPoints + to];
  }
  /// Samples exactly on the edge.
  [[nodiscard]] std::uint8_t on(std::uint32_t from, std::uint32_t to) const {
    return on_[from * kGridPoints + to];
  }

 private:
  std::vector<std::uint8_t> inside_;
  std::vector<std::uint8_t> on_;
};

/// What the units make of the triangles.
struct ExhaustiveTally {
  std::uint64_t triangles = 0;  ///< each in each winding and at each place counts
  std::uint64_t without_area = 0;
  std::uint64_t samples = 0;
  std::uint64_t wrong = 0;        ///< samples that are not as the definition has them
  std::uint64_t wrong_quads = 0;  ///< quads that are not those of the covered samples
  std::uint64_t tiles = 0;        ///< decided
  std::uint64_t unsound = 0;      ///< tiles rejected with a covered sample, accepted without one
  std::uint64_t edges = 0;        ///< between two points, from triangles on both sides
  std::uint64_t on_edges = 0;     ///< samples exactly on them
  std::uint64_t ownerless = 0;    ///< samples that are not on exactly one side of an edge

  ExhaustiveTally& operator+=(const ExhaustiveTally& other);
  [[nodiscard]] std::uint64_t errors() const { return wrong + wrong_quads + unsound + ownerless; }
};

/// Puts all triangles whose least point is one of every `every`, in both windings, through setup,
/// block_walker, tile_walker, edge_evaluator and quad_generator with tiles of 4, 8 and 16 pixels in turn, at
/// two places: in one quad, and astride four tiles. `units` is their fill rule, `rule` what the definition
/// calls it. `progress` hears of points done.
ExhaustiveTally check_units(FillRule units, reference::TieRule rule, std::uint32_t every, int threads,
                            const std::function<void(std::size_t)>& progress);

/// Draws the same triangles, in one winding in one quad, as frames of many triangles, and compares each
/// frame's fragments with the sums of the definition by the rule. An engine that compares its own packets
/// (the RTL) throws where they differ.
ExhaustiveTally check_subject(Subject& subject, reference::TieRule rule, std::uint32_t every,
                              const std::function<void(std::size_t)>& progress);

}  // namespace halfspace::stress
