// Wavefront OBJ by tinyobjloader, behind a check of what it would pass over (docs/adr/0003-mesh-readers.md).
#define TINYOBJLOADER_IMPLEMENTATION
#define TINYOBJLOADER_USE_DOUBLE
#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <istream>
#include <limits>
#include <streambuf>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/mesh_builder.hpp"
#include "halfspace/scene/mesh_formats.hpp"
#include "halfspace/scene/quote.hpp"

namespace halfspace {
namespace {

constexpr std::string_view kBlank = " \t";

/// Cuts the next word off the line; empty at its end.
std::string_view next_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlank));
  line.remove_prefix(word.size());
  return word;
}

/// Reads all of `word` as a number.
template <typename T>
bool to_number(std::string_view word, T& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

/// Finds the statements tinyobjloader would read as something else: it takes a malformed number for 0, cuts
/// an index to 32 bits, ends a line at a zero byte and does not know continued lines.
class ObjCheck {
 public:
  ObjCheck(std::string_view name, MeshBuilder& builder) : name_(name), builder_(builder) {}

  void run(std::string_view text) {
    while (!text.empty()) {
      ++line_;
      const std::size_t end = text.find_first_of("\r\n");
      check_line(text.substr(0, end));
      if (end == std::string_view::npos) break;
      text.remove_prefix(text.substr(end).starts_with("\r\n") ? end + 2 : end + 1);
    }
  }

 private:
  template <typename... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> text, Args&&... args) const {
    throw InputError(
        fmt::format("{}: line {}: {}", name_, line_, fmt::format(text, std::forward<Args>(args)...)));
  }

  void check_line(std::string_view line) {
    if (const std::size_t at = line.find('\0'); at != std::string_view::npos) {
      fail("character {} is a zero byte; legal: text", at);
    }
    const std::string_view keyword = next_word(line);
    if (keyword.starts_with('#')) return;
    if (line.ends_with('\\')) fail("ends in \\; legal: a statement on one line");
    if (keyword == "v") check_vertex(line);
    if (keyword == "f") check_face(line);
    if (keyword == "p" || keyword == "l") builder_.leave_out("points and lines");
  }

  void check_vertex(std::string_view line) {
    builder_.check_room(static_cast<std::uint64_t>(++vertices_), 0);
    for (int i = 0; i < 3; ++i) {
      const std::string_view word = next_word(line);
      double value = 0;
      if (!to_number(word, value) || !std::isfinite(value)) {
        fail("coordinate {} is {}; legal: three finite numbers", i, quote(word));
      }
    }
  }

  void check_face(std::string_view line) {
    std::uint64_t corners = 0;
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
      const std::string_view digits = word.substr(0, word.find('/'));
      std::int32_t index = 0;
      // tinyobjloader takes what follows a third slash for a corner of its own.
      if (!to_number(digits, index) || index == 0 || std::count(word.begin(), word.end(), '/') > 2) {
        fail("corner {} is {}; legal: v, v/t, v//n or v/t/n with v from 1, or from -1 down", corners,
             quote(word));
      }
      if (std::int64_t{index} > vertices_ || -std::int64_t{index} > vertices_) {
        fail("corner {} is vertex {}; legal: 1 to {}, the vertices up to here", corners, index, vertices_);
      }
      ++corners;
    }
    if (corners < 3) return;
    triangles_ += corners - 2;
    builder_.check_room(0, triangles_);
  }

  std::string_view name_;
  std::uint64_t line_ = 0;
  std::int64_t vertices_ = 0;
  std::uint64_t triangles_ = 0;
  MeshBuilder& builder_;
};

/// Text as a stream to read from, without a copy.
class TextBuffer : public std::streambuf {
 public:
  explicit TextBuffer(std::string_view text) {
    char* const begin = const_cast<char*>(text.data());  // the interface's; nothing is written
    setg(begin, begin, begin + text.size());
  }
};

/// What the callbacks build.
struct Builder {
  std::string_view name;
  MeshBuilder& mesh;
  std::string material;
  std::vector<std::uint32_t> polygon;
};

void add_vertex(void* user, double x, double y, double z, double /*w*/) {
  static_cast<Builder*>(user)->mesh.add_vertex({x, y, z});
}

void add_face(void* user, tinyobj::index_t* corners, int count) {
  auto& builder = *static_cast<Builder*>(user);
  const auto vertices = std::int64_t{builder.mesh.vertex_count()};
  builder.polygon.clear();
  for (int i = 0; i < count; ++i) {
    const std::int64_t number = corners[i].vertex_index;
    const std::int64_t vertex = number > 0 ? number - 1 : vertices + number;
    if (vertex < 0 || vertex >= vertices) {
      throw InputError(
          fmt::format("{}: a face has vertex {}; legal: 1 to {}", builder.name, number, vertices));
    }
    builder.polygon.push_back(static_cast<std::uint32_t>(vertex));
  }
  builder.mesh.add_face(builder.polygon);
}

void use_material(void* user, const char* material, int /*id*/) {
  auto& builder = *static_cast<Builder*>(user);
  if (builder.material == material) return;
  builder.mesh.end_part(builder.material);
  builder.material = material;
}

}  // namespace

Mesh parse_obj(std::span<const std::byte> bytes, std::string_view name) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  MeshBuilder mesh(name);
  ObjCheck(name, mesh).run(text);
  Builder builder{.name = name, .mesh = mesh, .material = {}, .polygon = {}};

  tinyobj::callback_t callbacks;
  callbacks.vertex_cb = add_vertex;
  callbacks.index_cb = add_face;
  callbacks.usemtl_cb = use_material;
  TextBuffer buffer(text);
  std::istream stream(&buffer);
  std::string error;
  if (!tinyobj::LoadObjWithCallback(stream, callbacks, &builder, nullptr, nullptr, &error)) {
    throw InputError(fmt::format("{}: not read as OBJ; legal: a Wavefront OBJ file", name));
  }
  mesh.end_part(builder.material);
  return std::move(mesh).finish();
}

}  // namespace halfspace
