#include "halfspace/core/functional.hpp"

#include <utility>

#include "halfspace/core/run_core.hpp"

namespace halfspace {

FrameResult run_functional(const Frame& frame, const Config& config, const Watch& watch) {
  return run_core(frame, config, watch, nullptr);
}

FunctionalRuns::FunctionalRuns(const Config& config, const Watch& watch) : config_(config), watch_(watch) {
  if (core_of(config, watch, nullptr) == Core::kFast) {
    fast_.emplace(config, watch);
  }
}

const Counters& FunctionalRuns::run(const Frame& frame) {
  if (!fast_) {
    readable_ = run_functional(frame, config_, watch_);
    return readable_.counters;
  }
  fast_->run(frame);
  return fast_->counters();
}

FrameResult FunctionalRuns::take() { return fast_ ? fast_->take() : std::move(readable_); }

}  // namespace halfspace
