/// The fast core: the function of the units, a second time, with vectors for samples, tiles and triangles.
/// The units stay the definition; this gives the same result, bit for bit.
#pragma once

#include <memory>
#include <string_view>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/machine/packet_observer.hpp"

namespace halfspace {

class StreamReader;

namespace fast {

/// What of such a run the fast core does not cover; empty where it covers all.
std::string_view gap(const Config& config, const Watch& watch, const StreamReader* reader);

/// Runs frames one after the other, and keeps its memory from one to the next.
class FastCore {
 public:
  /// A run of `config`, `watch` and `reader` must have no gap. Where `reader` is not null, it reads the
  /// packets of one run.
  FastCore(const Config& config, const Watch& watch, StreamReader* reader = nullptr);
  ~FastCore();
  FastCore(FastCore&&) noexcept;

  /// As run_in_order (machine/in_order.hpp).
  void run(const Frame& frame);
  /// Counters of the last run.
  [[nodiscard]] const Counters& counters() const;
  /// The result of the last run, which is then gone. Makes the depth codes that nobody has looked at so far,
  /// and the counts of pixels.
  FrameResult take();

 private:
  class Runner;
  std::unique_ptr<Runner> runner_;
};

}  // namespace fast
}  // namespace halfspace
