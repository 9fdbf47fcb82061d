#include "halfspace/timing/rtl/input_trace.hpp"

#include <cstddef>
#include <utility>

#include "halfspace/timing/rtl/pipeline_decorator.hpp"

namespace halfspace::rtl {
namespace {

constexpr std::uint8_t kReset = 1u << 0;
constexpr std::uint8_t kTriangle = 1u << 1;
constexpr std::uint8_t kBeatReady = 1u << 2;
constexpr std::uint8_t kFill = 1u << 3;
constexpr std::uint8_t kClear = 1u << 4;
constexpr std::uint8_t kFlush = 1u << 5;
constexpr std::uint8_t kSelect = 1u << 6;  ///< the selection of the counter is not 0
constexpr std::uint8_t kLate = 1u << 7;

std::uint8_t flags_of(const PipelineInputs& in) {
  const auto flag = [](bool on, std::uint8_t bit) { return on ? bit : std::uint8_t{0}; };
  return static_cast<std::uint8_t>(flag(in.reset, kReset) | flag(in.triangle_valid, kTriangle) |
                                   flag(in.beat_ready, kBeatReady) | flag(in.fill_valid, kFill) |
                                   flag(in.clear_valid, kClear) | flag(in.flush, kFlush) |
                                   flag(in.counter_select != 0, kSelect) | flag(in.late_valid, kLate));
}

/// Calls words(vector) for each payload and word(number) for each number that a cycle with `flags` has.
template <class Inputs, class Words, class Word>
void visit(Inputs& in, std::uint8_t flags, Words&& words, Word&& word) {
  if ((flags & kTriangle) != 0) {
    words(in.triangle);
    words(in.state);
  }
  if ((flags & kFill) != 0) {
    words(in.fill);
  }
  if ((flags & kLate) != 0) {
    words(in.late_keep);
  }
  if ((flags & kClear) != 0) {
    word(in.clear_first);
    word(in.clear_last);
    word(in.clear_first_block);
    word(in.clear_last_block);
  }
  if ((flags & kSelect) != 0) {
    word(in.counter_select);
  }
}

class TracedPipeline final : public PipelineDecorator {
 public:
  TracedPipeline(std::unique_ptr<VerilatedPipeline> pipeline, InputTrace& trace)
      : PipelineDecorator(std::move(pipeline)), trace_(trace) {}

  void settle(const PipelineInputs& in, PipelineOutputs& out) override {
    pipeline().settle(in, out);
    in_ = in;
    out_ = out;
  }
  void clock_edge() override {
    trace_.add(in_, out_);
    pipeline().clock_edge();
  }

 private:
  InputTrace& trace_;
  PipelineInputs in_;
  PipelineOutputs out_;
};

/// FNV-1a, word by word.
std::uint64_t digest_of(std::uint64_t before, const PipelineInputs& in, const PipelineOutputs& out) {
  if (in.reset) {
    return before;  // registers may hold anything
  }
  constexpr std::uint64_t kPrime = 0x100000001b3;
  return ((before ^ out.activity) * kPrime ^ out.events) * kPrime;
}

}  // namespace

void InputTrace::add(const PipelineInputs& in, const PipelineOutputs& out) {
  digest_ = digest_of(digest_, in, out);
  flags_.push_back(flags_of(in));
  visit(
      in, flags_.back(),
      [&](const std::vector<std::uint32_t>& words) {
        payload_.push_back(static_cast<std::uint32_t>(words.size()));
        payload_.insert(payload_.end(), words.begin(), words.end());
      },
      [&](std::uint32_t number) { commands_.push_back(number); });
}

std::uint64_t InputTrace::play(VerilatedPipeline& pipeline) const {
  std::uint64_t seen = kDigestStart;
  PipelineInputs in;
  PipelineOutputs out;
  auto payload = payload_.begin();
  auto command = commands_.begin();
  for (const std::uint8_t flags : flags_) {
    in.reset = (flags & kReset) != 0;
    in.triangle_valid = (flags & kTriangle) != 0;
    in.beat_ready = (flags & kBeatReady) != 0;
    in.fill_valid = (flags & kFill) != 0;
    in.late_valid = (flags & kLate) != 0;
    in.clear_valid = (flags & kClear) != 0;
    in.flush = (flags & kFlush) != 0;
    in.counter_select = 0;
    visit(
        in, flags,
        [&](std::vector<std::uint32_t>& words) {
          const auto count = static_cast<std::ptrdiff_t>(*payload++);
          words.assign(payload, payload + count);
          payload += count;
        },
        [&](std::uint32_t& number) { number = *command++; });
    pipeline.settle(in, out);
    seen = digest_of(seen, in, out);
    pipeline.clock_edge();
  }
  return seen;
}

std::unique_ptr<VerilatedPipeline> traced(std::unique_ptr<VerilatedPipeline> pipeline, InputTrace& trace) {
  return std::make_unique<TracedPipeline>(std::move(pipeline), trace);
}

}  // namespace halfspace::rtl
