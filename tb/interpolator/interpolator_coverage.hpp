/// Functional coverage of interpolator: what the quads of a bench are like.
#pragma once

#include "common/bins.hpp"
#include "halfspace/units/link_packets.hpp"
#include "models.hpp"

namespace halfspace::tb {

class InterpolatorCoverage {
 public:
  explicit InterpolatorCoverage(const InterpolatorParameters& parameters);

  void quad(const AttributeQuad& quad, const ShadedQuad& shaded);

  [[nodiscard]] bool report() const { return bins_.report(); }

 private:
  void pixel(const AttributeQuad& quad, const ShadedQuad& shaded, int number);

  InterpolatorParameters parameters_;
  Bins bins_;
};

}  // namespace halfspace::tb
