// Stanford PLY: ascii and binary of both byte orders (docs/adr/0003-mesh-readers.md says why it is read
// here).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "halfspace/scene/mesh_attributes.hpp"
#include "halfspace/scene/mesh_builder.hpp"
#include "halfspace/scene/mesh_formats.hpp"
#include "halfspace/scene/ply_attributes.hpp"
#include "halfspace/scene/ply_header.hpp"
#include "halfspace/scene/ply_numbers.hpp"
#include "halfspace/scene/quote.hpp"
#include "halfspace/scene/text.hpp"

namespace halfspace {
namespace ply {
namespace {

/// Triangles of a strip: each corner from the third on makes one with the two before it, and every second one
/// is turned around, so that all wind the same way.
class Strip {
 public:
  explicit Strip(MeshBuilder& builder) : builder_(builder) {}

  void add(std::uint32_t corner) {
    last_ = {last_[1], last_[2], corner};
    if (++length_ < 3) return;
    std::array<std::uint32_t, 3> triangle = last_;
    if (length_ % 2 == 0) std::swap(triangle[0], triangle[1]);
    builder_.add_face(triangle);
  }

  /// A strip of one or two corners is a face of so many.
  void end() {
    if (length_ == 1 || length_ == 2) builder_.add_face(std::span(last_).last(length_));
    length_ = 0;
  }

 private:
  MeshBuilder& builder_;
  std::array<std::uint32_t, 3> last_{};
  std::size_t length_ = 0;
};

template <typename Numbers>
class BodyParser {
 public:
  BodyParser(std::string_view name, const Header& header, MeshContent content)
      : name_(name), header_(header), content_(content), numbers_(name, header.body), builder_(name) {}

  Mesh run() {
    for (const Element& element : header_.elements) parse_element(element);
    parse_waiting();
    if (const std::uint64_t left = numbers_.left(); left > 0) {
      builder_.leave_out("bytes behind the last element", left);
    }
    add_cloud();
    builder_.end_part("face");
    Mesh mesh = std::move(builder_).finish();
    std::move(attributes_).finish(mesh);
    return mesh;
  }

 private:
  void parse_element(const Element& element) {
    if (element.properties.empty() && element.count > 0) {
      refuse(name_, "element {} has no property; legal: one or more", quote(element.name));
    }
    check_room(element);
    if (element.name == "vertex") {
      parse_vertices(element);
      parse_waiting();
    } else if (!is_drawn(element)) {
      pass_over(element);
      leave_out(element);
    } else if (builder_.vertex_count() > 0) {
      parse_drawn(element);
    } else {
      waiting_.emplace_back(&element, numbers_);
      pass_over(element);
    }
  }

  /// Throws unless so many records of these properties can be in what is left: the check before any
  /// allocation.
  void check_room(const Element& element) const {
    std::uint64_t least = 0;
    for (const Property& property : element.properties) {
      least += Numbers::least_size(property.count_type.value_or(property.type));
    }
    if (element.count * least > numbers_.room()) {
      refuse(name_,
             "element {} has {} records of {} bytes or more, the file {} bytes for them; legal: all within",
             quote(element.name), element.count, least, numbers_.room());
    }
  }

  void leave_out(const Element& element) {
    if (element.name == "edge") return builder_.leave_out("edges", element.count);
    builder_.leave_out(fmt::format("records of the element {}", quote(element.name)), element.count);
  }

  void pass_over(const Element& element) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const Property& property : element.properties) pass_over(property);
    }
  }

  void pass_over(const Property& property) {
    numbers_.skip(property.type, property.count_type ? next_count(property) : 1);
  }

