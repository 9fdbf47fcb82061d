#include "interpolator_coverage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "halfspace/units/interpolator.hpp"

namespace halfspace::tb {
namespace {

constexpr std::array<const char*, 2> kKinds = {"helper", "covered"};
/// Powers of two between the largest and the least product: beyond the last a term is gone.
constexpr std::array<int, 4> kSpreads = {0, 4, 16, 64};

std::string at(int pixel, const char* what) { return fmt::format("pixel {}: {}", pixel, what); }

std::array<std::int64_t, 3> edges_at(const AttributeQuad& quad, int pixel, int sub_pixel_bits) {
  std::array<std::int64_t, 3> e{quad.area2, 0, 0};
  for (std::size_t i = 0; i < 2; ++i) {
    const std::int64_t steps = std::int64_t{quad.a[i]} * (pixel % 2) + std::int64_t{quad.b[i]} * (pixel / 2);
    e[i + 1] = quad.e[i] + steps * (std::int64_t{1} << sub_pixel_bits);
    e[0] -= e[i + 1];
  }
  return e;
}

int exponent(std::uint32_t q) { return static_cast<int>(q >> 23 & 0xFF); }

}  // namespace

InterpolatorCoverage::InterpolatorCoverage(const InterpolatorParameters& parameters)
    : parameters_(parameters) {
  for (int mask = 0; mask < 16; ++mask) {
    bins_.add(fmt::format("mask {:#x}", mask));
  }
  for (int pixel = 0; pixel < 4; ++pixel) {
    bins_.add(at(pixel, "behind the horizon"));
    for (int edge = 0; edge < 3; ++edge) {
      bins_.add(fmt::format("pixel {}: E of edge {} is 0", pixel, edge));
      bins_.add(fmt::format("pixel {}: E of edge {} is below 0", pixel, edge));
    }
    for (const int weight : {1, 2}) {
      bins_.add(fmt::format("pixel {}: weight {} at its largest", pixel, weight));
      bins_.add(fmt::format("pixel {}: weight {} at its least", pixel, weight));
      bins_.add(fmt::format("pixel {}: weight {} is 0 beside one that is not", pixel, weight));
    }
    for (const char* kind : kKinds) {
      bins_.add(fmt::format("pixel {}: {}, value at an end of the vertices'", pixel, kind));
      bins_.add(fmt::format("pixel {}: {}, value between the vertices'", pixel, kind));
    }
    bins_.add(at(pixel, "helper, value beyond the vertices'"));
    bins_.add(at(pixel, "helper, value at the largest number"));
    bins_.add(at(pixel, "helper, value at the least number"));
  }
  for (const int spread : kSpreads) {
    bins_.add(fmt::format("1/w over {} powers of two or more", spread));
  }
  bins_.add("1/w alike");
}

void InterpolatorCoverage::quad(const AttributeQuad& quad, const ShadedQuad& shaded) {
  bins_.hit(fmt::format("mask {:#x}", quad.mask));
  const auto [least, most] = std::minmax({exponent(quad.q[0]), exponent(quad.q[1]), exponent(quad.q[2])});
  for (const int spread : kSpreads) {
    if (most - least >= spread) {
      bins_.hit(fmt::format("1/w over {} powers of two or more", spread));
    }
  }
  if (quad.q[0] == quad.q[1] && quad.q[1] == quad.q[2]) {
    bins_.hit("1/w alike");
  }
  for (int number = 0; number < 4; ++number) {
    pixel(quad, shaded, number);
  }
}

void InterpolatorCoverage::pixel(const AttributeQuad& quad, const ShadedQuad& shaded, int number) {
  const std::array<std::int64_t, 3> e = edges_at(quad, number, parameters_.sub_pixel_bits);
  for (std::size_t i = 0; i < 3; ++i) {
    if (e[i] <= 0) {
      bins_.hit(fmt::format("pixel {}: E of edge {} is {}", number, i, e[i] == 0 ? "0" : "below 0"));
    }
  }
  const VertexWeights weights = perspective_weights(e, quad.q, parameters_.bits);
  const std::int64_t most = (std::int64_t{1} << (parameters_.bits + kWeightWhole)) - 1;
  const std::array<std::int64_t, 2> both{weights.w1, weights.w2};
  for (std::size_t i = 0; i < 2; ++i) {
    const char* const place = both[i] == most                    ? "at its largest"
                              : both[i] == -most                 ? "at its least"
                              : both[i] == 0 && both[1 - i] != 0 ? "is 0 beside one that is not"
                                                                 : "";
    bins_.hit(fmt::format("pixel {}: weight {} {}", number, i + 1, place));
  }
  if (both == std::array<std::int64_t, 2>{} && e[1] != 0 && e[2] != 0 &&
      std::ranges::any_of(e, [](std::int64_t each) { return each < 0; })) {
    bins_.hit(at(number, "behind the horizon"));
  }
  const bool covered = (quad.mask >> number & 1) != 0;
  for (std::size_t c = 0; c < kComponents; ++c) {
    const std::int32_t value = shaded.value[kComponents * static_cast<std::size_t>(number) + c];
    const auto [low, high] =
        std::minmax({quad.value[c], quad.value[kComponents + c], quad.value[2 * kComponents + c]});
    if (!covered && value == std::numeric_limits<std::int32_t>::max() && high < value) {
      bins_.hit(at(number, "helper, value at the largest number"));
    }
    if (!covered && value == std::numeric_limits<std::int32_t>::min() && low > value) {
      bins_.hit(at(number, "helper, value at the least number"));
    }
    if (value < low || value > high) {
      bins_.hit(at(number, "helper, value beyond the vertices'"));
    } else if (low != high) {
      bins_.hit(fmt::format("pixel {}: {}, value {} the vertices'", number, kKinds[covered ? 1 : 0],
                            value == low || value == high ? "at an end of" : "between"));
    }
  }
}

}  // namespace halfspace::tb
