#include "tile_coverage.hpp"

#include <fmt/format.h>

#include <bit>

#include "stimulus.hpp"

namespace halfspace::tb {
namespace {

constexpr std::array<const char*, 4> kSides = {"left", "right", "top", "bottom"};
constexpr std::array<const char*, 2> kNoYes = {"", "not "};

constexpr const char* kResetInTile = "reset between samples of a tile";

const char* no(bool yes) { return kNoYes[yes ? 0 : 1]; }

/// For which jobs of the block.
std::string wait_name(bool first, bool last) {
  return fmt::format("waits, {}for the first job of the block, {}for the last", no(first), no(last));
}

}  // namespace

TileCoverage::TileCoverage(const TileWalkerParameters& parameters) : parameters_(parameters) {
  for (std::size_t edge = 0; edge < 3; ++edge) {
    for (std::size_t direction = 0; direction < kDirections; ++direction) {
      if (direction == kNoDirection) {
        continue;
      }
      const auto bin = [&](const char* what) {
        return bins_.add(fmt::format("tile {} edge {} {}", what, edge, direction_name(direction)));
      };
      edge_accepts_[edge][direction] = parameters.trivial_accept ? bin("accepted by") : nullptr;
      edge_does_not_[edge][direction] = bin("left to");
    }
  }
  for (std::size_t accept = 0; accept < (parameters.trivial_accept ? 8 : 1); ++accept) {
    accepts_[accept] = bins_.add(fmt::format("job with accept bits {:03b}", accept));
  }
  for (std::size_t side = 0; side < kSides.size(); ++side) {
    for (std::size_t no = 0; no < kNoYes.size(); ++no) {
      cuts_[side][no] = bins_.add(fmt::format("job {}cut on the {}", kNoYes[no], kSides[side]));
    }
  }
  const int tiles = parameters.sizes.row_tiles() * parameters.sizes.row_tiles();
  for (int tile = 0; tile < tiles; ++tile) {
    for (std::size_t no = 0; no < kNoYes.size(); ++no) {
      tiles_[static_cast<std::size_t>(tile)][no] =
          bins_.add(fmt::format("tile {}, {}alone in the mask", tile, kNoYes[no]));
    }
  }
  bins_.add("every tile of the block in the mask");
  bins_.add("first and last tile alone in the mask");
  bins_.add("a tile left out between two of the mask");
  for (const char* no : kNoYes) {
    bins_.add(fmt::format("block {}offered at once after the last", no));
    bins_.add(fmt::format("reset, block {}begun", no));
  }
  for (const bool first : {false, true}) {
    for (const bool last : {false, true}) {
      // A tile has a job for each of its samples, so with several no job is the first and the last.
      if (!(first && last && parameters.sizes.samples > 1)) {
        bins_.add(wait_name(first, last));
      }
    }
  }
  bins_.add("reset in a wait");
  if (parameters.sizes.samples > 1) {
    for (int sample = 0; sample < parameters.sizes.samples; ++sample) {
      samples_[static_cast<std::size_t>(sample)] = bins_.add(fmt::format("job of sample {}", sample));
    }
    bins_.add(kResetInTile);
  }
}

void TileCoverage::block(const BlockJob& block, bool at_once) {
  std::array<std::size_t, 3> direction{};
  for (std::size_t i = 0; i < 3; ++i) {
    direction[i] = edge_direction(block.a[i], block.b[i]);
  }
  for (const TileJob& each : tile_jobs(block, parameters_)) {
    job(each, direction);
  }
  const int tiles = parameters_.sizes.row_tiles() * parameters_.sizes.row_tiles();
  const bool alone = std::has_single_bit(block.tiles);
  for (std::uint64_t left = block.tiles; left != 0; left &= left - 1) {
    ++*tiles_[static_cast<std::size_t>(std::countr_zero(left))][alone ? 0 : 1];
  }
  const int first = std::countr_zero(block.tiles);
  const int last = 63 - std::countl_zero(block.tiles);
  if (std::popcount(block.tiles) == tiles) {
    bins_.hit("every tile of the block in the mask");
  }
  if (first == 0 && last == tiles - 1 && std::popcount(block.tiles) == 2) {
    bins_.hit("first and last tile alone in the mask");
  }
  if (std::popcount(block.tiles) < last - first + 1) {
    bins_.hit("a tile left out between two of the mask");
  }
  bins_.hit(fmt::format("block {}offered at once after the last", no(at_once)));
}

void TileCoverage::job(const TileJob& job, const std::array<std::size_t, 3>& direction) {
  for (std::size_t i = 0; i < 3; ++i) {
    count((job.accept >> i & 1) != 0 ? edge_accepts_[i][direction[i]] : edge_does_not_[i][direction[i]]);
  }
  count(accepts_[job.accept]);
  count(samples_[job.tile_x % static_cast<std::size_t>(parameters_.sizes.samples)]);
  const int last = parameters_.sizes.tile_size - 1;
  count(cuts_[0][job.x_first == 0 ? 1 : 0]);
  count(cuts_[1][job.x_last == last ? 1 : 0]);
  count(cuts_[2][job.y_first == 0 ? 1 : 0]);
  count(cuts_[3][job.y_last == last ? 1 : 0]);
}

void TileCoverage::waited(bool first, bool last) { bins_.hit(wait_name(first, last)); }

void TileCoverage::reset(bool begun, bool waiting, bool in_tile) {
  bins_.hit(fmt::format("reset, block {}begun", no(begun)));
  if (waiting) {
    bins_.hit("reset in a wait");
  }
  if (in_tile) {
    bins_.hit(kResetInTile);
  }
}

}  // namespace halfspace::tb
