/// The scoreboard of the verilated pipeline: what the C++ units say of each packet that moves on a link.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include "halfspace/machine/draw_state.hpp"
#include "halfspace/machine/passage/block_walker.hpp"
#include "halfspace/machine/passage/edge_evaluator.hpp"
#include "halfspace/machine/passage/hi_z.hpp"
#include "halfspace/machine/passage/quad_generator.hpp"
#include "halfspace/machine/passage/setup.hpp"
#include "halfspace/machine/passage/tile_walker.hpp"
#include "halfspace/machine/passage/z_lookup.hpp"
#include "halfspace/machine/passage/z_test.hpp"
#include "halfspace/machine/tokens.hpp"
#include "halfspace/timing/rtl/memory_port.hpp"
#include "halfspace/timing/rtl/rtl_error.hpp"
#include "halfspace/timing/rtl/run_state.hpp"
#include "halfspace/timing/rtl/tested_sink.hpp"
#include "halfspace/units/quad_beats.hpp"
#include "halfspace/units/z_cache.hpp"

namespace halfspace::rtl {

template <int TileSize>
class Scoreboard {
 public:
  Scoreboard(RunState& run, MemoryPort& memory, TestedSink<TileSize>& sink)
      : run_(run),
        memory_(memory),
        sink_(sink),
        walker_config_(walker_config(run.config)),
        walker_(walker_config_),
        z_cache_(z_cache_shape(run.config), memory_lines(run.places, z_cache_shape(run.config))),
        hi_z_(make_hi_z(run.blocks, run.config)),
        triangle_check_("setup", run.widths, run.report),
        equation_check_("setup (depth equation)", run.widths, run.report),
        state_check_("setup (draw state)", run.widths, run.report),
        walked_check_("block_walker", run.widths, run.report),
        block_check_(run.config.hi_z.enabled ? "hi_z" : "block_walker", run.widths, run.report),
        job_check_("tile_walker", run.widths, run.report),
        coverage_check_("edge_evaluator", run.widths, run.report),
        beat_check_("quad_generator", run.widths, run.report) {}

  // What goes in.

  /// Setup takes a triangle.
  void take_triangle(const ScreenTriangle& triangle, DrawContext& draw, const DrawStatePacket& state) {
    SetupTriangle equations;
    const bool drawn = passage::setup(triangle, draw, equations);
    run_.meter.take(Link::kSetupQueue, &draw, run_.cycle);
    TriangleToken& decision = decisions_.emplace_back(TriangleToken{.draw = &draw, .triangle = nullptr});
    if (drawn) {
      decision.triangle = std::make_shared<const SetupTriangle>(equations);
      triangles_.push_back({.token = decision, .state = state});
    }
  }

  void clear(std::uint32_t surface, std::uint32_t code) {
    clear_surface(run_.result.surfaces[surface], code);
    z_cache_.clear(run_.places[surface]);
    if (run_.config.hi_z.enabled) {
      retire();
      hi_z_.clear(run_.blocks[surface], code);
    }
    memory_.clear(run_.places[surface]);
    run_.clear_code[surface] = code;
  }

  void flush() {
    z_cache_.flush([&](std::uint32_t /*slot*/, std::uint32_t line, std::uint32_t bytes) {
      memory_.expect_write(line, bytes);
    });
  }

  // What happens in the cycle.

  /// The stages that begin with a packet in this cycle: it is this packet's.
  void begin_packets() {
    const auto begins = [this](Event event, Stage stage, const auto& queue) {
      if (run_.happens(event) && !queue.empty()) {
        run_.meter.begins(stage, queue.front().draw);
      }
    };
    begins(Event::kDecide, Stage::kSetup, decisions_);
    begins(Event::kHiZ, Stage::kHiZ, walked_);
    begins(Event::kJob, Stage::kEdgeEvaluator, jobs_);
    begins(Event::kCoverage, Stage::kQuadGenerator, coverages_);
    begins(Event::kFirstBeat, Stage::kZLookup, bursts_);
    if (run_.happens(Event::kEmit) && !to_emit_.empty()) {
      run_.meter.begins(Stage::kTileWalker, to_emit_.front());
    }
    if (run_.happens(Event::kTestFirst) && !to_test_.empty()) {
      run_.meter.begins(Stage::kZTest, to_test_.front());
    }
  }

