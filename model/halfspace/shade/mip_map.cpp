#include "halfspace/shade/mip_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "halfspace/scene/srgb.hpp"

namespace halfspace {
namespace {

using Texel = std::array<std::uint8_t, 4>;

float light_of(std::uint8_t stored) {
  static const std::array<float, 256> kLight = [] {
    std::array<float, 256> light{};
    for (std::size_t i = 0; i < light.size(); ++i) light[i] = srgb_to_linear(static_cast<float>(i) / 255);
    return light;
  }();
  return kLight[stored];
}

glm::vec4 light_of(const Texel& texel) {
  return {light_of(texel[0]), light_of(texel[1]), light_of(texel[2]), static_cast<float>(texel[3]) / 255};
}

Texel texel_of(const glm::vec4& light) {
  const auto stored = [](float value) { return static_cast<std::uint8_t>(std::lround(value * 255)); };
  return {stored(linear_to_srgb(light.r)), stored(linear_to_srgb(light.g)), stored(linear_to_srgb(light.b)),
          stored(light.a)};
}

const Texel& texel_at(const Image& image, std::uint32_t x, std::uint32_t y) {
  return image.texels[std::size_t{y} * image.width + x];
}

/// The texels [first, second) of `size` that texel `at` of `half` lies over.
std::pair<std::uint32_t, std::uint32_t> range_of(std::uint32_t at, std::uint32_t size, std::uint32_t half) {
  return {static_cast<std::uint32_t>(std::uint64_t{at} * size / half),
          static_cast<std::uint32_t>((std::uint64_t{at} + 1) * size / half)};
}

Image half_of(const Image& image) {
  Image half{.width = std::max(image.width / 2, 1u), .height = std::max(image.height / 2, 1u), .texels = {}};
  half.texels.reserve(std::size_t{half.width} * half.height);
  for (std::uint32_t row = 0; row < half.height; ++row) {
    const auto [top, bottom] = range_of(row, image.height, half.height);
    for (std::uint32_t column = 0; column < half.width; ++column) {
      const auto [left, right] = range_of(column, image.width, half.width);
      glm::vec4 sum(0);
      for (std::uint32_t y = top; y < bottom; ++y) {
        for (std::uint32_t x = left; x < right; ++x) sum += light_of(texel_at(image, x, y));
      }
      half.texels.push_back(texel_of(sum / static_cast<float>((bottom - top) * (right - left))));
    }
  }
  return half;
}

/// Which of `size` texels stands at `at`, which may be beyond.
std::uint32_t wrapped(std::int64_t at, std::uint32_t size, Wrap wrap) {
  const auto n = static_cast<std::int64_t>(size);
  const auto modulo = [at](std::int64_t period) { return (at % period + period) % period; };
  switch (wrap) {
    case Wrap::kRepeat:
      return static_cast<std::uint32_t>(modulo(n));
    case Wrap::kMirror:
      return static_cast<std::uint32_t>(modulo(2 * n) < n ? modulo(2 * n) : 2 * n - 1 - modulo(2 * n));
    case Wrap::kClamp:
      break;
  }
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(at, 0, n - 1));
}

/// The two texels on each side of a coordinate, and how far it is from the first to the second.
struct Between {
  std::uint32_t first;
  std::uint32_t second;
  float part;
};

Between between(float coordinate, std::uint32_t size, Wrap wrap) {
  const float at = coordinate * static_cast<float>(size) - 0.5f;
  const float below = std::floor(at);
  const auto first = static_cast<std::int64_t>(below);
  return {wrapped(first, size, wrap), wrapped(first + 1, size, wrap), at - below};
}

glm::vec4 bilinear(const Image& image, glm::vec2 uv, const Texture& texture) {
  const Between u = between(uv.x, image.width, texture.wrap_u);
  const Between v = between(uv.y, image.height, texture.wrap_v);
  const auto row = [&](std::uint32_t y) {
    return glm::mix(light_of(texel_at(image, u.first, y)), light_of(texel_at(image, u.second, y)), u.part);
  };
  return glm::mix(row(v.first), row(v.second), v.part);
}

}  // namespace

MipMap::MipMap(const Image& image) : levels_{image} {
  while (levels_.back().width > 1 || levels_.back().height > 1) levels_.push_back(half_of(levels_.back()));
}

float MipMap::level_of(glm::vec2 right, glm::vec2 down) const {
  const glm::vec2 size(levels_.front().width, levels_.front().height);
  return std::log2(std::max(glm::length(right * size), glm::length(down * size)));
}

glm::vec4 MipMap::sample(glm::vec2 uv, float level, const Texture& texture) const {
  const float at = std::clamp(level, 0.0f, static_cast<float>(levels_.size() - 1));
  const auto first = static_cast<std::size_t>(at);
  const float part = at - static_cast<float>(first);
  const glm::vec4 here = bilinear(levels_[first], uv, texture);
  return part == 0 ? here : glm::mix(here, bilinear(levels_[first + 1], uv, texture), part);
}

Image checker_image() {
  constexpr std::uint32_t kSquares = 8;
  constexpr std::uint32_t kSide = 32;  // texels of a square
  Image image{.width = kSquares * kSide, .height = kSquares * kSide, .texels = {}};
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const std::uint8_t grey = (x / kSide + y / kSide) % 2 == 0 ? 230 : 90;
      image.texels.push_back({grey, grey, grey, 255});
    }
  }
  return image;
}

}  // namespace halfspace
