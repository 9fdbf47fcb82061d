// A queue between two threads.
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>
#include <vector>

#include "halfspace/numerics/ring.hpp"

namespace halfspace::testing {

TEST_CASE("ring: items arrive in order, whichever side is the slower one") {
  constexpr int kCount = 1000;
  for (const auto& [fills, takes] : std::vector<std::pair<int, int>>{{0, 0}, {0, 20}, {20, 0}, {20, 20}}) {
    CAPTURE(fills, takes);
    Ring<int, 8> ring;
    std::vector<int> taken;
    {
      const std::jthread reader([&ring, &taken, wait = takes] {
        for (int i = 0; i < kCount; ++i) {
          taken.push_back(ring.filled());
          ring.take();
          std::this_thread::sleep_for(std::chrono::microseconds(wait));
        }
      });
      for (int i = 0; i < kCount; ++i) {
        ring.free() = i;
        ring.fill(i + 1 == kCount);
        std::this_thread::sleep_for(std::chrono::microseconds(fills));
      }
    }
    std::vector<int> all(kCount);
    for (int i = 0; i < kCount; ++i) {
      all[static_cast<std::size_t>(i)] = i;
    }
    CHECK(taken == all);
  }
}

}  // namespace halfspace::testing
