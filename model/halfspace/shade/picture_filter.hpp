/// Pictures made smaller: the reconstruction filters of supersampling.
#pragma once

#include <cstdint>

#include "halfspace/shade/picture.hpp"

namespace halfspace {

enum class PictureFilter : std::uint8_t {
  kBox,   ///< the mean of the samples in the pixel
  kTent,  ///< weights fall from the pixel's centre to 0 a pixel away, in each direction
};

/// The picture `times` as small on a side, which must divide it. Values are averaged as they are stored,
/// rounded to the nearest. A tent that reaches over a side of the picture has the weights that are inside.
[[nodiscard]] Picture shrink(const Picture& picture, int times, PictureFilter filter);

}  // namespace halfspace
