// Slots of triangles behind hi_z.
#include "halfspace/units/hi_z.hpp"

#include <catch2/catch.hpp>

using namespace halfspace;

namespace {

/// Decides blocks of triangles that came with these slots; the draw's function says what becomes of them.
class Blocks {
 public:
  HiZ::Verdict decide(std::uint8_t slot, DepthFunc func) {
    const EarlyZState state{.test = true, .func = func, .format = DepthFormat::kUnorm24};
    const HiZ::Verdict verdict =
        hi_z_.decide({.slot = slot, .tiles = 1}, {}, state, {.first_block = 0, .blocks_x = 1, .blocks = 1});
    CHECK((verdict.rejected != 0) == (func == DepthFunc::kNever));
    if (verdict.rejected == 0) {
      hi_z_.retire({});
    }
    return verdict;
  }

 private:
  HiZ hi_z_{{.enabled = true}, 1};
};

constexpr DepthFunc kLeaves = DepthFunc::kAlways;
constexpr DepthFunc kRejected = DepthFunc::kNever;

}  // namespace

TEST_CASE("hi_z: a triangle has a slot from its first block that leaves") {
  Blocks blocks;
  blocks.decide(7, kRejected);
  HiZ::Verdict verdict = blocks.decide(7, kLeaves);
  CHECK(verdict.first);
  CHECK(verdict.slot == 0);
  CHECK_FALSE(blocks.decide(7, kRejected).first);
  verdict = blocks.decide(7, kLeaves);
  CHECK_FALSE(verdict.first);
  CHECK(verdict.slot == 0);
  verdict = blocks.decide(8, kLeaves);
  CHECK(verdict.first);
  CHECK(verdict.slot == 1);
}

TEST_CASE("hi_z: triangles of which nothing is left hold no slot, however many") {
  Blocks blocks;
  CHECK(blocks.decide(3, kLeaves).slot == 0);
  for (int passed = 1; passed < 256; ++passed) {
    CHECK_FALSE(blocks.decide(static_cast<std::uint8_t>(3 + passed), kRejected).first);
  }
  // Slot 3 came round again: another triangle.
  const HiZ::Verdict verdict = blocks.decide(3, kLeaves);
  CHECK(verdict.first);
  CHECK(verdict.slot == 1);
}
