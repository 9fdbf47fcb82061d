/// The cycle table of a unit that latency and capacity alone do not describe, as a checker of its pins.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "failure.hpp"

namespace halfspace::tb {

/// The pins of one cycle, at its end.
struct UnitPins {
  std::uint64_t cycle = 0;
  bool in_valid = false;
  bool in_ready = false;
  std::span<const std::uint32_t> input;
  bool out_valid = false;
  bool out_ready = false;
  std::span<const std::uint32_t> output;
  std::span<const std::uint32_t> side;  ///< StreamDut::side_outputs()
};

class UnitTiming {
 public:
  UnitTiming() = default;
  UnitTiming(const UnitTiming&) = delete;
  UnitTiming& operator=(const UnitTiming&) = delete;
  virtual ~UnitTiming() = default;

  /// Compares the pins of this cycle with what they must be, and takes note of what moves in it.
  virtual std::optional<Failure> cycle(const UnitPins& pins) = 0;
  /// A reset: what is under way is lost.
  virtual void clear() = 0;
};

}  // namespace halfspace::tb
