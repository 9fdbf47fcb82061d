// Are cameras and meshes that make no picture refused?
#include "halfspace/scene/camera.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "../scene/fixture.hpp"

using namespace halfspace;
using namespace halfspace::test;

namespace {

struct CameraRule {
  std::function<void(Mesh&, Camera&)> change;
  std::string error;
};

const CameraRule kCameraRules[] = {
    {[](Mesh&, Camera& c) { c.fov_degrees = 0; }, "f: camera fov is 0; legal: above 0 and below 180 degrees"},
    {[](Mesh&, Camera& c) { c.fov_degrees = 180; },
     "f: camera fov is 180; legal: above 0 and below 180 degrees"},
    {[](Mesh&, Camera& c) { c.fov_degrees = NAN; },
     "f: camera fov is nan; legal: above 0 and below 180 degrees"},
    {[](Mesh&, Camera& c) { c.width = 0; }, "f: camera width is 0; legal: 1 to 16384 pixels"},
    {[](Mesh&, Camera& c) { c.height = 16385; }, "f: camera height is 16385; legal: 1 to 16384 pixels"},
    {[](Mesh&, Camera& c) { c.eye = glm::dvec3(0, NAN, 0); },
     "f: camera eye is (0, nan, 0); legal: finite numbers"},
    {[](Mesh&, Camera& c) { c.at = glm::dvec3(INFINITY, 0, 0); },
     "f: camera at is (inf, 0, 0); legal: finite numbers"},
    {[](Mesh&, Camera& c) { c.up = glm::dvec3(0, NAN, 0); },
     "f: camera up is (0, nan, 0); legal: finite numbers"},
    {[](Mesh&, Camera& c) { c.up = glm::dvec3(0); },
     "f: camera up is (0, 0, 0); legal: a vector that is not 0"},
    {[](Mesh&, Camera& c) {
       c.eye = glm::dvec3(0, 0, 5);
       c.up = glm::dvec3(0, 0, -2);
     },
     "f: camera up (0, 0, -2) is along its line of sight; legal: across it"},
    {[](Mesh&, Camera& c) { c.eye = c.at = glm::dvec3(1, 2, 3); },
     "f: camera eye and at are both (1, 2, 3); legal: two different points"},
    {[](Mesh&, Camera& c) { c.eye = glm::dvec3(0); },  // the middle of the mesh, which is looked at
     "f: camera eye and at are both (0, 0, 0); legal: two different points"},
    {[](Mesh&, Camera& c) {
       c.eye = glm::dvec3(0, 0, 5);
       c.at = glm::dvec3(0, 0, 9);
     },
     "f: camera eye (0, 0, 5) looking at (0, 0, 9) has the whole mesh behind it; legal: some in front"},
    {[](Mesh& m, Camera&) { m.positions.assign(8, glm::dvec3(NAN)); },
     "f: mesh has 12 triangles and no finite vertex in them; legal: one or more"},
    {[](Mesh& m, Camera&) { m.indices.clear(), m.parts.clear(); },
     "f: mesh has 0 triangles and no finite vertex in them; legal: one or more"},
    {[](Mesh& m, Camera&) { m.indices[5] = 8; }, "f: mesh index 5 is 8; legal: below 8"},
    {[](Mesh& m, Camera&) { m.parts[0].index_count = 39; },
     "f: mesh part 0 is 39 indices from 0; legal: whole triangles up to 36"},
    {[](Mesh& m, Camera&) { m.parts[0].first_index = 0xFFFFFFFF; },
     "f: mesh part 0 is 36 indices from 4294967295; legal: whole triangles up to 36"},
    {[](Mesh& m, Camera&) { m.parts[0].index_count = 35; },
     "f: mesh part 0 is 35 indices from 0; legal: whole triangles up to 36"},
};

}  // namespace

TEST_CASE("cameras and meshes that make no picture are refused") {
  for (const CameraRule& rule : kCameraRules) {
    Mesh mesh;
    mesh.positions.assign(kCubeCorners.begin(), kCubeCorners.end());
    mesh.indices = cube_indices();
    mesh.parts = {{"all", 0, 36}};
    Camera camera;
    rule.change(mesh, camera);
    INFO(rule.error);
    CHECK(error_of([&] { return frame_from_mesh(mesh, camera, "f"); }) == rule.error);
  }
}

TEST_CASE("a mesh too large for floats is refused, by its vertex") {
  Mesh mesh;
  for (const glm::dvec3& p : kCubeCorners) mesh.positions.push_back(3e38 * p);
  mesh.indices = cube_indices();
  mesh.parts = {{"all", 0, 36}};
  const std::string error = error_of([&] { return frame_from_mesh(mesh, {}, "f"); });
  CHECK(error.starts_with("f: mesh vertex ("));
  CHECK(error.find(" in clip space; legal: up to 3.4028") != std::string::npos);
}
