// Occupancies that are summed up without a look at the order of events, against the events in their order.
#include <catch2/catch.hpp>
#include <cstdint>
#include <utility>
#include <vector>

#include "all_vectors.hpp"
#include "halfspace/timing/link_meter.hpp"
#include "random_machine.hpp"
#include "scalar_probe.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

struct HeldCredit {
  std::uint64_t take;
  std::uint64_t back;
};

/// Packets of a link with so many credits. Many are returned in the cycle in which another is taken, some in
/// that in which they were taken themselves.
std::vector<HeldCredit> random_packets(Random& random, std::size_t capacity, std::size_t count) {
  std::vector<HeldCredit> packets;
  const std::int64_t most_gap = pick(random, {0, 1, 3, 30});
  const std::int64_t most_held = pick(random, {0, 1, 5, 100, 3000});
  const std::int64_t pauses = pick(random, {2, 100, 100000});  // one packet in so many comes late
  for (std::size_t n = 0; n < count; ++n) {
    const auto cycles = [&](std::int64_t most) {
      return static_cast<std::uint64_t>(random.between(0, most)) +
             (random.between(1, pauses) == 1
                  ? static_cast<std::uint64_t>(random.between(0, pick(random, {300, 70000, 1 << 30})))
                  : 0);
    };
    std::uint64_t take = (n > 0 ? packets.back().take : 0) + cycles(most_gap);
    take = n >= capacity ? std::max(take, packets[n - capacity].back) : take;
    const std::uint64_t back = std::max(n > 0 ? packets.back().back : 0, take + cycles(most_held));
    packets.push_back({.take = take, .back = back});
  }
  return packets;
}

}  // namespace

TEST_CASE("a link's meter says what the events say", "[timing]") {
  Random random(seed());
  for (int run = 0; run < 300; ++run) {
    const int capacity = pick(random, {1, 2, 3, 8, 40, 63, 64});
    const auto most = static_cast<std::int64_t>(pick(random, {2u, 255u, 257u, 3000u}));
    const std::vector<HeldCredit> packets = random_packets(random, static_cast<std::size_t>(capacity),
                                                           static_cast<std::size_t>(random.between(0, most)));
    const std::uint64_t end =
        (packets.empty() ? 0 : packets.back().back) + static_cast<std::uint64_t>(random.between(0, 100000));
    const std::int64_t asks = pick(random, {1, 10, 1000});  // after one packet in so many
    std::vector<bool> asked;
    for (std::size_t n = 0; n < packets.size(); ++n) {
      asked.push_back(random.between(1, asks) == 1);
    }
    CAPTURE(seed(), run, capacity, packets.size(), end);
    with_all_vectors([&] {
      EventMeter events(capacity);
      LinkMeter meter(capacity);
      std::uint64_t held = 0;
      std::uint64_t n = 0;
      for (const HeldCredit& packet : packets) {
        events.add(packet.take, packet.back);
        held += packet.back - packet.take;
        meter.add(n++, packet.take, packet.back);
        if (asked[n - 1]) {
          REQUIRE(meter.held(n) == std::exchange(held, 0));
        }
      }
      REQUIRE(meter.held(n) == held);
      REQUIRE(meter.finish(n, end) == events.finish(end));
    });
  }
}
