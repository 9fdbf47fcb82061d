/// The transfer function of sRGB (IEC 61966-2-1), by which colours are stored.
#pragma once

#include <cmath>

namespace halfspace {

/// From a stored value in [0, 1] to light.
inline float srgb_to_linear(float stored) {
  return stored <= 0.04045f ? stored / 12.92f : std::pow((stored + 0.055f) / 1.055f, 2.4f);
}

/// From light in [0, 1] to the stored value.
inline float linear_to_srgb(float light) {
  return light <= 0.0031308f ? light * 12.92f : 1.055f * std::pow(light, 1 / 2.4f) - 0.055f;
}

}  // namespace halfspace
