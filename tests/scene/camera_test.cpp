// Does the camera see the mesh: all of it by default, and from where it is told to?
#include "halfspace/scene/camera.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtx/component_wise.hpp>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>

#include "fixture.hpp"
#include "halfspace/scene/validate.hpp"

using namespace halfspace;
using namespace halfspace::test;

namespace {

Mesh box(glm::dvec3 center, glm::dvec3 half) {
  Mesh mesh;
  for (const glm::dvec3& corner : kCubeCorners) mesh.positions.push_back(center + half * corner);
  mesh.indices = cube_indices();
  mesh.parts = {{"lower", 0, 18}, {"upper", 18, 18}};
  return mesh;
}

}  // namespace

TEST_CASE("by default the whole mesh is in the clip volume and fills the screen one way") {
  const glm::dvec3 center = GENERATE(glm::dvec3(0), glm::dvec3(1000, -2000, 500));
  const glm::dvec3 half = GENERATE(glm::dvec3(1), glm::dvec3(100, 1, 1), glm::dvec3(1, 100, 1),
                                   glm::dvec3(1, 0, 50), glm::dvec3(0.1f, 0.1f, 30));
  Camera camera;
  camera.fov_degrees = GENERATE(10.0, 60.0, 120.0);
  std::tie(camera.width, camera.height) = GENERATE(std::pair(1920u, 1080u), std::pair(300u, 900u));
  const Frame frame = frame_from_mesh(box(center, half), camera, "box");
  float reach = 0;
  for (const glm::vec4& v : frame.vertices) {
    REQUIRE(v.w > 0);
    CHECK(std::abs(v.z) <= v.w);
    reach = std::max({reach, std::abs(v.x / v.w), std::abs(v.y / v.w)});
  }
  CHECK(reach > 0.87f);
  CHECK(reach < 0.91f);
}

TEST_CASE("meshes of any scale are framed") {
  const double scale = GENERATE(1e-30, 1e-6, 1e6, 1e30);
  const Frame frame = frame_from_mesh(box(glm::dvec3(0), glm::dvec3(scale)), {}, "box");
  for (const glm::vec4& v : frame.vertices) {
    CHECK(v.w > 0);
    CHECK(std::abs(v.x) <= v.w);
    CHECK(std::abs(v.y) <= v.w);
    CHECK(std::abs(v.z) <= v.w);
  }
}

TEST_CASE("the default view is from above, and up is up") {
  const Frame frame = frame_from_mesh(box(glm::dvec3(0), glm::dvec3(1)), {}, "box");
  // The first face is the back one, z = -1: its first two corners are (-1, -1) and (-1, 1).
  const glm::vec4 low = frame.vertices[0];
  const glm::vec4 high = frame.vertices[1];
  CHECK(high.y / high.w > low.y / low.w);
  CHECK(high.w < low.w);  // the top is nearer to an eye above
  // y up in clip space is up on the screen: the viewport's height is negative.
  CHECK(frame.commands[1].viewport == glm::vec4(0, 1080, 1920, -1080));
}

TEST_CASE("the frame is a clear and one draw for each part") {
  const Mesh mesh = box(glm::dvec3(0), glm::dvec3(1));
  const Frame frame = frame_from_mesh(mesh, {}, "box");
  CHECK_NOTHROW(validate(frame));
  CHECK(frame.name == "box");
  REQUIRE(frame.targets.size() == 1);
  CHECK(frame.targets[0].width == 1920);
  CHECK(frame.targets[0].depth_format == DepthFormat::kUnorm24);
  CHECK(frame.targets[0].presented);
  REQUIRE(frame.commands.size() == 3);
  const Command& clear = frame.commands[0];
  CHECK(clear.kind == CommandKind::kClear);
  CHECK(clear.has(Flag::kClearDepth));
  CHECK(clear.has(Flag::kClearColor));
  CHECK(clear.clear_depth == 1);
  CHECK(same_bits(clear.scissor, Scissor{0, 0, 1920, 1080}));
  for (std::size_t i = 1; i < 3; ++i) {
    const Command& draw = frame.commands[i];
    CHECK(draw.kind == CommandKind::kDraw);
    CHECK(draw.depth_func == DepthFunc::kLess);
    CHECK(draw.has(Flag::kDepthTest));
    CHECK(draw.has(Flag::kDepthWrite));
    CHECK(draw.has(Flag::kNdcZMinusOneToOne));
    CHECK_FALSE(draw.has(Flag::kCullBack));
    CHECK(draw.index_count == 18);
  }
  CHECK(frame.commands[1].vertex_count == 8);
  CHECK(frame.commands[2].first_vertex == 8);
}

