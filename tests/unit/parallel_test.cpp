// Work that threads share.
#include <catch2/catch.hpp>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "halfspace/numerics/parallel.hpp"

namespace halfspace::testing {

TEST_CASE("parallel_for: every piece is done once, whatever the number of threads") {
  for (const int threads : {1, 2, 3, 8}) {
    for (const std::size_t count : {0, 1, 2, 7, 1000}) {
      CAPTURE(threads, count);
      std::vector<int> done(count);
      parallel_for(count, threads, [&](std::size_t i) { ++done[i]; });
      CHECK(done == std::vector<int>(count, 1));
    }
  }
}

TEST_CASE("parallel_for: of all that is thrown the caller gets what a loop would throw") {
  for (const int threads : {1, 2, 3, 8}) {
    for (int run = 0; run < 200; ++run) {
      CAPTURE(threads, run);
      std::vector<int> done(100);
      const auto work = [&](std::size_t i) {
        ++done[i];
        if (i % 7 == 6) {
          throw std::runtime_error(std::to_string(i));
        }
      };
      REQUIRE_THROWS_WITH(parallel_for(done.size(), threads, work), "6");
      REQUIRE(std::accumulate(done.begin(), done.begin() + 7, 0) == 7);
    }
  }
}

}  // namespace halfspace::testing
