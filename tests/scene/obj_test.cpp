// Are OBJ files read as their specification says, and as programs write them?
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "fixture.hpp"
#include "halfspace/scene/mesh_formats.hpp"

using namespace halfspace;
using namespace halfspace::test;

namespace {

using Positions = std::vector<glm::dvec3>;
using Indices = std::vector<std::uint32_t>;
using Strings = std::vector<std::string>;

Mesh obj_mesh(const std::string& text) { return parse_obj(as_bytes(text), "f"); }

const std::string kObjPoints = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

/// What is left out of the triangle of the first three points and more statements.
Strings left_out_of_obj(const std::string& statements) {
  const Mesh mesh = obj_mesh(kObjPoints + "f 1 2 3\n" + statements);
  INFO(statements);
  CHECK(mesh.indices == Indices{0, 1, 2});
  return mesh.left_out;
}

}  // namespace

TEST_CASE("OBJ: line ends, blanks, comments and continued lines do not change the mesh") {
  const std::string texts[] = {
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3",
      "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n",
      "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r",
      "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3",
      "v 0 0 0\n\rv 1 0 0\n\n\r\r\nv 0 1 0\nf 1 2 3\r\n",
      "\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
      "v\t0\t0\t0\nv 1  0   0 \t\n \t v 0 1 0 \r\n\tf  1\t2 3 \n",
      "v\v0\f0 0\f\nv 1 0 0\nv 0 1 0\v\n\f\nf 1\v2 3\n",
      "#v 9 9 9\nv 0 0 0 # origin\nv 1 0 0# v 9 9 9\n  # x\nv 0 1 0 #\nf 1 2 3 # 4 5\n#",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3#4\n",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1/1 2/2/2 3/3/3# triangle\n",
      "# C:\\meshes\\\nv 0 0 0 # C:\\\nv 1 0 0\nv 0 1 0\nf 1 2 3 # \\\n",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n3\n",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\r\n3\r\n",
      "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 \\\r3\r",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\\\n3\n",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//2\\\n 3//3\n",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\ \t\n  3\n",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf \\\n1 \\\r\n\\\n2 3 \\\n\n",
      "v \\\n0 \\\n0 \\\n0\nv 1 0\\\n0\nv\\\n0 1 0\nf 1 2 3\\",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 \\",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n3 # end \\\n",
      "v 0 0 0\nvn 0 0 1 \\\nv 9 9 9\nv 1 0 0\ng a \\\n b\nv 0 1 0\nf 1 2 3\n",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nfo 1 2 3\n",
  };
  for (const std::string& text : texts) {
    INFO(text);
    const Mesh mesh = obj_mesh(text);
    CHECK(mesh.positions == Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(mesh.indices == Indices{0, 1, 2});
    CHECK(mesh.left_out.empty());
  }
}

TEST_CASE("OBJ: coordinates are kept as doubles, weights and colours behind them passed over") {
  const Mesh mesh = obj_mesh(
      "v 388096.123 -.5 +3948996.25e0\nv 1 2 3 0.5\nv 4 5 6 0.25 0.5 1.0\nv 7 8 9 1 0 0 0\nf 1 2 3\n");
  CHECK(mesh.positions == Positions{{388096.123, -0.5, 3948996.25}, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}});
  CHECK(mesh.left_out.empty());
}

TEST_CASE("OBJ: corners have texture and normal numbers or none, and count from either end") {
  for (const std::string face :
       {"f 1 2 3", "f 1/5 2/6 3/7", "f 1//5 2//6 3//7", "f 1/5/8 2/6/9 3/7/9", "f 1/ 2/ 3/", "f 1// 2// 3//",
        "f 1/5/ 2 3//8", "f -4 -3 -2", "f -4/-1/-1 2 -2//-1", "f +1 02 3"}) {
    INFO(face);
    CHECK(obj_mesh(kObjPoints + face).indices == Indices{0, 1, 2});
  }
  const Mesh mesh = obj_mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf -3 -2 -1\n");
  CHECK(mesh.indices == Indices{0, 1, 2, 1, 2, 3});
}

TEST_CASE("OBJ: vertices that are not finite are left out with their faces, and counted") {
  for (const std::string number : {"nan", "-nan(ind)", "NaN", "inf", "-Infinity", "1.#QNAN", "-1.#IND00",
                                   "1.#INF", "1.#J # x", "1e400", "-1e400", "1e99999999999999999999"}) {
    INFO(number);
    const Mesh mesh =
        obj_mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 " + number + "\nf 4 1 2\nf 1 2 3\nf 1 2 3 4\n");
    CHECK(mesh.indices == Indices{0, 1, 2});
    CHECK(mesh.left_out ==
          Strings{"faces with a vertex that is not finite (2)", "vertices that are not finite (1)"});
  }
  CHECK(obj_mesh(kObjPoints + "v 1e39 0 -1e-400\nf 1 2 5\n").positions[4] == glm::dvec3(1e39, 0, 0));
}

TEST_CASE("OBJ: faces of fewer than three corners are left out and counted") {
  CHECK(left_out_of_obj("f\nf 1\nf 1/1 2/2\nfo 1 \\\n2\n") ==
        Strings{"faces with fewer than three corners (4)"});
}

TEST_CASE("OBJ: what draws something else is left out and counted") {
  CHECK(left_out_of_obj("l 1\nl\n") == Strings{"lines with fewer than two vertices (2)"});
  CHECK(left_out_of_obj("curv 0 1 1 2 3\ncurv2 1 2\ncdc 1 2 3 4\n") == Strings{"free-form curves (3)"});
  CHECK(left_out_of_obj("surf 0 1 0 1 1 2 3 \\\n4\nbsp 1\nbzp 1\ncdp 1\n") ==
        Strings{"free-form surfaces (4)"});
  CHECK(left_out_of_obj("v1 2 3\nF 1 2 3\nsolid cube\n\x1A") == Strings{"unknown statements (4)"});
}

TEST_CASE("OBJ: statements that say nothing about triangles are passed over") {
  CHECK(left_out_of_obj(
            "vt 0 0\nvn 0 0 1\nvp 0 0\nvt nan\ng a b\ng\ns off\ns 1\nmg 1 0.5\no thing\n"
            "cstype rat bspline\ndeg 3\nbmat u 1 \\\n0\nstep 1\nparm u 0 1\ntrim 0 1 1\nhole 0 1 1\n"
            "scrv 0 1 1\nsp 1\nend\ncon 1 0 1 1 2 0 1 1\nbevel on\nc_interp off\nd_interp on\nlod 3\n"
            "usemap off\nmaplib a\nmtllib a.mtl b.mtl\nshadow_obj a\ntrace_obj a\nctech cparm 1\n"
            "stech cparma 1 1\nres 1 2\n")
            .empty());
}

TEST_CASE("OBJ: names of materials may have blanks; comments behind them do not count") {
  const Mesh mesh =
      obj_mesh(kObjPoints +
               "usemtl Dark  Red # a\nf 1 2 3\nusemtl Dark Red\nf 1 2 4\nusemtl Dark \\\nBlue#2\nf 1 3 4\n");
  REQUIRE(mesh.parts.size() == 2);
  CHECK(mesh.parts[0].name == "Dark Red");
  CHECK(mesh.parts[0].index_count == 6);
  CHECK(mesh.parts[1].name == "Dark Blue#2");
}
