#include "halfspace/timing/rtl/run_rtl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include "halfspace/numerics/error.hpp"
#include "halfspace/timing/frame_source.hpp"
#include "halfspace/timing/rtl/cycle_meter.hpp"
#include "halfspace/timing/rtl/line_memory.hpp"
#include "halfspace/timing/rtl/pipeline_arguments.hpp"
#include "halfspace/timing/tally.hpp"
#include "halfspace/units/early_z.hpp"
#include "halfspace/units/edge_evaluator.hpp"
#include "halfspace/units/quad_beats.hpp"
#include "halfspace/units/quad_generator.hpp"
#include "halfspace/units/setup.hpp"
#include "halfspace/units/z_cache.hpp"

namespace halfspace {
namespace {

using namespace rtl;
using Cycle = std::uint64_t;

constexpr int kResetCycles = 2;
/// A machine in which nothing moves for so long, and the longest wait for memory, will not move any more: the
/// longest clear takes a cycle a tile.
constexpr Cycle kLongestRest = 2 * Cycle{kMemoryTiles};

// What the model expects on each link. The tokens keep what the next unit needs beside the packet.

struct Decision {
  DrawContext* draw = nullptr;
  std::shared_ptr<const SetupTriangle> triangle;  ///< null: dropped
};

struct ExpectedTriangle {
  DrawContext* draw = nullptr;
  std::shared_ptr<const SetupTriangle> triangle;
  DrawStatePacket state;
};

struct ExpectedJob {
  DrawContext* draw = nullptr;
  std::shared_ptr<const SetupTriangle> triangle;
  TileJob job;
  TileWork work = TileWork::kEvaluate;
};

struct ExpectedCoverage {
  DrawContext* draw = nullptr;
  std::shared_ptr<const SetupTriangle> triangle;
  Coverage coverage;
};

struct ExpectedBurst {
  DrawContext* draw = nullptr;
  std::shared_ptr<const SetupTriangle> triangle;
  QuadBurst burst;
};

struct ExpectedWrite {
  DrawContext* draw = nullptr;  ///< null: of the flush
  std::uint32_t line = 0;
};

template <int TileSize>
class RtlRun {
 public:
  RtlRun(const Frame& frame, const Config& config, bool keep_visible, PacketObserver* observer, TimedRun& run,
         VerilatedPipeline& pipeline, PacketReport& report)
      : frame_(frame),
        config_(config),
        observer_(observer),
        run_(run),
        pipeline_(pipeline),
        report_(report),
        widths_(widths(config)),
        walker_(walker_config(config)),
        meter_(config, report),
        before_(config, report),
        triangle_check_("setup", widths_, report),
        equation_check_("setup (depth equation)", widths_, report),
        state_check_("setup (draw state)", widths_, report),
        job_check_("tile_walker", widths_, report),
        coverage_check_("edge_evaluator", widths_, report),
        beat_check_("quad_generator", widths_, report),
        tested_check_("early_z", widths_, report),
        longest_rest_(kLongestRest + 4 * static_cast<Cycle>(config.memory.latency)) {
    result_.surfaces = make_surfaces(frame, config.tile_walker.tile_size, keep_visible);
    places_ = place_surfaces(result_.surfaces, config);
    const ZCacheShape shape = z_cache_shape(config);
    const std::uint32_t lines = memory_lines(places_, shape);
    if (lines / static_cast<std::uint32_t>(config.z_cache.parts) > kMemoryTiles) {
      throw InputError(fmt::format(
          "{}: its depth surfaces have {} tiles of {}x{}; legal for the RTL: at most {}", frame.name,
          lines / static_cast<std::uint32_t>(config.z_cache.parts), TileSize, TileSize, kMemoryTiles));
    }
    z_cache_ = ZCache(shape, lines);
    memory_.emplace(config, result_.surfaces, places_);
    clear_code_.resize(places_.size());
    source_.emplace(frame, config, observer, result_, draws_);
    in_.triangle.resize(words_for(packed_bits<ScreenTrianglePacket>(widths_)));
    in_.state.resize(words_for(packed_bits<DrawStatePacket>(widths_)));
    in_.fill.resize(
        words_for(8 * std::min(config.memory.read_bytes, TileSize * TileSize * 4 / config.z_cache.parts)));
    if (run.times != nullptr) {
      *run.times = {};
    }
  }

