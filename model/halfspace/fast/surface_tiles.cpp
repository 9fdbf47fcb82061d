#include "halfspace/fast/surface_tiles.hpp"

#include <algorithm>
#include <bit>

namespace halfspace::fast {

namespace {

std::uint32_t columns_of_thread(int tiles_x, int block_tiles, std::uint32_t threads) {
  const auto columns = static_cast<std::uint32_t>((tiles_x + block_tiles - 1) / block_tiles);
  return (columns + threads - 1) / threads;
}

std::uint32_t blocks_of_thread(std::uint32_t columns, int tiles_y, int block_tiles, std::uint32_t threads) {
  constexpr std::uint32_t kLine = 64;  // bytes of the processor's cache: a block has one, or more
  const std::uint32_t blocks =
      columns * static_cast<std::uint32_t>((tiles_y + block_tiles - 1) / block_tiles);
  // and vectors read past the last
  return threads == 1 ? blocks : (blocks + kLanes + kLine - 1) / kLine * kLine;
}

}  // namespace

SurfaceTiles::SurfaceTiles(const TiledImage<std::uint32_t>& codes, int block_tiles, std::uint32_t code,
                           std::uint32_t threads)
    : block_shift(std::countr_zero(static_cast<unsigned>(block_tiles))),
      thread_shift(std::countr_zero(threads)),
      across(columns_of_thread(codes.tiles_x(), block_tiles, threads)),
      of_thread(blocks_of_thread(across, codes.tiles_y(), block_tiles, threads)),
      blocks(of_thread * threads),
      entries(static_cast<std::size_t>(std::max(block_tiles * block_tiles, kLanes))),
      block_min(unset_array<std::int32_t>(blocks + kLanes, Pages::kSmall)),  // vectors read past the last
      block_max(unset_array<std::int32_t>(blocks + kLanes, Pages::kSmall)),
      block_plane(unset_array<std::uint32_t>(blocks, Pages::kSmall)),
      bounded(zeroed_array<std::uint8_t>(blocks)),
      opened(zeroed_array<std::uint8_t>(blocks)),
      z_min(unset_array<std::int32_t>(blocks * entries, Pages::kSmall)),
      z_max(unset_array<std::int32_t>(blocks * entries, Pages::kSmall)),
      plane(unset_array<std::uint32_t>(blocks * entries, Pages::kSmall)),
      whole_fragments(unset_array<std::int32_t>(blocks * entries, Pages::kSmall)),
      whole_survivors(unset_array<std::int32_t>(blocks * entries, Pages::kSmall)),
      fragments(blocks * entries),
      survivors(blocks * entries),
      counted(zeroed_array<std::uint8_t>(blocks)),
      lists(threads) {
  clear(code);
}

void SurfaceTiles::clear(std::uint32_t code) {
  for (std::uint32_t list = 0; list < lists.size(); ++list) {
    forget_planes(list);
  }
  cleared_to = static_cast<std::int32_t>(code);
  ++epoch;
  if (epoch == kNever) {  // before a number comes again, all flags go back
    bounded = zeroed_array<std::uint8_t>(blocks);
    opened = zeroed_array<std::uint8_t>(blocks);
    epoch = 1;
  }
}

std::uint32_t SurfaceTiles::add_plane(std::uint32_t number, Plane& plane, const DepthEquation* equation) {
  PlaneList& list = lists[number];
  const auto in_list = [&](std::size_t index) {
    return number << kListShift | static_cast<std::uint32_t>(index);
  };
  if (equation != nullptr) {
    plane.equation = in_list(list.equations.size());
    list.equations.push_back(*equation);
  }
  list.planes.push_back(plane);
  return in_list(list.planes.size() - 1);
}

void SurfaceTiles::begin_frame() {
  ++frame;
  if (frame == 0) {  // as with `epoch`
    counted = zeroed_array<std::uint8_t>(blocks);
    frame = 1;
  }
}

void SurfaceTiles::start_counts(std::uint32_t number) {
  std::fill_n(whole_fragments.get() + number * entries, entries, 0);
  std::fill_n(whole_survivors.get() + number * entries, entries, 0);
  fragments.start(number * entries, entries);
  survivors.start(number * entries, entries);
  counted[number] = frame;
}

void SurfaceTiles::start(std::uint32_t number) {
  if (!is_bounded(number)) {
    become_plane(number, kResolved, cleared_to, cleared_to);
  }
  const std::size_t first = number * entries;
  std::fill_n(z_min.get() + first, entries, block_min[number]);
  std::fill_n(z_max.get() + first, entries, block_max[number]);
  std::fill_n(plane.get() + first, entries, block_plane[number]);
  opened[number] = epoch;
}

}  // namespace halfspace::fast
