#include "stimulus.hpp"

#include <array>
#include <bit>
#include <utility>

#include "halfspace/machine/tile_size.hpp"
#include "halfspace/units/block_walker.hpp"
#include "halfspace/units/packing.hpp"
#include "halfspace/units/tile_walker.hpp"

namespace halfspace::tb {
namespace {

constexpr std::size_t kMostBlocks = 40;  // of a random triangle

/// The tiles of a random kind of mask: all, some, one, the first and the last.
std::uint64_t random_part(std::uint64_t tiles, Random& random) {
  switch (random.below(8)) {
    case 0: {
      const std::uint64_t some = tiles & random.bits();
      return some != 0 ? some : tiles;
    }
    case 1: {
      std::uint64_t one = tiles;
      for (std::uint64_t skip = random.below(static_cast<std::uint64_t>(std::popcount(tiles))); skip > 0;
           --skip) {
        one &= one - 1;
      }
      return one & -one;
    }
    case 2:
      return (tiles & -tiles) | std::bit_floor(tiles);
    default:
      return tiles;
  }
}

class BlockStimulus : public Stimulus {
 public:
  BlockStimulus(const TileWalkerParameters& parameters, std::uint64_t seed)
      : parameters_(parameters),
        random_(seed),
        slots_(seed),
        words_(words_for(packed_bits<TileJob>(parameters.sizes.widths()))) {}

  void reference(std::span<const std::uint32_t> packet, Scoreboard& scoreboard) final {
    const Widths widths = parameters_.sizes.widths();
    for (const TileJob& job : tile_jobs(unpack<BlockJob>(packet, widths), parameters_)) {
      pack(job, widths, words_);
      scoreboard.expect(words_);
      ++jobs_;
    }
  }

 protected:
  void fill(BlockJob block, std::span<std::uint32_t> packet) {
    block.slot = static_cast<std::uint8_t>(slots_.bits());
    const int tiles = parameters_.sizes.row_tiles() * parameters_.sizes.row_tiles();
    block.sure = slots_.bits() >> (64 - tiles);
    pack(block, parameters_.sizes.widths(), packet);
  }

  TileWalkerParameters parameters_;
  Random random_;
  Random slots_;
  std::uint64_t jobs_ = 0;  ///< that the blocks offered so far have given

 private:
  std::vector<std::uint32_t> words_;
};

class RandomStimulus final : public BlockStimulus {
 public:
  RandomStimulus(const TileWalkerParameters& parameters, std::uint64_t seed, std::uint64_t jobs)
      : BlockStimulus(parameters, seed), wanted_(jobs) {}

  bool next(std::span<std::uint32_t> packet) override {
    if (jobs_ >= wanted_) {
      return false;
    }
    while (next_ == blocks_.size()) {
      next_ = 0;
      draw_blocks();
    }
    fill(blocks_[next_++], packet);
    return true;
  }

 private:
  void draw_blocks() {
    const std::array<SetupTriangle, 1> triangle{random_triangle(parameters_.sizes, random_)};
    blocks_ = block_jobs(triangle, parameters_.sizes);
    const std::size_t all = blocks_.size();
    std::erase_if(blocks_, [&](const BlockJob&) { return random_.below(all) >= kMostBlocks; });
    for (BlockJob& block : blocks_) {
      block.tiles = random_part(block.tiles, random_);
    }
  }

  std::uint64_t wanted_;
  std::vector<BlockJob> blocks_;
  std::size_t next_ = 0;
};

class ListStimulus final : public BlockStimulus {
 public:
  ListStimulus(const TileWalkerParameters& parameters, std::uint64_t seed, std::vector<BlockJob> blocks)
      : BlockStimulus(parameters, seed), blocks_(std::move(blocks)) {}

  bool next(std::span<std::uint32_t> packet) override {
    if (next_ == blocks_.size()) {
      return false;
    }
    fill(blocks_[next_++], packet);
    return true;
  }

 private:
  std::vector<BlockJob> blocks_;
  std::size_t next_ = 0;
};

}  // namespace

std::vector<BlockJob> block_jobs(std::span<const SetupTriangle> triangles, const WalkSizes& sizes) {
  struct Sink {
    std::vector<BlockJob> jobs;
    void block(const BlockJob& job, std::uint64_t /*touched*/) {
      if (job.tiles != 0) {
        jobs.push_back(job);
      }
    }
    static void pass(const GridPlace& /*cell*/, int /*side*/) {}
  };
  const WalkerConfig walker{
      .sub_pixel_bits = sizes.sub_pixel_bits, .block_size = sizes.block_size, .samples = sizes.pattern()};
  Sink sink;
  for (const SetupTriangle& triangle : triangles) {
    with_tile_size(sizes.tile_size, [&](auto size) { block_walker<size()>(triangle, walker, 0, sink); });
  }
  return std::move(sink.jobs);
}

std::vector<TileJob> tile_jobs(const BlockJob& block, const TileWalkerParameters& parameters) {
  struct Sink {
    std::vector<TileJob> jobs;
    void tile(const TileJob& job, bool /*whole*/) { jobs.push_back(job); }
  };
  Sink sink;
  with_tile_size(parameters.sizes.tile_size,
                 [&](auto size) { tile_walker<size()>(block, parameters.walker(), sink); });
  return std::move(sink.jobs);
}

std::unique_ptr<Stimulus> random_stimulus(const TileWalkerParameters& parameters, std::uint64_t seed,
                                          std::uint64_t jobs) {
  return std::make_unique<RandomStimulus>(parameters, seed, jobs);
}

std::unique_ptr<Stimulus> list_stimulus(const TileWalkerParameters& parameters, std::uint64_t seed,
                                        std::vector<BlockJob> blocks) {
  return std::make_unique<ListStimulus>(parameters, seed, std::move(blocks));
}

}  // namespace halfspace::tb
