// Are malformed PLY files refused with the element, the value and what is legal?
#include <catch2/catch.hpp>

#include "../scene/fixture.hpp"
#include "halfspace/scene/mesh_formats.hpp"

using namespace halfspace;
using namespace halfspace::test;

namespace {

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kFace = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kBody = "0 0 0\n1 0 0\n0 1 0\n";

std::string header(const std::string& elements, const std::string& format = "ascii") {
  return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n";
}

std::string triangle(const std::string& face) {
  return header("element vertex 3\n" + kXyz + kFace) + kBody + face;
}

std::string error_of_ply(const std::string& text) {
  return error_of([&] { return parse_ply(as_bytes(text), "f"); });
}

}  // namespace

TEST_CASE("malformed PLY headers are refused") {
  const std::pair<std::string, std::string> cases[] = {
      {"", "f: does not start with a line \"ply\"; legal: a PLY header"},
      {"ply", "f: does not start with a line \"ply\"; legal: a PLY header"},
      {"plyx\n", "f: does not start with a line \"ply\"; legal: a PLY header"},
      {"ply x\n", "f: does not start with a line \"ply\"; legal: a PLY header"},
      {" \n", "f: does not start with a line \"ply\"; legal: a PLY header"},
      {"\xFE\xFFply\n", "f: byte order mark is that of UTF-16 or UTF-32; legal: UTF-8, or none"},
      {"ply\rformat ascii 1.0\r\nend_header\n",
       "f: header ends without \"end_header\" after 3 lines; legal: a whole header"},
      {"PLY\n", "f: does not start with a line \"ply\"; legal: a PLY header"},
      {"ply\nformat ascii 1.0\n",
       "f: header ends without \"end_header\" after 3 lines; legal: a whole header"},
      {"ply\nend_header\n", "f: header has no format line; legal: one"},
      {header("", "utf8"),
       "f: header line 2: format is \"utf8\"; legal: ascii, binary_little_endian, binary_big_endian"},
      {header("nonsense\n"),
       "f: header line 3 starts with \"nonsense\"; legal: format, element, property, comment, obj_info, "
       "end_header"},
      {header(kXyz), "f: header line 3 is a property before any element; legal: after one"},
      {header("element vertex -1\n"),
       "f: header line 3: element \"vertex\" has count \"-1\"; legal: a name and 0 to 4294967295"},
      {header("element vertex 4294967296\n"),
       "f: header line 3: element \"vertex\" has count \"4294967296\"; legal: a name and 0 to 4294967295"},
      {header("element\n"),
       "f: header line 3: element \"\" has count \"\"; legal: a name and 0 to 4294967295"},
      {header("element vertex 1\nproperty vec3 x\n"),
       "f: header line 4: type is \"vec3\"; legal: char to double, int8 to float64"},
      {header("element face 1\nproperty list float int a\n"),
       "f: header line 4: list is counted in a floating-point type; legal: an integer type"},
      {header("element a 1\n"), "f: element \"a\" has no property; legal: one or more"},
      {header("element vertex 0\n" + kXyz + "element vertex 0\n" + kXyz),
       "f: mesh has 0 vertices and 0 triangles; legal: 1 triangle, line or point or more"},
      {header("element vertex 1\n" + kXyz + "element vertex 1\n" + kXyz) + "0 0 0 0 0 0",
       "f: header has a second element \"vertex\"; legal: one"},
      {header("element vertex 1\nproperty float x\nproperty float y\n") + "0 0",
       "f: element \"vertex\" lacks x, y or z; legal: all three, not lists"},
      {header("element face 1\nproperty int vertex_indices\n") + "0",
       "f: element \"face\" has no list of integers vertex_indices or vertex_index; legal: one"},
      {header("element vertex 0\n" + kXyz + "element tristrips 1\nproperty list int int strips\n") + "0",
       "f: element \"tristrips\" has no list of integers vertex_indices or vertex_index; legal: one"},
      {header("element face 1\nproperty list uchar float vertex_indices\n") + "0",
       "f: element \"face\" has no list of integers vertex_indices or vertex_index; legal: one"},
  };
  for (const auto& [text, error] : cases) CHECK(error_of_ply(text) == error);
  std::string many = "element a 1\n";
  for (int i = 0; i < 257; ++i) many += "property int p\n";
  CHECK(error_of_ply(header(many)) ==
        "f: header line 260 is property 257 of its element; legal: at most 256");
}

