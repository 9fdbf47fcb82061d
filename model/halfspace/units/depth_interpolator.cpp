#include "halfspace/units/depth_interpolator.hpp"

#include <algorithm>
#include <bit>

#include "halfspace/units/depth_barycentric.hpp"
#include "halfspace/units/depth_plane.hpp"
#include "halfspace/units/float_parts.hpp"

namespace halfspace {
namespace {

void set_unorm_range(std::int64_t offset, DepthFormat format, const DepthLimits& limits, DepthEquation& out) {
  const auto [z_min, z_max] = std::minmax({out.z[0], out.z[1], out.z[2]});
  out.beyond = z_min < 0 || z_max >= kShortWordEnd;
  const auto magnitude = [](std::int64_t z) { return static_cast<std::uint64_t>(z < 0 ? -z : z); };
  const int width = std::bit_width(magnitude(z_min) | magnitude(z_max) | magnitude(offset));
  out.exponent = static_cast<std::int16_t>(std::max(width - kVertexDepthBits, 0));
  out.offset = offset;
  const std::int64_t least = vertex_depth_of_code(format, limits.least);
  const std::int64_t most = vertex_depth_of_code(format, limits.most);
  out.min_code = stored_code(format, std::clamp(z_min + offset, least, most));
  out.max_code = stored_code(format, std::clamp(z_max + offset, least, most));
}

void set_float_range(std::uint32_t offset, const DepthLimits& limits, DepthEquation& out) {
  std::array<std::uint32_t, 3> z{};
  std::uint32_t field = std::max(offset >> 23 & 0xFF, 1u);  // subnormal numbers have the exponent of 1
  for (std::size_t i = 0; i < 3; ++i) {
    z[i] = static_cast<std::uint32_t>(out.z[i]);
    field = std::max(field, z[i] >> 23 & 0xFF);
  }
  out.exponent = static_cast<std::int16_t>(static_cast<int>(field) - 126);
  out.offset = word_of_float(offset, out.exponent);
  const auto [z_min, z_max] = std::minmax(
      {z[0], z[1], z[2]}, [](std::uint32_t l, std::uint32_t r) { return float_order(l) < float_order(r); });
  // Without an offset as they are: a word may have to cut them.
  const auto code = [&](std::uint32_t bits) {
    const std::uint32_t moved =
        out.offset != 0 ? code_of_word(Int128{word_of_float(bits, out.exponent)} + out.offset, out.exponent)
                        : code_of_float(bits);
    return static_cast<std::uint32_t>(
        std::clamp(code_order(moved), code_order(limits.least), code_order(limits.most)));
  };
  out.min_code = code(z_min);
  out.max_code = code(z_max);
}

}  // namespace

void make_depth_equation(const std::array<ScreenVertex, 3>& v, std::int64_t offset,
                         const std::array<Edge, 3>& edge, std::int64_t area2, DepthFormat format,
                         const DepthLimits& limits, DepthInterpolator interpolator, DepthEquation& out) {
  out.z = {v[0].z, v[1].z, v[2].z};
  out.area2 = area2;
  if (format == DepthFormat::kFloat32) {
    set_float_range(static_cast<std::uint32_t>(offset), limits, out);
  } else {
    set_unorm_range(offset, format, {limits.least, std::min(limits.most, largest_code(format))}, out);
  }
  if (interpolator == DepthInterpolator::kPlane) {
    set_plane(v[0], edge, format, out);
  } else {
    set_reciprocal(out);
  }
}

}  // namespace halfspace
