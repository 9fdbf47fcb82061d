#include "halfspace/study/precision/unit_depth.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "halfspace/scene/frame_builder.hpp"
#include "halfspace/scene/front_end.hpp"
#include "halfspace/units/setup.hpp"

namespace halfspace::study {

UnitDepth::UnitDepth(const DepthTriangle& t, DepthFormat format, DepthInterpolator interpolator,
                     std::uint32_t size)
    : state_{.test = true, .format = format, .interpolator = interpolator, .sub_pixel_bits = kSubPixelBits} {
  FrameBuilder builder(size, format);
  std::vector<glm::dvec3> window;
  for (const DepthVertex& v : t.v) {
    window.emplace_back(std::ldexp(static_cast<double>(v.x), -kSubPixelBits),
                        std::ldexp(static_cast<double>(v.y), -kSubPixelBits), v.z);
  }
  const Command& draw = builder.draw(window);
  FrontEndCounters counters;
  std::vector<ScreenTriangle> pieces;
  FrontEnd(builder.frame, draw, format, kSubPixelBits).process(0, pieces, counters);
  const auto last = static_cast<std::int32_t>(size) - 1;
  const SetupState state{.sub_pixel_bits = kSubPixelBits,
                         .bounds = {.x_last = last, .y_last = last},
                         .depth_format = format,
                         .interpolator = interpolator};
  for (const ScreenTriangle& piece : pieces) {
    SetupTriangle made;
    if (setup(piece, state, made) == SetupVerdict::kDrawn) {
      pieces_.push_back(made);
    }
  }
}

std::uint32_t UnitDepth::code(std::int64_t x, std::int64_t y) const {
  constexpr int kTile = 16;
  const auto piece = std::find_if(pieces_.begin(), pieces_.end(), [&](const SetupTriangle& made) {
    return x >= made.bounds.x_first && x <= made.bounds.x_last && y >= made.bounds.y_first &&
           y <= made.bounds.y_last;
  });
  if (piece == pieces_.end()) {
    throw std::logic_error("the front end lost a covered pixel");
  }
  QuadBurst burst;
  burst.coverage.tile_x = static_cast<std::uint16_t>(x / kTile);
  burst.coverage.tile_y = static_cast<std::uint16_t>(y / kTile);
  for (std::size_t i = 1; i < 3; ++i) {
    const Edge& edge = piece->edge[i];
    burst.coverage.e[i - 1] =
        edge.c + ((edge.a * (x / kTile * kTile) + edge.b * (y / kTile * kTile)) << kSubPixelBits);
  }
  const auto bit = static_cast<std::size_t>(y % kTile * kTile + x % kTile);
  burst.coverage.mask.word[bit / 64] = std::uint64_t{1} << (bit % 64);
  TileCodes<kTile> codes{};
  interpolate_tile<kTile>(*piece, burst, state_, codes);
  return codes[bit];
}

}  // namespace halfspace::study
