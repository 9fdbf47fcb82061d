// Quad merging on meshes of a few triangles, counted by hand.
#include "halfspace/whatif/quad_merging.hpp"

#include <catch2/catch.hpp>

#include "../frames.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/numerics/error.hpp"

namespace halfspace::testing {
namespace {

using Window = std::vector<glm::dvec3>;

/// Groups of a frame by a buffer of so many quads, and the counters.
struct Merged {
  std::vector<QuadGroup> groups;
  QuadMergingResult result;
};

Merged merge(const Frame& frame, int buffer) {
  Merged merged;
  QuadMerging merging(frame, buffer, [&](const QuadGroup& group) { merged.groups.push_back(group); });
  run_functional(frame, {}, {.observer = &merging});
  merged.result = merging.finish();
  return merged;
}

QuadMergingCounters counts(const Frame& frame, int buffer = 32) { return merge(frame, buffer).result.frame; }

Frame frame_of(const Window& window) {
  FrameBuilder builder(64);
  builder.draw(window);
  return builder.frame;
}

Window operator+(Window a, const Window& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Window moved(Window window, double x, double y, double z = 0) {
  for (glm::dvec3& v : window) {
    v += glm::dvec3(x, y, z);
  }
  return window;
}

/// The two halves of the quad at (0, 0). Two samples lie on the diagonal: it is a left edge of the lower
/// half, which has them.
const Window kUpper{{0, 0, .5}, {2, 0, .5}, {0, 2, .5}};
const Window kLower{{2, 0, .5}, {2, 2, .5}, {0, 2, .5}};
const Window kLowerTurned{{2, 0, .5}, {0, 2, .5}, {2, 2, .5}};

/// Four triangles clockwise around the middle of the quad at (4, 4), one sample each and none of others.
Window fan(int i) {
  const Window corner{{5, 3.75, .5}, {6.25, 5, .5}, {5, 6.25, .5}, {3.75, 5, .5}};
  return {corner[static_cast<std::size_t>(i)], corner[static_cast<std::size_t>(i + 1) % 4], {5, 5, .5}};
}

}  // namespace

TEST_CASE("quad merging: two halves of a quad are shaded as one") {
  const Merged merged = merge(frame_of(kUpper + kLower), 32);
  const QuadMergingCounters& c = merged.result.frame;
  CHECK(c.quads == 2);
  CHECK(c.survivors == 4);
  CHECK(c.joined == 1);
  CHECK(c.pairs == 1);
  CHECK(c.alone == 1);
  CHECK(c.evictions == 0);
  CHECK(quads_shaded(c) == 1);
  CHECK(fragments_unmerged(c) == 8);
  CHECK(fragments_shaded(c) == 4);
  REQUIRE(merged.groups.size() == 1);
  CHECK(merged.groups[0].mask == 15);
  CHECK(merged.groups[0].size == 2);
  CHECK(merged.groups[0].triangles == std::array<std::uint32_t, 4>{0, 1, 0, 0});
}

TEST_CASE("quad merging: quads of triangles that face different ways stay apart") {
  const QuadMergingCounters c = counts(frame_of(kUpper + kLowerTurned));
  CHECK(c.quads == 2);
  CHECK(c.joined == 0);
  CHECK(c.other_facing == 1);
  CHECK(c.alone == 1);
}

TEST_CASE("quad merging: quads that share a sample stay apart") {
  FrameBuilder builder(64);
  builder.draw(kUpper + kUpper).depth_func = DepthFunc::kAlways;
  const QuadMergingCounters c = counts(builder.frame);
  CHECK(c.quads == 2);
  CHECK(c.joined == 0);
  CHECK(c.overlap == 1);
}

TEST_CASE("quad merging: what early-Z leaves of a quad counts") {
  FrameBuilder builder(64);
  SECTION("a quad without a survivor is gone") {
    builder.draw(kUpper + kUpper);  // LESS: the second fails everywhere
    CHECK(counts(builder.frame).quads == 1);
  }
  SECTION("a whole quad of which samples survive may merge") {
    builder.draw(moved(kUpper, 0, 0, -.25));
    // The upper sample is taken, so that of this whole quad the lower half's samples survive.
    builder.draw({{-1, -1, .5}, {5, -1, .5}, {-1, 5, .5}}).scissor = {0, 0, 2, 2};
    const Merged merged = merge(builder.frame, 32);
    REQUIRE(merged.groups.size() == 2);
    CHECK(merged.groups[1].draw == 1);
    CHECK(merged.groups[1].mask == 14);
    CHECK(merged.result.draws[1].whole == 0);
  }
}

TEST_CASE("quad merging: quads of different draws stay apart") {
  FrameBuilder builder(64);
  builder.draw(kUpper);
  builder.draw(kLower);
  const Merged merged = merge(builder.frame, 32);
  REQUIRE(merged.result.draws.size() == 2);
  for (const QuadMergingCounters& c : merged.result.draws) {
    CHECK(c.quads == 1);
    CHECK(c.alone == 1);
  }
  CHECK(merged.result.frame.joined == 0);
}

TEST_CASE("quad merging: triangles that share a vertex are no neighbours") {
  const Window small{{0, 0, .5}, {1.5, 0, .5}, {0, 1.5, .5}};       // the sample at (0.5, 0.5)
  const Window other{{1.5, 0, .5}, {2.5, 0, .5}, {1.5, 1.25, .5}};  // the sample to its right
  const QuadMergingCounters c = counts(frame_of(small + other));
  CHECK(c.quads == 2);
  CHECK(c.survivors == 2);
  CHECK(c.joined == 0);
  CHECK(c.not_adjacent == 1);
}

TEST_CASE("quad merging: four triangles with a sample each become one quad, a fourth of the shading") {
  const QuadMergingCounters c = counts(frame_of(fan(0) + fan(1) + fan(2) + fan(3)));
  CHECK(c.quads == 4);
  CHECK(c.survivors == 4);
  CHECK(c.joined == 3);
  CHECK(c.quadruples == 1);
  CHECK(c.pairs + c.triples == 0);
  CHECK(fragments_unmerged(c) == 16);
  CHECK(fragments_shaded(c) == 4);
}

TEST_CASE("quad merging: a group takes the neighbours of any of its triangles, the oldest group first") {
  // 2 is opposite of 0; 1 and 3 are neighbours of both.
  const Merged merged = merge(frame_of(fan(0) + fan(2) + fan(1) + fan(3)), 32);
  const QuadMergingCounters& c = merged.result.frame;
  CHECK(c.not_adjacent == 1);
  CHECK(c.joined == 2);
  CHECK(c.triples == 1);
  CHECK(quads_shaded(c) == 2);
  REQUIRE(merged.groups.size() == 2);
  CHECK(merged.groups[0].triangles == std::array<std::uint32_t, 4>{0, 2, 3, 0});
  CHECK(merged.groups[1].triangles == std::array<std::uint32_t, 4>{1, 0, 0, 0});
}

TEST_CASE("quad merging: the oldest group leaves when the buffer is full") {
  // A quad of another place comes between the halves.
  const Frame frame = frame_of(kUpper + moved(kUpper, 8, 0) + kLower);
  const QuadMergingCounters two = counts(frame, 2);
  CHECK(two.joined == 1);
  CHECK(two.evictions == 0);
  CHECK(quads_shaded(two) == 2);
  const Merged one = merge(frame, 1);
  CHECK(one.result.frame.joined == 0);
  CHECK(one.result.frame.missed == 1);
  CHECK(one.result.frame.evictions == 2);
  REQUIRE(one.groups.size() == 3);
  CHECK(one.groups[0].triangles[0] == 0);
  CHECK(one.groups[1].triangles[0] == 1);
  CHECK(one.groups[2].triangles[0] == 2);
}

TEST_CASE("quad merging: a buffer of no quads merges nothing") {
  const QuadMergingCounters c = counts(frame_of(kUpper + kLower + fan(0) + fan(1)), 0);
  CHECK(c.quads == 4);
  CHECK(c.joined == 0);
  CHECK(c.evictions == 4);
  CHECK(c.missed == 2);
  CHECK(c.alone == 2);
}

TEST_CASE("quad merging: where a draw shares vertices by index, they tell what is an edge") {
  FrameBuilder builder(64);
  Command& draw = builder.draw({{0, 0, .5}, {2, 0, .5}, {0, 2, .5}, {2, 2, .5}, {2, 0, .5}, {0, 2, .5}});
  const auto with_indices = [&](std::vector<std::uint32_t> indices) {
    builder.frame.indices = std::move(indices);
    draw.index_count = static_cast<std::uint32_t>(builder.frame.indices.size());
    return counts(builder.frame);
  };
  CHECK(with_indices({0, 1, 2, 1, 3, 2}).joined == 1);
  // The lower half has vertices of its own on the diagonal, as where a surface has a crease. The third
  // triangle has no area.
  const QuadMergingCounters crease = with_indices({0, 1, 2, 4, 3, 5, 0, 0, 0});
  CHECK(crease.joined == 0);
  CHECK(crease.not_adjacent == 1);
  // Without the third no index tells, and positions do.
  CHECK(with_indices({0, 1, 2, 4, 3, 5}).joined == 1);
}

TEST_CASE("quad merging: positions are equal where their numbers are, 0 of either sign") {
  Frame frame = frame_of(moved(kUpper, 32, 32) + moved(kLower, 32, 32));  // (32, 32) is 0, 0 in clip space
  REQUIRE(frame.vertices[2].x == 0);
  REQUIRE(frame.vertices[5].x == 0);
  frame.vertices[5].x = -0.0F;
  CHECK(counts(frame).joined == 1);
}

TEST_CASE("quad merging: pieces of a triangle that was clipped belong together") {
  // The corner where x + y < 20 is nearer than the near plane. Two triangles remain, and the border between
  // them runs through quads.
  FrameBuilder builder(64);
  builder.draw({{0, 0, -.5}, {40, 0, .5}, {0, 40, .5}});
  const FrameResult result = run_functional(builder.frame, {});
  REQUIRE(result.counters.setup.drawn == 2);
  const Merged merged = merge(builder.frame, 32);
  CHECK(merged.result.frame.joined > 0);
  CHECK(merged.result.frame.joined == merged.result.frame.pairs);
  CHECK(merged.result.frame.not_adjacent == 0);
}

TEST_CASE("quad merging: a draw that runs no shader has nothing to merge") {
  FrameBuilder builder(64);
  Command& draw = builder.draw(kUpper + kLower);
  draw.flags &= ~bits({Flag::kColorWrite});
  CHECK(counts(builder.frame).quads == 0);
  for (const Flag flag :
       {Flag::kShaderDiscards, Flag::kShaderWritesDepth, Flag::kShaderSideEffects, Flag::kAlphaToCoverage}) {
    const std::uint32_t before = draw.flags;
    draw.flags |= bits({flag});
    CHECK(counts(builder.frame).quads == 2);
    draw.flags = before;
  }
}

TEST_CASE("quad merging: the buffer holds a number of quads that is legal") {
  const Frame frame = frame_of(kUpper);
  CHECK_NOTHROW(QuadMerging(frame, kMostMergeQuads));
  for (const int buffer : {-1, kMostMergeQuads + 1}) {
    CHECK_THROWS_AS(QuadMerging(frame, buffer), InputError);
    CHECK_THROWS_WITH(QuadMerging(frame, buffer),
                      Catch::Contains(std::to_string(buffer)) && Catch::Contains("legal: 0 to 1048576"));
  }
}

}  // namespace halfspace::testing