TEST_CASE("malformed PLY bodies are refused") {
  const std::pair<std::string, std::string> cases[] = {
      {triangle(""), "f: body ends too early; legal: all the records of the header"},
      {triangle("3 0 1"), "f: body ends too early; legal: all the records of the header"},
      {triangle("3 0 1 x"), "f: body has \"x\"; legal: a number"},
      {triangle("3 0 1 2x"), "f: body has \"2x\"; legal: a number"},
      {triangle("2 0 1"),
       "f: mesh has 3 vertices and 0 triangles, without faces with fewer than three corners (1); legal: 1 "
       "triangle, line or point or more"},
      {triangle("3 0 1 3"), "f: face 0 has vertex 3; legal: below 3"},
      {triangle("3 0 1 -1"), "f: face 0 has vertex -1; legal: below 3"},
      {triangle("3 0 1 9223372036854775807"), "f: face 0 has vertex 9223372036854775807; legal: below 3"},
      {triangle("3 0 1 1.5"), "f: property \"vertex_indices\" has the value 1.5; legal: an integer"},
      {triangle("3 0 1 nan"), "f: property \"vertex_indices\" has the value nan; legal: an integer"},
      {triangle("3 0 1 1e99"), "f: property \"vertex_indices\" has the value 1e+99; legal: an integer"},
      {triangle("-1 0 1 2"), "f: property \"vertex_indices\" is a list of -1 values; legal: 0 to 2147483647"},
      {triangle("3e9 0 1 2"),
       "f: property \"vertex_indices\" is a list of 3000000000 values; legal: 0 to 2147483647"},
      {triangle("1e9 0 1 2"), "f: mesh has 999999998 triangles or more; legal: at most 33554432"},
      {header("element vertex 3\n" + kXyz + "element face 0\nproperty list uchar int vertex_index\n") +
           "0 0 0 1 0 0 0 1 0\n",
       "f: mesh has 3 vertices and 0 triangles; legal: 1 triangle, line or point or more"},
  };
  for (const auto& [text, error] : cases) CHECK(error_of_ply(text) == error);
}

TEST_CASE("PLY strips with a vertex that is not there are refused") {
  const auto strips = [](const std::string& type, const std::string& list) {
    return error_of_ply(header("element vertex 3\n" + kXyz + "element tristrips 2\nproperty list int " +
                               type + " vertex_indices\n") +
                        kBody + "3 0 1 2\n" + list);
  };
  CHECK(strips("int", "3 0 1 3") == "f: list of strips 1 has vertex 3; legal: below 3");
  CHECK(strips("int", "3 0 1 -2") == "f: list of strips 1 has vertex -2; legal: below 3");
  CHECK(strips("int", "3 0 1 2.5") == "f: property \"vertex_indices\" has the value 2.5; legal: an integer");
  CHECK(strips("uint", "3 0 1 255") == "f: list of strips 1 has vertex 255; legal: below 3");
  CHECK(strips("uchar", "3 0 1 255") == "no error");
}

TEST_CASE("a PLY header that promises more than the file holds is refused before anything is allocated") {
  CHECK(error_of_ply(header("element vertex 4000000000\n" + kXyz, "binary_little_endian") + "0123") ==
        "f: element \"vertex\" has 4000000000 records of 12 bytes or more, the file 4 bytes for them; legal: "
        "all within");
  CHECK(error_of_ply(header("element vertex 4000000000\n" + kXyz) + "0 0 0") ==
        "f: element \"vertex\" has 4000000000 records of 6 bytes or more, the file 6 bytes for them; legal: "
        "all within");
  CHECK(error_of_ply(header("element a 1\nproperty list uint uchar b\n", "binary_big_endian") +
                     "\x7F\xFF\xFF\xFF" + "abc") ==
        "f: body ends too early; legal: all the records of the header");
}

TEST_CASE("a PLY file cut short anywhere is refused") {
  std::string text = header("element vertex 3\n" + kXyz + kFace, "binary_little_endian");
  for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) append(text, value);
  text += '\3';
  for (const std::uint32_t index : {0u, 1u, 2u}) append(text, index);
  CHECK(error_of_ply(text) == "no error");
  for (std::size_t size = 0; size < text.size(); ++size) {
    INFO(size);
    CHECK(error_of_ply(text.substr(0, size)) != "no error");
  }
}
