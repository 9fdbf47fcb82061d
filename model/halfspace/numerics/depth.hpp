/// Depth formats and the codes that stand for depth values on a link and in a surface.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace halfspace {

/// Numbered as in the PTF1 file format.
enum class DepthFormat : std::uint32_t { kNone = 0, kUnorm16 = 1, kUnorm24 = 2, kUnorm32 = 3, kFloat32 = 4 };

constexpr std::string_view name(DepthFormat format) {
  constexpr std::array<std::string_view, 5> kNames{"none", "unorm16", "unorm24", "unorm32", "float32"};
  return kNames[static_cast<std::size_t>(format)];
}

/// Depth comparison "incoming OP stored", numbered as in Vulkan.
enum class DepthFunc : std::uint32_t {
  kNever,
  kLess,
  kEqual,
  kLequal,
  kGreater,
  kNotEqual,
  kGequal,
  kAlways
};

/// Vertex depths of unorm surfaces carry this many bits: the stored code and, below it, a fraction.
inline constexpr int kVertexDepthBits = 31;

/// Of a unorm triangle with a vertex depth of this or more the plane takes long words: sums of 32-bit words
/// are off by up to 22 units (docs/numerics.md), and must stay below 2^31. Depth 1 is less.
inline constexpr std::int64_t kShortWordEnd = (std::int64_t{1} << kVertexDepthBits) - 64;

/// Vertex depths are below 2^kVertexDepthRange times the depth range (or 1): depth clamp allows that.
inline constexpr int kVertexDepthRange = 15;

/// Bits of a stored unorm code; 0 for float32 and none.
constexpr int unorm_bits(DepthFormat format) {
  return format == DepthFormat::kUnorm16 ? 16 : format == DepthFormat::kUnorm24 ? 24 : 0;
}

/// Bits of a vertex depth below the unit of the stored code.
constexpr int vertex_depth_fraction(DepthFormat format) { return kVertexDepthBits - unorm_bits(format); }

/// Largest code of a unorm surface: depth 1.
constexpr std::uint32_t max_unorm_code(DepthFormat format) { return (1u << unorm_bits(format)) - 1; }

/// The stored code of depth 1.
constexpr std::uint32_t largest_code(DepthFormat format) {
  return format == DepthFormat::kFloat32 ? std::bit_cast<std::uint32_t>(1.0f) : max_unorm_code(format);
}

/// Orders float32 by value: a number that is less for the bits of a smaller float, and the same for both
/// zeros.
constexpr std::int32_t float_order(std::uint32_t bits) {
  const auto magnitude = static_cast<std::int32_t>(bits & 0x7FFFFFFFu);
  return bits >> 31 != 0 ? -magnitude : magnitude;
}

/// The stored code of a float32, given its bits: a number that is not negative is stored as it is. Depths
/// below 0 have codes that are negative as signed integers; docs/numerics.md says which surfaces hold them.
constexpr std::uint32_t code_of_float(std::uint32_t bits) {
  return static_cast<std::uint32_t>(float_order(bits));
}
constexpr std::uint32_t float_of_code(std::uint32_t code) {
  return code >> 31 != 0 ? (0u - code) | 0x80000000u : code;
}

/// The depth of a vertex, or what polygon offset adds to it, as it enters setup: for unorm surfaces the code
/// scaled by 2^vertex_depth_fraction, rounded to nearest even; for float32 the bits of the nearest float.
inline std::int64_t vertex_depth_code(DepthFormat format, double depth) {
  if (format == DepthFormat::kFloat32) {
    return std::bit_cast<std::uint32_t>(static_cast<float>(depth) + 0.0f);  // + 0 turns -0 into 0
  }
  const auto one = static_cast<double>(std::int64_t{max_unorm_code(format)} << vertex_depth_fraction(format));
  return std::llrint(depth * one);
}

/// A vertex depth of a stored code.
constexpr std::int64_t vertex_depth_of_code(DepthFormat format, std::uint32_t code) {
  return format == DepthFormat::kFloat32 ? float_of_code(code)
                                         : std::int64_t{code} << vertex_depth_fraction(format);
}

/// The stored code nearest to a vertex depth, halves upwards. On unorm surfaces the depth is in [0, 1].
constexpr std::uint32_t stored_code(DepthFormat format, std::int64_t vertex_depth) {
  if (format == DepthFormat::kFloat32) {
    return code_of_float(static_cast<std::uint32_t>(vertex_depth));
  }
  const int fraction = vertex_depth_fraction(format);
  return static_cast<std::uint32_t>((vertex_depth + (std::int64_t{1} << (fraction - 1))) >> fraction);
}

/// The stored code of a depth. Unorm surfaces hold none outside [0, 1]: it is clamped, as by glClearDepth.
inline std::uint32_t code_of_depth(DepthFormat format, float depth) {
  const double value = depth;
  const bool is_float = format == DepthFormat::kFloat32;
  return stored_code(format, vertex_depth_code(format, is_float ? value : std::clamp(value, 0.0, 1.0)));
}

/// A stored code as a depth.
inline float depth_of_code(DepthFormat format, std::uint32_t code) {
  if (format == DepthFormat::kFloat32) {
    return std::bit_cast<float>(float_of_code(code));
  }
  return static_cast<float>(static_cast<double>(code) / max_unorm_code(format));
}

/// The order of depth in codes of every format.
constexpr std::int32_t code_order(std::uint32_t code) { return static_cast<std::int32_t>(code); }
constexpr bool is_nearer(std::uint32_t l, std::uint32_t r) { return code_order(l) < code_order(r); }

constexpr bool depth_passes(DepthFunc func, std::uint32_t incoming_code, std::uint32_t stored_code) {
  const std::int32_t incoming = code_order(incoming_code);
  const std::int32_t stored = code_order(stored_code);
  switch (func) {
    case DepthFunc::kNever:
      return false;
    case DepthFunc::kLess:
      return incoming < stored;
    case DepthFunc::kEqual:
      return incoming == stored;
    case DepthFunc::kLequal:
      return incoming <= stored;
    case DepthFunc::kGreater:
      return incoming > stored;
    case DepthFunc::kNotEqual:
      return incoming != stored;
    case DepthFunc::kGequal:
      return incoming >= stored;
    case DepthFunc::kAlways:
      return true;
  }
  return false;
}

}  // namespace halfspace
