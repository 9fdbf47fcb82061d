// A frame that the reader accepts runs to its end, whatever its bytes say.
#include <catch2/catch.hpp>
#include <limits>

#include "halfspace/core/functional.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/byte_source.hpp"
#include "halfspace/scene/ptf.hpp"

using namespace halfspace;

TEST_CASE("a scissor may lie anywhere and have any size") {
  constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  for (const std::int32_t at : {kLeast, -1, 0, kMost}) {
    for (const std::int32_t extent : {0, 1, kMost}) {
      Frame frame = read_ptf(HALFSPACE_SCENES "/vkcube.ptf.xz");
      for (Command& command : frame.commands) {
        command.scissor = {at, at, extent, extent};
      }
      const FrameResult result = run_functional(frame, {});
      const std::uint64_t fragments = result.counters.quad_generator.fragments;
      CHECK(fragments == (at <= 0 && extent == kMost && at != kLeast ? 74783 : 0));
    }
  }
}

namespace {

/// Changes every `step`-th byte of a frame: it is refused, or it runs and every fragment is accounted for.
void change_bytes(std::size_t step) {
  std::vector<std::byte> bytes = read_bytes(HALFSPACE_SCENES "/vkcube.ptf.xz");
  std::size_t refused = 0;
  std::size_t ran = 0;
  for (std::size_t i = 0; i < bytes.size(); i += step) {
    for (const unsigned change : {0x01u, 0x80u, 0xFFu}) {
      const std::byte before = bytes[i];
      bytes[i] ^= static_cast<std::byte>(change);
      CAPTURE(i, change);
      try {
        const Frame frame = parse_ptf(bytes, "changed");
        const Counters c = run_functional(frame, {}).counters;
        ++ran;
        REQUIRE(c.front_end.triangles >=
                c.front_end.non_finite + c.front_end.clipped_away + c.front_end.degenerate);
        REQUIRE(c.setup.triangles == c.front_end.emitted);
        REQUIRE(c.setup.triangles ==
                c.setup.zero_area + c.setup.culled + c.setup.no_sample + c.setup.outside + c.setup.drawn);
        REQUIRE(c.quad_generator.fragments == c.early_z.tested + c.early_z.untested);
      } catch (const InputError& error) {
        ++refused;
        REQUIRE(std::string(error.what()).rfind("changed", 0) == 0);
      }
      bytes[i] = before;
    }
  }
  CHECK(refused > 100 / step);
  CHECK(ran > 1000 / step);
}

}  // namespace

TEST_CASE("any byte of a frame may change", "[exhaustive]") { change_bytes(1); }

TEST_CASE("every 47th byte of a frame may change") { change_bytes(47); }