TEST_CASE("each draw has only the vertices it uses") {
  Mesh mesh = box(glm::dvec3(0), glm::dvec3(1));
  mesh.positions.insert(mesh.positions.end(), 100, glm::dvec3(1e30f));  // used by none: not framed either
  mesh.parts = {{"face", 6, 6}};
  const Frame frame = frame_from_mesh(mesh, {}, "box");
  CHECK(frame.vertices.size() == 4);
  CHECK(frame.indices == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
}

TEST_CASE("a given eye and target are GLM's lookAt and perspective") {
  Camera camera;
  camera.eye = {3, 4, 5};
  camera.at = {0, 1, 0};
  camera.fov_degrees = 45;
  camera.width = 640;
  camera.height = 480;
  const Mesh mesh = box(glm::dvec3(0), glm::dvec3(1));
  const Frame frame = frame_from_mesh(mesh, camera, "box");
  const glm::dmat4 matrix = glm::perspectiveRH_NO(glm::radians(45.0), 640.0 / 480.0, 1.0, 10.0) *
                            glm::lookAtRH(*camera.eye, *camera.at, glm::dvec3(0, 1, 0));
  for (std::size_t i = 0; i < 18; ++i) {
    const glm::dvec4 expected = matrix * glm::dvec4(mesh.positions[mesh.indices[i]], 1);
    const glm::vec4 actual = frame.vertices[frame.indices[i]];
    CHECK(actual.x == Approx(expected.x).margin(1e-5));
    CHECK(actual.y == Approx(expected.y).margin(1e-5));
    CHECK(actual.w == Approx(expected.w).margin(1e-5));
  }
}

TEST_CASE("a camera that looks straight down, or is inside the mesh, sees something") {
  Camera camera;
  camera.at = glm::dvec3(0);
  camera.eye = GENERATE(glm::dvec3(0, 5, 0), glm::dvec3(0, -5, 0), glm::dvec3(0, 0, 0.5f));
  const Frame frame = frame_from_mesh(box(glm::dvec3(0), glm::dvec3(1)), camera, "box");
  CHECK(std::any_of(frame.vertices.begin(), frame.vertices.end(), [](glm::vec4 v) { return v.w > 0; }));
  for (const glm::vec4& v : frame.vertices) CHECK(std::isfinite(glm::compAdd(v)));
}

TEST_CASE("a mesh without extent, or with some positions that are not finite, is still framed") {
  const Frame point = frame_from_mesh(box(glm::dvec3(1, 2, 3), glm::dvec3(0)), {}, "point");
  for (const glm::vec4& v : point.vertices) CHECK(std::abs(v.z) <= v.w);
  Mesh mesh = box(glm::dvec3(0), glm::dvec3(1));
  mesh.positions[0].x = NAN;
  mesh.positions[1].y = INFINITY;
  const Frame frame = frame_from_mesh(mesh, {}, "box");
  const auto is_nan = [](glm::vec4 v) { return std::isnan(v.x) && std::isnan(v.w); };
  CHECK(std::count_if(frame.vertices.begin(), frame.vertices.end(), is_nan) == 4);  // two in each part
}

TEST_CASE("a mesh far from the origin gives the vertices of the same mesh at the origin, bit for bit") {
  // Map coordinates (UTM, in metres) and all offsets in it are sums of powers of two down to 2^-20: exact.
  const glm::dvec3 place{388096.25, 3948996.25, 17.5};
  Camera camera;
  camera.eye = glm::dvec3(0.25, 0.5, 3);
  camera.at = glm::dvec3(0);
  camera.up = GENERATE(std::optional<glm::dvec3>(), std::optional(glm::dvec3(0, 1, 1)));
  const double step = std::ldexp(1, -20);
  const Frame here = frame_from_mesh(box(glm::dvec3(0), glm::dvec3(3, 5, 7) * step), camera, "box");
  *camera.eye += place;
  *camera.at += place;
  const Frame there = frame_from_mesh(box(place, glm::dvec3(3, 5, 7) * step), camera, "box");
  CHECK(here.vertices == there.vertices);
}

TEST_CASE("what is given as up points up in the picture, and the default view turns with it") {
  Camera camera;
  camera.up = GENERATE(glm::dvec3(0, 0, 2), glm::dvec3(1, 0, 0), glm::dvec3(0, -3, 0), glm::dvec3(1, 1, 1));
  const Frame frame =
      frame_from_mesh(box(glm::dvec3(0), glm::dvec3(0.01) + glm::abs(*camera.up)), camera, "box");
  const Mesh mesh = box(glm::dvec3(0), glm::dvec3(0.01) + glm::abs(*camera.up));
  // Of an edge along up, the end that is farther up is farther up in the picture, and nearer: the eye is
  // above.
  const auto vertex = [&](std::size_t index) { return frame.vertices[frame.indices[index]]; };
  std::size_t edges = 0;
  for (std::size_t i = 0; i < 18; ++i) {
    for (std::size_t j = 0; j < 18; ++j) {
      const glm::dvec3 along = mesh.positions[mesh.indices[j]] - mesh.positions[mesh.indices[i]];
      const double rise = glm::dot(along, glm::normalize(*camera.up));
      if (!(rise > 0) || glm::length(glm::cross(along, *camera.up)) > 1e-9) continue;
      ++edges;
      CHECK(vertex(j).y / vertex(j).w > vertex(i).y / vertex(i).w);
      CHECK(vertex(j).w < vertex(i).w);
    }
  }
  CHECK(edges > 0);
}
