// Cycles that are skipped, against a machine that counts every one of them.
#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "halfspace/timing/rtl/cycle_meter.hpp"
#include "halfspace/timing/rtl/rest_skipper.hpp"
#include "random_machine.hpp"

using namespace halfspace;
using namespace halfspace::testing;
using namespace halfspace::rtl;

namespace {

/// Works off what it is given, a unit of work a cycle, some of it without any packet on a link, and a beat of
/// a write with every fifth. Then it comes to rest. Counts its cycles as the RTL does.
class Toy final : public VerilatedPipeline {
 public:
  explicit Toy(std::uint64_t& edges) : edges_(edges) {}

  void settle(const PipelineInputs& in, PipelineOutputs& out) override {
    now_.in = in;
    out = {};
    out.activity = now_.work != 0 ? 0 : in.beat_ready ? 2 : 1;
    out.events = now_.work % 16 == 1 ? 1 : 0;
    out.write_valid = now_.work != 0 && now_.work % 5 == 0;
    out.counter = now_.counter;
    activity_ = out.activity;
    writes_ = out.write_valid;
  }
  void clock_edge() override {
    ++edges_;
    now_.counter = counts_[now_.in.counter_select];
    if (counts_cycles_) {
      for (std::size_t stage = 0; stage < kStages; ++stage) {
        ++counts_[stage << kActivityBits | (activity_ >> (stage * kActivityBits) & kActivityMask)];
      }
      counts_[kStages << kActivityBits] += now_.in.fill_valid ? 1 : 0;
      counts_[kStages << kActivityBits | 1] += writes_ ? 1 : 0;
    }
    now_.work = now_.in.fill_valid ? now_.in.fill[0] : now_.work - (now_.work != 0 ? 1 : 0);
  }
  void count_cycles(bool on) override { counts_cycles_ = on; }
  void keep_state() override { kept_ = now_; }
  [[nodiscard]] bool holds_kept_state() const override { return now_ == kept_; }

  [[nodiscard]] bool clear_done() const override { return false; }
  [[nodiscard]] bool flush_done() const override { return false; }
  [[nodiscard]] std::span<const std::uint32_t> setup_triangle() const override { return {}; }
  [[nodiscard]] std::span<const std::uint32_t> depth_equation() const override { return {}; }
  [[nodiscard]] std::span<const std::uint32_t> draw_state() const override { return {}; }
  [[nodiscard]] std::span<const std::uint32_t> walked_job() const override { return {}; }
  [[nodiscard]] std::span<const std::uint32_t> block_job() const override { return {}; }
  [[nodiscard]] std::span<const std::uint32_t> tile_job() const override { return {}; }
  [[nodiscard]] std::span<const std::uint32_t> coverage() const override { return {}; }
  [[nodiscard]] std::span<const std::uint32_t> quad_beat() const override { return {}; }
  [[nodiscard]] std::span<const std::uint32_t> tested_beat() const override { return {}; }
  void write_data(std::vector<std::uint32_t>& /*words*/) const override {}
  [[nodiscard]] bool assertion_failed() const override { return false; }
  void trace_to(const std::filesystem::path& /*file*/) override {}

 private:
  struct State {
    PipelineInputs in;
    std::uint32_t work = 0;
    std::uint64_t counter = 0;  ///< that is shown
    friend bool operator==(const State&, const State&) = default;
  };

  std::uint64_t& edges_;
  State now_;
  State kept_;
  std::uint32_t activity_ = 0;
  bool writes_ = false;
  bool counts_cycles_ = true;
  std::array<std::uint64_t, (kStages + 1) << kActivityBits> counts_{};
};

/// Inputs of a cycle that differ from those before it.
PipelineInputs random_inputs(Random& random) {
  PipelineInputs in;
  in.fill = {static_cast<std::uint32_t>(random.between(0, 100))};
  in.fill_valid = random.between(0, 3) == 0;
  in.beat_ready = random.between(0, 1) == 0;
  in.counter_select = pick(random, {0u, 1u, 2u, 8u, static_cast<std::uint32_t>(kStages) << kActivityBits,
                                    static_cast<std::uint32_t>(kStages) << kActivityBits | 1});
  return in;
}

}  // namespace

TEST_CASE("a rest that is skipped shows what every cycle of it would", "[timing]") {
  Random random(seed());
  for (int run = 0; run < 100; ++run) {
    std::uint64_t all_edges = 0;
    std::uint64_t edges = 0;
    RestCounts counts;
    Toy every(all_edges);
    const std::unique_ptr<VerilatedPipeline> skipping = skipping_rests(std::make_unique<Toy>(edges), &counts);
    const std::int64_t longest = pick(random, {1, 3, 20, 400});  // time for which inputs stay
    std::uint64_t cycles = 0;
    for (int change = 0; change < 100; ++change) {
      PipelineInputs in = random_inputs(random);
      for (std::int64_t left = random.between(1, longest); left > 0; --left, ++cycles) {
        PipelineOutputs want;
        PipelineOutputs got;
        every.settle(in, want);
        skipping->settle(in, got);
        CAPTURE(seed(), run, cycles);
        REQUIRE(got == want);
        every.clock_edge();
        skipping->clock_edge();
        in.fill_valid = false;
      }
    }
    CHECK(counts.evaluated == edges);
    CHECK(counts.evaluated + counts.skipped == cycles);
    CHECK(counts.looked <= counts.evaluated);
    CHECK((longest < 400 || counts.skipped > cycles / 3));
  }
}

TEST_CASE("a rest begins when a look at two cycles finds the same, and ends with an input", "[timing]") {
  std::uint64_t edges = 0;
  RestCounts counts;
  const std::unique_ptr<VerilatedPipeline> skipping = skipping_rests(std::make_unique<Toy>(edges), &counts);
  PipelineInputs in;
  PipelineOutputs out;
  const auto cycles = [&](int count) {
    for (; count > 0; --count) {
      skipping->settle(in, out);
      skipping->clock_edge();
    }
  };
  cycles(10);  // the state of the last is kept
  CHECK(edges == 10);
  CHECK(counts.looked == 1);
  cycles(1000);
  CHECK(edges == 10);
  CHECK(counts.skipped == 1000);
  in.beat_ready = true;
  cycles(1);
  CHECK(edges == 11);
  CHECK(out.activity == 2);
}
