// Are PLY files read as their description says, and as programs write them?
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "fixture.hpp"
#include "halfspace/scene/mesh_formats.hpp"

using namespace halfspace;
using namespace halfspace::test;

namespace {

using PlyPositions = std::vector<glm::dvec3>;
using PlyIndices = std::vector<std::uint32_t>;
using PlyStrings = std::vector<std::string>;

Mesh ply_mesh(const std::string& text) { return parse_ply(as_bytes(text), "f"); }

/// Lines that each end in `end`.
std::string lines(const std::vector<std::string>& all, const std::string& end) {
  std::string out;
  for (const std::string& line : all) out += line + end;
  return out;
}

/// A PLY file of ascii with the element "vertex" of (0 0 0), (1 0 0), (0 1 0), (0 0 1), ... and others.
std::string ply_text(std::size_t vertices, const std::string& elements, const std::string& body) {
  std::string out = fmt::format("ply\nformat ascii 1.0\nelement vertex {}\n", vertices);
  out += "property double x\nproperty double y\nproperty double z\n" + elements + "end_header\n";
  for (std::size_t i = 0; i < vertices; ++i)
    out += fmt::format("{} {} {}\n", int{i % 4 == 1}, int{i % 4 == 2}, i / 3);
  return out + body;
}

const std::string kPlyFaces = "property list uchar int vertex_indices\n";

/// Indices of a mesh of `vertices` vertices and one list of strips.
PlyIndices strip_indices(std::size_t vertices, const std::string& type, const std::string& list) {
  return ply_mesh(
             ply_text(vertices, "element tristrips 1\nproperty list int " + type + " vertex_indices\n", list))
      .indices;
}

template <typename T>
void append_big(std::string& out, T value) {
  std::string raw;
  append(raw, value);
  std::reverse(raw.begin(), raw.end());
  out += raw;
}

}  // namespace

TEST_CASE("PLY: line ends, blanks, comments and a mark in the header do not change the mesh") {
  const std::vector<std::string> head{"element vertex 3", "property float x",
                                      "property float y", "property float z",
                                      "element face 1",   "property list uchar int vertex_index",
                                      "end_header"};
  const std::vector<float> numbers{std::bit_cast<float>(0x0A0D0A0Du), 0, 0, 1, 0, 0, 0, 1, 0};
  const std::string format = GENERATE("ascii", "binary_little_endian", "binary_big_endian");
  // The body begins with bytes that could be ends of the header's last line: 0D 0A 0D 0A, or 0A 0D 0A 0D.
  std::string body;
  for (const float number : numbers) {
    if (format == "ascii") body += fmt::format("{} ", double{number});
    if (format == "binary_little_endian") append(body, number);
    if (format == "binary_big_endian") append_big(body, number);
  }
  if (format == "ascii") {
    body += "\r3 0\r\n1 2";
  } else {
    body += '\3';
    for (const std::uint32_t index : {0u, 1u, 2u}) {
      if (format == "binary_big_endian") append_big(body, index);
      if (format == "binary_little_endian") append(body, index);
    }
  }
  for (const std::string end : {"\n", "\r\n", "\r", " \n", " \t\r\n", "\t\r"}) {
    for (const std::string mark : {"", "\xEF\xBB\xBF"}) {
      for (const std::string more :
           {"", "comment\n", "comment element vertex 9\n", "obj_info a b\n", "\n", "  comment\tx\n"}) {
        std::string extra = more;
        if (!extra.empty()) extra.replace(extra.size() - 1, 1, end);
        std::vector<std::string> all{"ply", fmt::format("{}format {} 1.0", extra, format)};
        for (const std::string& line : head) all.push_back((more.empty() ? "" : "\t") + line);
        all[4].insert(0, extra);
        all.back().insert(0, extra);
        const Mesh mesh = ply_mesh(fmt::format("{}{}{}", mark, lines(all, end), body));
        REQUIRE(mesh.positions == PlyPositions{{numbers[0], 0, 0}, {1, 0, 0}, {0, 1, 0}});
        REQUIRE(mesh.indices == PlyIndices{0, 1, 2});
        REQUIRE(mesh.left_out.empty());
      }
    }
  }
}