  FrameResult run() {
    reset();
    while (!done_) {
      step();
    }
    run_.cycles = {};
    run_.cycles.cycles = cycle_;
    run_.cycles.stats = meter_.finish(cycle_);
    read_counters();
    expect_nothing_more();
    collect_draws(draws_, result_, run_.cycles);
    read_surfaces();
    return std::move(result_);
  }

  // What the C++ walker calls.

  void decision(int x, int y, int size, TileVerdict verdict) {
    tally(walked_->draw->counters.tile_walker, verdict, size != TileSize);
    if (walked_->draw->record_decisions) {
      observer_->decision({.draw = walked_->draw->draw,
                           .triangle = walked_->triangle->triangle,
                           .surface = walked_->draw->surface,
                           .x = static_cast<std::uint32_t>(x),
                           .y = static_cast<std::uint32_t>(y),
                           .size = static_cast<std::uint32_t>(size),
                           .verdict = verdict});
    }
  }

  void tile(const TileJob& job, TileWork work) {
    slot_used_ = true;
    to_emit_.push_back(walked_->draw);
    jobs_.push_back({.draw = walked_->draw, .triangle = walked_->triangle, .job = job, .work = work});
    if (walked_->draw->record_jobs) {
      observer_->tile_job(job);
    }
  }

 private:
  // Cycles.

  /// Cycle 0 is the first in which a triangle could be taken.
  void reset() {
    in_.reset = true;
    for (int i = 0; i < kResetCycles; ++i) {
      pipeline_.settle(in_, out_);
      pipeline_.clock_edge();
    }
    in_.reset = false;
    pipeline_.settle(in_, out_);
    while (!out_.triangle_ready) {
      before_.cycle(out_.activity);
      clock_edge();
      pipeline_.settle(in_, out_);
      if (++rest_ > longest_rest_) {
        throw RtlError("deadlock: triangle_ready_o does not rise after reset");
      }
    }
    rest_ = 0;
  }

  void step() {
    offer();
    in_.fill_valid = memory_->fill(cycle_, in_.fill);
    in_.beat_ready = sink_takes();
    pipeline_.settle(in_, out_);
    ++rest_;
    begin_clear_or_flush();
    begin_packets();
    meter_.cycle(out_.activity);
    busy_reads_ += in_.fill_valid ? 1 : 0;
    busy_writes_ += out_.write_valid ? 1 : 0;
    if (in_.triangle_valid && out_.triangle_ready) {
      take_triangle();
    }
    if (out_.read_valid) {
      request();  // of the burst before one whose lookup begins in this cycle
    }
    if (out_.events != 0) {
      rest_ = 0;
      links();
    }
    if (out_.beat_valid && in_.beat_ready) {
      rest_ = 0;
      take_tested_beat();
    }
    if (out_.write_valid) {
      write();
    }
    clock_edge();
    ++cycle_;
    end_clear_or_flush();
    if (rest_ > longest_rest_) {
      throw RtlError(
          fmt::format("deadlock in cycle {}: nothing has moved for {} cycles; {} packets differ{}{}", cycle_,
                      rest_, report_.different, report_.different == 0 ? "" : ", first: ", report_.first));
    }
  }

  void clock_edge() {
    pipeline_.clock_edge();
    if (pipeline_.assertion_failed()) {
      throw RtlError(
          fmt::format("an assertion of the RTL failed in cycle {}: see its message above", cycle_));
    }
  }

  [[nodiscard]] bool happens(std::uint32_t event) const { return (out_.events & event) != 0; }

  void note(std::vector<Cycle> PacketTimes::*stream) {
    if (run_.times != nullptr) {
      (run_.times->*stream).push_back(cycle_);
    }
  }

  /// False, and a difference, where the RTL has a packet that the model has not.
  template <class Queue>
  bool expected(const Queue& queue, const char* link) {
    if (!queue.empty()) {
      return true;
    }
    report_.differ(fmt::format("{}: a packet in cycle {} where the model has none", link, cycle_));
    return false;
  }

