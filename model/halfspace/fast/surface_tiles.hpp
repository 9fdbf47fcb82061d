/// What the fast core knows of the tiles of a depth surface: bounds of their codes, and the triangle whose
/// plane they still are.
///
/// A tile that a triangle covered whole, each of whose samples passed, is that triangle's plane: its codes
/// are made when somebody looks at them. So is a block, until something that does not cover it whole opens
/// it: what is known of its tiles is there from then on. Like TiledImage, the lists take memory where
/// something is drawn.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "halfspace/fast/block_cache.hpp"
#include "halfspace/fast/pixel_counts.hpp"
#include "halfspace/fast/set_up.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/units/lazy_array.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace::fast {

/// Of SurfaceTiles::plane: the codes are in the image.
inline constexpr std::uint32_t kResolved = 0xFFFFFFFFu;

/// Planes that tiles are, in a list for each thread that draws.
struct alignas(128) PlaneList {
  std::vector<Plane> planes;
  std::vector<DepthEquation> equations;  ///< of planes that the units must resolve
};

struct SurfaceTiles {
  SurfaceTiles() = default;
  /// `block_tiles`: tiles on a side of a block. Every tile has `code` in every sample.
  SurfaceTiles(const TiledImage<std::uint32_t>& codes, int block_tiles, std::uint32_t code,
               std::uint32_t threads);

  /// The next block from `number` on that may have been used since its memory was new, by these flags: what
  /// nobody drew on is passed over a line of the processor's cache at a time.
  [[nodiscard]] std::uint32_t next_used(const std::uint8_t* flags, std::uint32_t number) const {
    constexpr std::uint32_t kLine = 64;
    static constexpr std::array<std::uint8_t, kLine> kUnused{};
    while (number % kLine == 0 && number + kLine <= blocks &&
           std::memcmp(flags + number, kUnused.data(), kLine) == 0) {
      number += kLine;
    }
    return number;
  }

  /// Before something looks at the tiles of a block.
  void open(std::uint32_t number) {
    if (!is_open(number)) [[unlikely]] {
      start(number);
    }
  }
  [[nodiscard]] bool is_open(std::uint32_t number) const { return opened[number] == epoch; }
  /// Samples of a block that is open have changed.
  void change(std::uint32_t number) { bounded[number] = kNever; }
  /// Whether block_min and block_max hold.
  [[nodiscard]] bool is_bounded(std::uint32_t number) const { return bounded[number] == epoch; }
  void bound(std::uint32_t number, std::int32_t low, std::int32_t high) {
    block_min[number] = low;
    block_max[number] = high;
    bounded[number] = epoch;
  }
  /// A block is a plane, with codes from `low` to `high`, or kResolved and what clears it.
  void become_plane(std::uint32_t number, std::uint32_t plane_number, std::int32_t low, std::int32_t high) {
    bound(number, low, high);
    block_plane[number] = plane_number;
    opened[number] = kNever;
  }

  /// Before the counts of a block's tiles are added to.
  void open_counts(std::uint32_t number) {
    if (!is_counted(number)) [[unlikely]] {
      start_counts(number);
    }
  }
  [[nodiscard]] bool is_counted(std::uint32_t number) const { return counted[number] == frame; }
  /// A frame begins: nothing is counted.
  void begin_frame();

  /// Block (x, y), in blocks. Those of a thread's columns lie together, so that no two threads write to the
  /// same line of the processor's cache.
  [[nodiscard]] std::uint32_t block(std::uint32_t x, std::uint32_t y) const {
    return (x & ((1u << thread_shift) - 1)) * of_thread + y * across + (x >> thread_shift);
  }
  /// The first tile of a block.
  struct Tile {
    int x;
    int y;
  };
  [[nodiscard]] Tile first_tile(std::uint32_t block) const {
    const std::uint32_t in_columns = block % of_thread;
    const std::uint32_t x = in_columns % across << thread_shift | block / of_thread;
    return {static_cast<int>(x << block_shift), static_cast<int>(in_columns / across << block_shift)};
  }
  /// Where a tile is in the lists below.
  [[nodiscard]] std::size_t index(int tile_x, int tile_y) const {
    const auto x = static_cast<std::uint32_t>(tile_x);
    const auto y = static_cast<std::uint32_t>(tile_y);
    const std::uint32_t in_block = (1u << block_shift) - 1;
    return block(x >> block_shift, y >> block_shift) * entries + ((y & in_block) << block_shift) +
           (x & in_block);
  }

  /// Every tile has `code` in every sample of the image, too.
  void clear(std::uint32_t code);

  /// Adds a plane to a list, with its equation where the units must resolve it; gives its number.
  std::uint32_t add_plane(std::uint32_t list, Plane& plane, const DepthEquation* equation);
  [[nodiscard]] const Plane& plane_of(std::uint32_t number) const {
    return lists[number >> kListShift].planes[number & kInList];
  }
  [[nodiscard]] const DepthEquation& equation_of(const Plane& plane) const {
    return lists[plane.equation >> kListShift].equations[plane.equation & kInList];
  }
  /// Forgets the planes of a list, when no tile is one.
  void forget_planes(std::uint32_t list) {
    lists[list].planes.clear();
    lists[list].equations.clear();
  }

  int block_shift = 0;          ///< log2 of the tiles on a side of a block
  int thread_shift = 0;         ///< log2 of the threads
  std::uint32_t across = 0;     ///< columns of blocks of a thread
  std::uint32_t of_thread = 0;  ///< blocks of a thread, with some that no tile is in
  std::uint32_t blocks = 0;     ///< of all threads
  std::size_t entries = 0;      ///< of a block: its tiles in row order, and groups of kLanes full
  // By block. One that is neither bounded nor open is as it was cleared.
  LazyArray<std::int32_t> block_min;  ///< no code of the block is less
  LazyArray<std::int32_t> block_max;
  LazyArray<std::uint32_t> block_plane;  ///< where it is not open: as `plane`
  LazyArray<std::uint8_t> bounded;       ///< the epoch in which block_min and block_max hold
  LazyArray<std::uint8_t> opened;        ///< the epoch in which its tiles are what counts
  // By tile, where the block is open.
  LazyArray<std::int32_t> z_min;  ///< no code of the tile is less
  LazyArray<std::int32_t> z_max;
  LazyArray<std::uint32_t> plane;  ///< its number, or kResolved
  std::uint8_t epoch = 0;          ///< counts clears
  // Of pixels, what is the same for all of a tile, and the rest; clears leave it.
  LazyArray<std::int32_t> whole_fragments;
  LazyArray<std::int32_t> whole_survivors;
  PixelCounts fragments;
  PixelCounts survivors;
  LazyArray<std::uint8_t> counted;  ///< by block: the frame in which it was
  std::uint8_t frame = 1;           ///< counts frames
  std::int32_t cleared_to = 0;      ///< what blocks are that are neither bounded nor open
  std::vector<PlaneList> lists;

 private:
  static constexpr std::uint8_t kNever = 0;  ///< no epoch
  static constexpr int kListShift = 24;      ///< of a number
  static constexpr std::uint32_t kInList = (1u << kListShift) - 1;

  void start(std::uint32_t number);
  void start_counts(std::uint32_t number);
};

}  // namespace halfspace::fast