TEST_CASE("PLY: numbers of every type, by both names") {
  const std::pair<std::string, std::string> names[] = {
      {"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},   {"ushort", "uint16"},
      {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}};
  for (int type = 0; type < 8; ++type) {
    for (const std::string& name : {names[type].first, names[type].second}) {
      INFO(name);
      std::string text = "ply\nformat binary_big_endian 1.0\nelement vertex 3\n";
      for (const char axis : {'x', 'y', 'z'}) text += "property " + name + ' ' + axis + '\n';
      // A list of every type, which is passed over, is counted in every integer type.
      text += "property list " + (type < 6 ? name : "int") + ' ' + name + " more\n";
      text += "element face 1\nproperty list " + (type < 6 ? name : "int") + ' ' + (type < 6 ? name : "int") +
              " vertex_indices\nend_header\n";
      const auto put = [&text](int kind, double value) {
        if (kind == 0) append_big(text, static_cast<std::int8_t>(value));
        if (kind == 1) append_big(text, static_cast<std::uint8_t>(value));
        if (kind == 2) append_big(text, static_cast<std::int16_t>(value));
        if (kind == 3) append_big(text, static_cast<std::uint16_t>(value));
        if (kind == 4) append_big(text, static_cast<std::int32_t>(value));
        if (kind == 5) append_big(text, static_cast<std::uint32_t>(value));
        if (kind == 6) append_big(text, static_cast<float>(value));
        if (kind == 7) append_big(text, value);
      };
      const double low[] = {-128, 0, -32768, 0, -2147483648., 0, -0.5, -0.1};
      const double high[] = {127, 255, 32767, 65535, 2147483647, 4294967295., 0.5, 388096.123};
      const int counted = type < 6 ? type : 4;
      for (int vertex = 0; vertex < 3; ++vertex) {
        for (const double value : {low[type], high[type], double(vertex)}) put(type, value);
        put(counted, 2);
        for (int i = 0; i < 2; ++i) put(type, 7);
      }
      put(counted, 3);
      for (const int index : {2, 1, 0}) put(counted, index);
      const Mesh mesh = ply_mesh(text);
      CHECK(mesh.positions ==
            PlyPositions{{low[type], high[type], 0}, {low[type], high[type], 1}, {low[type], high[type], 2}});
      CHECK(mesh.indices == PlyIndices{2, 1, 0});
      CHECK(mesh.left_out.empty());
    }
  }
}

TEST_CASE("PLY: ascii integers may be written as real numbers") {
  CHECK(ply_mesh(ply_text(3, "element face 1\n" + kPlyFaces, "3.0 +2 1e0 0.\n")).indices ==
        PlyIndices{2, 1, 0});
}

TEST_CASE("PLY: ascii coordinates are kept as doubles") {
  CHECK(ply_mesh(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 1\nproperty list uchar int vertex_index\nend_header\n"
            "388096.123 0.1 1e-3 1e99 0 0 0 1 0 3 0 1 2")
            .positions == PlyPositions{{388096.123, 0.1, 0.001}, {1e99, 0, 0}, {0, 1, 0}});
}

TEST_CASE("PLY: triangle strips wind one way, and end at -1") {
  const PlyIndices two{0, 1, 2, 2, 1, 3};
  CHECK(strip_indices(4, "int", "4 0 1 2 3") == two);
  CHECK(strip_indices(4, "int", "5 0 1 2 3 -1") == two);
  CHECK(strip_indices(4, "int", "8 -1 -1 0 1 2 3 -1 -1") == two);
  CHECK(strip_indices(6, "int", "6 0 1 2 3 4 5") == PlyIndices{0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5});
  // The second strip begins again with a triangle that is not turned around, even behind an odd number of
  // corners.
  CHECK(strip_indices(7, "int", "8 0 1 2 -1 3 4 5 6") == PlyIndices{0, 1, 2, 3, 4, 5, 5, 4, 6});
  CHECK(strip_indices(7, "int", "8 0 1 2 3 -1 4 5 6") == PlyIndices{0, 1, 2, 2, 1, 3, 4, 5, 6});
  // Strips joined by corners that repeat keep their triangles without area.
  CHECK(strip_indices(5, "int", "6 0 1 2 2 3 4") == PlyIndices{0, 1, 2, 2, 1, 2, 2, 2, 3, 3, 2, 4});
}

TEST_CASE("PLY: the end of a strip in types of every size, with and without sign") {
  const std::tuple<std::string, int, std::int64_t> types[] = {{"char", 1, -1},      {"short", 2, -1},
                                                              {"int", 4, -1},       {"uchar", 1, 255},
                                                              {"ushort", 2, 65535}, {"uint", 4, 4294967295}};
  for (const auto& [type, size, end] : types) {
    INFO(type);
    std::string text =
        "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty uchar x\nproperty uchar y\n"
        "property uchar z\nelement tristrips 2\nproperty list int " +
        type + " vertex_index\nend_header\n";
    text += std::string("\0\0\0\1\0\0\0\1\0\0\0\1", 12);
    for (int record = 0; record < 2; ++record) {
      append(text, std::int32_t{7});
      for (const std::int64_t corner : {std::int64_t{0}, std::int64_t{1}, std::int64_t{2}, end,
                                        std::int64_t{1}, std::int64_t{2}, std::int64_t{3}}) {
        text.append(reinterpret_cast<const char*>(&corner), static_cast<std::size_t>(size));
      }
    }
    CHECK(ply_mesh(text).indices == PlyIndices{0, 1, 2, 1, 2, 3, 0, 1, 2, 1, 2, 3});
    CHECK(strip_indices(4, type, fmt::format("7 0 1 2 {} 1 2 3", end)) == PlyIndices{0, 1, 2, 1, 2, 3});
  }
  // Where a vertex has that number, it is the vertex.
  CHECK(strip_indices(256, "uchar", "4 0 1 255 2") == PlyIndices{0, 1, 255, 255, 1, 2});
  CHECK(strip_indices(255, "uchar", "7 0 1 254 255 2 3 4") == PlyIndices{0, 1, 254, 2, 3, 4});
}

TEST_CASE("PLY: strips of fewer than three corners count as such faces") {
  const Mesh mesh = ply_mesh(
      ply_text(4, "element tristrips 1\nproperty list int int vertex_indices\n", "9 0 -1 0 1 -1 0 1 2 -1"));
  CHECK(mesh.indices == PlyIndices{0, 1, 2});
  CHECK(mesh.left_out == PlyStrings{"faces with fewer than three corners (2)"});
}

TEST_CASE("PLY: faces and strips are in the file's order, and may stand before the vertices") {
  const Mesh mesh = ply_mesh(
      "ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int vertex_indices\nelement face 1\n" +
      kPlyFaces +
      "element vertex 4\nproperty int x\nproperty int y\nproperty int z\nelement face 1\nproperty int "
      "flag\n" +
      kPlyFaces +
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "4 3 2 1 -1\n3 0 1 2\n0 0 0 1 0 0 0 1 0 0 0 1\n7 3 1 2 3\n3 0 2 3\n");
  CHECK(mesh.indices == PlyIndices{3, 2, 1, 0, 1, 2, 1, 2, 3, 0, 2, 3});
  CHECK(mesh.left_out.empty());
  CHECK(mesh.parts.size() == 1);
}

TEST_CASE(
    "PLY: faces of fewer than three corners or with vertices that are not finite are left out and counted") {
  const Mesh mesh = ply_mesh(
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 6\n" +
      kPlyFaces +
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\nnan 0 0\n0 1.#INF 0\n0\n1 0\n2 0 1\n3 0 1 3\n4 0 1 2 4\n3 0 1 2\n5 1 0 2 3 0\n");
  CHECK(mesh.indices == PlyIndices{0, 1, 2, 1, 0, 2});
  CHECK(mesh.left_out == PlyStrings{"faces with a vertex that is not finite (4)",
                                    "faces with fewer than three corners (3)",
                                    "vertices that are not finite (2)"});
}

TEST_CASE("PLY: edges are lines, and vertices alone points") {
  const Mesh edges =
      ply_mesh(ply_text(3, "element edge 2\nproperty uchar red\nproperty int vertex2\nproperty int vertex1\n",
                        "9 1 0 9 2 1\n"));
  CHECK(edges.indices == PlyIndices{0, 1, 1, 2});
  REQUIRE(edges.parts.size() == 1);
  CHECK(edges.parts[0].primitive == Primitive::kLines);
  const Mesh cloud = ply_mesh(ply_text(3, "", ""));
  CHECK(cloud.indices == PlyIndices{0, 1, 2});
  REQUIRE(cloud.parts.size() == 1);
  CHECK(cloud.parts[0].primitive == Primitive::kPoints);
}

TEST_CASE("PLY: other elements and what stands behind the last one are left out and counted") {
  const std::string elements =
      "element edge 2\nproperty int vertex1\nproperty float vertex2\nelement camera 1\n"
      "property float view\nproperty list uchar float more\nelement empty 0\nelement face 1\n" +
      kPlyFaces;
  const Mesh mesh = ply_mesh(ply_text(3, elements, "0 1 1 2 0.5 2 7 8 3 0 1 2 \n\r\n 3 0 1\n"));
  CHECK(mesh.indices == PlyIndices{0, 1, 2});
  CHECK(mesh.left_out == PlyStrings{"bytes behind the last element (6)", "edges (2)",
                                    "records of the element \"camera\" (1)"});
  CHECK(ply_mesh(ply_text(3, "element face 1\n" + kPlyFaces, "3 0 1 2 \r\n\n")).left_out.empty());
}
