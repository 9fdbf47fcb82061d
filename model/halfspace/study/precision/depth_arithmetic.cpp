#include "halfspace/study/precision/depth_arithmetic.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "halfspace/reference/depth_code.hpp"
#include "halfspace/reference/float_edges.hpp"
#include "halfspace/units/depth_plane.hpp"

namespace halfspace::study {
namespace {

/// The centre of a pixel in sub-pixels.
constexpr std::int64_t centre(std::int64_t pixel) {
  return (pixel << kSubPixelBits) + (std::int64_t{1} << (kSubPixelBits - 1));
}

constexpr bool is_float(DepthFormat format) { return format == DepthFormat::kFloat32; }

std::uint32_t bits_of(float z) {
  return static_cast<std::uint32_t>(vertex_depth_code(DepthFormat::kFloat32, z));
}

CodeRange range_of(const std::array<std::uint32_t, 3>& code) {
  const auto [least, most] = std::minmax({code[0], code[1], code[2]});
  return {least, most};
}

std::uint32_t within(const CodeRange& range, std::int64_t code) {
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(code, range.least, range.most));
}

/// floor(value / 2^bits + 1/2)
constexpr std::int64_t rounded(std::int64_t value, int bits) {
  return bits == 0 ? value : (value + (std::int64_t{1} << (bits - 1))) >> bits;
}

}  // namespace

FloatPlane::FloatPlane(const DepthTriangle& t, DepthFormat format) : format_(format) {
  std::array<reference::FloatPoint<float>, 3> p;
  for (std::size_t i = 0; i < 3; ++i) {
    p[i] = reference::float_point({t.v[i].x, t.v[i].y}, kSubPixelBits);
  }
  x0_ = p[0].x;
  y0_ = p[0].y;
  z0_ = t.v[0].z;
  const float x1 = p[1].x - x0_;
  const float y1 = p[1].y - y0_;
  const float z1 = t.v[1].z - z0_;
  const float x2 = p[2].x - x0_;
  const float y2 = p[2].y - y0_;
  const float z2 = t.v[2].z - z0_;
  const float area = x1 * y2 - x2 * y1;
  dx_ = (z1 * y2 - z2 * y1) / area;
  dy_ = (x1 * z2 - x2 * z1) / area;
}

std::uint32_t FloatPlane::code(std::int64_t x, std::int64_t y) const {
  const float px = static_cast<float>(x) + 0.5F;
  const float py = static_cast<float>(y) + 0.5F;
  const float z = z0_ + dx_ * (px - x0_) + dy_ * (py - y0_);
  const float clamped = z > 0 ? std::min(z, 1.0F) : 0.0F;  // 0 for NaN
  return is_float(format_)
             ? std::bit_cast<std::uint32_t>(clamped)
             : static_cast<std::uint32_t>(std::lrint(clamped * static_cast<float>(max_unorm_code(format_))));
}

DoublePlane::DoublePlane(const DepthTriangle& t, DepthFormat format) : format_(format) {
  reference::WindowTriangle window;
  for (std::size_t i = 0; i < 3; ++i) {
    window[i] = {std::ldexp(static_cast<double>(t.v[i].x), -kSubPixelBits),
                 std::ldexp(static_cast<double>(t.v[i].y), -kSubPixelBits), t.v[i].z};
  }
  plane_ = reference::depth_plane(window);
}

