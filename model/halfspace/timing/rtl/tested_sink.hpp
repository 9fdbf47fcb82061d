/// What follows the verilated early_z: checks the beats that leave it, and keeps image, counts and quads as
/// the RTL gives them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "halfspace/machine/passage/sink.hpp"
#include "halfspace/machine/passage/z_test.hpp"
#include "halfspace/machine/tokens.hpp"
#include "halfspace/timing/contract.hpp"
#include "halfspace/timing/rtl/run_state.hpp"
#include "halfspace/units/packing.hpp"
#include "halfspace/units/quad_beats.hpp"
#include "halfspace/units/quad_generator.hpp"

namespace halfspace::rtl {

template <int TileSize>
class TestedSink {
 public:
  explicit TestedSink(RunState& run)
      : run_(run), check_("early_z", run.widths, run.report), stalls_(run.options.stalls.any()) {}

  /// The model's burst that comes next but for those before it, after its test.
  void expect(BurstToken token, const passage::Tested& tested, const TileCodes<TileSize>& codes) {
    for (const TestedBeat& beat :
         tested_beats<TileSize>(token.burst.packet, tested.passed, tested.inner, codes, run_.widths)) {
      beats_.push_back(beat);
    }
    bursts_.push_back(std::move(token));
  }

  /// The test of a burst begins in this cycle.
  void burst_under_way() { visible_.push_back(run_.cycle + kTestLatency); }

  /// Whether the sink takes a beat in this cycle. Only whole bursts are held back.
  [[nodiscard]] bool ready() const {
    if (!stalls_ || in_burst_) {
      return true;
    }
    return !visible_.empty() &&
           run_.cycle >= visible_.front() + run_.options.stalls.cycles(StallPoint::kSink, bursts_taken_);
  }

  void take() {
    if (!run_.expected(beats_, "early_z") || !run_.expected(bursts_, "early_z (burst)")) {
      return;
    }
    const std::span<const std::uint32_t> wires = run_.pipeline.tested_beat();
    TestedBeat& beat = beats_.front();
    if (!check_.compare(run_.cycle, beat, wires)) {
      beat = unpack<TestedBeat>(wires, run_.widths);
    }
    if (!in_burst_) {
      run_.note(&PacketTimes::y);
      covered_ = passed_ = inner_ = {};
      beat_cycles_.clear();
    }
    beat_cycles_.push_back(run_.cycle);
    for (std::size_t i = 0; i < static_cast<std::size_t>(run_.widths.TestWidth) && beat.mask[i] != 0; ++i) {
      add_quad(beat, i);
    }
    in_burst_ = beat.last == 0;
    if (!in_burst_) {
      end_burst(beat);
    }
    beats_.pop_front();
  }

  /// The shader answers for the late burst that it is through with in this cycle.
  void answer_late() {
    run_.in.late_valid = !answers_.empty() && answers_.front().cycle == run_.cycle;
    if (run_.in.late_valid) {
      std::ranges::fill(run_.in.late_keep, 0);
      const TileMask& kept = answers_.front().kept;
      constexpr std::size_t kSize = TileSize;
      for (std::size_t bit = 0; bit < kSize * kSize; ++bit) {
        const std::size_t x = bit % kSize;
        const std::size_t y = bit / kSize;
        const std::size_t at = 4 * (y / 2 * (kSize / 2) + x / 2) + y % 2 * 2 + x % 2;
        const std::uint64_t keep = kept.word[bit / 64] >> (bit % 64) & 1;
        run_.in.late_keep[at / 32] |= static_cast<std::uint32_t>(keep) << (at % 32);
      }
      answers_.pop_front();
    }
  }

  void expect_no_more() { run_.expect_no_more(beats_, "early_z"); }

 private:
  /// Quad i of a beat.
  void add_quad(const TestedBeat& beat, std::size_t i) {
    const int x = beat.index[i] % (TileSize / 2) * 2;
    const int y = beat.index[i] / (TileSize / 2) * 2;
    for (int sample = 0; sample < 4; ++sample) {
      const int bit = (y + sample / 2) * TileSize + x + sample % 2;
      const auto word = static_cast<std::size_t>(bit / 64);
      covered_.word[word] |= std::uint64_t{beat.mask[i] >> sample & 1u} << (bit % 64);
      passed_.word[word] |= std::uint64_t{beat.passed[i] >> sample & 1u} << (bit % 64);
      inner_.word[word] |= std::uint64_t{beat.inner[i] >> sample & 1u} << (bit % 64);
      codes_[static_cast<std::size_t>(bit)] = beat.depth[4 * i + static_cast<std::size_t>(sample)];
    }
  }

  void end_burst(const TestedBeat& beat) {
    const BurstToken token = std::move(bursts_.front());
    bursts_.pop_front();
    if (!visible_.empty()) {
      visible_.pop_front();
    }
    ++bursts_taken_;
    DrawContext& draw = *token.draw;
    const SetupTriangle& triangle = *token.triangle;
    run_.meter.give_back(Link::kEarlyZ, run_.cycle + 1);
    run_.meter.burst_left(draw, run_.cycle);
    const passage::Tested tested{
        .passed = passed_,
        .kept = passage::kept<TileSize>(passed_, beat.tile_x, beat.tile_y, triangle.triangle, draw),
        .inner = inner_};
    passage::count_z_test(draw, popcount(covered_), popcount(passed_), popcount(tested.kept),
                          popcount(inner_));
    if (draw.early_z.late && any(passed_)) {
      answers_.push_back({.cycle = run_.cycle + static_cast<std::uint64_t>(run_.config.late_z.latency),
                          .kept = tested.kept});
    }
    Surface& surface = run_.surface(draw);
    if (beat.tile_x >= surface.codes.tiles_x() || beat.tile_y >= surface.codes.tiles_y()) {
      return;  // its packet differs, and is reported
    }
    passage::sink<TileSize>(covered_, tested, beat.tile_x, beat.tile_y, triangle.triangle, draw, surface);
    if (draw.record_quads) {
      const QuadBurst burst =
          quad_generator<TileSize>({.tile_x = beat.tile_x, .tile_y = beat.tile_y, .mask = covered_});
      const auto width = static_cast<std::size_t>(run_.widths.TestWidth);
      passage::show_quads<TileSize>(
          burst, tested, codes_.data(), triangle, draw, [&](QuadEvent& quad, std::size_t number) {
            quad.cycle = beat_cycles_[std::min(number / width, beat_cycles_.size() - 1)];
            draw.observer->quad(quad);
          });
    }
  }

  RunState& run_;
  PacketCheck<TestedBeat> check_;
  bool stalls_;
  std::deque<TestedBeat> beats_;       ///< expected
  std::deque<BurstToken> bursts_;      ///< in early_z
  std::deque<std::uint64_t> visible_;  ///< when each burst that is tested can be seen here
  std::uint64_t bursts_taken_ = 0;
  struct Answer {
    std::uint64_t cycle;
    TileMask kept;
  };
  std::deque<Answer> answers_;  ///< of bursts that are in the shader

  // Of the burst that comes.
  bool in_burst_ = false;
  TileMask covered_;
  TileMask passed_;
  TileMask inner_;
  TileCodes<TileSize> codes_{};
  std::vector<std::uint64_t> beat_cycles_;
};

}  // namespace halfspace::rtl
