// Does each rule of a frame name the frame, the place, the value and what is legal?
#include "halfspace/scene/validate.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>

#include "../scene/fixture.hpp"

using namespace halfspace;
using namespace halfspace::test;

namespace {

struct FrameRule {
  std::function<void(Frame&)> change;
  std::string error;
};

Target& target(Frame& frame) { return frame.targets[0]; }
Command& clear(Frame& frame) { return frame.commands[0]; }
Command& draw(Frame& frame) { return frame.commands[1]; }

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

const std::string kTarget0 = "small: target 0: ";
const std::string kClear = "small: command 0 (clear): ";
const std::string kDraw = "small: command 1 (draw): ";

const FrameRule kFrameRules[] = {
    // Targets.
    {[](Frame& f) { target(f).width = 0; }, kTarget0 + "width is 0; legal: 1 to 16384"},
    {[](Frame& f) { target(f).width = 16385; }, kTarget0 + "width is 16385; legal: 1 to 16384"},
    {[](Frame& f) { target(f).height = 0xFFFFFFFF; }, kTarget0 + "height is 4294967295; legal: 1 to 16384"},
    {[](Frame& f) { target(f).samples = 4; },
     kTarget0 + "samples is 4; legal: 1 (multisampling is not modelled)"},
    {[](Frame& f) { target(f).samples = 0; },
     kTarget0 + "samples is 0; legal: 1 (multisampling is not modelled)"},
    {[](Frame& f) { target(f).depth_format = DepthFormat::kUnorm32; },
     kTarget0 + "depth_format is 3 (unorm32); legal: 1 (unorm16), 2 (unorm24), 4 (float32), or 0 (none)"},
    {[](Frame& f) { target(f).depth_format = DepthFormat{5}; },
     kTarget0 + "depth_format is 5; legal: 1 (unorm16), 2 (unorm24), 4 (float32), or 0 (none)"},
    {[](Frame& f) { target(f).depth_surface = kNoSurface; },
     kTarget0 + "depth_surface is 4294967295; legal: 0 to 1023 with a depth format"},
    {[](Frame& f) { target(f).depth_surface = 1024; },
     kTarget0 + "depth_surface is 1024; legal: 0 to 1023 with a depth format"},
    {[](Frame& f) { f.targets[1].depth_surface = 0; },
     "small: target 1: depth_surface is 0 without a depth format; legal: 4294967295 (none)"},
    {[](Frame& f) {
       f.targets[1] = f.targets[0];
       f.targets[1].depth_format = DepthFormat::kUnorm16;
     },
     "small: target 1: depth_format is 1 on depth surface 0; legal: 2, as in target 0"},
    {[](Frame& f) {
       f.targets[1] = f.targets[0];
       f.targets[1].width = 9;
     },
     "small: target 1: size is 9x6 on depth surface 0; legal: 8x6, as in target 0"},
    {[](Frame& f) {
       target(f).width = target(f).height = 16384;
       f.targets[1].depth_format = DepthFormat::kUnorm24;
       f.targets[1].depth_surface = 1;
     },
     "small: target 1: depth surfaces up to here have 268435472 pixels; legal: at most 268435456 in all"},
    // Commands of both kinds.
    {[](Frame& f) { draw(f).kind = CommandKind{3}; },
     "small: command 1: kind is 3; legal: 1 (draw) or 2 (clear)"},
    {[](Frame& f) { draw(f).target = 2; }, kDraw + "target is 2; legal: 0 to 1"},
    {[](Frame& f) { clear(f).target = 0xFFFFFFFF; }, kClear + "target is 4294967295; legal: 0 to 1"},
    {[](Frame& f) { f.targets.clear(); }, kClear + "target is 0; legal: none, the frame has no target"},
    {[](Frame& f) { draw(f).viewport.x = kNan; }, kDraw + "viewport.x is nan; legal: a finite number"},
    {[](Frame& f) { draw(f).viewport.y = -kInf; }, kDraw + "viewport.y is -inf; legal: a finite number"},
    {[](Frame& f) { draw(f).viewport.z = kInf; }, kDraw + "viewport.width is inf; legal: a finite number"},
    {[](Frame& f) { clear(f).viewport.w = kNan; }, kClear + "viewport.height is nan; legal: a finite number"},
    {[](Frame& f) { draw(f).depth_range.x = -0.5f; },
     kDraw + "depth_range.near is -0.5; legal on a unorm surface: 0 to 1"},
    {[](Frame& f) { draw(f).depth_range.y = 1.5f; },
     kDraw + "depth_range.far is 1.5; legal on a unorm surface: 0 to 1"},
    {[](Frame& f) { draw(f).depth_range.y = kNan; },
     kDraw + "depth_range.far is nan; legal on a unorm surface: 0 to 1"},
    {[](Frame& f) {
       target(f).depth_format = DepthFormat::kFloat32;
       draw(f).depth_range.y = kInf;
     },
     kDraw + "depth_range.far is inf; legal: a finite number"},
    {[](Frame& f) { draw(f).clear_depth = kInf; }, kDraw + "clear_depth is inf; legal: a finite number"},
    {[](Frame& f) { clear(f).clear_depth = kNan; }, kClear + "clear_depth is nan; legal: a finite number"},
    {[](Frame& f) { draw(f).offset_factor = kNan; }, kDraw + "offset_factor is nan; legal: a finite number"},
    {[](Frame& f) { draw(f).offset_units = kInf; }, kDraw + "offset_units is inf; legal: a finite number"},
    {[](Frame& f) { draw(f).offset_clamp = kNan; }, kDraw + "offset_clamp is nan; legal: a finite number"},
    {[](Frame& f) { draw(f).scissor.width = -1; }, kDraw + "scissor.width is -1; legal: 0 to 2147483647"},
    {[](Frame& f) { clear(f).scissor.height = -5; }, kClear + "scissor.height is -5; legal: 0 to 2147483647"},
    // Draws.
    {[](Frame& f) {
       f.targets[1].width = f.targets[1].height = 16384;
       f.targets.push_back(f.targets[1]);
       draw(f).target = 1;
       f.commands.push_back(draw(f));
       f.commands.back().target = 2;
     },
     "small: command 2 (draw): targets without depth that are drawn to up to here have 536870912 pixels; "
     "legal: "
     "at most 268435456 in all"},
    {[](Frame& f) { draw(f).depth_func = DepthFunc{8}; }, kDraw + "depth_func is 8; legal: 0 to 7"},
    {[](Frame& f) { draw(f).flags = 2; },
     kDraw + "flags are 0x2, depth_write without depth_test; legal: depth_write only with depth_test"},
    {[](Frame& f) { draw(f).index_count = 5; }, kDraw + "index_count is 5; legal: a multiple of 3"},
    {[](Frame& f) {
       draw(f).primitive = Primitive::kLineStrip;
       draw(f).index_count = 5;
     },
     kDraw + "index_count is 5; legal: a multiple of 2"},
    {[](Frame& f) { draw(f).primitive = Primitive{4}; }, kDraw + "primitive is 4; legal: 0 to 3"},
    {[](Frame& f) { draw(f).polygon_mode = PolygonMode{3}; }, kDraw + "polygon_mode is 3; legal: 0 to 2"},
    {[](Frame& f) { draw(f).line_rule = LineRule{5}; }, kDraw + "line_rule is 5; legal: 0 to 4"},
    {[](Frame& f) { draw(f).line_width = 0; }, kDraw + "line_width is 0; legal: above 0, at most 64"},
    {[](Frame& f) { draw(f).line_width = 64.5F; }, kDraw + "line_width is 64.5; legal: above 0, at most 64"},
    {[](Frame& f) { draw(f).point_size = kNan; }, kDraw + "point_size is nan; legal: above 0, at most 2048"},
    {[](Frame& f) { draw(f).stipple.factor = 0; }, kDraw + "stipple factor is 0; legal: 1 to 256"},
    {[](Frame& f) { draw(f).stipple.factor = 257; }, kDraw + "stipple factor is 257; legal: 1 to 256"},
    {[](Frame& f) { draw(f).first_index = 1; },
     kDraw + "first_index + index_count is 1 + 6 = 7; legal: at most 6"},
    {[](Frame& f) { draw(f).first_index = 0xFFFFFFFF; },
     kDraw + "first_index + index_count is 4294967295 + 6 = 4294967301; legal: at most 6"},
    {[](Frame& f) { draw(f).vertex_count = 5; },
     kDraw + "first_vertex + vertex_count is 1 + 5 = 6; legal: at most 5"},
    {[](Frame& f) { draw(f).first_vertex = 0xFFFFFFFF; },
     kDraw + "first_vertex + vertex_count is 4294967295 + 4 = 4294967299; legal: at most 5"},
    {[](Frame& f) { f.indices[4] = 4; }, kDraw + "index 4 is 4; legal: 0 to 3"},
    {[](Frame& f) { f.indices[2] = 0xFFFFFFFF; }, kDraw + "index 2 is 4294967295; legal: 0 to 3"},
    {[](Frame& f) { draw(f).vertex_count = 0; }, kDraw + "index 0 is 0; legal: none, vertex_count is 0"},
};

}  // namespace