  /// The packets that move in it, in the order of the pipe.
  void links() {
    if (run_.happens(Event::kDecide) && run_.expected(decisions_, "setup (decision)")) {
      decide();
    }
    if (run_.happens(Event::kAccept) && run_.expected(triangles_, "setup")) {
      accept();
    }
    if (run_.happens(Event::kBlock) && run_.expected(to_visit_, "block_walker (emission)")) {
      run_.meter.take(Link::kBlockWalker, to_visit_.front(), run_.cycle);
      to_visit_.pop_front();
      run_.note(&PacketTimes::block);
    }
    if (run_.happens(Event::kHiZ) && run_.expected(walked_, "block_walker")) {
      hi_z();
    }
    if (run_.happens(Event::kEmit) && run_.expected(to_emit_, "tile_walker (emission)")) {
      run_.meter.take(Link::kTileWalker, to_emit_.front(), run_.cycle);
      to_emit_.pop_front();
      run_.note(&PacketTimes::emit);
    }
    if (run_.happens(Event::kBlockDone) && run_.expected(blocks_, "block job")) {
      block_done();
    }
    if (run_.happens(Event::kJob) && run_.expected(jobs_, "tile_walker")) {
      job();
    }
    if (run_.happens(Event::kCoverage) && run_.expected(coverages_, "edge_evaluator")) {
      coverage();
    }
    if (run_.happens(Event::kBeat) && run_.expected(beats_, "quad_generator")) {
      beat();
    }
    if (run_.happens(Event::kTestFirst) && run_.expected(to_test_, "early_z (test)")) {
      begin_test();
    }
    for (std::uint32_t n = run_.out.events >> kWritesShift; n > 0; --n) {
      memory_.buffer_write(run_.flushing ? nullptr : tested_draw_);
    }
    if (run_.happens(Event::kTestLast)) {
      run_.meter.give_back(Link::kEarlyZPending, run_.cycle + 1);
    }
  }

  void expect_no_more() {
    run_.expect_no_more(decisions_, "setup (decision)");
    run_.expect_no_more(triangles_, "setup");
    run_.expect_no_more(to_visit_, "block_walker (emission)");
    run_.expect_no_more(walked_, "block_walker");
    run_.expect_no_more(blocks_, "block job");
    run_.expect_no_more(to_emit_, "tile_walker (emission)");
    run_.expect_no_more(jobs_, "tile_walker");
    run_.expect_no_more(coverages_, "edge_evaluator");
    run_.expect_no_more(beats_, "quad_generator");
  }

 private:
  struct ExpectedTriangle {
    TriangleToken token;
    DrawStatePacket state;
  };

  template <class Token>
  static Token take(std::deque<Token>& queue) {
    Token token = std::move(queue.front());
    queue.pop_front();
    return token;
  }

  void decide() {
    const TriangleToken decision = take(decisions_);
    run_.meter.give_back(Link::kSetupQueue, run_.cycle + 1);
    run_.note(&PacketTimes::decide);
    if (decision.triangle != nullptr) {
      run_.meter.take(Link::kSetup, decision.draw, run_.cycle);
    }
  }

  void accept() {
    const ExpectedTriangle expected = take(triangles_);
    const auto& [draw, triangle] = expected.token;
    run_.meter.begins(Stage::kBlockWalker, draw);  // the cycle itself is still that of the triangle before
    run_.meter.give_back(Link::kSetup, run_.cycle + 1);
    run_.note(&PacketTimes::accept);
    triangle_check_.compare(run_.cycle, to_packet(*triangle, walker_config_), run_.pipeline.setup_triangle());
    equation_check_.compare(run_.cycle,
                            to_packet(*triangle, draw->setup.depth_format, run_.config.depth.interpolator),
                            run_.pipeline.depth_equation());
    state_check_.compare(run_.cycle, expected.state, run_.pipeline.draw_state());
    const TriangleToken& token = expected.token;
    walker_.walk<TileSize>(*token.triangle, *token.draw, [&](const BlockJob& block, std::uint32_t /*empty*/) {
      to_visit_.push_back(token.draw);
      BlockToken walked{.draw = token.draw, .triangle = token.triangle, .block = block};
      if (run_.config.hi_z.enabled) {
        walked_.push_back(std::move(walked));
      } else {
        expect_block(std::move(walked));
      }
    });
  }