std::uint32_t DoublePlane::code(std::int64_t x, std::int64_t y) const {
  const double depth = plane_.at(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
  return reference::encode_depth(std::clamp(depth, 0.0, 1.0), static_cast<reference::Storage>(format_));
}

WordPlane::WordPlane(const DepthTriangle& t, DepthFormat format, int bits) : format_(format), bits_(bits) {
  eq_.from = {t.v[0].x, t.v[0].y};
  std::array<std::int64_t, 3> word{};
  std::array<std::uint32_t, 3> stored{};
  if (is_float(format)) {
    const float most = std::max({t.v[0].z, t.v[1].z, t.v[2].z});
    exponent_ = std::max(most == 0 ? -126 : std::ilogb(most), -126) + 1;
    for (std::size_t i = 0; i < 3; ++i) {
      stored[i] = bits_of(t.v[i].z);
      word[i] = word_of_float(stored[i], exponent_) >> (kLongWordFraction - bits);
    }
  } else {
    const double one = std::ldexp(max_unorm_code(format), bits - unorm_bits(format));
    for (std::size_t i = 0; i < 3; ++i) {
      word[i] = std::llrint(double{t.v[i].z} * one);
      stored[i] = static_cast<std::uint32_t>(rounded(word[i], bits - unorm_bits(format)));
    }
  }
  eq_.range = range_of(stored);
  eq_.z = word[0];
  const Int128 rise1 = Int128{word[1]} - word[0];
  const Int128 rise2 = Int128{word[2]} - word[0];
  constexpr Int128 kOne = Int128{1} << kGradientFraction;
  eq_.dx = static_cast<Modular>((rise1 * t.a(1) + rise2 * t.a(2)) * kOne / t.area2);
  eq_.dy = static_cast<Modular>((rise1 * t.b(1) + rise2 * t.b(2)) * kOne / t.area2);
}

std::uint32_t WordPlane::code(std::int64_t x, std::int64_t y) const {
  const auto nearest = [](Modular value, int fraction) {
    return (value + (Modular{1} << (fraction - 1))) >> fraction;
  };
  const auto from_vertex = [](std::int64_t pixel, std::int64_t vertex) {
    return static_cast<Modular>(centre(pixel / kAnchorSize * kAnchorSize) - vertex);
  };
  const Modular anchor = (static_cast<Modular>(eq_.z) << kGradientFraction) +
                         eq_.dx * from_vertex(x, eq_.from[0]) + eq_.dy * from_vertex(y, eq_.from[1]);
  const Modular sum =
      nearest(anchor, kGradientFraction) +
      nearest(eq_.dx, kGradientFraction - kSubPixelBits) * static_cast<Modular>(x % kAnchorSize) +
      nearest(eq_.dy, kGradientFraction - kSubPixelBits) * static_cast<Modular>(y % kAnchorSize);
  // The low bits, with a sign: a word.
  const int above = 63 - bits_;
  const std::int64_t word = static_cast<std::int64_t>(static_cast<std::uint64_t>(sum) << above) >> above;
  if (!is_float(format_)) {
    return within(eq_.range, rounded(word, bits_ - unorm_bits(format_)));
  }
  return within(eq_.range, word <= 0 ? 0 : float_bits(static_cast<std::uint64_t>(word), exponent_ - bits_));
}

Barycentric::Barycentric(const DepthTriangle& t, DepthFormat format, int width)
    : triangle_(t),
      format_(format),
      width_(width),
      shift_(std::bit_width(static_cast<std::uint64_t>(t.area2)) - width) {
  reciprocal_ = ((Int128{1} << (2 * width - 1)) - 1) / std::max<Int128>(scaled(t.area2), 1);
  std::array<std::uint32_t, 3> stored{};
  for (std::size_t i = 0; i < 3; ++i) {
    z_[i] = vertex_depth_code(format, t.v[i].z);
    stored[i] = stored_code(format, z_[i]);
  }
  range_ = range_of(stored);
}

std::uint32_t Barycentric::code(std::int64_t x, std::int64_t y) const {
  const reference::GridPoint p{centre(x), centre(y)};
  const std::int64_t e1 = triangle_.edge(1, p);
  const std::int64_t e2 = triangle_.edge(2, p);
  const std::array<std::int64_t, 3> e{triangle_.area2 - e1 - e2, e1, e2};
  return is_float(format_) ? float32(e) : unorm(e);
}

std::uint32_t Barycentric::unorm(const std::array<std::int64_t, 3>& e) const {
  const int weight_bits = width_ - 2;
  const auto weight = [&](std::int64_t value) {
    return scaled(value) * reciprocal_ >> (2 * width_ - 1 - weight_bits);
  };
  const Int128 sum =
      (Int128{z_[0]} << weight_bits) + weight(e[1]) * (z_[1] - z_[0]) + weight(e[2]) * (z_[2] - z_[0]);
  return within(range_,
                rounded(static_cast<std::int64_t>(sum >> weight_bits), vertex_depth_fraction(format_)));
}

std::uint32_t Barycentric::float32(const std::array<std::int64_t, 3>& e) const {
  // A number m * 2^exponent whose m has `width` bits, lower ones cut off.
  struct Normal {
    std::int64_t m = 0;
    int exponent = 0;
  };
  const auto normal = [&](std::int64_t value, int exponent) {
    const int shift = width_ - std::bit_width(static_cast<std::uint64_t>(value));
    return Normal{shift >= 0 ? value << shift : value >> -shift, exponent - shift};
  };
  std::array<std::int64_t, 3> product{};
  std::array<int, 3> exponent{};
  int top = -1000;  // below every exponent that can occur
  for (std::size_t i = 0; i < 3; ++i) {
    const Normal weight = normal(e[i], 0);
    const FloatParts z = float_parts(static_cast<std::uint32_t>(z_[i]));
    product[i] = weight.m * z.mantissa;
    exponent[i] = weight.exponent + z.exponent;
    top = product[i] != 0 ? std::max(top, exponent[i]) : top;
  }
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int shift = top - exponent[i];
    sum += product[i] != 0 && shift < 64 ? product[i] >> shift : 0;
  }
  const Normal s = normal(sum, top);
  // Of wider products the lowest bits, far below a float32's, are left out.
  const int cut = std::max(2 * width_ - 64, 0);
  const auto depth = static_cast<std::uint64_t>(Int128{s.m} * reciprocal_ >> cut);
  return within(range_, float_bits(depth, s.exponent - (2 * width_ - 1) - shift_ + cut));
}

}  // namespace halfspace::study
