/// Bench of interpolator: the RTL against model/halfspace/units/interpolator.hpp.
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/bench_cli.hpp"
#include "interpolator_coverage.hpp"
#include "models.hpp"
#include "stimulus.hpp"

namespace halfspace::tb {
namespace {

constexpr std::uint64_t kTimingQuads = 500;
constexpr int kBinsMissed = 18;  // exit status, after those of FailureKind

/// The cycle table of docs/units/interpolator.md.
int latency(const InterpolatorParameters& parameters) { return parameters.bits / 2 + 18; }

/// The bench as a whole: its models, and the bins of the one at work.
class InterpolatorBench {
 public:
  int run(int argc, char** argv) {
    std::vector<DutModel> models;
    for (const InterpolatorModel& model : models_) {
      models.push_back(model.dut);
    }
    const int status = bench_main(
        argc, argv,
        {.unit = "interpolator",
         .models = std::move(models),
         .cases = {"directed", "timing", "reset", "random"},
         .model_of_file = [this](const std::string&) { return models_.front().dut.name; },
         .shape = [this](const DutModel& model) { return shape(model); },
         .runs = [this](const DutModel& model, const std::string& test_case, const CommandLine& command_line,
                        const BenchOptions& base) { return runs(model, test_case, command_line, base); }});
    return status != 0 || !wants_bins_ || coverage_->report() ? status : kBinsMissed;
  }

 private:
  [[nodiscard]] const InterpolatorParameters& parameters(const DutModel& model) const {
    return std::ranges::find(models_, model.name,
                             [](const InterpolatorModel& known) { return known.dut.name; })
        ->parameters;
  }

  UnitShape shape(const DutModel& model) {
    const InterpolatorParameters& unit = parameters(model);
    coverage_ = std::make_unique<InterpolatorCoverage>(unit);
    return {.input_words = words_for(packed_bits<AttributeQuad>(unit.widths())),
            .output_fields = field_slots<ShadedQuad>(unit.widths()),
            .latency = latency(unit),
            .capacity = unit.fifo_depth};
  }

  std::vector<BenchRun> runs(const DutModel& model, const std::string& test_case,
                             const CommandLine& command_line, const BenchOptions& base) {
    const InterpolatorParameters unit = parameters(model);
    wants_bins_ = command_line.test_case == "all" && command_line.coverage.empty();
    if (test_case == "timing") {
      BenchOptions options = base;
      // At full rate where the FIFO has the credits for it.
      options.full_rate_packets = unit.fifo_depth > latency(unit) ? kTimingQuads : 0;
      return {{test_case, options,
               [=, this] { return random_stimulus(unit, *coverage_, options.seed, kTimingQuads); }}};
    }
    return case_runs(
        test_case, command_line, with_stalls(base, command_line),
        {.directed = [=,
                      this](std::uint64_t) { return list_stimulus(unit, *coverage_, directed_quads(unit)); },
         .replay = nullptr,
         .random = [=, this](
                       std::uint64_t seed,
                       std::uint64_t quads) { return random_stimulus(unit, *coverage_, seed, quads); }});
  }

  std::vector<InterpolatorModel> models_ = interpolator_models();
  std::unique_ptr<InterpolatorCoverage> coverage_;
  bool wants_bins_ = false;
};

}  // namespace
}  // namespace halfspace::tb

int main(int argc, char** argv) { return halfspace::tb::InterpolatorBench().run(argc, argv); }