  // Source.

  /// What the source offers in this cycle: a triangle, a clear or the flush.
  void offer() {
    in_.triangle_valid = in_.clear_valid = in_.flush = false;
    if (waits_for_done_ || cycle_ < next_arrival_) {
      return;
    }
    while (!item_ && next_command_ <= frame_.commands.size()) {
      if (in_command_) {
        item_ = source_->next();
        in_command_ = item_.has_value();
      } else if (next_command_ < frame_.commands.size()) {
        source_->begin(next_command_++);
        in_command_ = true;
      } else {
        ++next_command_;  // the end of the frame
      }
      if (item_ && item_->draw != nullptr) {
        load_triangle();
      }
    }
    if (!item_) {
      in_.flush = true;
    } else if (item_->draw == nullptr) {
      in_.clear_valid = true;
      in_.clear_first = places_[item_->surface].first_tile;
      in_.clear_last = in_.clear_first + places_[item_->surface].tiles - 1;
    } else {
      in_.triangle_valid = cycle_ >= next_arrival_;
    }
  }

  void load_triangle() {
    const DrawContext& draw = *item_->draw;
    const bool has_depth = draw.surface != kNoSurface;
    state_ = draw_state_packet(draw.setup, draw.early_z, has_depth ? places_[draw.surface] : ZSurface{},
                               has_depth ? clear_code_[draw.surface] : 0);
    pack(to_packet(item_->triangle), widths_, in_.triangle);
    pack(state_, widths_, in_.state);
    next_arrival_ = cycle_ + run_.stalls.cycles(StallPoint::kSource, triangles_++);
  }

  void take_triangle() {
    rest_ = 0;
    DrawContext& draw = *item_->draw;
    SetupTriangle triangle;
    const SetupVerdict verdict = setup(item_->triangle, draw.setup, triangle);
    tally(draw.counters.setup, verdict);
    meter_.take(Link::kSetupQueue, &draw, cycle_);
    Decision& decision = decisions_.emplace_back();
    decision.draw = &draw;
    if (verdict == SetupVerdict::kDrawn) {
      decision.triangle = std::make_shared<const SetupTriangle>(triangle);
      triangles_out_.push_back({.draw = &draw, .triangle = decision.triangle, .state = state_});
    }
    item_.reset();
    next_arrival_ = cycle_ + 1;
  }

  void begin_clear_or_flush() {
    if (!out_.idle || !(in_.clear_valid || in_.flush)) {
      return;
    }
    rest_ = 0;
    waits_for_done_ = true;
    flushing_ = in_.flush;
    if (flushing_) {
      z_cache_.flush([&](std::uint32_t /*slot*/, std::uint32_t line, std::uint32_t /*bytes*/) {
        writes_.push_back({.draw = nullptr, .line = line});
      });
      return;
    }
    Surface& surface = result_.surfaces[item_->surface];
    const PixelRect all{.x_last = surface.codes.width() - 1, .y_last = surface.codes.height() - 1};
    surface.codes.fill(all, item_->code);
    if (!surface.visible.empty()) {
      surface.visible.fill(all, kNothingVisible);
    }
    z_cache_.clear(places_[item_->surface]);
    memory_->clear(places_[item_->surface]);
    clear_code_[item_->surface] = item_->code;
    item_.reset();
  }

  void end_clear_or_flush() {
    if (!waits_for_done_ || !(flushing_ ? pipeline_.flush_done() : pipeline_.clear_done())) {
      return;
    }
    waits_for_done_ = false;
    next_arrival_ = cycle_;
    done_ = flushing_;
  }

  // Links, in the order of the pipe.

  /// The stages that begin with a packet in this cycle: it is this packet's.
  void begin_packets() {
    if (happens(event::kDecide) && !decisions_.empty()) {
      meter_.begins(Stage::kSetup, decisions_.front().draw);
    }
    if (happens(event::kJob) && !jobs_.empty()) {
      meter_.begins(Stage::kEdgeEvaluator, jobs_.front().draw);
    }
    if (happens(event::kCoverage) && !coverages_.empty()) {
      meter_.begins(Stage::kQuadGenerator, coverages_.front().draw);
    }
    if (happens(event::kFirstBeat) && !bursts_.empty()) {
      meter_.begins(Stage::kZLookup, bursts_.front().draw);
    }
    if (happens(event::kTestFirst) && !to_test_.empty()) {
      meter_.begins(Stage::kEarlyZ, to_test_.front());
    }
  }

