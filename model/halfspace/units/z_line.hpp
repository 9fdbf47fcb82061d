/// Lines of depth: the shape of the z cache, and where the lines of the depth surfaces lie in memory.
///
/// A line is one tile, or one of `parts` equal bands of its rows.
#pragma once

#include <cstdint>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/tile_mask.hpp"

namespace halfspace {

inline constexpr int kMaxZParts = 4;
inline constexpr std::uint32_t kNoZLine = 0xFFFFFFFFu;

/// Powers of two; lines >= parts * ways.
struct ZCacheShape {
  int lines = 128;  ///< in all
  int ways = 4;
  int parts = 1;
  int late_writes = 0;  ///< that may be out; 0 where no draw is late

  [[nodiscard]] int sets() const { return lines / (ways * parts); }
  friend bool operator==(const ZCacheShape&, const ZCacheShape&) = default;
};

/// Where the tiles of a depth surface lie among those of all surfaces.
struct ZSurface {
  std::uint32_t first_tile = 0;
  std::uint32_t tiles_x = 0;
  std::uint32_t tiles = 0;
  std::uint32_t line_bytes = 0;  ///< of one line in memory

  /// Number of a line of the surface in memory.
  [[nodiscard]] std::uint32_t line(std::uint32_t tile_x, std::uint32_t tile_y, int parts, int part) const {
    return (first_tile + tile_y * tiles_x + tile_x) * static_cast<std::uint32_t>(parts) +
           static_cast<std::uint32_t>(part);
  }
};

/// By how much the parts of a tile are coded, see units/z_codec.hpp: two bits each.
class ZShifts {
 public:
  constexpr ZShifts() = default;
  constexpr explicit ZShifts(std::uint8_t bits) : bits_(bits) {}
  [[nodiscard]] constexpr int of(int part) const { return bits_ >> (2 * part) & 3; }
  constexpr void set(int part, int shift) {
    bits_ = static_cast<std::uint8_t>((bits_ & ~(3 << (2 * part))) | shift << (2 * part));
  }
  [[nodiscard]] constexpr std::uint8_t bits() const { return bits_; }

 private:
  std::uint8_t bits_ = 0;
};

/// Bytes of a sample in memory.
constexpr int sample_bytes(DepthFormat format) { return format == DepthFormat::kUnorm16 ? 2 : 4; }

/// Bit i: part i of the tile has a sample of the mask.
template <int TileSize>
constexpr std::uint8_t parts_of_mask(const TileMask& mask, int parts) {
  if (parts == 1) {
    return any(mask) ? 1 : 0;
  }
  std::uint8_t found = 0;
  for (int y = 0; y < TileSize; ++y) {
    const int bit = y * TileSize;
    const std::uint64_t row = mask.word[static_cast<std::size_t>(bit / 64)] >> (bit % 64);
    const bool hit = (row & ((std::uint64_t{1} << TileSize) - 1)) != 0;
    found |= static_cast<std::uint8_t>((hit ? 1u : 0u) << (y * parts / TileSize));
  }
  return found;
}

/// Bit i: the burst of this coverage overwrites part i of the tile whole.
template <int TileSize>
constexpr std::uint8_t sure_parts(const Coverage& coverage, int parts) {
  if (coverage.sure == 0) {
    return 0;
  }
  TileMask holes;
  for (std::size_t i = 0; i < kMaskWords<TileSize>; ++i) {
    holes.word[i] = full_mask<TileSize>().word[i] & ~coverage.mask.word[i];
  }
  return static_cast<std::uint8_t>(((1u << parts) - 1) & ~parts_of_mask<TileSize>(holes, parts));
}

}  // namespace halfspace
