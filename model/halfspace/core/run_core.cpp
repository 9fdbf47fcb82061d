#include "halfspace/core/run_core.hpp"

#include <fmt/format.h>

#include "halfspace/fast/fast_core.hpp"
#include "halfspace/machine/in_order.hpp"
#include "halfspace/machine/threaded_reader.hpp"
#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

FrameResult run_units(const Frame& frame, const Config& config, const Watch& watch, StreamReader* reader) {
  if (core_of(config, watch, reader) == Core::kReadable) {
    return run_in_order(frame, config, watch, reader);
  }
  fast::FastCore core(config, watch, reader);
  core.run(frame);
  return core.take();
}

}  // namespace

Core core_of(const Config& config, const Watch& watch, const StreamReader* reader) {
  if (watch.core == Core::kReadable) {
    return Core::kReadable;
  }
  const std::string_view gap = fast::gap(config, watch, reader);
  if (watch.core == Core::kFast && !gap.empty()) {
    throw OptionError(fmt::format("core is 'fast', which does not cover {}; legal: auto, readable", gap));
  }
  return gap.empty() ? Core::kFast : Core::kReadable;
}

FrameResult run_core(const Frame& frame, const Config& config, const Watch& watch, StreamReader* reader) {
  // without time, to read a part costs less than to hand it over
  if (reader == nullptr || !reader->has_time() || watch.threads < 2 || shows_cycles(watch, *reader)) {
    return run_units(frame, config, watch, reader);
  }
  ThreadedReader beside(*reader);
  FrameResult result = run_units(frame, config, watch, &beside);
  beside.finish();
  return result;
}

}  // namespace halfspace