  void links() {
    if (happens(event::kDecide) && expected(decisions_, "setup (decision)")) {
      decide();
    }
    if (happens(event::kAccept) && expected(triangles_out_, "setup")) {
      accept();
    }
    if (happens(event::kEmit) && expected(to_emit_, "tile_walker (emission)")) {
      meter_.take(Link::kTileWalker, to_emit_.front(), cycle_);
      to_emit_.pop_front();
      note(&PacketTimes::emit);
    }
    if (happens(event::kJob) && expected(jobs_, "tile_walker")) {
      job();
    }
    if (happens(event::kCoverage) && expected(coverages_, "edge_evaluator")) {
      coverage();
    }
    if (happens(event::kBeat) && expected(beats_, "quad_generator")) {
      beat();
    }
    if (happens(event::kTestFirst) && expected(to_test_, "early_z (test)")) {
      tested_draw_ = to_test_.front();
      to_test_.pop_front();
      meter_.take(Link::kEarlyZ, tested_draw_, cycle_);
      to_sink_.push_back(cycle_ + kTestLatency);
      note(&PacketTimes::b);
    }
    for (std::uint32_t n = out_.events >> event::kWritesShift; n > 0; --n) {
      written_for_.push_back(flushing_ ? nullptr : tested_draw_);
    }
    if (happens(event::kTestLast)) {
      meter_.give_back(Link::kEarlyZPending, cycle_ + 1);
    }
  }

  void decide() {
    const Decision& decision = decisions_.front();
    meter_.give_back(Link::kSetupQueue, cycle_ + 1);
    note(&PacketTimes::decide);
    if (decision.triangle != nullptr) {
      meter_.take(Link::kSetup, decision.draw, cycle_);
    }
    decisions_.pop_front();
  }

  void accept() {
    const ExpectedTriangle expected = std::move(triangles_out_.front());
    triangles_out_.pop_front();
    meter_.begins(Stage::kTileWalker,
                  expected.draw);  // the cycle itself is still that of the triangle before
    meter_.give_back(Link::kSetup, cycle_ + 1);
    note(&PacketTimes::accept);
    triangle_check_.compare(cycle_, to_packet(*expected.triangle, walker_, TileSize),
                            pipeline_.setup_triangle());
    equation_check_.compare(cycle_, to_packet(*expected.triangle, expected.draw->setup.depth_format),
                            pipeline_.depth_equation());
    state_check_.compare(cycle_, expected.state, pipeline_.draw_state());
    walked_ = &expected;
    slot_used_ = false;
    tile_walker<TileSize>(*expected.triangle, walker_, slot_, *this);
    slot_ = static_cast<std::uint8_t>(slot_ + (slot_used_ ? 1 : 0));
    walked_ = nullptr;
  }

  void job() {
    ExpectedJob expected = std::move(jobs_.front());
    jobs_.pop_front();
    meter_.give_back(Link::kTileWalker, cycle_ + 1);
    meter_.take(Link::kEdgeEvaluator, expected.draw, cycle_);
    note(&PacketTimes::e);
    job_check_.compare(cycle_, expected.job, pipeline_.tile_job());
    ExpectedCoverage& next = coverages_.emplace_back();
    next.draw = expected.draw;
    next.triangle = std::move(expected.triangle);
    next.coverage = edge_evaluator<TileSize>(expected.job, config_.raster.sub_pixel_bits);
    tally(expected.draw->counters, expected.job, expected.work, any(next.coverage.mask));
  }

