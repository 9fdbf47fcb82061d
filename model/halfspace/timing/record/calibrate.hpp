#pragma once

#include <span>
#include <vector>

#include "halfspace/timing/record/stretch.hpp"

namespace halfspace {

/// Weights of a sample, near `weights`, with which its `counts` add up to `totals`: of all such weights those
/// with the least sum of (w - weight)^2 / weight, though none is more than five times off. Survey statistics
/// calls it the generalised regression estimator (Deville and Sarndal, Calibration Estimators in Survey
/// Sampling, JASA 87, 1992). A total of 0 asks for nothing. Totals that contradict each other, or that the
/// sample hardly bears on, are met as nearly as weights near the given ones allow.
std::vector<double> calibrate(std::span<const double> weights, std::span<const StretchCounts> counts,
                              const StretchCounts& totals);

}  // namespace halfspace
