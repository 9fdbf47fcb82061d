/// Faults on the link between a device under test and its checker, to prove that the checker sees them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace halfspace::tb {

enum class FaultKind : std::uint8_t {
  kNone,
  kFlipBit,        ///< lowest payload bit of a packet inverted
  kDrop,           ///< a packet swallowed
  kDropLast,       ///< all packets from one on swallowed
  kSwap,           ///< a packet after its successor
  kDuplicate,      ///< a packet twice
  kExtra,          ///< one more packet at the end
  kEarlyValid,     ///< valid before the packet is there, and withdrawn again
  kChangePayload,  ///< another payload in the second cycle of a stall
  kLate,           ///< a packet one cycle late
  kStuck,          ///< the link blocks for ever
  kSourceChange,  ///< the bench's own source changes its payload while stalled: for the assertions of the RTL
};

/// The fault of that name ("flip-bit"); nothing when there is none.
std::optional<FaultKind> fault_by_name(const std::string& name);

/// Sits on the link. One step() a cycle, when the device's outputs and the sink's ready are known.
class FaultShim {
 public:
  FaultShim(FaultKind kind, std::uint64_t packet) : kind_(kind), at_(packet) {}

  /// `draining`: everything expected has arrived.
  void step(bool valid, std::span<const std::uint32_t> payload, bool ready, bool draining);

  // What the sink sees.
  [[nodiscard]] bool valid() const { return valid_; }
  [[nodiscard]] std::span<const std::uint32_t> payload() const { return payload_; }
  /// What the device sees.
  [[nodiscard]] bool ready() const { return ready_; }

 private:
  void show_copy(bool ready);

  FaultKind kind_;
  std::uint64_t at_;          ///< the packet that the fault is about
  std::uint64_t packet_ = 0;  ///< packets that have left the device
  bool valid_ = false;
  bool ready_ = false;
  std::vector<std::uint32_t> payload_;
  std::vector<std::uint32_t> copy_;  ///< a packet held back or repeated
  bool copy_waits_ = false;
  bool done_ = false;
  bool stalled_ = false;  ///< the sink stalled this link in the last cycle
};

}  // namespace halfspace::tb
