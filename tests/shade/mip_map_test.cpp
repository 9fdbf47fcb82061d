// Smaller copies of images and how they are read, beside a second implementation from the definition.
#include "halfspace/shade/mip_map.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "../property/random.hpp"

using namespace halfspace;
using halfspace::testing::Random;
using halfspace::testing::seed;

namespace {

Image random_image(Random& random, std::uint32_t width, std::uint32_t height) {
  Image image{.width = width, .height = height, .texels = {}};
  for (std::uint32_t i = 0; i < width * height; ++i) {
    std::array<std::uint8_t, 4> texel{};
    for (std::uint8_t& each : texel) each = static_cast<std::uint8_t>(random.between(0, 255));
    image.texels.push_back(texel);
  }
  return image;
}

/// IEC 61966-2-1 in double; alpha is as it is.
double light_in(std::uint8_t stored, std::size_t channel) {
  const double c = stored / 255.0;
  if (channel == 3) return c;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// Which texel an address means, step by step: from outside until it is in.
std::int64_t address(std::int64_t at, std::int64_t size, Wrap wrap) {
  while (at < 0 || at >= size) {
    if (wrap == Wrap::kClamp) return at < 0 ? 0 : size - 1;
    if (wrap == Wrap::kRepeat) at += at < 0 ? size : -size;
    if (wrap == Wrap::kMirror) at = at < 0 ? -1 - at : 2 * size - 1 - at;
  }
  return at;
}

/// The mean of the four texels around (u, v), by how near they are.
double bilinear_in(const Image& image, glm::dvec2 uv, const Texture& texture, std::size_t channel) {
  double sum = 0;
  const std::int64_t width = image.width;
  const std::int64_t height = image.height;
  const double x = uv.x * image.width;
  const double y = uv.y * image.height;
  for (std::int64_t row = -4 * height; row < 5 * height; ++row) {
    for (std::int64_t column = -4 * width; column < 5 * width; ++column) {
      const double near_x = 1 - std::abs(static_cast<double>(column) + 0.5 - x);
      const double near_y = 1 - std::abs(static_cast<double>(row) + 0.5 - y);
      if (near_x <= 0 || near_y <= 0) continue;
      const std::int64_t at =
          address(row, height, texture.wrap_v) * width + address(column, width, texture.wrap_u);
      sum += near_x * near_y * light_in(image.texels[static_cast<std::size_t>(at)][channel], channel);
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("mip map: levels halve, and a texel is the mean of the light below it") {
  CAPTURE(seed());
  Random random(seed());
  const Image image = random_image(random, 6, 4);
  const MipMap map(image);
  REQUIRE(map.levels() == 3);
  CHECK(map.level(1).width == 3);
  CHECK(map.level(1).height == 2);
  CHECK(map.level(2).width == 1);
  CHECK(map.level(2).height == 1);
  for (std::uint32_t y = 0; y < 2; ++y) {
    for (std::uint32_t x = 0; x < 3; ++x) {
      for (std::size_t c = 0; c < 4; ++c) {
        double sum = 0;
        for (const std::uint32_t at :
             {12 * y + 2 * x, 12 * y + 2 * x + 1, 12 * y + 6 + 2 * x, 12 * y + 7 + 2 * x}) {
          sum += light_in(image.texels[at][c], c);
        }
        // Stored in 8 bits: to the nearest.
        const int stored = map.level(1).texels[3 * y + x][c];
        const double low = stored == 0 ? 0 : light_in(static_cast<std::uint8_t>(stored - 1), c);
        const double high = stored == 255 ? 1 : light_in(static_cast<std::uint8_t>(stored + 1), c);
        CHECK(sum / 4 > low - 1e-6);
        CHECK(sum / 4 < high + 1e-6);
      }
    }
  }
  const MipMap odd(random_image(random, 5, 1));
  REQUIRE(odd.levels() == 3);
  CHECK(odd.level(1).width == 2);
  CHECK(odd.level(1).height == 1);
}

TEST_CASE("mip map: the level is log2 of the texels that a pixel spans") {
  Random random(1);
  const MipMap map(random_image(random, 64, 16));
  CHECK(map.level_of({1 / 64.0f, 0}, {0, 1 / 16.0f}) == 0);
  CHECK(map.level_of({4 / 64.0f, 0}, {0, 1 / 16.0f}) == 2);
  CHECK(map.level_of({0, 8 / 16.0f}, {0, 0}) == 3);
  CHECK(map.level_of({3 / 64.0f, 4 / 16.0f}, {0, 0}) == Approx(std::log2(5)));
  CHECK(map.level_of({0.5f / 64, 0}, {0, 0}) == -1);
}

TEST_CASE("mip map: bilinear in a level, linear between two, every wrap") {
  CAPTURE(seed());
  Random random(seed());
  constexpr std::array kWraps{Wrap::kRepeat, Wrap::kMirror, Wrap::kClamp};
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    const MipMap map(random_image(random, static_cast<std::uint32_t>(random.between(1, 7)),
                                  static_cast<std::uint32_t>(random.between(1, 7))));
    const Texture texture{.image = 0,
                          .wrap_u = kWraps[static_cast<std::size_t>(random.between(0, 2))],
                          .wrap_v = kWraps[static_cast<std::size_t>(random.between(0, 2))]};
    const glm::vec2 uv{static_cast<float>(random.between(-3000, 3000)) / 1000,
                       static_cast<float>(random.between(-3000, 3000)) / 1000};
    const auto level = static_cast<float>(random.between(-8, 32)) / 8;
    const glm::vec4 found = map.sample(uv, level, texture);
    const double kept = std::min(std::max(level, 0.0f), static_cast<float>(map.levels() - 1));
    const auto first = static_cast<std::size_t>(kept);
    const std::size_t second = std::min(first + 1, map.levels() - 1);
    for (std::size_t c = 0; c < 4; ++c) {
      const double part = kept - static_cast<double>(first);
      const double wanted = (1 - part) * bilinear_in(map.level(first), uv, texture, c) +
                            part * bilinear_in(map.level(second), uv, texture, c);
      worst = std::max(worst, std::abs(wanted - found[static_cast<int>(c)]));
    }
  }
  CHECK(worst < 1e-5);
}
