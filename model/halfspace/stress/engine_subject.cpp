#include "halfspace/stress/engine_subject.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace halfspace::stress {
namespace {

class Decisions final : public PacketObserver {
 public:
  [[nodiscard]] bool wants_decisions() const override { return true; }
  void decision(const DecisionEvent& event) override { all.push_back(event); }
  std::vector<DecisionEvent> all;
};

template <class Value>
std::vector<std::uint32_t> by_row(const TiledImage<Value>& image) {
  std::vector<std::uint32_t> values;
  values.reserve(static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()) *
                 static_cast<std::size_t>(image.samples()));
  for (int sample = 0; sample < image.samples(); ++sample) {
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        values.push_back(image.at(x, y, sample));
      }
    }
  }
  return values;
}

class Engine final : public Subject {
 public:
  Engine(Fidelity fidelity, const Config& config, RunOptions options)
      : fidelity_(fidelity), config_(config), options_(std::move(options)) {}

  [[nodiscard]] std::string name() const override {
    const Core core = options_.watch.core;
    return fmt::format("{}{}{}, machine {}", info(fidelity_).name, info(fidelity_).core ? ", core " : "",
                       info(fidelity_).core ? kCoreName[static_cast<std::size_t>(core)] : "",
                       config_hash(config_));
  }

  Picture draw(const Frame& frame) override {
    Decisions decisions;
    RunOptions options = options_;
    options.watch.count_pixels = true;
    const bool units = options.watch.core == Core::kReadable;
    options.watch.observer = units ? &decisions : nullptr;
    const RunResult result = run(fidelity_, frame, config_, options);
    if (result.rtl && result.rtl->different != 0) {
      throw std::runtime_error(
          fmt::format("{} packets of the RTL differ from the units", result.rtl->different));
    }
    const Surface& surface = result.frame.surfaces.at(0);
    return {.width = static_cast<std::uint32_t>(surface.codes.width()),
            .height = static_cast<std::uint32_t>(surface.codes.height()),
            .fragments = by_row(surface.fragments),
            .survivors = by_row(surface.survivors),
            .codes = by_row(surface.codes),
            .culls = config_.hi_z.enabled,
            .tile_size = units ? config_.tile_walker.tile_size : 0,
            .decisions = std::move(decisions.all)};
  }

 private:
  Fidelity fidelity_;
  Config config_;
  RunOptions options_;
};

}  // namespace

std::unique_ptr<Subject> engine_subject(Fidelity fidelity, const Config& config, RunOptions options) {
  return std::make_unique<Engine>(fidelity, config, std::move(options));
}

}  // namespace halfspace::stress
