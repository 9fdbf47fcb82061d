#include "halfspace/timing/systemc/raster_pipeline.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "halfspace/machine/surfaces.hpp"
#include "halfspace/timing/systemc/block_walker.hpp"
#include "halfspace/timing/systemc/early_z.hpp"
#include "halfspace/timing/systemc/edge_evaluator.hpp"
#include "halfspace/timing/systemc/hi_z.hpp"
#include "halfspace/timing/systemc/interpolator.hpp"
#include "halfspace/timing/systemc/quad_generator.hpp"
#include "halfspace/timing/systemc/setup.hpp"
#include "halfspace/timing/systemc/sink.hpp"
#include "halfspace/timing/systemc/tile_walker.hpp"

namespace halfspace::systemc {
namespace {

/// Of every traced value: a link has at most 64 credits.
constexpr int kTraceBits = 8;

}  // namespace

std::uint64_t depth_bytes(const Frame& frame, const Config& config) {
  const std::vector<Surface> surfaces = make_surfaces(frame, config, Watch{.count_pixels = false});
  return DepthLayout(surfaces, place_surfaces(surfaces, config), config.z_cache.parts, 0).end();
}

/// The units and the links between them, in the order of the pipe. A new unit is a link and a member here,
/// its ports bound, and begin_frame() called.
struct RasterPipeline::Units {
  Units(RunState& run, FrameControl& control, std::uint64_t base)
      : setup_link(run, Fifo::kSetup),
        block_link(run, Fifo::kBlockWalker),
        hi_z_link(run, Fifo::kHiZ),
        tile_link(run, Fifo::kTileWalker),
        edge_link(run, Fifo::kEdgeEvaluator),
        quad_link(run, Fifo::kQuadGenerator),
        early_z_link(run, Fifo::kEarlyZ),
        shaded_link(run, Fifo::kInterpolator),
        source("source", run, control),
        setup("setup", run),
        block_walker("block_walker", run),
        hi_z("hi_z", run),
        tile_walker("tile_walker", run),
        edge_evaluator("edge_evaluator", run),
        quad_generator("quad_generator", run, hi_z.returns),
        early_z("early_z", run, hi_z.returns, base),
        sink("sink", run, early_z.test.answers),
        interpolator("interpolator", run, sink) {
    source.out(setup);
    source.depth(early_z.control);
    setup.out(setup_link);
    block_walker.in(setup_link);
    block_walker.out(block_link);
    const bool with_hi_z = run.config.hi_z.enabled;  // else it sees no block
    hi_z.in(with_hi_z ? block_link : hi_z_link);
    hi_z.out(hi_z_link);
    tile_walker.in(with_hi_z ? hi_z_link : block_link);
    tile_walker.out(tile_link);
    edge_evaluator.in(tile_link);
    edge_evaluator.out(edge_link);
    quad_generator.in(edge_link);
    quad_generator.out(quad_link);
    early_z.lookup.in(quad_link);
    early_z.test.out(early_z_link);
    if (run.config.interpolator.enabled) {
      interpolator.in(early_z_link);
      interpolator.out(shaded_link);
      sink.shaded(shaded_link);
    } else {
      sink.in(early_z_link);
    }
  }

  void begin_frame() {
    setup.begin_frame();
    block_walker.begin_frame();
    hi_z.begin_frame();
    tile_walker.begin_frame();
    edge_evaluator.begin_frame();
    quad_generator.begin_frame();
    early_z.begin_frame();
    interpolator.begin_frame();
    sink.begin_frame();
  }

