#include "block_coverage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace halfspace::tb {
namespace {

constexpr std::array<const char*, 4> kSides = {"left", "right", "top", "bottom"};
constexpr std::array<const char*, 2> kNoYes = {"", "not "};

const char* no(bool yes) { return kNoYes[yes ? 0 : 1]; }

/// In which steps of its walk.
std::string wait_name(bool first_step, bool last_step) {
  return fmt::format("waits, {}in the first step, {}in the last", no(first_step), no(last_step));
}

constexpr const char* kLastSlot = "last slot";

}  // namespace

BlockCoverage::BlockCoverage(const BlockWalkerParameters& parameters) : parameters_(parameters) {
  const bool rejects = parameters.trivial_reject;
  for (std::size_t edge = 0; edge < 3; ++edge) {
    for (std::size_t direction = 0; direction < kDirections; ++direction) {
      if (direction == kNoDirection) {
        continue;
      }
      const auto bin = [&](const char* what) {
        return bins_.add(fmt::format("tile {} edge {} {}", what, edge, direction_name(direction)));
      };
      edge_outside_[edge][direction] = direction != kLeftEdge ? bin("only outside") : nullptr;
      edge_crosses_[edge][direction] = bin("on both sides of");
      edge_inside_[edge][direction] = bin("inside");
    }
  }
  const int tiles = parameters.sizes.row_tiles() * parameters.sizes.row_tiles();
  for (int tile = 0; tile < tiles; ++tile) {
    const auto at = static_cast<std::size_t>(tile);
    tile_kept_[at] = bins_.add(fmt::format("tile {} in the mask", tile));
    for (std::size_t edge = 0; edge < 3; ++edge) {
      tile_outside_[edge][at] = bins_.add(fmt::format("tile {} only outside edge {}", tile, edge));
    }
    tile_untouched_[at] = bins_.add(fmt::format("tile {} not in the bounds", tile));
  }
  for (std::size_t side = 0; side < kSides.size(); ++side) {
    for (std::size_t no = 0; no < kNoYes.size(); ++no) {
      cuts_[side][no] = bins_.add(fmt::format("block {}cut on the {}", kNoYes[no], kSides[side]));
    }
  }
  for (const char* no : kNoYes) {
    bins_.add(fmt::format("reset, triangle {}under way", no));
    bins_.add(fmt::format("next {}taken in the last step, which gives out a block", no));
    if (rejects) {
      bins_.add(fmt::format("next {}taken in the last step, which gives out nothing", no));
    }
  }
  for (const char* walk : {"one block", "a row of blocks", "a column of blocks", "rows of blocks"}) {
    bins_.add(fmt::format("{}, drawn", walk));
    if (rejects) {
      bins_.add(fmt::format("{}, nothing leaves", walk));
    }
  }
  if (rejects) {
    for (const char* where : {"before the first that leaves", "between two that leave", "after the last"}) {
      bins_.add(fmt::format("a block without a tile {}", where));
    }
    bins_.add("waits, and gives out nothing");
  }
  for (const bool first : {false, true}) {
    for (const bool last : {false, true}) {
      bins_.add(wait_name(first, last));
    }
  }
  if (parameters.sample_reject) {
    for (const char* tiles : {"0", "1", "2", "3", "4"}) {
      bins_.add(fmt::format("few samples, covered in {} tiles", tiles));
    }
    for (const int side : {1, parameters.sizes.row_tiles()}) {
      bins_.add(fmt::format("few samples, {} columns", side));
      bins_.add(fmt::format("few samples, {} rows", side));
    }
  }
  bins_.add("taken when idle");
  bins_.add("reset in a wait");
  bins_.add(kLastSlot);
}

void BlockCoverage::taken(const std::vector<BlockStep>& steps, std::uint8_t slot) {
  std::array<std::size_t, 3> direction{};
  for (std::size_t i = 0; i < 3; ++i) {
    direction[i] = edge_direction(steps.front().job.a[i], steps.front().job.b[i]);
  }
  for (const BlockStep& each : steps) {
    step(each, direction);
  }
  shape(steps);
  if (slot == 255 && std::ranges::any_of(steps, &BlockStep::leaves)) {
    bins_.hit(kLastSlot);
  }
}

