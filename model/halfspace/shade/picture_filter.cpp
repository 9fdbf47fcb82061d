#include "halfspace/shade/picture_filter.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace halfspace {
namespace {

/// Samples of one direction that a pixel takes: from `first` on, with whole weights.
struct Taps {
  int first = 0;
  std::vector<std::int64_t> weights;
  std::int64_t sum = 0;
};

/// In half samples, the pixel's centre is `times` from its first border, and sample i of it 2 i + 1.
Taps taps_of(int pixel, int times, int size, PictureFilter filter) {
  const int reach = filter == PictureFilter::kBox ? 0 : (times + 1) / 2;
  Taps taps{.first = std::max(0, pixel * times - reach), .weights = {}, .sum = 0};
  const int end = std::min(size, (pixel + 1) * times + reach);
  for (int sample = taps.first; sample < end; ++sample) {
    const int distance = std::abs(2 * (sample - pixel * times) + 1 - times);
    const std::int64_t weight = filter == PictureFilter::kBox ? 1 : std::max(0, 2 * times - distance);
    taps.weights.push_back(weight);
    taps.sum += weight;
  }
  return taps;
}

Rgb filtered(const Picture& picture, const Taps& across, const Taps& down) {
  std::array<std::int64_t, 3> sum{};
  for (std::size_t y = 0; y < down.weights.size(); ++y) {
    for (std::size_t x = 0; x < across.weights.size(); ++x) {
      const Rgb& sample = picture.at(across.first + static_cast<int>(x), down.first + static_cast<int>(y));
      for (std::size_t i = 0; i < sum.size(); ++i) {
        sum[i] += down.weights[y] * across.weights[x] * sample[i];
      }
    }
  }
  const std::int64_t all = across.sum * down.sum;
  Rgb out{};
  for (std::size_t i = 0; i < sum.size(); ++i) {
    out[i] = static_cast<std::uint8_t>((2 * sum[i] + all) / (2 * all));
  }
  return out;
}

}  // namespace

Picture shrink(const Picture& picture, int times, PictureFilter filter) {
  Picture out(picture.width / times, picture.height / times);
  std::vector<Taps> across;
  across.reserve(static_cast<std::size_t>(out.width));
  for (int x = 0; x < out.width; ++x) {
    across.push_back(taps_of(x, times, picture.width, filter));
  }
  for (int y = 0; y < out.height; ++y) {
    const Taps down = taps_of(y, times, picture.height, filter);
    for (int x = 0; x < out.width; ++x) {
      out.at(x, y) = filtered(picture, across[static_cast<std::size_t>(x)], down);
    }
  }
  return out;
}

}  // namespace halfspace
