/// What a bench can find wrong. The number is its exit status.
#pragma once

#include <cstdint>
#include <string>

namespace halfspace::tb {

enum class FailureKind : std::uint8_t {
  kPayload = 10,    ///< a packet differs from the reference
  kMissing = 11,    ///< a packet never came
  kOrder = 12,      ///< packets came in another order
  kExtra = 13,      ///< a packet that nobody expects
  kHandshake = 14,  ///< valid withdrawn or payload changed while stalled, or a path from pin to pin
  kTiming = 15,     ///< not in the cycle that latency and credits say
  kDeadlock = 16,   ///< nothing moves
  kAssertion = 17,  ///< an assertion of the RTL
};

inline std::string to_string(FailureKind kind) {
  switch (kind) {
    case FailureKind::kPayload:
      return "payload";
    case FailureKind::kMissing:
      return "missing";
    case FailureKind::kOrder:
      return "order";
    case FailureKind::kExtra:
      return "extra";
    case FailureKind::kHandshake:
      return "handshake";
    case FailureKind::kTiming:
      return "timing";
    case FailureKind::kDeadlock:
      return "deadlock";
    case FailureKind::kAssertion:
      return "assertion";
  }
  return "?";
}

struct Failure {
  FailureKind kind = FailureKind::kPayload;
  std::uint64_t cycle = 0;
  std::string message;
};

}  // namespace halfspace::tb
