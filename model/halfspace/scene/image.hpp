/// Images of textures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace halfspace {

inline constexpr std::uint32_t kMaxImageSize = 16384;                         ///< texels on a side
inline constexpr std::uint64_t kMaxImageTexels = std::uint64_t{1} << 26;      ///< of one image
inline constexpr std::uint64_t kMaxMeshImageTexels = std::uint64_t{1} << 27;  ///< of all images of a mesh

/// Row 0 on top. Red, green and blue are encoded as sRGB; alpha is linear.
struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::array<std::uint8_t, 4>> texels;
};

/// A PNG or JPEG file, by content. Throws InputError where it is neither, is damaged, or is larger than
/// legal or than `texels`; the text says why and names no file.
[[nodiscard]] Image decode_image(std::span<const std::byte> bytes, std::uint64_t texels = kMaxImageTexels);

}  // namespace halfspace
