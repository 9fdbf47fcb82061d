// Are malformed OBJ files refused with the line, the value and what is legal?
#include <catch2/catch.hpp>

#include "../scene/fixture.hpp"
#include "halfspace/scene/mesh_formats.hpp"
#include "halfspace/scene/triangulate.hpp"

using namespace halfspace;
using namespace halfspace::test;

namespace {

const std::string kPoints = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

std::string error_of_obj(const std::string& text) {
  return error_of([&] { return parse_obj(as_bytes(text), "f"); });
}

}  // namespace

TEST_CASE("malformed OBJ files are refused") {
  const std::string legal_corner = "; legal: v, v/t, v//n or v/t/n with v from 1, or from -1 down";
  const std::pair<std::string, std::string> cases[] = {
      {"", "f: mesh has 0 vertices and 0 triangles; legal: 1 triangle, line or point or more"},
      {kPoints, "f: mesh has 3 vertices and 0 triangles; legal: 1 triangle, line or point or more"},
      {kPoints + "l 1\n",
       "f: mesh has 3 vertices and 0 triangles, without lines with fewer than two vertices (1); legal: 1 "
       "triangle, line or point or more"},
      {kPoints + "p 4\n", "f: line 4: corner 0 is vertex 4; legal: 1 to 3, the vertices up to here"},
      {kPoints + "l 1 x\n", "f: line 4: corner 1 is \"x\"" + legal_corner},
      {"v 0 0\n", "f: line 1: coordinate 2 is \"\"; legal: three numbers"},
      {"\n# x\r\nv 0 zero 0\n", "f: line 3: coordinate 1 is \"zero\"; legal: three numbers"},
      {"v 0 1,5 0", "f: line 1: coordinate 1 is \"1,5\"; legal: three numbers"},
      {"v 0x10 0 0", "f: line 1: coordinate 0 is \"0x10\"; legal: three numbers"},
      {"v 1d5 0 0", "f: line 1: coordinate 0 is \"1d5\"; legal: three numbers"},
      {"v 0 0 1.#INFx", "f: line 1: coordinate 2 is \"1.#INFx\"; legal: three numbers"},
      {"v 0 0 -", "f: line 1: coordinate 2 is \"-\"; legal: three numbers"},
      {"v 0 0 # 0", "f: line 1: coordinate 2 is \"\"; legal: three numbers"},
      {"v 0 0 \\\n\n0", "f: line 2: coordinate 2 is \"\"; legal: three numbers"},
      {"v 0 0 \\ 0", "f: line 1: coordinate 2 is \"\\\"; legal: three numbers"},
      {"v 0 1.5f 0", "f: line 1: coordinate 1 is \"1.5f\"; legal: three numbers"},
      {kPoints + "f 1 2\nf 2",
       "f: mesh has 3 vertices and 0 triangles, without faces with fewer than three corners (2); legal: 1 "
       "triangle, line or point or more"},
      {kPoints + "f 1 2 4", "f: line 4: corner 2 is vertex 4; legal: 1 to 3, the vertices up to here"},
      {kPoints + "f 1 2 -4", "f: line 4: corner 2 is vertex -4; legal: 1 to 3, the vertices up to here"},
      {kPoints + "f 1 0 2", "f: line 4: corner 1 is \"0\"" + legal_corner},
      {kPoints + "f 1 x 2", "f: line 4: corner 1 is \"x\"" + legal_corner},
      {kPoints + "f 1 2.5 2", "f: line 4: corner 1 is \"2.5\"" + legal_corner},
      {kPoints + "f 4294967297 2 3", "f: line 4: corner 0 is \"4294967297\"" + legal_corner},
      {kPoints + "f 1 2 /3", "f: line 4: corner 2 is \"/3\"" + legal_corner},
      {kPoints + "f 1/1/1/1 2 3", "f: line 4: corner 0 is \"1/1/1/1\"" + legal_corner},
      {kPoints + "f 1 2 \\ 3", "f: line 4: corner 2 is \"\\\"" + legal_corner},
      {kPoints + "f 1 2 \\\r\n\\\r4",
       "f: line 6: corner 2 is vertex 4; legal: 1 to 3, the vertices up to here"},
      {kPoints + "\r\r\n\nf 1 2 x", "f: line 7: corner 2 is \"x\"" + legal_corner},
      {kPoints + "call a.obj",
       "f: line 4: statement is \"call\"; legal: a file that is whole without others"},
      {kPoints + " csh -ls", "f: line 4: statement is \"csh\"; legal: a file that is whole without others"},
      {"\xFF\xFEv\0 \0", "f: byte order mark is that of UTF-16 or UTF-32; legal: UTF-8, or none"},
      {kPoints + std::string("f 1 2\0 3", 8), "f: line 4: character 5 is a zero byte; legal: text"},
      {"f 1 2 3\n" + kPoints, "f: line 1: corner 0 is vertex 1; legal: 1 to 0, the vertices up to here"},
      {"v \x1B[31m 0 0", "f: line 1: coordinate 0 is \"?[31m\"; legal: three numbers"},
      {"v " + std::string(100, '9') + "x 0 0",
       "f: line 1: coordinate 0 is \"" + std::string(60, '9') + "...\"; legal: three numbers"},
  };
  for (const auto& [text, error] : cases) CHECK(error_of_obj(text) == error);
}

TEST_CASE("a face with a fourth part in a corner, as found by fuzzing") {
  const std::string text = kPoints + "v 0 1 0.5\nvt 0 0\nvn 0 0 1\nf 1/4 -1/-3/\xFF\xFF\xFF/1 -2/1\n";
  CHECK(error_of_obj(text).starts_with("f: line 7: corner 1 is \"-1/-3/\xFF\xFF\xFF/1\""));
}

TEST_CASE("a concave polygon with too many corners is refused") {
  std::string text = "v 0 0 0\nv 1 0.5 0\nv 2 0 0\nv 1 9 0\n";
  text += "f";
  for (std::size_t i = 0; i < kMaxConcaveCorners; ++i) text += " 1 2 3 4";
  CHECK(error_of_obj(text) == "f: a face that is not convex has 131072 corners; legal: at most 32768");
}