TEST_CASE("each rule of a frame names the place, the value and what is legal") {
  CHECK_NOTHROW(validate(small_frame()));
  for (const FrameRule& rule : kFrameRules) {
    Frame frame = small_frame();
    rule.change(frame);
    CHECK(error_of([&] {
            validate(frame);
            return 0;
          }) == rule.error);
  }
}

TEST_CASE("what looks odd but is legal") {
  Frame frame = small_frame();
  SECTION("positions that are not finite") { frame.vertices[2] = {kNan, kInf, -kInf, 0}; }
  SECTION("an empty draw, even past the end of nothing") {
    draw(frame).index_count = 0;
    draw(frame).first_index = 6;
    draw(frame).vertex_count = 0;
    draw(frame).first_vertex = 5;
  }
  SECTION("a reversed depth range, a negative viewport, an empty scissor") {
    draw(frame).depth_range = {1, 0};
    draw(frame).viewport = {0, 0, -8, 0};
    draw(frame).scissor = {-100, 100, 0, 0};
  }
  SECTION("any number of large targets without depth that nothing is drawn to, and one that is") {
    frame.targets[1].width = frame.targets[1].height = 16384;
    frame.targets.resize(100, frame.targets[1]);
    draw(frame).target = 1;
    frame.commands.push_back(draw(frame));
  }
  SECTION("a clear of a unorm surface beyond 1, which is clamped") { clear(frame).clear_depth = 2; }
  SECTION("depth of any size on a float32 surface") {
    target(frame).depth_format = DepthFormat::kFloat32;
    clear(frame).clear_depth = -1e30f;
    draw(frame).depth_range = {-65536, 65536};
  }
  SECTION("a depth range of any size without depth") {
    draw(frame).target = 1;
    draw(frame).depth_range = {-65536, 65536};
  }
  SECTION("a clear that leaves depth alone may say anything about it") {
    clear(frame).flags = static_cast<std::uint32_t>(Flag::kClearColor);
    clear(frame).clear_depth = 7;
  }
  SECTION("targets that share a surface, the largest surface, a surface number with gaps") {
    frame.targets[1] = frame.targets[0];
    frame.targets.push_back(frame.targets[0]);
    frame.targets[2].depth_surface = kMaxDepthSurface;
  }
  CHECK_NOTHROW(validate(frame));
}

TEST_CASE("the triangles of all draws together are limited", "[exhaustive]") {
  Frame frame;
  frame.name = "many";
  frame.targets = {{.width = 1, .height = 1, .samples = 1}};
  frame.vertices.resize(1);
  frame.indices.resize(3 << 20);
  Command all;
  all.index_count = 3 << 20;
  all.vertex_count = 1;
  frame.commands.assign(256, all);
  CHECK_NOTHROW(validate(frame));
  frame.commands.push_back(all);
  CHECK(error_of([&] {
          validate(frame);
          return 0;
        }) ==
        "many: command 256 (draw): triangles up to here are 269484032; legal: at most 268435456 in a frame");
}
