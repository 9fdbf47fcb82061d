#include "halfspace/units/depth_plane.hpp"

namespace halfspace {
namespace {

/// numerator * 2^kGradientFraction / area2, cut towards zero.
Modular gradient(Int128 numerator, std::int64_t area2) {
  return static_cast<Modular>(numerator * (Int128{1} << kGradientFraction) / area2);
}

/// The same of a numerator of at most 63 bits. Most quotients are small: a double is near them, and the
/// remainder, which wraps around as unsigned numbers do, says how near.
Modular gradient(std::int64_t numerator, std::int64_t area2) {
  const auto magnitude = static_cast<std::uint64_t>(numerator < 0 ? -numerator : numerator);
  const double estimate =
      static_cast<double>(magnitude) * (1 << kGradientFraction) / static_cast<double>(area2);
  if (estimate > 0x1p50) {  // may be off by more than 1
    return gradient(Int128{numerator}, area2);
  }
  auto quotient = static_cast<std::int64_t>(estimate);
  const std::uint64_t product = static_cast<std::uint64_t>(quotient) * static_cast<std::uint64_t>(area2);
  const auto rest = static_cast<std::int64_t>((magnitude << kGradientFraction) - product);
  quotient += rest < 0 ? -1 : rest >= area2 ? 1 : 0;
  return static_cast<Modular>(Int128{numerator < 0 ? -quotient : quotient});
}

template <class Sum>
void set_gradients(const std::array<std::int64_t, 3>& word, const std::array<Edge, 3>& edge,
                   std::int64_t area2, PlaneEquation& out) {
  // z = z0 + ((z1 - z0) E1 + (z2 - z0) E2) / 2A, and a and b are the changes of E
  const Sum rise1 = Sum{word[1]} - word[0];
  const Sum rise2 = Sum{word[2]} - word[0];
  out.dx = gradient(rise1 * edge[1].a + rise2 * edge[2].a, area2);
  out.dy = gradient(rise1 * edge[1].b + rise2 * edge[2].b, area2);
  out.z = word[0];
}

}  // namespace

void set_plane(const ScreenVertex& vertex, const std::array<Edge, 3>& edge, DepthFormat format,
               DepthEquation& eq) {
  eq.plane.x = vertex.x;
  eq.plane.y = vertex.y;
  const bool is_float = format == DepthFormat::kFloat32;
  if (!is_float && !eq.beyond) {
    set_gradients<std::int64_t>(eq.z, edge, eq.area2, eq.plane);
    return;
  }
  std::array<std::int64_t, 3> word{};
  for (std::size_t i = 0; i < 3; ++i) {
    word[i] = is_float ? word_of_float(static_cast<std::uint32_t>(eq.z[i]), eq.exponent)
                       : word_of_unorm(eq.z[i], eq.exponent);
  }
  set_gradients<Int128>(word, edge, eq.area2, eq.plane);
}

}  // namespace halfspace
