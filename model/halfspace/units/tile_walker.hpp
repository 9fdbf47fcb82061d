/// tile_walker: from a block to its tiles, one after the other.
///
/// Tiles leave in the order of the configuration, each with its edges, its part of the bounds, and an accept
/// bit for every edge that all its samples are inside of: the edge evaluator need not look at that edge. With
/// several samples a pixel a tile leaves once for each of them, in their order.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "halfspace/units/packets.hpp"
#include "halfspace/units/square_edges.hpp"

namespace halfspace {

enum class TileVerdict : std::uint8_t { kReject = 0, kAccept = 1, kPartial = 2 };

/// Walks one block. Calls sink.tile(job, whole) for every tile of the mask, and sample of a pixel; `whole`:
/// all samples of the job are covered.
template <int TileSize, class Sink>
void tile_walker(const BlockJob& block, const WalkerConfig& config, Sink& sink) {
  const int row_tiles = config.block_size / TileSize;
  const SquareEdges edges(block.e, block.a, block.b, config.sub_pixel_bits);
  TileJob job{.slot = block.slot, .a = block.a, .b = block.b};
  const auto make = [&](int tile) {
    const int tile_x = tile % row_tiles;
    const int tile_y = tile / row_tiles;
    const int x = tile_x * TileSize;
    const int y = tile_y * TileSize;
    job.tile_y = static_cast<std::uint16_t>(block.block_y * row_tiles + tile_y);
    job.sure = static_cast<std::uint8_t>(block.sure >> tile & 1);
    const auto in_tile = [](int pixel, int first) {
      return static_cast<std::uint8_t>(std::clamp(pixel - first, 0, TileSize - 1));
    };
    job.x_first = in_tile(block.x_first, x);
    job.x_last = in_tile(block.x_last, x);
    job.y_first = in_tile(block.y_first, y);
    job.y_last = in_tile(block.y_last, y);
    const bool filled = job.x_last - job.x_first == TileSize - 1 && job.y_last - job.y_first == TileSize - 1;
    const std::array<std::int64_t, 3> centre = edges.at(x, y);
    const int column = (block.block_x * row_tiles + tile_x) * config.samples.count;
    for (int sample = 0; sample < config.samples.count; ++sample) {
      const SamplePosition& position = config.samples.at[static_cast<std::size_t>(sample)];
      job.tile_x = static_cast<std::uint16_t>(column + sample);
      job.accept = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        job.e[i] = centre[i] + to_sample(job.a[i], job.b[i], position, config.sub_pixel_bits);
        const bool inside = config.trivial_accept && job.e[i] + edges.to_least(i, TileSize) >= 0;
        job.accept = static_cast<std::uint8_t>(job.accept | (inside ? 1u << i : 0u));
      }
      sink.tile(job, job.accept == 7 && filled);
    }
  };
  if (config.tile_order == TileOrder::kRaster) {
    for (std::uint64_t left = block.tiles; left != 0; left &= left - 1) {
      make(std::countr_zero(left));
    }
  } else {
    for_each_in_order(config.tile_order, row_tiles, block.tiles, make);
  }
}

}  // namespace halfspace
