/// hi_z: hierarchical Z. Takes tiles out of a block before anything is done for them, where no sample can
/// pass the depth test, and marks those in which every sample passes (N. Greene, M. Kass, G. Miller,
/// "Hierarchical Z-Buffer Visibility", SIGGRAPH 1993; S. Morein, "ATI Radeon HyperZ Technology", Graphics
/// Hardware 2000).
///
/// What it knows of stored depth comes from early_z, which says of each burst's tile what then lies in it.
/// What a block sees of that is a matter of order, never of time: a tile job is *seen* by block k when at
/// least `lag` jobs have left between the two, those of the kHiZDepth blocks before k not counted, because
/// what becomes of them is not yet known, or not in time to put in what their jobs let it see. Jobs that are
/// not seen are in flight. Where one of them may have raised what is stored in its tile, the tile's upper
/// bound counts for nothing, and likewise the lower one. docs/adr/0012-hi-z.md.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>

#include "halfspace/units/hi_z_bounds.hpp"
#include "halfspace/units/hi_z_plane.hpp"
#include "halfspace/units/lazy_array.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/z_test.hpp"

namespace halfspace {

/// Blocks before a block whose jobs it does not count: what becomes of them is not known, or too late.
inline constexpr std::uint32_t kHiZDepth = 5;

/// Of these the last, of which it is not known whether they leave.
inline constexpr std::uint32_t kHiZUndecided = 3;

/// Jobs that a block sees where `before` had left when the block kHiZDepth before it was decided, and the
/// last block saw `seen`.
constexpr std::uint64_t hi_z_must_see(std::uint64_t before, std::uint64_t lag, std::uint64_t seen) {
  return std::max(seen, before - std::min(before, lag));
}

struct HiZConfig {
  bool enabled = false;
  bool accept = true;   ///< look for tiles in which every sample passes, too
  int bits = 8;         ///< of a bound, 4 to 32
  int lag = 128;        ///< jobs, 1 or more
  int block_size = 32;  ///< pixels
  int tile_size = 8;
  int parts = 1;  ///< of a tile, each with bounds of its own
};

/// Where the blocks of a depth surface are among those of all.
struct HiZSurface {
  std::uint32_t first_block = 0;
  std::uint32_t blocks_x = 0;
  std::uint32_t blocks = 0;

  [[nodiscard]] std::uint32_t block(std::uint32_t x, std::uint32_t y) const {
    return first_block + y * blocks_x + x;
  }
};

/// What is stored in a tile after a burst, by the parts that it touched; none where it had to do with none.
struct HiZUpdate {
  std::uint8_t touched = 0;
  std::array<CodeBounds, kMaxZParts> bounds{};
};

/// The bounds of the parts that `touched` names, given the tile's codes (TileSize^2, row order).
template <int TileSize>
HiZUpdate hi_z_update(const std::uint32_t* codes, std::uint8_t touched, int parts) {
  HiZUpdate update{.touched = touched};
  const int samples = TileSize * TileSize / parts;
  for (int part = 0; part < parts; ++part) {
    if ((touched >> part & 1) != 0) {
      const auto [least, most] = std::minmax_element(codes + part * samples, codes + (part + 1) * samples);
      update.bounds[static_cast<std::size_t>(part)] = {.least = *least, .most = *most};
    }
  }
  return update;
}

/// The same for a burst of a late draw, whose writes are to come: `update` allows for any of them.
inline void allow_for_late_write(HiZUpdate& update, const DepthEquation& equation, const EarlyZState& state) {
  const DepthMoves moves = depth_moves(state.func, state.write);
  for (std::size_t part = 0; part < kMaxZParts; ++part) {
    if ((update.touched >> part & 1) == 0) {
      continue;
    }
    CodeBounds& bounds = update.bounds[part];
    bounds.least = moves.down ? std::min(bounds.least, equation.min_code) : bounds.least;
    bounds.most = moves.up ? std::max(bounds.most, equation.max_code) : bounds.most;
  }
}

enum class HiZOutcome : std::uint8_t { kUnknown, kNonePasses, kAllPass };

/// What is stored in a tile, and which ends of it count.
struct StoredBounds {
  CodeBounds bounds;
  bool least_counts = true;
  bool most_counts = true;
};

/// What becomes of the samples that a triangle may have in a tile of the block.
HiZOutcome hi_z_outcome(const HiZConfig& config, const BlockJob& block, int tile,
                        const DepthEquation& equation, const EarlyZState& state, const StoredBounds& stored);

/// The unit's state. Everything is called in order: decide() for each block, which numbers its jobs from
/// jobs() on; retire() for each job in the order of numbers, when it is through early_z. decide() needs the
/// first must_retire() of them.
class HiZ {
 public:
  HiZ() = default;
  /// `blocks`: of all surfaces.
  HiZ(const HiZConfig& config, std::uint32_t blocks);