  /// At tile_walker.
  void expect_block(BlockToken token) {
    passage::tile_walker<TileSize>(
        token.block, walker_config_, *token.draw, [&](const TileJob& job, bool whole) {
          to_emit_.push_back(token.draw);
          jobs_.push_back({.draw = token.draw, .triangle = token.triangle, .job = job, .whole = whole});
        });
    blocks_.push_back(std::move(token));
  }

  /// hi_z takes a block. What it must see of jobs has happened before.
  void hi_z() {
    BlockToken token = take(walked_);
    DrawContext& draw = *token.draw;
    run_.meter.give_back(Link::kBlockWalker, run_.cycle + 1);
    run_.note(&PacketTimes::hi_z);
    walked_check_.compare(run_.cycle, token.block, run_.pipeline.walked_job());
    retire();
    if (retired_ < hi_z_.must_retire()) {
      throw RtlError(fmt::format("hi_z: a block in cycle {} that must see {} jobs, of which {} are done",
                                 run_.cycle, hi_z_.must_retire(), retired_));
    }
    passage::hi_z(hi_z_, token.block, token.triangle->depth,
                  draw.surface == kNoSurface ? HiZSurface{} : run_.blocks[draw.surface], draw);
    if (token.block.tiles != 0) {
      run_.meter.take(Link::kHiZ, &draw, run_.cycle);
      expect_block(std::move(token));
    }
  }

  /// Tells hi_z of the jobs that are done, in their order.
  void retire() {
    for (; !under_way_.empty() && under_way_.front(); under_way_.pop_front()) {
      hi_z_.retire(*under_way_.front());
      ++retired_;
    }
  }

  /// The block leaves its FIFO, at whose head it was.
  void block_done() {
    const BlockToken expected = take(blocks_);
    run_.meter.give_back(run_.config.hi_z.enabled ? Link::kHiZ : Link::kBlockWalker, run_.cycle + 1);
    block_check_.compare(run_.cycle, expected.block, run_.pipeline.block_job());
  }

  void job() {
    JobToken expected = take(jobs_);
    run_.meter.give_back(Link::kTileWalker, run_.cycle + 1);
    run_.meter.take(Link::kEdgeEvaluator, expected.draw, run_.cycle);
    run_.note(&PacketTimes::e);
    job_check_.compare(run_.cycle, expected.job, run_.pipeline.tile_job());
    coverages_.push_back(
        {.draw = expected.draw,
         .triangle = std::move(expected.triangle),
         .coverage = passage::edge_evaluator<TileSize>(expected.job, expected.whole, *expected.draw)});
  }

  void coverage() {
    CoverageToken expected = take(coverages_);
    run_.meter.give_back(Link::kEdgeEvaluator, run_.cycle + 1);
    run_.note(&PacketTimes::g);
    coverage_check_.compare(run_.cycle, expected.coverage, run_.pipeline.coverage());
    const bool empty = !any(expected.coverage.mask);
    if (run_.config.hi_z.enabled) {
      under_way_.push_back(empty ? std::optional(HiZUpdate{}) : std::nullopt);
    }
    if (empty) {
      return;
    }
    run_.meter.take(Link::kQuadGenerator, expected.draw, run_.cycle);
    const Burst burst = passage::quad_generator<TileSize>(expected.coverage, *expected.draw);
    for (const QuadBeat& beat : quad_beats<TileSize>(burst.packet, run_.widths)) {
      beats_.push_back(beat);
    }
    bursts_.push_back({.draw = expected.draw, .triangle = std::move(expected.triangle), .burst = burst});
  }

  void beat() {
    beat_check_.compare(run_.cycle, beats_.front(), run_.pipeline.quad_beat());
    beats_.pop_front();
    if (run_.happens(Event::kFirstBeat) && run_.expected(bursts_, "quad_generator (burst)")) {
      run_.note(&PacketTimes::f);
      look_up(take(bursts_));
    }
    if (run_.happens(Event::kLastBeat)) {
      run_.meter.give_back(Link::kQuadGenerator, run_.cycle + 1);
    }
  }

