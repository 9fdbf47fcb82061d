/// source -> device under test -> sink, with the reference queue: one run of one case.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "failure.hpp"
#include "fault.hpp"
#include "halfspace/units/packing.hpp"
#include "scoreboard.hpp"
#include "staller.hpp"
#include "stream_dut.hpp"
#include "unit_timing.hpp"

namespace halfspace::tb {

/// What a case sends, and what must come of it.
class Stimulus {
 public:
  Stimulus() = default;
  Stimulus(const Stimulus&) = delete;
  Stimulus& operator=(const Stimulus&) = delete;
  virtual ~Stimulus() = default;

  /// Fills in the next packet of the source; false when there is none.
  virtual bool next(std::span<std::uint32_t> packet) = 0;
  /// Queues what the unit's C++ definition makes of a packet.
  virtual void reference(std::span<const std::uint32_t> packet, Scoreboard& scoreboard) = 0;
  /// A reset of the unit: what it remembers of the packets before is lost.
  virtual void reset() {}
};

/// The links of the unit and its cycle table (docs/units).
struct UnitShape {
  std::size_t input_words = 0;
  std::vector<FieldSlot> output_fields;
  int latency = 0;   ///< cycles from a packet's acceptance until its result is valid
  int capacity = 0;  ///< credits
  /// For a unit whose cycle table latency and capacity do not tell; the checker of a run.
  std::function<std::unique_ptr<UnitTiming>()> timing = nullptr;
  /// The unit works on the packet at its input before it takes it: what comes of it is expected from the
  /// offer on, and ready may follow from the packet.
  bool reads_ahead = false;
  /// Cycles without a packet on any link that mean a deadlock: longer than any stall profile holds a link,
  /// and than the unit may work in silence.
  std::uint64_t deadlock_cycles = 2000;
};

/// Which of the checkers may end the run. Must-fail cases leave out those that would see their fault first.
struct Checks {
  bool packets = true;
  bool handshake = true;
  bool timing = true;
};

struct BenchOptions {
  std::uint64_t seed = 1;
  StallProfile idle = StallProfile::kNone;   ///< of the source
  StallProfile stall = StallProfile::kNone;  ///< of the sink
  double idle_share = 0;
  double stall_share = 0;
  Checks checks;
  bool probe_paths = false;  ///< wiggle every input in every cycle: no output may follow before the edge
  std::uint64_t reset_period = 0;       ///< mean number of cycles between resets under way; 0 for none
  std::uint64_t full_rate_packets = 0;  ///< when not 0, the run must take exactly this + latency cycles
  FaultKind fault = FaultKind::kNone;
  std::uint64_t fault_packet = 0;
  std::string wave_file;        ///< empty for none
  std::uint64_t wave_from = 0;  ///< first cycle in it
  std::string coverage_file;
};

struct BenchResult {
  std::optional<Failure> failure;
  std::uint64_t cycles = 0;    ///< after the first reset
  std::uint64_t compared = 0;  ///< packets that were as expected
};

BenchResult run_bench(StreamDut& dut, const UnitShape& shape, Stimulus& stimulus,
                      const BenchOptions& options);

}  // namespace halfspace::tb
