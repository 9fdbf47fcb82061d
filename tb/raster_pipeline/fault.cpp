#include "raster_pipeline/fault.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "halfspace/timing/rtl/pipeline_decorator.hpp"

namespace halfspace::tb {
namespace {

using namespace rtl;

constexpr std::array<std::pair<const char*, PipelineFault>, 18> kNames{{
    {"none", PipelineFault::kNone},
    {"flip-triangle", PipelineFault::kFlipTriangle},
    {"flip-equation", PipelineFault::kFlipEquation},
    {"flip-state", PipelineFault::kFlipState},
    {"flip-block", PipelineFault::kFlipBlock},
    {"flip-job", PipelineFault::kFlipJob},
    {"flip-coverage", PipelineFault::kFlipCoverage},
    {"flip-beat", PipelineFault::kFlipBeat},
    {"flip-tested", PipelineFault::kFlipTested},
    {"flip-fill", PipelineFault::kFlipFill},
    {"flip-write", PipelineFault::kFlipWrite},
    {"drop-triangle", PipelineFault::kDropTriangle},
    {"drop-tested", PipelineFault::kDropTested},
    {"late-tested", PipelineFault::kLateTested},
    {"lose-fill", PipelineFault::kLoseFill},
    {"activity", PipelineFault::kActivity},
    {"counter", PipelineFault::kCounter},
    {"rest", PipelineFault::kRest},
}};

/// What passes counts; the fault happens once, when as many as `at` have passed.
class FaultyPipeline final : public PipelineDecorator {
 public:
  FaultyPipeline(std::unique_ptr<VerilatedPipeline> pipeline, PipelineFault fault, std::uint64_t at)
      : PipelineDecorator(std::move(pipeline)), fault_(fault), left_(at) {}

  void settle(const PipelineInputs& in, PipelineOutputs& out) override {
    in_ = in;
    here_ = false;
    if (in.reset) {  // before it registers hold anything
      pipeline().settle(in, out);
      return;
    }
    if (in.fill_valid && fault_ == PipelineFault::kFlipFill && due()) {
      in_.fill[0] ^= 1;
    }
    if (in.fill_valid && fault_ == PipelineFault::kLoseFill && due()) {
      in_.fill_valid = false;
    }
    pipeline().settle(in_, out);
    const std::uint32_t event = event_of_fault();
    here_ = event != 0 && (out.events & event) != 0 && due();
    switch (fault_) {
      case PipelineFault::kFlipTested:
        here_ = out.beat_valid && in.beat_ready && due();
        break;
      case PipelineFault::kFlipWrite:
        here_ = out.write_valid && due();
        break;
      case PipelineFault::kDropTriangle:
        if (in.triangle_valid && out.triangle_ready && due()) {
          in_.triangle_valid = false;  // the driver thinks that it was taken
          PipelineOutputs same;
          pipeline().settle(in_, same);
        }
        break;
      case PipelineFault::kDropTested:
        out.beat_valid = out.beat_valid && !(in.beat_ready && due());
        break;
      case PipelineFault::kLateTested:
        if (out.beat_valid && in.beat_ready && due()) {
          in_.beat_ready = false;
          pipeline().settle(in_, out);
          out.beat_valid = false;
        }
        break;
      case PipelineFault::kActivity:
        out.activity ^= due() ? 1u : 0u;
        break;
      case PipelineFault::kCounter:
        out.counter += in.counter_select == 1 ? 1 : 0;
        break;
      default:
        break;
    }
  }

  [[nodiscard]] bool holds_kept_state() const override {
    return (fault_ == PipelineFault::kRest && due()) || pipeline().holds_kept_state();
  }
  [[nodiscard]] std::span<const std::uint32_t> setup_triangle() const override {
    return payload(pipeline().setup_triangle(), PipelineFault::kFlipTriangle);
  }
  [[nodiscard]] std::span<const std::uint32_t> depth_equation() const override {
    return payload(pipeline().depth_equation(), PipelineFault::kFlipEquation);
  }
  [[nodiscard]] std::span<const std::uint32_t> draw_state() const override {
    return payload(pipeline().draw_state(), PipelineFault::kFlipState);
  }
  [[nodiscard]] std::span<const std::uint32_t> block_job() const override {
    return payload(pipeline().block_job(), PipelineFault::kFlipBlock);
  }
  [[nodiscard]] std::span<const std::uint32_t> tile_job() const override {
    return payload(pipeline().tile_job(), PipelineFault::kFlipJob);
  }
  [[nodiscard]] std::span<const std::uint32_t> coverage() const override {
    return payload(pipeline().coverage(), PipelineFault::kFlipCoverage);
  }
  [[nodiscard]] std::span<const std::uint32_t> quad_beat() const override {
    return payload(pipeline().quad_beat(), PipelineFault::kFlipBeat);
  }
  [[nodiscard]] std::span<const std::uint32_t> tested_beat() const override {
    return payload(pipeline().tested_beat(), PipelineFault::kFlipTested);
  }
  void write_data(std::vector<std::uint32_t>& words) const override {
    pipeline().write_data(words);
    words[0] ^= here_ && fault_ == PipelineFault::kFlipWrite ? 1u : 0u;
  }

 private:
  /// Called once for each that passes.
  bool due() const { return left_-- == 0; }

  [[nodiscard]] std::uint32_t event_of_fault() const {
    switch (fault_) {
      case PipelineFault::kFlipTriangle:
      case PipelineFault::kFlipEquation:
      case PipelineFault::kFlipState:
        return bit(Event::kAccept);
      case PipelineFault::kFlipBlock:
        return bit(Event::kBlockDone);
      case PipelineFault::kFlipJob:
        return bit(Event::kJob);
      case PipelineFault::kFlipCoverage:
        return bit(Event::kCoverage);
      case PipelineFault::kFlipBeat:
        return bit(Event::kBeat);
      default:
        return 0;
    }
  }

  [[nodiscard]] std::span<const std::uint32_t> payload(std::span<const std::uint32_t> words,
                                                       PipelineFault fault) const {
    if (!here_ || fault_ != fault) {
      return words;
    }
    flipped_.assign(words.begin(), words.end());
    flipped_[0] ^= 1;
    return flipped_;
  }

  PipelineFault fault_;
  mutable std::uint64_t left_;
  bool here_ = false;  ///< in this cycle
  PipelineInputs in_;
  mutable std::vector<std::uint32_t> flipped_;
};

}  // namespace

std::optional<PipelineFault> pipeline_fault(const std::string& name) {
  const auto* const known =
      std::ranges::find_if(kNames, [&](const auto& each) { return name == each.first; });
  return known == kNames.end() ? std::nullopt : std::optional(known->second);
}

std::vector<std::string> pipeline_fault_names() {
  std::vector<std::string> names;
  for (const auto& [name, fault] : kNames) {
    names.emplace_back(name);
  }
  return names;
}

std::unique_ptr<VerilatedPipeline> with_fault(std::unique_ptr<VerilatedPipeline> pipeline,
                                              PipelineFault fault, std::uint64_t at) {
  return std::make_unique<FaultyPipeline>(std::move(pipeline), fault, at);
}

}  // namespace halfspace::tb