  /// The burst is in early_z: what will be tested, and which lines have to move.
  void look_up(BurstToken token) {
    DrawContext& draw = *token.draw;
    const QuadBurst& burst = token.burst.packet;
    const Coverage& coverage = burst.coverage;
    memory_.look_up_for(&draw);
    run_.meter.take(Link::kEarlyZPending, &draw, run_.cycle);
    to_test_.push_back(&draw);
    std::uint32_t* const stored = passage::stored_codes(run_.surface(draw), draw, coverage);
    TileCodes<TileSize> codes{};
    // Not the passage: what the test counts is counted of what the RTL gives.
    const TileMask passed = z_test<TileSize>(*token.triangle, burst, draw.early_z, stored, codes);
    const passage::Tested tested{.passed = passed,
                                 .kept = passage::kept<TileSize>(passed, coverage.tile_x, coverage.tile_y,
                                                                 token.triangle->triangle, draw),
                                 .inner = passage::inner<TileSize>(*token.triangle, coverage, draw.early_z)};
    passage::complete_codes<TileSize>(*token.triangle, burst, draw.early_z, codes);
    const int parts = run_.config.z_cache.parts;
    HiZUpdate update;
    if (const std::uint8_t touched = passage::touched_parts<TileSize>(coverage, draw, parts)) {
      update = passage::hi_z_update<TileSize>(draw, token.triangle->depth, stored, touched, parts);
      passage::write_late<TileSize>(tested, codes, draw, stored);
      const ZSurface& place = run_.places[draw.surface];
      const ZMisses misses = passage::z_cache(
          z_cache_, place, coverage,
          passage::z_access<TileSize>(coverage, tested, stored, draw, place, run_.config), draw);
      for (const ZMiss& miss : misses.parts()) {
        if (miss.fetch) {
          memory_.expect_read(miss.line, miss.bytes);
        }
        if (miss.write_back) {
          memory_.expect_write(miss.victim, miss.victim_bytes);
        }
      }
    }
    if (run_.config.hi_z.enabled) {
      *std::ranges::find_if(under_way_, [](const auto& job) { return !job; }) = update;
    }
    sink_.expect(std::move(token), tested, codes);
  }

  void begin_test() {
    tested_draw_ = to_test_.front();
    to_test_.pop_front();
    run_.meter.take(Link::kEarlyZ, tested_draw_, run_.cycle);
    sink_.burst_under_way();
    run_.note(&PacketTimes::b);
  }

  RunState& run_;
  MemoryPort& memory_;
  TestedSink<TileSize>& sink_;
  WalkerConfig walker_config_;
  passage::BlockWalker walker_;
  ZCache z_cache_;
  HiZ hi_z_;
  std::deque<std::optional<HiZUpdate>> under_way_;  ///< by job that hi_z was not told of; empty: not done
  std::uint64_t retired_ = 0;                       ///< jobs that it has

  PacketCheck<SetupTrianglePacket> triangle_check_;
  PacketCheck<DepthEquationPacket> equation_check_;
  PacketCheck<DrawStatePacket> state_check_;
  PacketCheck<BlockJob> walked_check_;
  PacketCheck<BlockJob> block_check_;
  PacketCheck<TileJob> job_check_;
  PacketCheck<Coverage> coverage_check_;
  PacketCheck<QuadBeat> beat_check_;

  // What is expected on each link.
  std::deque<TriangleToken> decisions_;
  std::deque<ExpectedTriangle> triangles_;
  std::deque<DrawContext*> to_visit_;
  std::deque<BlockToken> walked_;  ///< at hi_z
  std::deque<BlockToken> blocks_;
  std::deque<DrawContext*> to_emit_;
  std::deque<JobToken> jobs_;
  std::deque<CoverageToken> coverages_;
  std::deque<QuadBeat> beats_;
  std::deque<BurstToken> bursts_;
  std::deque<DrawContext*> to_test_;
  DrawContext* tested_draw_ = nullptr;
};

}  // namespace halfspace::rtl
