/// Random numbers that are the same with every compiler and library, as those of <random>'s distributions are
/// not.
#pragma once

#include <cstdint>

namespace halfspace {

/// splitmix64: G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators", 2014.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
  /// The sequence of `seed` after its first `n` numbers.
  static SplitMix64 at(std::uint64_t seed, std::uint64_t n) { return SplitMix64(seed + n * kStep); }

  std::uint64_t next() {
    state_ += kStep;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  /// Uniform in [low, high), a multiple of (high - low) / 2^53 above low.
  double real(double low, double high) {
    return low + (high - low) * (static_cast<double>(next() >> 11) * 0x1p-53);
  }

  /// Uniform in low..high, both included, but for a bias of (high - low) / 2^64.
  std::int64_t integer(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(next() % static_cast<std::uint64_t>(high - low + 1));
  }

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15u;

  std::uint64_t state_;
};

}  // namespace halfspace