  /// A list's count; the body's end is met long before memory is.
  std::uint32_t next_count(const Property& property) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
    const std::int64_t count = numbers_.next_integer(*property.count_type, property.name);
    if (count < 0 || count > kMost) {
      refuse(name_, "property {} is a list of {} values; legal: 0 to {}", quote(property.name), count, kMost);
    }
    return static_cast<std::uint32_t>(count);
  }

  void parse_vertices(const Element& element) {
    if (builder_.vertex_count() > 0) refuse(name_, "header has a second element \"vertex\"; legal: one");
    const std::array<std::size_t, 3> axes{element.find("x", false), element.find("y", false),
                                          element.find("z", false)};
    if (*std::max_element(axes.begin(), axes.end()) == element.properties.size()) {
      refuse(name_, "element \"vertex\" lacks x, y or z; legal: all three, not lists");
    }
    builder_.reserve_vertices(element.count);
    std::optional<VertexAttributes> attributes;
    if (content_ == MeshContent::kAttributes) attributes.emplace(element, attributes_);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      glm::dvec3 position{0};
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const auto* const axis = std::find(axes.begin(), axes.end(), p);
        if (axis != axes.end()) {
          position[static_cast<int>(axis - axes.begin())] = numbers_.next_real(element.properties[p].type);
        } else if (attributes && attributes->wants(p)) {
          attributes->take(p, numbers_.next_real(element.properties[p].type));
        } else {
          pass_over(element.properties[p]);
        }
      }
      if (attributes) attributes->store(builder_.vertex_count());
      builder_.add_vertex(position);
    }
  }

  /// The faces that stood before the vertices.
  void parse_waiting() {
    const Numbers here = numbers_;
    for (const auto& [element, begin] : std::exchange(waiting_, {})) {
      numbers_ = begin;
      parse_drawn(*element);
    }
    numbers_ = here;
  }

  /// Edges have two vertices, which are integers.
  [[nodiscard]] static bool has_ends(const Element& edge) {
    return std::ranges::all_of(std::array{"vertex1", "vertex2"}, [&](const char* end) {
      const std::size_t at = edge.find(end, false);
      return at != edge.properties.size() && !is_float(edge.properties[at].type);
    });
  }

  [[nodiscard]] static bool is_drawn(const Element& element) {
    return element.name == "face" || element.name == "tristrips" ||
           (element.name == "edge" && has_ends(element));
  }

  void parse_drawn(const Element& element) {
    if (element.name == "edge") {
      parse_edges(element);
    } else {
      parse_faces(element);
    }
  }

  void parse_edges(const Element& element) {
    const std::array<std::size_t, 2> at{element.find("vertex1", false), element.find("vertex2", false)};
    for (std::uint64_t i = 0; i < element.count; ++i) {
      std::array<std::uint32_t, 2> ends{};
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const Property& property = element.properties[p];
        if (p == at[0] || p == at[1]) {
          ends[p == at[0] ? 0 : 1] =
              to_vertex(numbers_.next_integer(property.type, property.name), "edge", i);
        } else {
          pass_over(property);
        }
      }
      builder_.add_line(ends[0], ends[1]);
    }
  }

  /// A file of vertices alone is a cloud of points.
  void add_cloud() {
    const auto is_cloud = std::ranges::none_of(header_.elements, [](const Element& element) {
      return element.name == "face" || element.name == "tristrips" || element.name == "edge";
    });
    for (std::uint32_t i = 0; is_cloud && i < builder_.vertex_count(); ++i) builder_.add_point(i);
  }

  /// Of an element "face" or "tristrips".
  void parse_faces(const Element& element) {
    std::size_t corners = element.find("vertex_indices", true);
    if (corners == element.properties.size()) corners = element.find("vertex_index", true);
    if (corners == element.properties.size() || is_float(element.properties[corners].type)) {
      refuse(name_, "element {} has no list of integers vertex_indices or vertex_index; legal: one",
             quote(element.name));
    }
    const bool strips = element.name == "tristrips";
    if (!strips) builder_.reserve_triangles(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        if (p != corners) {
          pass_over(element.properties[p]);
        } else if (strips) {
          parse_strips(element.properties[p], i);
        } else {
          parse_face(element.properties[p], i);
        }
      }
    }
  }

  void parse_face(const Property& property, std::uint64_t record) {
    const std::uint32_t count = next_count(property);
    if (count > 2) builder_.check_room(0, count - 2);
    corners_.clear();
    corners_.reserve(std::min<std::uint64_t>(count, numbers_.room()));
    for (std::uint32_t c = 0; c < count; ++c) {
      corners_.push_back(to_vertex(numbers_.next_integer(property.type, property.name), "face", record));
    }
    builder_.add_face(corners_);
  }

  /// The strips of one list, which end at -1.
  void parse_strips(const Property& property, std::uint64_t record) {
    const std::uint32_t count = next_count(property);
    builder_.reserve_triangles(std::min<std::uint64_t>(count, numbers_.room()));
    Strip strip(builder_);
    for (std::uint32_t c = 0; c < count; ++c) {
      const std::int64_t value = numbers_.next_integer(property.type, property.name);
      if (is_strip_end(value, property.type)) {
        strip.end();
      } else {
        strip.add(to_vertex(value, "list of strips", record));
      }
    }
    strip.end();
  }

  /// -1, also as it stands in a type without sign; there it may be a vertex instead.
  [[nodiscard]] bool is_strip_end(std::int64_t value, Type type) const {
    const auto all_ones = (std::int64_t{1} << (8 * size_of(type))) - 1;
    return value == -1 || (value == all_ones && value >= builder_.vertex_count());
  }

  [[nodiscard]] std::uint32_t to_vertex(std::int64_t value, std::string_view what,
                                        std::uint64_t record) const {
    if (value < 0 || value >= builder_.vertex_count()) {
      refuse(name_, "{} {} has vertex {}; legal: below {}", what, record, value, builder_.vertex_count());
    }
    return static_cast<std::uint32_t>(value);
  }

  std::string_view name_;
  const Header& header_;
  MeshContent content_;
  Numbers numbers_;
  MeshBuilder builder_;
  AttributeBuilder attributes_;
  std::vector<std::pair<const Element*, Numbers>>
      waiting_;                         // faces before the vertices, and where they begin
  std::vector<std::uint32_t> corners_;  // of the face that is being read
};

}  // namespace
}  // namespace ply

Mesh parse_ply(std::span<const std::byte> bytes, std::string_view name, MeshContent content) {
  const ply::Header header = ply::parse_header(text_of(bytes, name), name);
  switch (header.encoding) {
    case ply::Encoding::kAscii:
      return ply::BodyParser<ply::TextNumbers>(name, header, content).run();
    case ply::Encoding::kLittleEndian:
      return ply::BodyParser<ply::BinaryNumbers<std::endian::little>>(name, header, content).run();
    case ply::Encoding::kBigEndian:
      break;
  }
  return ply::BodyParser<ply::BinaryNumbers<std::endian::big>>(name, header, content).run();
}

Mesh parse_ply(std::span<const std::byte> bytes, std::string_view name) {
  return parse_ply(bytes, name, MeshContent::kGeometry);
}

}  // namespace halfspace
