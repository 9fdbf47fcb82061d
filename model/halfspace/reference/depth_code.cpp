#include "halfspace/reference/depth_code.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "halfspace/numerics/error.hpp"

namespace halfspace::reference {
namespace {

double largest_code(Storage storage) { return std::ldexp(1.0, unorm_bits(storage)) - 1; }

}  // namespace

int unorm_bits(Storage storage) {
  switch (storage) {
    case Storage::kUnorm16:
      return 16;
    case Storage::kUnorm24:
      return 24;
    case Storage::kUnorm32:
      return 32;
    case Storage::kNone:
    case Storage::kFloat32:
      break;
  }
  return 0;
}

std::uint32_t encode_depth(double depth, Storage storage) {
  if (storage == Storage::kFloat32) {
    const auto nearest = static_cast<float>(depth);
    const auto magnitude = std::bit_cast<std::uint32_t>(std::abs(nearest));
    return nearest < 0 ? 1 + ~magnitude : magnitude;
  }
  // Written so that NaN fails both comparisons.
  const double clamped = depth > 0 ? std::min(depth, 1.0) : 0.0;
  return static_cast<std::uint32_t>(std::nearbyint(clamped * largest_code(storage)));
}

float decode_depth(std::uint32_t code, Storage storage) {
  if (storage == Storage::kFloat32) {
    const bool negative = code > std::numeric_limits<std::int32_t>::max();
    return negative ? -std::bit_cast<float>(1 + ~code) : std::bit_cast<float>(code);
  }
  return static_cast<float>(code / largest_code(storage));
}

bool depth_test(std::uint32_t func, std::uint32_t incoming_code, std::uint32_t stored_code) {
  const auto incoming = static_cast<std::int32_t>(incoming_code);
  const auto stored = static_cast<std::int32_t>(stored_code);
  switch (func) {
    case 0:
      return false;
    case 1:
      return incoming < stored;
    case 2:
      return incoming == stored;
    case 3:
      return incoming <= stored;
    case 4:
      return incoming > stored;
    case 5:
      return incoming != stored;
    case 6:
      return incoming >= stored;
    case 7:
      return true;
    default:
      throw InputError("depth_func: " + std::to_string(func) + " is not one of 0 to 7");
  }
}

}  // namespace halfspace::reference