  CreditLink<TriangleToken> setup_link;
  CreditLink<BlockToken> block_link;
  CreditLink<BlockToken> hi_z_link;
  CreditLink<JobToken> tile_link;
  CreditLink<CoverageToken> edge_link;
  CreditLink<BurstToken> quad_link;
  CreditLink<TestedToken> early_z_link;
  CreditLink<ShadedToken> shaded_link;
  Source source;
  Setup setup;
  BlockWalker block_walker;
  HiZ hi_z;
  TileWalker tile_walker;
  EdgeEvaluator edge_evaluator;
  QuadGenerator quad_generator;
  EarlyZ early_z;
  Sink sink;
  Interpolator interpolator;
};

RasterPipeline::RasterPipeline(const sc_core::sc_module_name& name, const Config& config, std::uint64_t base)
    : sc_module(name),
      commands("commands"),
      memory("memory"),
      run_(config),
      units_(std::make_unique<Units>(run_, static_cast<FrameControl&>(*this), base)) {
  commands.register_b_transport(this, &RasterPipeline::transport);
  units_->early_z.cache.memory.socket.bind(memory);
}

RasterPipeline::~RasterPipeline() = default;

void RasterPipeline::bind_frame(const Frame& frame, const EngineOptions& options) {
  run_.frame = &frame;
  run_.stalls = options.stalls;
  run_.observer = options.watch.observer;
  run_.notes_times = options.packet_times;
  watch_ = options.watch;
  bound_ = true;
}

void RasterPipeline::trace_to(sc_core::sc_trace_file* file) {
  const auto add = [&](const std::string& name) {
    signals_.push_back(std::make_unique<TimedSignal>(sc_core::sc_gen_unique_name("traced"), run_.clock));
    sc_core::sc_trace(file, signals_.back()->value(), name, kTraceBits);
    return signals_.back().get();
  };
  for (std::size_t i = 0; i < kFifos; ++i) {
    run_.fifos[i]->trace_on(add("links." + std::string(kFifoName[i])));
  }
  for (StageMeter* const meter : run_.meters) {
    meter->trace_on(add("stages." + meter->name()));
  }
}

void RasterPipeline::begin_frame() {
  run_.clock.restart();
  run_.result = {};
  run_.result.surfaces = make_surfaces(*run_.frame, run_.config, watch_);
  run_.places = place_surfaces(run_.result.surfaces, run_.config);
  run_.draws.clear();
  run_.book = {};
  run_.times = {};
  for (CreditLinkBase* const fifo : run_.fifos) {
    fifo->begin_frame();
  }
  for (StageMeter* const meter : run_.meters) {
    meter->begin_frame();
  }
  units_->begin_frame();
}

Cycle RasterPipeline::stages_idle_from(Stage last) const {
  Cycle from = 0;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(last); ++i) {
    from = std::max(from, run_.meters[i]->next());
  }
  return from;
}

void RasterPipeline::write_all_late(Cycle since) {
  late_next_ =
      units_->early_z.test.write_all_late(std::max({since, stages_idle_from(Stage::kZTest), hi_z_out()}));
}

Cycle RasterPipeline::idle_from() const {
  return std::max({units_->sink.next(), stages_idle_from(Stage::kInterpolator), late_next_});
}

Cycle RasterPipeline::hi_z_out() const { return units_->hi_z.blocks_out(); }

Cycle RasterPipeline::clear_hi_z(std::uint32_t surface, std::uint32_t code, Cycle idle) {
  return run_.config.hi_z.enabled ? units_->hi_z.clear(surface, code, idle) : idle;
}

void RasterPipeline::end_frame(Cycle cycles) {
  units_->early_z.test.end_frame();
  for (CreditLinkBase* const fifo : run_.fifos) {
    fifo->end_frame(cycles);
  }
  for (StageMeter* const meter : run_.meters) {
    meter->end_frame(cycles);
  }
  collect_draws(run_.draws, run_.result);
  cycles_ = run_.book.finish(cycles, run_.result.draws.size());
  bound_ = false;
}

TimedResult RasterPipeline::take_result() {
  for (std::size_t i = 0; i < run_.places.size(); ++i) {
    units_->early_z.read_surface(static_cast<std::uint32_t>(i), run_.result.surfaces[i].codes);
  }
  return {.frame = std::move(run_.result), .cycles = cycles_, .times = std::move(run_.times)};
}

