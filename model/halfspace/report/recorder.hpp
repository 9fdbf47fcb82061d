/// What a run leaves of its packets: quads.npy, tiles.npy, and sums a pixel or tile for the pictures.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/report/npy.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace {

/// Sums over the squares of a surface, in row order.
template <class Cell>
struct CellMap {
  int columns = 0;
  int rows = 0;
  std::vector<Cell> cells;

  CellMap() = default;
  CellMap(int width, int height, int cell)
      : columns((width + cell - 1) / cell),
        rows((height + cell - 1) / cell),
        cells(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {}
  [[nodiscard]] Cell& at(std::uint32_t column, std::uint32_t row) {
    return cells[std::size_t{row} * static_cast<std::size_t>(columns) + column];
  }
};

/// Decisions of the walker about one tile; a block counts for each of its tiles.
struct TileDecisions {
  std::uint32_t rejected = 0;
  std::uint32_t accepted = 0;
  std::uint32_t partial = 0;
};

/// Quads that left at one place and the samples they covered.
struct QuadLanes {
  std::uint32_t quads = 0;
  std::uint32_t covered = 0;
};

/// Streams records to files and keeps the sums, as asked.
class Recorder : public PacketObserver {
 public:
  struct Options {
    std::optional<std::filesystem::path> quads;  ///< file to write
    std::optional<std::filesystem::path> tiles;  ///< file to write
    bool sums = false;                           ///< for the pictures
  };

  Recorder(const Frame& frame, int tile_size, const Options& options);

  [[nodiscard]] bool wants_quads() const override { return quads_.has_value() || sums_; }
  [[nodiscard]] bool wants_decisions() const override { return tiles_.has_value() || sums_; }
  void quad(const QuadEvent& event) override;
  void decision(const DecisionEvent& event) override;

  /// Completes the files. Throws InputError.
  void finish();

  std::vector<CellMap<TileDecisions>> decisions;  ///< by surface, a cell a tile
  std::vector<CellMap<QuadLanes>> lanes;          ///< by surface, a cell a quad

 private:
  void count_decision(const DecisionEvent& event);

  int tile_size_;
  bool sums_;
  std::optional<NpyWriter> quads_;
  std::optional<NpyWriter> tiles_;
};

}  // namespace halfspace
