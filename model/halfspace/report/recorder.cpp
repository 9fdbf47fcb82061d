#include "halfspace/report/recorder.hpp"

#include <algorithm>
#include <bit>

namespace halfspace {
namespace {

#pragma pack(push, 1)
/// A record of quads.npy.
struct QuadRecord {
  std::uint32_t draw, triangle, surface, x, y;
  std::uint8_t mask, passed;
  std::uint32_t depth[4];
  std::uint64_t cycle;
};

/// A record of tiles.npy.
struct TileRecord {
  std::uint32_t draw, triangle, x, y, size;
  std::uint8_t verdict;
};
#pragma pack(pop)

constexpr const char* kQuadDescr =
    "[('draw','<u4'),('triangle','<u4'),('surface','<u4'),('x','<u4'),('y','<u4'),('mask','|u1'),('passed','|"
    "u1'),"
    "('depth','<u4',(4,)),('cycle','<u8')]";
constexpr const char* kTileDescr =
    "[('draw','<u4'),('triangle','<u4'),('x','<u4'),('y','<u4'),('size','<u4'),('verdict','|u1')]";

template <class Record>
void append(NpyWriter& file, const Record& record) {
  file.append(std::as_bytes(std::span(&record, 1)));
}

}  // namespace

Recorder::Recorder(const Frame& frame, int tile_size, const Options& options)
    : tile_size_(tile_size), sums_(options.sums) {
  if (options.quads) {
    quads_.emplace(*options.quads, kQuadDescr, sizeof(QuadRecord));
  }
  if (options.tiles) {
    tiles_.emplace(*options.tiles, kTileDescr, sizeof(TileRecord));
  }
  for (const Target& target : frame.targets) {
    if (!sums_ || target.depth_surface == kNoSurface) {
      continue;
    }
    const std::size_t count = std::max<std::size_t>(decisions.size(), target.depth_surface + 1);
    decisions.resize(count);
    lanes.resize(count);
    const int width = static_cast<int>(target.width);
    const int height = static_cast<int>(target.height);
    decisions[target.depth_surface] = {width, height, tile_size};
    lanes[target.depth_surface] = {width, height, 2};
  }
}

void Recorder::quad(const QuadEvent& event) {
  if (sums_ && event.surface != kNoSurface) {
    QuadLanes& cell = lanes[event.surface].at(event.x / 2, event.y / 2);
    ++cell.quads;
    cell.covered += static_cast<std::uint32_t>(std::popcount(event.mask));
  }
  if (quads_) {
    const auto& z = event.depth;
    append(*quads_, QuadRecord{event.draw,
                               event.triangle,
                               event.surface,
                               event.x,
                               event.y,
                               event.mask,
                               event.passed,
                               {z[0], z[1], z[2], z[3]},
                               event.cycle});
  }
}

void Recorder::decision(const DecisionEvent& event) {
  const bool undecided_block =
      event.verdict == TileVerdict::kPartial && event.size != static_cast<std::uint32_t>(tile_size_);
  if (sums_ && event.surface != kNoSurface && !undecided_block) {
    count_decision(event);
  }
  if (tiles_) {
    append(*tiles_, TileRecord{event.draw, event.triangle, event.x, event.y, event.size,
                               static_cast<std::uint8_t>(event.verdict)});
  }
}

void Recorder::count_decision(const DecisionEvent& event) {
  CellMap<TileDecisions>& map = decisions[event.surface];
  const auto tile = static_cast<std::uint32_t>(tile_size_);
  const std::uint32_t last_column =
      std::min((event.x + event.size) / tile, static_cast<std::uint32_t>(map.columns));
  const std::uint32_t last_row =
      std::min((event.y + event.size) / tile, static_cast<std::uint32_t>(map.rows));
  for (std::uint32_t row = event.y / tile; row < last_row; ++row) {
    for (std::uint32_t column = event.x / tile; column < last_column; ++column) {
      TileDecisions& cell = map.at(column, row);
      ++(event.verdict == TileVerdict::kReject   ? cell.rejected
         : event.verdict == TileVerdict::kAccept ? cell.accepted
                                                 : cell.partial);
    }
  }
}

void Recorder::finish() {
  if (quads_) {
    quads_->finish();
  }
  if (tiles_) {
    tiles_->finish();
  }
}

}  // namespace halfspace