  void coverage() {
    ExpectedCoverage expected = std::move(coverages_.front());
    coverages_.pop_front();
    meter_.give_back(Link::kEdgeEvaluator, cycle_ + 1);
    note(&PacketTimes::g);
    coverage_check_.compare(cycle_, expected.coverage, pipeline_.coverage());
    if (!any(expected.coverage.mask)) {
      return;
    }
    meter_.take(Link::kQuadGenerator, expected.draw, cycle_);
    const QuadBurst burst = quad_generator<TileSize>(expected.coverage);
    tally<TileSize>(expected.draw->counters.quad_generator, burst,
                    static_cast<std::uint64_t>(popcount(burst.quads)),
                    static_cast<std::uint64_t>(popcount(burst.coverage.mask)));
    for (const QuadBeat& beat : quad_beats<TileSize>(burst, widths_)) {
      beats_.push_back(beat);
    }
    bursts_.push_back({.draw = expected.draw, .triangle = std::move(expected.triangle), .burst = burst});
  }

  void beat() {
    beat_check_.compare(cycle_, beats_.front(), pipeline_.quad_beat());
    beats_.pop_front();
    if (happens(event::kFirstBeat) && expected(bursts_, "quad_generator (burst)")) {
      note(&PacketTimes::f);
      look_up(std::move(bursts_.front()));
      bursts_.pop_front();
    }
    if (happens(event::kLastBeat)) {
      meter_.give_back(Link::kQuadGenerator, cycle_ + 1);
    }
  }

  /// The burst is in early_z: what will be tested, and which lines have to move.
  void look_up(ExpectedBurst burst) {
    DrawContext& draw = *burst.draw;
    lookup_draw_ = &draw;
    meter_.take(Link::kEarlyZPending, &draw, cycle_);
    to_test_.push_back(&draw);
    const Coverage& coverage = burst.burst.coverage;
    Surface* const surface = draw.surface == kNoSurface ? nullptr : &result_.surfaces[draw.surface];
    TileCodes<TileSize> codes{};
    std::uint32_t* const stored =
        surface == nullptr ? nullptr : surface->codes.tile(coverage.tile_x, coverage.tile_y);
    const TileMask passed = early_z<TileSize>(*burst.triangle, burst.burst, draw.early_z, stored, codes);
    if (surface == nullptr) {
      codes = {};
    } else if (!draw.early_z.test) {
      interpolate_tile<TileSize>(*burst.triangle, burst.burst, draw.early_z, codes);
    }
    if (touches_depth(draw.early_z)) {
      const std::uint8_t touched = parts_of_mask<TileSize>(coverage.mask, config_.z_cache.parts);
      const std::uint8_t written =
          draw.early_z.write ? parts_of_mask<TileSize>(passed, config_.z_cache.parts) : std::uint8_t{0};
      const ZMisses misses =
          z_cache_.access(places_[draw.surface], coverage.tile_x, coverage.tile_y, touched, written);
      tally(draw.counters.early_z, std::popcount(touched), misses);
      for (const ZMiss& miss : misses.parts()) {
        if (miss.fetch) {
          requests_.push_back(miss.line);
        }
        if (miss.write_back) {
          writes_.push_back({.draw = &draw, .line = miss.victim});
        }
      }
    }
    for (const TestedBeat& tested : tested_beats<TileSize>(burst.burst, passed, codes, widths_)) {
      tested_.push_back(tested);
    }
    sunk_.push_back(std::move(burst));
  }

  // Sink.

  [[nodiscard]] bool sink_takes() {
    if (!stalls_sink_ || in_burst_) {
      return true;
    }
    return !to_sink_.empty() &&
           cycle_ >= to_sink_.front() + run_.stalls.cycles(StallPoint::kSink, bursts_taken_);
  }

