#include "halfspace/units/hi_z.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace halfspace {
namespace {

/// What is known of the codes that a triangle has in a tile.
class CodeRange {
 public:
  CodeRange(const DepthEquation& equation, const HiZPlane& plane, const WordBounds& words, DepthFormat format)
      : equation_(equation),
        known_(plane.known),
        words_(words),
        format_(format),
        exponent_(format == DepthFormat::kFloat32 || equation.beyond ? equation.exponent : 0) {}

  /// All of them are `code` or more. The clamp to the triangle's own range comes behind the plane.
  [[nodiscard]] bool at_least(std::uint64_t code) const {
    return equation_.min_code >= code || (known_ && equation_.max_code >= code && words_.least >= word(code));
  }
  [[nodiscard]] bool below(std::uint64_t code) const {
    return equation_.max_code < code || (known_ && equation_.min_code < code && words_.most < word(code));
  }

 private:
  /// `code` is between two codes of the triangle.
  [[nodiscard]] std::int64_t word(std::uint64_t code) const {
    return word_of_code(static_cast<std::uint32_t>(code), format_, exponent_);
  }

  const DepthEquation& equation_;
  bool known_;
  WordBounds words_;
  DepthFormat format_;
  int exponent_;
};

/// What becomes of the triangle's codes against what lies within `bounds`; which of its ends count.
HiZOutcome test(DepthFunc func, const CodeRange& codes, const CodeBounds& bounds, bool least_counts,
                bool most_counts) {
  const auto at_least = [&](std::uint64_t code) { return most_counts && codes.at_least(code); };
  const auto below = [&](std::uint64_t code) { return least_counts && codes.below(code); };
  const std::uint64_t least = bounds.least;
  const std::uint64_t most = bounds.most;
  const auto outcome = [](bool none, bool all) {
    return none ? HiZOutcome::kNonePasses : all ? HiZOutcome::kAllPass : HiZOutcome::kUnknown;
  };
  switch (func) {
    case DepthFunc::kNever:
      return HiZOutcome::kNonePasses;
    case DepthFunc::kLess:
      return outcome(at_least(most), below(least));
    case DepthFunc::kLequal:
      return outcome(at_least(most + 1), below(least + 1));
    case DepthFunc::kEqual:
      return outcome(at_least(most + 1) || below(least), false);
    case DepthFunc::kGreater:
      return outcome(below(least + 1), at_least(most + 1));
    case DepthFunc::kGequal:
      return outcome(below(least), at_least(most));
    case DepthFunc::kNotEqual:
      return outcome(false, at_least(most + 1) || below(least));
    case DepthFunc::kAlways:
      return HiZOutcome::kAllPass;
  }
  return HiZOutcome::kUnknown;
}

}  // namespace

HiZOutcome hi_z_outcome(const HiZConfig& config, const BlockJob& block, int tile,
                        const DepthEquation& equation, const EarlyZState& state, const StoredBounds& stored) {
  const HiZPlane plane{.z = block.z, .dx = block.z_dx, .dy = block.z_dy, .known = block.z_known != 0};
  const int row = config.block_size / config.tile_size;
  const int x = tile % row * config.tile_size;
  const int y = tile / row * config.tile_size;
  const WordBounds words = config.tile_size == 4   ? tile_words<4>(plane, x, y)
                           : config.tile_size == 8 ? tile_words<8>(plane, x, y)
                                                   : tile_words<16>(plane, x, y);
  return test(state.func, CodeRange(equation, plane, words, state.format), stored.bounds, stored.least_counts,
              stored.most_counts);
}

HiZ::HiZ(const HiZConfig& config, std::uint32_t blocks) : config_(config) {
  const auto row = static_cast<std::size_t>(config.block_size / config.tile_size);
  tiles_ = row * row;
  entries_ = tiles_ * static_cast<std::size_t>(config.parts);
  if (config.enabled) {
    blocks = std::max(blocks, 1u);  // a job that it does not look at counts as one of block 0
    states_ = zeroed_array<WordState>(blocks);
    words_ = zeroed_array<HiZWord>(blocks);
    raising_ = zeroed_array<std::uint16_t>(blocks * tiles_);
    lowering_ = zeroed_array<std::uint16_t>(blocks * tiles_);
  }
}

std::uint64_t HiZ::must_retire() const {
  return hi_z_must_see(jobs_before_.front(), static_cast<std::uint64_t>(config_.lag), seen_);
}

