/// Random numbers of the benches: the same stream for the same seed on every machine.
#pragma once

#include <cstdint>
#include <random>

namespace halfspace::tb {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  std::uint64_t bits() { return engine_(); }
  /// 0 to count - 1.
  std::uint64_t below(std::uint64_t count) { return engine_() % count; }
  /// first to last, both included.
  std::int64_t range(std::int64_t first, std::int64_t last) {
    return first + static_cast<std::int64_t>(below(static_cast<std::uint64_t>(last - first) + 1));
  }
  bool chance(double probability) {
    return static_cast<double>(engine_() >> 11) < probability * static_cast<double>(std::uint64_t{1} << 53);
  }

 private:
  std::mt19937_64 engine_;  // std distributions differ between libraries; the engine does not
};

}  // namespace halfspace::tb