  /// Jobs that have left so far.
  [[nodiscard]] std::uint64_t jobs() const { return jobs_; }
  /// Of these the first so many are seen by the next block.
  [[nodiscard]] std::uint64_t must_retire() const;

  /// The tiles of the next block in which no sample can pass, and those in which every one passes and writes:
  /// masks as in BlockJob. Where a tile is left: the slot that the triangle has from here on, and whether the
  /// block is its first. `state` is the draw's; `surface` is looked at where it tests depth.
  struct Verdict {
    std::uint64_t rejected = 0;
    std::uint64_t sure = 0;
    std::uint8_t slot = 0;
    bool first = false;
  };
  Verdict decide(const BlockJob& block, const DepthEquation& equation, const EarlyZState& state,
                 const HiZSurface& surface);
  void retire(const HiZUpdate& update) { retired_.push_back(update); }

  /// The blocks to come see the first `jobs`, at least as many as before. They must have retired. decide()
  /// does that by the rule; this is for studies of another rule.
  void see(std::uint64_t jobs);

  /// The whole surface now holds `code`. All jobs must have retired.
  void clear(const HiZSurface& surface, std::uint32_t code);

 private:
  /// A job that is not seen yet, or that has retired before it is.
  struct Flight {
    std::uint32_t block = 0;
    std::uint8_t tile = 0;
    DepthMoves moves;
  };

  /// What the word of a block is; untouched memory says that nothing is known.
  enum class WordState : std::uint8_t { kUnknown, kCleared, kStored };

  /// Gives the block's triangle a slot, if it has none and the block leaves.
  void give_slot(const BlockJob& block, bool leaves, Verdict& verdict);
  [[nodiscard]] HiZWord word(std::uint32_t block) const;
  [[nodiscard]] CodeBounds bounds(const HiZWord& word, std::size_t tile) const;

  HiZConfig config_;
  std::size_t tiles_ = 0;                               ///< of a block
  std::size_t entries_ = 0;                             ///< of a word
  LazyArray<WordState> states_;                         ///< by block
  LazyArray<HiZWord> words_;                            ///< where stored
  std::map<std::uint32_t, std::uint32_t> clear_codes_;  ///< of the surfaces, by their first blocks
  LazyArray<std::uint16_t> raising_;  ///< by tile of a block: jobs in flight that may raise what is stored
  LazyArray<std::uint16_t> lowering_;
  std::uint64_t jobs_ = 0;
  std::uint64_t seen_ = 0;
  std::array<std::uint64_t, kHiZDepth> jobs_before_{};  ///< of the blocks under way, the oldest first
  std::deque<Flight> flights_;                          ///< from job seen_ on
  std::deque<HiZUpdate> retired_;                       ///< of these the first
  std::optional<std::uint8_t> walked_;                  ///< the slot that the last block came with
  bool slot_given_ = false;                             ///< to its triangle
  std::uint8_t slot_ = 255;                             ///< the last that was given
};

}  // namespace halfspace
