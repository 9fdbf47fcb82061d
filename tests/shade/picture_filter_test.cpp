// Filters of supersampling, beside sums over all samples of the picture by the definition, in double.
#include "halfspace/shade/picture_filter.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "../property/random.hpp"

using namespace halfspace;
using halfspace::testing::Random;
using halfspace::testing::seed;

namespace {

/// The filter at a distance from the pixel's centre, in pixels.
double weight(PictureFilter filter, double x, double y) {
  if (filter == PictureFilter::kBox) {
    return std::abs(x) < 0.5 && std::abs(y) < 0.5 ? 1 : 0;
  }
  return std::max(0.0, 1 - std::abs(x)) * std::max(0.0, 1 - std::abs(y));
}

double mean_at(const Picture& picture, int times, PictureFilter filter, int px, int py, std::size_t channel) {
  double sum = 0;
  double all = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const double w = weight(filter, (x + 0.5) / times - (px + 0.5), (y + 0.5) / times - (py + 0.5));
      sum += w * picture.at(x, y)[channel];
      all += w;
    }
  }
  return sum / all;
}

Picture random_picture(Random& random, int width, int height) {
  Picture picture(width, height);
  for (Rgb& pixel : picture.pixels) {
    for (std::uint8_t& each : pixel) {
      each = static_cast<std::uint8_t>(random.between(0, 255));
    }
  }
  return picture;
}

}  // namespace

TEST_CASE("picture filter: box and tent are weighted means by their definition", "[property]") {
  CAPTURE(seed());
  Random random(seed());
  for (int times = 1; times <= 7; ++times) {
    for (const PictureFilter filter : {PictureFilter::kBox, PictureFilter::kTent}) {
      const auto width = static_cast<int>(random.between(1, 5));
      const auto height = static_cast<int>(random.between(1, 5));
      const Picture large = random_picture(random, width * times, height * times);
      const Picture small = shrink(large, times, filter);
      REQUIRE(small.width == width);
      REQUIRE(small.height == height);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          for (std::size_t channel = 0; channel < 3; ++channel) {
            CAPTURE(times, filter, x, y);
            CHECK(std::abs(small.at(x, y)[channel] - mean_at(large, times, filter, x, y, channel)) <=
                  0.5 + 1e-9);
          }
        }
      }
    }
  }
}

TEST_CASE("picture filter: a tent sees half a pixel beyond its own") {
  Picture large(12, 4);
  large.at(7, 0) = {255, 0, 0};  // in the second pixel of three, next to the third
  CHECK(shrink(large, 4, PictureFilter::kBox).at(2, 0)[0] == 0);
  CHECK(shrink(large, 4, PictureFilter::kTent).at(2, 0)[0] > 0);
  CHECK(shrink(large, 4, PictureFilter::kTent).at(0, 0)[0] == 0);
}
