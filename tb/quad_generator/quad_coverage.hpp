/// Functional coverage of quad_generator: what the runs of a bench have met, counted in named bins.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "halfspace/numerics/widths.hpp"

namespace halfspace::tb {

class QuadCoverage {
 public:
  /// What a coverage is to the timing.
  enum class Kind : std::uint8_t { kEmpty, kOneBeat, kBeats };
  QuadCoverage(const Widths& widths, int fifo_depth);

  /// A coverage is taken. `quads` are the numbers of its quads, ascending; `in_use` the credits in use before
  /// it; `at_once` tells that it was there in the first cycle in which it could be taken, and `returned` that
  /// a credit comes back in the same cycle.
  void taken(const std::vector<int>& quads, int in_use, bool at_once, bool returned);
  /// Of a sure coverage, the parts that it covers whole.
  void sure(unsigned parts);
  /// A coverage waits for nothing but a credit.
  void no_credit(bool empty);
  /// A burst has left; the sink held back its first beat, or a later one.
  void left(int quads, bool stalled_at_first, bool stalled_later);
  /// `making`: beats were yet to be made; `waiting`: bursts were in the FIFO.
  void reset(bool making, bool waiting);

  [[nodiscard]] std::size_t bins() const { return bins_.size(); }
  /// Names of the bins that nothing has hit.
  [[nodiscard]] std::vector<std::string> missed() const;

 private:
  struct Bin {
    std::string name;
    std::uint64_t hits = 0;
  };
  /// Bins with consecutive places.
  struct Group {
    std::size_t first = 0;
    std::size_t count = 0;
  };

  Group add(const std::vector<std::string>& names);
  void hit(const Group& group, std::size_t place);
  [[nodiscard]] std::size_t beats(std::size_t quads) const;
  [[nodiscard]] std::size_t quads_bin(std::size_t quads) const;
  [[nodiscard]] Kind kind(std::size_t quads) const;

  Widths widths_;
  std::size_t kinds_;  ///< without kBeats where no burst has more than one
  std::size_t depth_;
  std::vector<Bin> bins_;
  std::vector<std::size_t> quads_bins_;  ///< the least number of quads of each

  std::vector<Group> left_;  ///< by bin of quads: where it was stalled
  Group fill_;               ///< quads in the last beat
  Group first_quad_;
  Group last_quad_;
  Group parts_;
  Group sure_;
  Group follows_;  ///< kind before, kind, at once or later
  Group in_use_;   ///< credits in use, empty or not
  Group no_credit_;
  Group returned_;
  Group reset_;
  Kind before_ = Kind::kEmpty;
};

}  // namespace halfspace::tb