HiZWord HiZ::word(std::uint32_t block) const {
  switch (states_[block]) {
    case WordState::kUnknown:
      break;
    case WordState::kCleared:
      return cleared_word(std::prev(clear_codes_.upper_bound(block))->second);
    case WordState::kStored:
      return words_[block];
  }
  return unknown_word(entries_, config_.bits);
}

CodeBounds HiZ::bounds(const HiZWord& word, std::size_t tile) const {
  const auto parts = static_cast<std::size_t>(config_.parts);
  CodeBounds all = word.entry(tile * parts);
  for (std::size_t part = 1; part < parts; ++part) {
    all = unite(all, word.entry(tile * parts + part));
  }
  return all;
}

HiZ::Verdict HiZ::decide(const BlockJob& block, const DepthEquation& equation, const EarlyZState& state,
                         const HiZSurface& surface) {
  see(must_retire());
  Verdict verdict;
  const bool accept = config_.accept && state.write && !state.late;
  const bool looks = state.test && !state.unrestricted;
  const std::uint32_t number = looks ? surface.block(block.block_x, block.block_y) : 0;
  const HiZWord stored = word(number);
  for (std::uint64_t left = looks ? block.tiles : 0; left != 0; left &= left - 1) {
    const int tile = std::countr_zero(left);
    const auto at = static_cast<std::size_t>(tile);
    const HiZOutcome outcome = hi_z_outcome(config_, block, tile, equation, state,
                                            {.bounds = bounds(stored, at),
                                             .least_counts = lowering_[number * tiles_ + at] == 0,
                                             .most_counts = raising_[number * tiles_ + at] == 0});
    verdict.rejected |= std::uint64_t{outcome == HiZOutcome::kNonePasses} << tile;
    verdict.sure |= std::uint64_t{accept && outcome == HiZOutcome::kAllPass} << tile;
  }
  const DepthMoves moves = looks ? depth_moves(state.func, state.write) : DepthMoves{};
  std::uint64_t left = block.tiles & ~verdict.rejected;
  give_slot(block, left != 0, verdict);
  jobs_ += static_cast<std::uint64_t>(std::popcount(left));
  for (; left != 0; left &= left - 1) {
    const auto tile = static_cast<std::size_t>(std::countr_zero(left));
    flights_.push_back({.block = number, .tile = static_cast<std::uint8_t>(tile), .moves = moves});
    raising_[number * tiles_ + tile] =
        static_cast<std::uint16_t>(raising_[number * tiles_ + tile] + (moves.up ? 1 : 0));
    lowering_[number * tiles_ + tile] =
        static_cast<std::uint16_t>(lowering_[number * tiles_ + tile] + (moves.down ? 1 : 0));
  }
  std::shift_left(jobs_before_.begin(), jobs_before_.end(), 1);
  jobs_before_.back() = jobs_;
  return verdict;
}

void HiZ::give_slot(const BlockJob& block, bool leaves, Verdict& verdict) {
  slot_given_ = slot_given_ && walked_ == block.slot;
  walked_ = block.slot;
  verdict.first = leaves && !slot_given_;
  slot_ = static_cast<std::uint8_t>(slot_ + (verdict.first ? 1 : 0));
  slot_given_ |= leaves;
  verdict.slot = slot_;
}

void HiZ::see(std::uint64_t jobs) {
  for (; seen_ != jobs; ++seen_) {
    if (retired_.empty()) {
      throw std::logic_error("hi_z: a block is decided before a job that it sees has retired");
    }
    const Flight& flight = flights_.front();
    const HiZUpdate& update = retired_.front();
    const std::size_t at = flight.block * tiles_ + flight.tile;
    if (update.touched != 0) {
      const auto parts = static_cast<std::size_t>(config_.parts);
      HiZWord put = word(flight.block);
      put_entries(put, entries_, flight.tile * parts, update.touched, update.bounds, config_.bits);
      words_[flight.block] = put;
      states_[flight.block] = WordState::kStored;
    }
    raising_[at] = static_cast<std::uint16_t>(raising_[at] - (flight.moves.up ? 1 : 0));
    lowering_[at] = static_cast<std::uint16_t>(lowering_[at] - (flight.moves.down ? 1 : 0));
    flights_.pop_front();
    retired_.pop_front();
  }
}

void HiZ::clear(const HiZSurface& surface, std::uint32_t code) {
  see(jobs_);
  jobs_before_.fill(jobs_);
  std::fill_n(states_.get() + surface.first_block, surface.blocks, WordState::kCleared);
  clear_codes_[surface.first_block] = code;
}

}  // namespace halfspace
