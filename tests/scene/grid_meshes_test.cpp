// Are the files that `bench read` writes the same mesh in every format?
#include "halfspace/speed/grid_meshes.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "fixture.hpp"
#include "halfspace/scene/mesh.hpp"

using namespace halfspace;

TEST_CASE("bench read: the grid is the same mesh in every format") {
  const test::TempFolder folder;
  const auto paths = write_grid_meshes(folder.path(""), 9);
  REQUIRE(paths.size() == 7);
  const Mesh first = read_mesh(paths[0]);
  CHECK(first.positions.size() == 81);
  CHECK(first.indices.size() == 3 * 128);
  CHECK(first.positions.front() == glm::dvec3(-5, first.positions.front().y, -5));
  CHECK(first.positions.back() == glm::dvec3(5, first.positions.back().y, 5));
  // The first square: two triangles that both face up.
  const std::vector<std::uint32_t> square(first.indices.begin(), first.indices.begin() + 6);
  CHECK(square == std::vector<std::uint32_t>{0, 9, 10, 0, 10, 1});
  for (const std::filesystem::path& path : paths) {
    INFO(path);
    const Mesh mesh = read_mesh(path);
    CHECK(mesh.indices == first.indices);
    CHECK(mesh.left_out.empty());
    REQUIRE(mesh.positions.size() == first.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        // Text has six decimals.
        CHECK(std::abs(mesh.positions[i][axis] - first.positions[i][axis]) <= 1e-6);
      }
    }
  }
}