  void take_tested_beat() {
    if (!expected(tested_, "early_z") || !expected(sunk_, "early_z (burst)")) {
      return;
    }
    const std::span<const std::uint32_t> wires = pipeline_.tested_beat();
    TestedBeat& beat = tested_.front();
    if (!tested_check_.compare(cycle_, beat, wires)) {
      beat = unpack<TestedBeat>(wires, widths_);
    }
    const ExpectedBurst& burst = sunk_.front();
    DrawContext& draw = *burst.draw;
    if (!in_burst_) {
      note(&PacketTimes::y);
      covered_ = passed_ = {};
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(widths_.TestWidth) && beat.mask[i] != 0; ++i) {
      add_quad(beat, i, draw, *burst.triangle);
    }
    in_burst_ = beat.last == 0;
    if (!in_burst_) {
      if (!to_sink_.empty()) {
        to_sink_.pop_front();
      }
      ++bursts_taken_;
      meter_.give_back(Link::kEarlyZ, cycle_ + 1);
      draw.cycles.end = cycle_;
      draw.has_burst = true;
      count_pixels(beat, draw, *burst.triangle);
      sunk_.pop_front();
    }
    tested_.pop_front();
  }

  /// Quad i of a beat, as the RTL gives it.
  void add_quad(const TestedBeat& beat, std::size_t i, const DrawContext& draw,
                const SetupTriangle& triangle) {
    const int x = beat.index[i] % (TileSize / 2) * 2;
    const int y = beat.index[i] / (TileSize / 2) * 2;
    for (int sample = 0; sample < 4; ++sample) {
      const int bit = (y + sample / 2) * TileSize + x + sample % 2;
      const auto word = static_cast<std::size_t>(bit / 64);
      covered_.word[word] |= std::uint64_t{beat.mask[i] >> sample & 1u} << (bit % 64);
      passed_.word[word] |= std::uint64_t{beat.passed[i] >> sample & 1u} << (bit % 64);
    }
    if (draw.record_quads) {
      QuadEvent event{.draw = draw.draw,
                      .triangle = triangle.triangle,
                      .surface = draw.surface,
                      .x = static_cast<std::uint32_t>(beat.tile_x * TileSize + x),
                      .y = static_cast<std::uint32_t>(beat.tile_y * TileSize + y),
                      .mask = beat.mask[i],
                      .passed = beat.passed[i],
                      .depth = {},
                      .cycle = cycle_};
      std::copy_n(&beat.depth[4 * i], 4, event.depth.begin());
      observer_->quad(event);
    }
  }

  void count_pixels(const TestedBeat& beat, DrawContext& draw, const SetupTriangle& triangle) {
    tally(draw.counters.early_z, draw.early_z, static_cast<std::uint64_t>(popcount(covered_)),
          static_cast<std::uint64_t>(popcount(passed_)));
    if (draw.surface == kNoSurface) {
      return;
    }
    Surface& surface = result_.surfaces[draw.surface];
    if (beat.tile_x >= surface.codes.tiles_x() || beat.tile_y >= surface.codes.tiles_y()) {
      return;  // its packet differs, and is reported
    }
    if (!draw.is_clear()) {
      count_samples<TileSize>(covered_, surface.fragments.tile(beat.tile_x, beat.tile_y));
      count_samples<TileSize>(passed_, surface.survivors.tile(beat.tile_x, beat.tile_y));
    }
    if (!draw.keeps_visible) {
      return;
    }
    const std::uint32_t shown = draw.is_clear() ? kNothingVisible : draw.first_triangle + triangle.triangle;
    std::uint32_t* const visible = surface.visible.tile(beat.tile_x, beat.tile_y);
    for (std::size_t i = 0; i < kMaskWords<TileSize>; ++i) {
      for (std::uint64_t left = passed_.word[i]; left != 0; left &= left - 1) {
        visible[i * 64 + static_cast<std::size_t>(std::countr_zero(left))] = shown;
      }
    }
  }

  // Memory.

  /// A line of memory that the RTL works on, and its size, are those that the model says.
  void check_line(const char* what, std::uint32_t line, std::uint32_t want, bool half) {
    ++report_.compared;
    const std::uint32_t bytes = memory_->line_bytes(line);
    if (line != want ||
        half != (bytes < 4u * TileSize * TileSize / static_cast<std::uint32_t>(config_.z_cache.parts))) {
      report_.differ(fmt::format("{} in cycle {}: model line {}, RTL line {} ({})", what, cycle_, want, line,
                                 half ? "2 bytes a sample" : "4 bytes a sample"));
    }
    if (bytes == 0) {
      throw RtlError(fmt::format("{} in cycle {}: line {} is in no surface", what, cycle_, line));
    }
  }