void BlockCoverage::step(const BlockStep& step, const std::array<std::size_t, 3>& direction) {
  if (step.pass) {
    return;
  }
  if (step.few_samples) {
    few_samples(step);
    return;
  }
  const auto has = [](std::uint64_t tiles, std::size_t tile) { return (tiles >> tile & 1) != 0; };
  std::uint64_t kept = step.touched;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint64_t only = step.outside[i] & ~step.outside[(i + 1) % 3] & ~step.outside[(i + 2) % 3];
    kept &= ~step.outside[i];
    if (only != 0) {
      count(edge_outside_[i][direction[i]]);
    }
    if (step.inside[i] != 0) {
      count(edge_inside_[i][direction[i]]);
    }
    if ((step.touched & ~step.outside[i] & ~step.inside[i]) != 0) {
      count(edge_crosses_[i][direction[i]]);
    }
    for (std::size_t tile = 0; tile < tile_kept_.size(); ++tile) {
      if (has(only, tile)) {
        count(tile_outside_[i][tile]);
      }
    }
  }
  for (std::size_t tile = 0; tile < tile_kept_.size(); ++tile) {
    if (has(kept, tile)) {
      count(tile_kept_[tile]);
    }
    if (!has(step.touched, tile)) {
      count(tile_untouched_[tile]);
    }
  }
  const int last = parameters_.sizes.block_size - 1;
  count(cuts_[0][step.job.x_first == 0 ? 1 : 0]);
  count(cuts_[1][step.job.x_last == last ? 1 : 0]);
  count(cuts_[2][step.job.y_first == 0 ? 1 : 0]);
  count(cuts_[3][step.job.y_last == last ? 1 : 0]);
}

void BlockCoverage::few_samples(const BlockStep& step) {
  bins_.hit(fmt::format("few samples, covered in {} tiles", std::popcount(step.job.tiles)));
  const auto side = [&](int count, const char* what) {
    if (count == 1 || count == parameters_.sizes.row_tiles()) {
      bins_.hit(fmt::format("few samples, {} {}", count, what));
    }
  };
  side(step.job.x_last - step.job.x_first + 1, "columns");
  side(step.job.y_last - step.job.y_first + 1, "rows");
}

void BlockCoverage::shape(const std::vector<BlockStep>& steps) {
  const bool wide = steps.front().wide;
  const bool tall = steps.front().tall;
  const auto leaves = [](const BlockStep& step) { return step.leaves(); };
  const auto first = std::ranges::find_if(steps, leaves);
  bins_.hit(fmt::format("{}, {}",
                        wide && tall ? "rows of blocks"
                        : wide       ? "a row of blocks"
                        : tall       ? "a column of blocks"
                                     : "one block",
                        first == steps.end() ? "nothing leaves" : "drawn"));
  if (first == steps.end()) {
    return;
  }
  const auto last = std::find_if(steps.rbegin(), steps.rend(), leaves).base();
  if (first != steps.begin()) {
    bins_.hit("a block without a tile before the first that leaves");
  }
  if (std::any_of(first, last, [](const BlockStep& step) { return !step.leaves(); })) {
    bins_.hit("a block without a tile between two that leave");
  }
  if (last != steps.end()) {
    bins_.hit("a block without a tile after the last");
  }
}

void BlockCoverage::triangle_done(const BlockStep& last, bool next) {
  bins_.hit(fmt::format("next {}taken in the last step, which gives out {}", no(next),
                        last.leaves() ? "a block" : "nothing"));
}

void BlockCoverage::waited(bool first_step, bool last_step, bool leaves) {
  bins_.hit(wait_name(first_step, last_step));
  if (!leaves) {
    bins_.hit("waits, and gives out nothing");
  }
}

void BlockCoverage::reset(bool under_way, bool waiting) {
  bins_.hit(fmt::format("reset, triangle {}under way", no(under_way)));
  if (waiting) {
    bins_.hit("reset in a wait");
  }
}

}  // namespace halfspace::tb
