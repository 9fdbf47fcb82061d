// The depth test of `bench roof` is a depth test.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "halfspace/speed/roof.hpp"

namespace halfspace::testing {

TEST_CASE("roof: codes of a plane are tested and written, one by one") {
  std::mt19937 random;  // its output is fixed by the C++ standard
  std::vector<std::uint32_t> stored(640);
  std::ranges::generate(stored, [&] { return static_cast<std::uint32_t>(random()); });
  std::vector<std::uint32_t> expected = stored;
  const std::uint32_t first = 0x7FFFFF00;
  const std::uint32_t step = 0x01234567;
  std::uint64_t passes = 0;
  for (std::uint32_t i = 0; i < expected.size(); ++i) {
    const std::uint32_t code = first + i * step;
    passes += code < expected[i] ? 1 : 0;
    expected[i] = std::min(code, expected[i]);
  }
  CHECK(test_in_a_row(stored, first, step) == passes);
  CHECK(stored == expected);
}

}  // namespace halfspace::testing
