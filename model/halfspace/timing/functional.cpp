#include "halfspace/timing/functional.hpp"

#include "halfspace/timing/pipeline.hpp"

namespace halfspace {

FrameResult run_functional(const Frame& frame, const Config& config, bool keep_visible,
                           PacketObserver* observer) {
  NoClock clock;
  return run_pipeline(frame, config, keep_visible, observer, clock);
}

}  // namespace halfspace
