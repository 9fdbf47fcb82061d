// What-ifs on frames small enough to count by hand.
#include <catch2/catch.hpp>
#include <limits>

#include "../frames.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/whatif/depth_ahead.hpp"
#include "halfspace/whatif/sequence.hpp"
#include "halfspace/whatif/sort.hpp"
#include "halfspace/whatif/what_if.hpp"

namespace halfspace::testing {
namespace {

using whatif::WhatIf;

/// Two triangles that cover `size` x `size` pixels from the top left.
std::vector<glm::dvec3> square(double size, double depth) {
  return {{0, 0, depth},    {size, 0, depth},    {0, size, depth},
          {size, 0, depth}, {size, size, depth}, {0, size, depth}};
}

/// Squares over each other, the farthest first: each of 64 pixels is drawn and passes once for each.
FrameBuilder far_first(int layers) {
  FrameBuilder builder(8);
  for (int i = 0; i < layers; ++i) {
    builder.draw(square(8, 0.9 - 0.1 * i)).source_event = static_cast<std::uint32_t>(i);
  }
  return builder;
}

std::uint64_t shaded(const Frame& frame) {
  std::uint64_t sum = 0;
  for (const DrawStats& draw : run_functional(frame, {}).draws) {
    sum += frame.commands[draw.command].has(Flag::kColorWrite) ? draw.counters.early_z.survivors : 0;
  }
  return sum;
}

std::vector<std::uint32_t> events(const Frame& frame) {
  std::vector<std::uint32_t> all;
  for (const Command& command : frame.commands) {
    if (command.kind == CommandKind::kDraw) {
      all.push_back(command.source_event);
    }
  }
  return all;
}

using Events = std::vector<std::uint32_t>;

}  // namespace

TEST_CASE("what if: a prepass shades each pixel once, and covers it twice") {
  Frame frame = far_first(4).frame;
  CHECK(shaded(frame) == 4 * 64);
  const whatif::Acted acted = whatif::prepass(frame);
  CHECK(acted.draws == 4);
  CHECK(acted.ranges == 1);
  CHECK(shaded(frame) == 64);
  CHECK(run_functional(frame, {}).counters.quad_generator.fragments == 2 * 4 * 64);
}

TEST_CASE("what if: a prepass stays between clears, and leaves alone what only lays depth") {
  FrameBuilder builder = far_first(2);
  builder.clear(1);
  builder.draw(square(8, 0.5)).flags &= ~bits({Flag::kColorWrite});
  const std::size_t before = builder.frame.commands.size();
  const whatif::Acted acted = whatif::prepass(builder.frame);
  CHECK(acted.draws == 2);
  CHECK(acted.ranges == 1);
  CHECK(builder.frame.commands.size() == before + 2);
  CHECK(shaded(builder.frame) == 64);
}

TEST_CASE("what if: the longer the queue of a delay stream, the less is shaded") {
  // A layer is two triangles, and a batch one. What hides a triangle is the second one behind it.
  const auto with = [](std::uint64_t triangles) {
    Frame frame = far_first(4).frame;
    whatif::delay(frame, triangles);
    return shaded(frame);
  };
  CHECK(with(1) == 4 * 64);  // the triangle behind covers the other half
  CHECK(with(2) == 64);      // that of the next layer covers the same half
  CHECK(with(100) == 64);
}

TEST_CASE("what if: sorting goes by the farthest depth, is stable, and knows where near is") {
  FrameBuilder builder(8);
  const auto draw = [&](double depth, DepthFunc func) {
    Command& command = builder.draw(square(4, depth));
    command.depth_func = func;
    command.source_event = static_cast<std::uint32_t>(builder.frame.commands.size());
  };
  for (const double depth : {0.5, 0.25, 0.75, 0.25}) {  // events 2 to 5
    draw(depth, DepthFunc::kLess);
  }
  draw(0.5, DepthFunc::kAlways);                  // 6 ends the range
  for (const double depth : {0.5, 0.25, 0.75}) {  // 7 to 9
    draw(depth, DepthFunc::kGequal);
  }
  Frame frame = builder.frame;
  const whatif::Acted acted = whatif::sort(frame, whatif::SortOrder::kFrontToBack);
  CHECK(acted.ranges == 2);
  CHECK(acted.draws == 7);
  CHECK(events(frame) == Events{3, 5, 2, 4, 6, 9, 7, 8});
  frame = builder.frame;
  whatif::sort(frame, whatif::SortOrder::kBackToFront);
  CHECK(events(frame) == Events{4, 2, 3, 5, 6, 8, 7, 9});
}

TEST_CASE("what if: the depth to sort by is that of what near and far leave, in the window") {
  FrameBuilder builder(8);
  Command& draw = builder.draw({{0, 0, 0.5}, {8, 0, 2}, {0, 8, 2}});
  CHECK(whatif::farthest_depth(builder.frame, draw) == 1);  // cut by far
  draw.depth_range = {0.25, 0.75};
  CHECK(whatif::farthest_depth(builder.frame, draw) == 0.75);
  draw.depth_func = DepthFunc::kGreater;
  CHECK(whatif::farthest_depth(builder.frame, draw) == -0.5);
  draw.flags |= bits({Flag::kNdcZMinusOneToOne});
  CHECK(whatif::farthest_depth(builder.frame, draw) == -0.625);  // z = 0.5 of -1 to 1
  Command& behind = builder.draw({{0, 0, 2}, {8, 0, 2}, {0, 8, 2}});
  CHECK(whatif::farthest_depth(builder.frame, behind) == -std::numeric_limits<double>::infinity());
  behind.flags |= bits({Flag::kDepthClamp});
  CHECK(whatif::farthest_depth(builder.frame, behind) == 1);
}

TEST_CASE("what if: every second frame is walked backwards, triangle by triangle") {
  const Frame frame = far_first(3).frame;
  WhatIf wanted;
  wanted.alternate = true;
  const whatif::Sequence sequence = whatif::apply({frame, frame, frame}, wanted);
  CHECK(events(sequence.frame) == Events{0, 1, 2, 2, 1, 0, 0, 1, 2});
  CHECK(sequence.applied.size() == 1);
  CHECK(sequence.applied[0].acted.draws == 3);
  CHECK(shaded(sequence.frame) == (3 + 1 + 3) * 64);  // backwards, the nearest comes first
  const Frame& all = sequence.frame;
  const Command& last =
      all.commands[5];  // 0 to 3: clear and draws; 4: clear; 5: the nearest, walked backwards
  const auto corner = [&](std::uint32_t i) {
    return all.vertices[last.first_vertex + all.indices[last.first_index + i]];
  };
  const Command& third = frame.commands[3];
  for (std::uint32_t i = 0; i < 3; ++i) {
    CHECK(corner(i) == frame.vertices[third.first_vertex + frame.indices[third.first_index + 3 + i]]);
    CHECK(corner(3 + i) == frame.vertices[third.first_vertex + frame.indices[third.first_index + i]]);
  }
}

TEST_CASE("what if: a sequence is on the targets of its first frame") {
  const Frame frame = far_first(1).frame;
  FrameBuilder other(16);
  other.frame.name = "other";
  CHECK_THROWS_WITH(
      whatif::join({frame, other.frame}),
      "other: targets are 16x16 with depth format 2, surface 0; legal in a sequence: those of its first "
      "frame, 8x8 with depth format 2, surface 0");
}

TEST_CASE("what if: errors name the thing, its value and what is legal") {
  const Frame frame = far_first(1).frame;
  const auto refused = [&](const auto& ask) {
    WhatIf wanted;
    ask(wanted);
    try {
      static_cast<void>(whatif::apply({frame}, wanted));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK(refused([](WhatIf& w) { w.lod_pixels = 0; }) == "lod is 0 pixels; legal: a finite number above 0");
  CHECK(refused([](WhatIf& w) { w.delay = 0; }) == "delay is 0 triangles; legal: 1 to 268435456");
  CHECK(refused([](WhatIf& w) { w.delay = ~std::uint64_t{0}; }) ==
        "delay is 18446744073709551615 triangles; legal: 1 to 268435456");
  CHECK(refused([](WhatIf& w) {
          w.prepass = true;
          w.delay = 5;
        }) == "prepass is given with delay 5; legal: one of them, for a prepass is the longest delay");
  CHECK(refused([](WhatIf& w) {
          w.order = whatif::SortOrder::kBackToFront;
          w.alternate = true;
        }) == "sort is 'back-to-front' with order 'alternate'; legal: one of them, for both order the draws");
  CHECK(refused([](WhatIf& w) { w.alternate = true; }) ==
        "order is 'alternate' with 1 frame; legal: with two or more, one after the other");
}

}  // namespace halfspace::testing
