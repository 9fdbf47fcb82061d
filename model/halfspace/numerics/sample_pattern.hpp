/// Where the samples of a pixel are.
///
/// Positions are on the grid of sixteenths of a pixel that Direct3D and Vulkan share, so every machine, of 4
/// sub-pixel bits or more, has them exactly. docs/guides/multisampling.md.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace halfspace {

inline constexpr int kSampleGridLog2 = 4;
inline constexpr int kSampleGrid = 1 << kSampleGridLog2;  ///< positions along a side of a pixel
inline constexpr int kMostSamples = 16;

/// Sixteenths of a pixel from its top left corner, 0 to 15.
struct SamplePosition {
  std::uint8_t x = kSampleGrid / 2;
  std::uint8_t y = kSampleGrid / 2;
  friend bool operator==(const SamplePosition&, const SamplePosition&) = default;
};

/// Sixteenths as a way in 1/2^sub_pixel_bits pixel; 4 to 8 bits.
constexpr std::int32_t sample_way(int sixteenths, int sub_pixel_bits) {
  return sixteenths * (1 << (sub_pixel_bits - kSampleGridLog2));
}

/// The least box that holds all samples of a pixel, in sixteenths, inclusive.
struct SampleBox {
  std::uint8_t x_least = kSampleGrid / 2;
  std::uint8_t x_most = kSampleGrid / 2;
  std::uint8_t y_least = kSampleGrid / 2;
  std::uint8_t y_most = kSampleGrid / 2;
};

/// The samples of a pixel in their order; those behind `count` mean nothing.
struct SamplePattern {
  int count = 1;
  std::array<SamplePosition, kMostSamples> at{};

  [[nodiscard]] std::span<const SamplePosition> positions() const {
    return {at.data(), static_cast<std::size_t>(count)};
  }

  /// One sample, at the centre of the pixel: what a machine without multisampling has.
  [[nodiscard]] bool is_centre() const { return count == 1 && at[0] == SamplePosition{}; }

  [[nodiscard]] SampleBox box() const {
    SampleBox box{.x_least = at[0].x, .x_most = at[0].x, .y_least = at[0].y, .y_most = at[0].y};
    for (const SamplePosition& each : positions()) {
      box = {.x_least = std::min(box.x_least, each.x),
             .x_most = std::max(box.x_most, each.x),
             .y_least = std::min(box.y_least, each.y),
             .y_most = std::max(box.y_most, each.y)};
    }
    return box;
  }

  friend bool operator==(const SamplePattern& l, const SamplePattern& r) {
    return std::ranges::equal(l.positions(), r.positions());
  }
};

/// As the RTL is given it, a number of 8 bits for each of kMostSamples: x and y, the first sample in the
/// lowest bits.
inline std::string to_hex(const SamplePattern& samples) {
  std::string text = std::to_string(8 * kMostSamples) + "'h";
  for (int i = samples.count - 1; i >= 0; --i) {
    const SamplePosition& at = samples.at[static_cast<std::size_t>(i)];
    text += "0123456789abcdef"[at.x];
    text += "0123456789abcdef"[at.y];
  }
  return text;
}

/// As the value of a key: the standard positions, of as many samples as there are.
inline constexpr SamplePattern kStandardSamples{.count = 0};

/// The standard positions of 1, 2, 4, 8 or 16 samples: `standardSampleLocations` of Vulkan, which are the
/// standard multisample patterns of Direct3D 11.
constexpr SamplePattern standard_samples(int count) {
  switch (count) {
    case 2:
      return {2, {{{12, 12}, {4, 4}}}};
    case 4:
      return {4, {{{6, 2}, {14, 6}, {2, 10}, {10, 14}}}};
    case 8:
      return {8, {{{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}}}};
    case 16:
      return {16,
              {{{9, 9},
                {7, 5},
                {5, 10},
                {12, 7},
                {3, 6},
                {10, 13},
                {13, 11},
                {11, 3},
                {6, 14},
                {8, 1},
                {4, 2},
                {2, 12},
                {0, 8},
                {15, 4},
                {14, 15},
                {1, 0}}}};
    default:
      return {};
  }
}

}  // namespace halfspace