  void request() {
    rest_ = 0;
    if (!expected(requests_, "requests")) {
      return;
    }
    check_line("request", out_.read_line, requests_.front(), out_.read_half);
    requests_.pop_front();
    memory_->request(cycle_, out_.read_line);
    const std::uint32_t bytes = memory_->line_bytes(out_.read_line);
    meter_.transfer(
        &CycleStats::read_busy, lookup_draw_,
        static_cast<std::uint64_t>(transfer_cycles(static_cast<int>(bytes), config_.memory.read_bytes)));
  }

  void write() {
    rest_ = 0;
    if (!expected(written_for_, "writes") || !expected(writes_, "writes")) {
      return;
    }
    if (!in_write_) {
      check_line("write", out_.write_line, writes_.front().line, out_.write_half);
    }
    pipeline_.write_data(write_words_);
    const bool last = memory_->write(out_.write_line, write_words_);
    if (last != out_.write_last) {
      report_.differ(fmt::format("write of line {}: write_last_o is {} in cycle {}", out_.write_line,
                                 out_.write_last ? 1 : 0, cycle_));
    }
    meter_.transfer(&CycleStats::write_busy, written_for_.front(), 1);
    in_write_ = !last;
    if (last) {
      if (written_for_.front() == nullptr) {
        ++result_.flushed_lines;
        result_.flushed_bytes += memory_->line_bytes(out_.write_line);
      }
      written_for_.pop_front();
      writes_.pop_front();
    }
  }

  // The end.

  /// The counters at the top have counted what was seen on activity_o.
  void read_counters() {
    const auto compare = [&](std::size_t stage, std::size_t activity, std::uint64_t count) {
      in_.counter_select = static_cast<std::uint32_t>(stage << kActivityBits | activity);
      in_.triangle_valid = in_.clear_valid = in_.flush = in_.fill_valid = false;
      pipeline_.settle(in_, out_);
      meter_.cycle(out_.activity);
      clock_edge();
      pipeline_.settle(in_, out_);
      ++report_.compared;
      if (out_.counter != count) {
        report_.differ(fmt::format("counter {} of stage {}: {} cycles were seen, RTL {}", activity, stage,
                                   count, out_.counter));
      }
    };
    for (std::size_t stage = 0; stage < kStages; ++stage) {
      for (std::size_t activity = 0; activity < kActivities; ++activity) {
        compare(stage, activity, before_.counts()[stage][activity] + meter_.counts()[stage][activity]);
      }
    }
    compare(kStages, 0, busy_reads_);
    compare(kStages, 1, busy_writes_);
  }

  void expect_nothing_more() {
    const auto missing = [&](std::size_t count, const char* link) {
      if (count != 0) {
        report_.differ(fmt::format("{}: {} packets of the model never came", link, count));
      }
    };
    missing(decisions_.size(), "setup (decision)");
    missing(triangles_out_.size(), "setup");
    missing(to_emit_.size(), "tile_walker (emission)");
    missing(jobs_.size(), "tile_walker");
    missing(coverages_.size(), "edge_evaluator");
    missing(beats_.size(), "quad_generator");
    missing(tested_.size(), "early_z");
    missing(requests_.size(), "requests");
    missing(writes_.size(), "writes");
  }

  /// The image is what memory holds; what the model has drawn must be the same.
  void read_surfaces() {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      Surface& surface = result_.surfaces[i];
      const TiledImage<std::uint32_t> model = surface.codes;
      memory_->read_surface(places_[i], clear_code_[i], surface);
      for (int y = 0; y < model.height(); ++y) {
        for (int x = 0; x < model.width(); ++x) {
          ++report_.compared;
          if (surface.codes.at(x, y) != model.at(x, y)) {
            report_.differ(fmt::format("surface {} at ({}, {}): model {:#x}, RTL {:#x}", i, x, y,
                                       model.at(x, y), surface.codes.at(x, y)));
          }
        }
      }
    }
  }

