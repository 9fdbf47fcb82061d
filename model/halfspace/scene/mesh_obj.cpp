// Wavefront OBJ by tinyobjloader, behind a check of what it would pass over (docs/adr/0003-mesh-readers.md).
#define TINYOBJLOADER_IMPLEMENTATION
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
#include "halfspace/scene/mesh_formats.hpp"
#include "halfspace/scene/quote.hpp"
#include "halfspace/scene/triangulate.hpp"

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
  explicit ObjCheck(std::string_view name) : name_(name) {}

  /// The number of point and line statements.
  std::uint64_t run(std::string_view text) {
    while (!text.empty()) {
      ++line_;
      const std::size_t end = text.find_first_of("\r\n");
      check_line(text.substr(0, end));
      if (end == std::string_view::npos) break;
      text.remove_prefix(text.substr(end).starts_with("\r\n") ? end + 2 : end + 1);
    }
    return skipped_;
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
    if (keyword == "p" || keyword == "l") ++skipped_;
  }

  void check_vertex(std::string_view line) {
    check_mesh_size(name_, ++vertices_, 0);
    for (int i = 0; i < 3; ++i) {
      const std::string_view word = next_word(line);
      double value = 0;
      if (!to_number(word, value) || !(std::abs(value) <= std::numeric_limits<float>::max())) {
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
    if (corners < 3) fail("face has {} corners; legal: 3 or more", corners);
    triangles_ += corners - 2;
    check_mesh_size(name_, 0, triangles_);
  }

  std::string_view name_;
  std::uint64_t line_ = 0;
  std::int64_t vertices_ = 0;
  std::uint64_t triangles_ = 0;
  std::uint64_t skipped_ = 0;
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
  Mesh mesh;
  std::string material;
  std::vector<std::uint32_t> polygon;
};

void add_vertex(void* user, float x, float y, float z, float /*w*/) {
  static_cast<Builder*>(user)->mesh.positions.emplace_back(x, y, z);
}

void add_face(void* user, tinyobj::index_t* corners, int count) {
  auto& builder = *static_cast<Builder*>(user);
  const auto vertices = static_cast<std::int64_t>(builder.mesh.positions.size());
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
  if (!triangulate(builder.polygon, builder.mesh.positions, builder.mesh.indices)) {
    throw InputError(fmt::format("{}: a face that is not convex has {} corners; legal: at most {}",
                                 builder.name, count, kMaxConcaveCorners));
  }
}

void use_material(void* user, const char* material, int /*id*/) {
  auto& builder = *static_cast<Builder*>(user);
  if (builder.material == material) return;
  close_part(builder.mesh, builder.material);
  builder.material = material;
}

}  // namespace

Mesh parse_obj(std::span<const std::byte> bytes, std::string_view name) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  Builder builder;
  builder.name = name;
  builder.mesh.skipped = ObjCheck(name).run(text);

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
  close_part(builder.mesh, builder.material);
  return finish_mesh(std::move(builder.mesh), name);
}

}  // namespace halfspace
