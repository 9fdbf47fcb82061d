/// Random integers for property tests: the same on every machine, printed on failure, settable from outside.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>

namespace halfspace::testing {

/// HALFSPACE_SEED from the environment, or a fixed seed. Tests CAPTURE it.
inline std::uint64_t seed() {
  const char* text = std::getenv("HALFSPACE_SEED");
  return text != nullptr ? std::stoull(text) : 20240229;
}

/// How many samples a property looks at: HALFSPACE_SAMPLES from the environment, or what the gate has time
/// for.
inline std::uint64_t samples(std::uint64_t in_gate) {
  const char* text = std::getenv("HALFSPACE_SAMPLES");
  return text != nullptr ? std::stoull(text) : in_gate;
}

class Random {
 public:
  explicit Random(std::uint64_t seed_value) : engine_(seed_value) {}

  /// low to high, both included. std::uniform_int_distribution differs between libraries; the bias of the
  /// remainder is below 2^-30 for the ranges used here.
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }

 private:
  std::mt19937_64 engine_;  // its output is fixed by the C++ standard
};

}  // namespace halfspace::testing