  const Frame& frame_;
  const Config& config_;
  PacketObserver* observer_;
  TimedRun& run_;
  VerilatedPipeline& pipeline_;
  PacketReport& report_;
  Widths widths_;
  WalkerConfig walker_;
  CycleMeter meter_;
  CycleMeter before_;  ///< of the cycles between reset and cycle 0
  PacketCheck<SetupTrianglePacket> triangle_check_;
  PacketCheck<DepthEquationPacket> equation_check_;
  PacketCheck<DrawStatePacket> state_check_;
  PacketCheck<TileJob> job_check_;
  PacketCheck<Coverage> coverage_check_;
  PacketCheck<QuadBeat> beat_check_;
  PacketCheck<TestedBeat> tested_check_;
  Cycle longest_rest_;

  FrameResult result_;                     ///< its codes are the model's, until the end
  std::vector<ZSurface> places_;           ///< by surface
  std::vector<std::uint32_t> clear_code_;  ///< of each surface's last clear by the z cache
  std::deque<DrawContext> draws_;
  ZCache z_cache_;
  std::optional<LineMemory> memory_;
  std::optional<FrameSource> source_;

  PipelineInputs in_;
  PipelineOutputs out_;
  Cycle cycle_ = 0;
  Cycle rest_ = 0;  ///< cycles since something moved
  bool done_ = false;

  // Source.
  std::uint32_t next_command_ = 0;
  bool in_command_ = false;
  std::optional<SourceItem> item_;
  DrawStatePacket state_;
  Cycle next_arrival_ = 0;
  std::uint64_t triangles_ = 0;
  bool waits_for_done_ = false;  ///< for the end of a clear or of the flush
  bool flushing_ = false;

  // Links.
  std::deque<Decision> decisions_;
  std::deque<ExpectedTriangle> triangles_out_;
  std::deque<DrawContext*> to_emit_;
  std::deque<ExpectedJob> jobs_;
  std::deque<ExpectedCoverage> coverages_;
  std::deque<QuadBeat> beats_;
  std::deque<ExpectedBurst> bursts_;
  std::deque<DrawContext*> to_test_;
  std::deque<TestedBeat> tested_;
  std::deque<ExpectedBurst> sunk_;  ///< bursts in early_z
  const ExpectedTriangle* walked_ = nullptr;
  std::uint8_t slot_ = 0;
  bool slot_used_ = false;
  DrawContext* lookup_draw_ = nullptr;
  DrawContext* tested_draw_ = nullptr;

  // Sink.
  bool stalls_sink_ = run_.stalls.any();
  std::deque<Cycle> to_sink_;  ///< when each burst that is tested can be seen at the sink
  std::uint64_t bursts_taken_ = 0;
  bool in_burst_ = false;
  TileMask covered_;  ///< of the burst at the sink
  TileMask passed_;

  // Memory.
  std::deque<std::uint32_t> requests_;    ///< expected
  std::deque<ExpectedWrite> writes_;      ///< expected
  std::deque<DrawContext*> written_for_;  ///< lines in the write buffer
  std::vector<std::uint32_t> write_words_;
  bool in_write_ = false;

  // Since reset.
  std::uint64_t busy_reads_ = 0;
  std::uint64_t busy_writes_ = 0;
};

}  // namespace

FrameResult run_rtl(const Frame& frame, const Config& config, bool keep_visible, PacketObserver* observer,
                    TimedRun& run, VerilatedPipeline& pipeline, PacketReport& report) {
  for (std::size_t i = 0; i < kStallPoints; ++i) {
    const auto point = static_cast<StallPoint>(i);
    const StallPlan::Rate& rate = run.stalls.rate[i];
    if (rate.percent != 0 && rate.max_cycles != 0 && point != StallPoint::kSource &&
        point != StallPoint::kSink) {
      throw InputError(fmt::format("stalls at '{}': legal for the RTL: source, sink", kStallPointName[i]));
    }
  }
  switch (config.tile_walker.tile_size) {
    case 4:
      return RtlRun<4>(frame, config, keep_visible, observer, run, pipeline, report).run();
    case 16:
      return RtlRun<16>(frame, config, keep_visible, observer, run, pipeline, report).run();
    default:
      return RtlRun<8>(frame, config, keep_visible, observer, run, pipeline, report).run();
  }
}

}  // namespace halfspace