void RasterPipeline::check() {
  if (run_.error) {
    std::rethrow_exception(run_.error);
  }
  if (!units_->source.idle()) {
    throw DeadlockError("deadlock in cycle " + std::to_string(run_.clock.now()) + "\n" + describe());
  }
}

std::string RasterPipeline::describe() {
  std::string text = "stage source: " + units_->source.describe() + "\n";
  for (const StageMeter* const meter : run_.meters) {
    text += "stage " + meter->name() + ": " + meter->describe() + "\n";
  }
  for (std::size_t i = 0; i < kFifos; ++i) {
    text += "link " + std::string(kFifoName[i]) + ": " + run_.fifos[i]->describe() + "\n";
  }
  return text;
}

// The command port.

void RasterPipeline::transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  constexpr std::uint64_t kWord = 4;
  const std::uint64_t address = payload.get_address();
  if (address > registers::kCyclesHigh || address % kWord != 0) {
    payload.set_response_status(tlm::TLM_ADDRESS_ERROR_RESPONSE);
    return;
  }
  if (payload.get_data_length() != kWord || payload.get_streaming_width() < kWord) {
    payload.set_response_status(tlm::TLM_BURST_ERROR_RESPONSE);
    return;
  }
  if (payload.get_byte_enable_ptr() != nullptr) {
    payload.set_response_status(tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
    return;
  }
  if (delay != sc_core::SC_ZERO_TIME) {
    wait(delay);
    delay = sc_core::SC_ZERO_TIME;
  }
  std::array<std::uint8_t, kWord> bytes{};
  std::uint32_t value = 0;
  if (payload.is_write()) {
    std::memcpy(bytes.data(), payload.get_data_ptr(), kWord);
    for (std::size_t i = 0; i < kWord; ++i) {
      value |= std::uint32_t{bytes[i]} << (8 * i);
    }
    payload.set_response_status(write_register(address, value));
  } else if (payload.is_read()) {
    payload.set_response_status(read_register(address, value));
    for (std::size_t i = 0; i < kWord; ++i) {
      bytes[i] = static_cast<std::uint8_t>(value >> (8 * i));
    }
    std::memcpy(payload.get_data_ptr(), bytes.data(), kWord);
  } else {
    payload.set_response_status(tlm::TLM_OK_RESPONSE);
  }
}

tlm::tlm_response_status RasterPipeline::write_register(std::uint64_t address, std::uint32_t value) {
  if (address > registers::kWaitIdle) {
    return tlm::TLM_COMMAND_ERROR_RESPONSE;
  }
  if (!bound_) {
    return tlm::TLM_GENERIC_ERROR_RESPONSE;
  }
  const std::size_t count = run_.frame->commands.size();
  if (address == registers::kSubmitCommand) {
    if (value >= count) {
      return tlm::TLM_GENERIC_ERROR_RESPONSE;
    }
    units_->source.submit(value);
  } else if (address == registers::kSubmitFrame) {
    for (std::uint32_t i = 0; i < count; ++i) {
      units_->source.submit(i);
    }
  } else {
    units_->source.submit_end();
    units_->source.wait_until_idle();
  }
  return tlm::TLM_OK_RESPONSE;
}

tlm::tlm_response_status RasterPipeline::read_register(std::uint64_t address, std::uint32_t& value) const {
  switch (address) {
    case registers::kStatus:
      value = (units_->source.idle() ? 0u : 1u) | (bound_ ? 2u : 0u);
      return tlm::TLM_OK_RESPONSE;
    case registers::kCommandsDone:
      value = units_->source.commands_done();
      return tlm::TLM_OK_RESPONSE;
    case registers::kCyclesLow:
      value = static_cast<std::uint32_t>(cycles_.cycles);
      return tlm::TLM_OK_RESPONSE;
    case registers::kCyclesHigh:
      value = static_cast<std::uint32_t>(cycles_.cycles >> 32);
      return tlm::TLM_OK_RESPONSE;
    default:
      return tlm::TLM_COMMAND_ERROR_RESPONSE;
  }
}

}  // namespace halfspace::systemc
