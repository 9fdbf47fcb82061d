/// Conservative rasterization: which pixels a triangle touches, or fills, in place of which centres it
/// covers.
///
/// A pixel is drawn where the triangle reaches a square around its centre: the pixel, and on each side of it
/// the uncertainty that snapping leaves (outer); or where the triangle holds that square (inner). An edge
/// function is linear, so over a square of half side g it is largest at E + g (|A| + |B|): outer pixels have
/// all three above 0 or at it, and their centres are no more than g outside the bounding box. A triangle and
/// a square are apart only along the normal of a side of one of them, so these are all the pixels, and no
/// others. Inner pixels have E - g (|A| + |B|) >= 0. Microsoft, "Conservative Rasterization", version 3.2
/// (DirectX-Specs).
#pragma once

#include <cstdint>
#include <cstdlib>

namespace halfspace {

enum class Conservative : std::uint8_t { kOff, kOuter, kInner };

/// How far the square reaches from the centre of a pixel, in sub-pixels: below 0 for inner, 0 where centres
/// count. `uncertainty` is in sub-pixels.
constexpr int square_reach(Conservative mode, int uncertainty, int sub_pixel_bits) {
  const int reach = (1 << (sub_pixel_bits - 1)) + uncertainty;
  return mode == Conservative::kOff ? 0 : mode == Conservative::kOuter ? reach : -reach;
}

/// From E at the centre of a square to where it decides.
constexpr std::int64_t to_square(std::int32_t a, std::int32_t b, int reach) {
  return (std::int64_t{std::abs(a)} + std::abs(b)) * reach;
}

}  // namespace halfspace
