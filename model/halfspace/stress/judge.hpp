/// Holds the picture of a case against the laws of the case.
#pragma once

#include <optional>

#include "halfspace/stress/case.hpp"
#include "halfspace/stress/subject.hpp"
#include "halfspace/stress/tally.hpp"
#include "halfspace/units/depth_interpolator.hpp"

namespace halfspace::stress {

/// How depth is judged.
struct DepthLaw {
  DepthInterpolator interpolator = DepthInterpolator::kPlane;
  std::optional<double>
      bound{};  ///< units of the last place; none: that of docs/numerics.md for the interpolator
};

/// What the picture of `made`, and of its twin where it has one, comes to. Pictures must be of the target's
/// size, with the samples of `precision`.
Tally judge(const Case& made, const Precision& precision, const DepthLaw& law, const Picture& picture,
            const Picture* twin);

inline constexpr double kNotJudged = -1;

/// How far each sample's depth is off, as a share of its bound, in the order of Picture, or kNotJudged.
std::vector<double> depth_shares(const Case& made, const Precision& precision, const DepthLaw& law,
                                 const Picture& picture);

/// Fragments that each sample ought to have, in the order of Picture, or kUncertain; where it is shorter,
/// kUncertain for the rest.
std::vector<std::int32_t> expected_fragments(const Case& made, const Precision& precision);

}  // namespace halfspace::stress
