/// sample_collector: from the quads of the samples of a tile to quads of pixels, for a shader that runs once
/// a pixel.
///
/// The samples of a tile follow each other from tile_walker on (docs/adr/0020-sample-planes.md). The unit
/// holds one tile of one triangle. When the next burst is of another tile or triangle, the quads that have a
/// sample that passed leave, in row order, each with the samples of its four pixels.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/numerics/sample_pattern.hpp"

namespace halfspace {

/// sample_collector -> fragment shader. Bit i of a mask is sample i of the pixel; pixels are those of a quad:
/// (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1).
struct PixelQuad {
  int x = 0;  ///< top left pixel in the tile, even
  int y = 0;
  std::array<std::uint16_t, 4> covered{};
  std::array<std::uint16_t, 4> passed{};

  [[nodiscard]] bool lives() const {
    return std::ranges::any_of(passed, [](std::uint16_t samples) { return samples != 0; });
  }
};

/// Where in a pixel the attributes that ask for the centroid are taken: at the centre if all samples are
/// covered or none is (a helper), else at the first sample that is. Direct3D 11.3 functional specification,
/// "Centroid Sampling"; Vulkan leaves the choice to the implementation.
constexpr SamplePosition centroid(std::uint16_t covered, const SamplePattern& pattern) {
  const auto all = static_cast<std::uint16_t>((1U << static_cast<unsigned>(pattern.count)) - 1);
  return covered == 0 || covered == all ? SamplePosition{}
                                        : pattern.at[static_cast<std::size_t>(std::countr_zero(covered))];
}

class SampleCollector {
 public:
  /// 4, 8 or 16 pixels.
  explicit SampleCollector(int tile_size) : row_(tile_size / 2) {
    for (int i = 0; i < row_ * row_; ++i) {
      quads_.push_back({.x = i % row_ * 2, .y = i / row_ * 2});
    }
  }

  /// A quad of one sample of the tile that is held: its top left pixel in the tile, and the bits of its
  /// pixels.
  void add(int x, int y, int sample, std::uint8_t covered, std::uint8_t passed) {
    PixelQuad& quad = quads_.at(static_cast<std::size_t>(y / 2) * static_cast<std::size_t>(row_) +
                                static_cast<std::size_t>(x / 2));
    for (std::size_t pixel = 0; pixel < 4; ++pixel) {
      quad.covered[pixel] =
          static_cast<std::uint16_t>(quad.covered[pixel] | (covered >> pixel & 1) << sample);
      quad.passed[pixel] = static_cast<std::uint16_t>(quad.passed[pixel] | (passed >> pixel & 1) << sample);
    }
  }

  /// Gives what is held to visit(PixelQuad); then nothing is.
  template <class Visit>
  void leave(Visit&& visit) {
    for (PixelQuad& quad : quads_) {
      if (quad.lives()) {
        visit(static_cast<const PixelQuad&>(quad));
      }
      quad.covered = {};
      quad.passed = {};
    }
  }

 private:
  int row_;
  std::vector<PixelQuad> quads_;
};

}  // namespace halfspace
