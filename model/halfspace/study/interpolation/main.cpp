// How far the unit interpolator is off the exact attribute, by its precision: JSON on stdout.
#include <fmt/format.h>
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

#include "halfspace/numerics/split_mix.hpp"
#include "halfspace/units/interpolator.hpp"

namespace {

using namespace halfspace;

/// A texture coordinate over a triangle of a picture: E at a pixel inside, 1/w, and the values at the
/// vertices.
struct Sample {
  std::array<std::int64_t, 3> e{};
  std::array<std::uint32_t, 3> q{};
  std::array<std::int32_t, 3> v{};
};

/// Triangles up to 1024 pixels wide, at distances of 1 to 256, with coordinates from 0 to 1.
Sample sample(SplitMix64& random) {
  Sample out;
  const auto below = [&](std::uint64_t n) { return random.next() % n; };
  for (std::size_t i = 0; i < 3; ++i) {
    out.e[i] = static_cast<std::int64_t>(below(std::uint64_t{1} << (1 + below(36))));
    out.q[i] = static_cast<std::uint32_t>((120 + below(8)) << 23 | below(1u << 23));
    out.v[i] = static_cast<std::int32_t>(below((1u << kAttributeFraction) + 1));
  }
  out.e[0] += out.e[0] + out.e[1] + out.e[2] == 0 ? 1 : 0;
  return out;
}

double error_of(const Sample& s, int bits) {
  const VertexWeights weights = perspective_weights(s.e, s.q, bits);
  const std::int32_t found = interpolate(s.v, weights, true, bits);
  mpz_class sum = 0;
  mpz_class weighted = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    mpz_class t = mpz_class(static_cast<long>(s.e[i])) * mpz_class((s.q[i] & 0x7FFFFF) | 0x800000);
    mpz_mul_2exp(t.get_mpz_t(), t.get_mpz_t(), s.q[i] >> 23);
    sum += t;
    weighted += t * s.v[i];
  }
  mpq_class exact(weighted, sum);
  exact.canonicalize();
  const mpq_class off = abs(exact - found);
  return off.get_d() / (1 << kAttributeFraction);
}

}  // namespace

int main(int argc, char** argv) {
  const long samples = argc > 1 ? std::atol(argv[1]) : 1'000'000;
  if (samples < 1) {
    fmt::print(stderr, "study: samples are '{}'; legal: 1 or more\n", argv[1]);
    return 2;
  }
  fmt::print("{{\"samples\": {}, \"bits\": [", samples);
  for (int bits = 8; bits <= 24; bits += 2) {
    SplitMix64 random(1);
    double worst = 0;
    double sum = 0;
    for (long i = 0; i < samples; ++i) {
      const double error = error_of(sample(random), bits);
      worst = std::max(worst, error);
      sum += error;
    }
    fmt::print("{}{{\"bits\": {}, \"worst\": {}, \"mean\": {}}}", bits == 8 ? "" : ", ", bits, worst,
               sum / static_cast<double>(samples));
  }
  fmt::print("]}}\n");
  return 0;
}
