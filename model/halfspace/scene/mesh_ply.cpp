// Stanford PLY: ascii and binary of both byte orders (docs/adr/0003-mesh-readers.md says why it is read
// here).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
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

constexpr std::size_t kMaxProperties = 256;  // of one element

enum class Encoding { kAscii, kLittleEndian, kBigEndian };

enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

struct TypeName {
  std::string_view name;
  Type type;
};
constexpr std::array<TypeName, 16> kTypeNames{{{"char", Type::kInt8},
                                               {"uchar", Type::kUint8},
                                               {"short", Type::kInt16},
                                               {"ushort", Type::kUint16},
                                               {"int", Type::kInt32},
                                               {"uint", Type::kUint32},
                                               {"float", Type::kFloat32},
                                               {"double", Type::kFloat64},
                                               {"int8", Type::kInt8},
                                               {"uint8", Type::kUint8},
                                               {"int16", Type::kInt16},
                                               {"uint16", Type::kUint16},
                                               {"int32", Type::kInt32},
                                               {"uint32", Type::kUint32},
                                               {"float32", Type::kFloat32},
                                               {"float64", Type::kFloat64}}};

std::size_t size_of(Type type) {
  switch (type) {
    case Type::kInt8:
    case Type::kUint8:
      return 1;
    case Type::kInt16:
    case Type::kUint16:
      return 2;
    case Type::kInt32:
    case Type::kUint32:
    case Type::kFloat32:
      return 4;
    case Type::kFloat64:
      break;
  }
  return 8;
}

bool is_float(Type type) { return type == Type::kFloat32 || type == Type::kFloat64; }

struct Property {
  std::string name;
  std::optional<Type> count_type;  // of a list
  Type type = Type::kFloat32;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  std::optional<Encoding> encoding;
  std::vector<Element> elements;
};

template <typename... Args>
[[noreturn]] void refuse(std::string_view name, fmt::format_string<Args...> text, Args&&... args) {
  throw InputError(fmt::format("{}: {}", name, fmt::format(text, std::forward<Args>(args)...)));
}

/// Text cut into lines (headers) and words (headers, ascii bodies).
class Text {
 public:
  explicit Text(std::string_view text) : text_(text) {}

  [[nodiscard]] std::string_view rest() const { return text_; }

  /// The line without its end; nothing when there is no further line end.
  std::optional<std::string_view> next_line() {
    const std::size_t end = text_.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    std::string_view line = text_.substr(0, end);
    text_.remove_prefix(end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  std::string_view next_word() {
    constexpr std::string_view kSpace = " \t\r\n";
    text_.remove_prefix(std::min(text_.find_first_not_of(kSpace), text_.size()));
    const std::string_view word = text_.substr(0, text_.find_first_of(kSpace));
    text_.remove_prefix(word.size());
    return word;
  }

 private:
  std::string_view text_;
};

class HeaderParser {
 public:
  HeaderParser(std::string_view name, std::string_view text) : name_(name), text_(text) {}

  Header run() {
    if (text_.next_line() != "ply") refuse(name_, "does not start with a line \"ply\"; legal: a PLY header");
    for (;;) {
      ++line_;
      const std::optional<std::string_view> line = text_.next_line();
      if (!line)
        refuse(name_, "header ends without \"end_header\" after {} lines; legal: a whole header", line_);
      Text words(*line);
      const std::string_view keyword = words.next_word();
      if (keyword == "end_header") break;
      if (keyword == "format") {
        parse_format(words);
      } else if (keyword == "element") {
        parse_element(words);
      } else if (keyword == "property") {
        parse_property(words);
      } else if (keyword != "comment" && keyword != "obj_info") {
        refuse(
            name_,
            "header line {} starts with {}; legal: format, element, property, comment, obj_info, end_header",
            line_, quote(keyword));
      }
    }
    if (!header_.encoding) refuse(name_, "header has no format line; legal: one");
    return std::move(header_);
  }

  [[nodiscard]] std::string_view body() const { return text_.rest(); }

 private:
  void parse_format(Text& words) {
    const std::string_view encoding = words.next_word();
    if (encoding == "ascii") {
      header_.encoding = Encoding::kAscii;
    } else if (encoding == "binary_little_endian") {
      header_.encoding = Encoding::kLittleEndian;
    } else if (encoding == "binary_big_endian") {
      header_.encoding = Encoding::kBigEndian;
    } else {
      refuse(name_, "header line {}: format is {}; legal: ascii, binary_little_endian, binary_big_endian",
             line_, quote(encoding));
    }
  }

  void parse_element(Text& words) {
    Element element;
    element.name = words.next_word();
    const std::string_view count = words.next_word();
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (element.name.empty() || error != std::errc() || end != count.data() + count.size() ||
        element.count > std::numeric_limits<std::uint32_t>::max()) {
      refuse(name_, "header line {}: element {} has count {}; legal: a name and 0 to {}", line_,
             quote(element.name), quote(count), std::numeric_limits<std::uint32_t>::max());
    }
    header_.elements.push_back(std::move(element));
  }

  void parse_property(Text& words) {
    if (header_.elements.empty()) {
      refuse(name_, "header line {} is a property before any element; legal: after one", line_);
    }
    std::vector<Property>& properties = header_.elements.back().properties;
    if (properties.size() == kMaxProperties) {
      refuse(name_, "header line {} is property {} of its element; legal: at most {}", line_,
             kMaxProperties + 1, kMaxProperties);
    }
    Property property;
    std::string_view type = words.next_word();
    if (type == "list") {
      property.count_type = parse_type(words.next_word());
      if (is_float(*property.count_type)) {
        refuse(name_, "header line {}: list is counted in a floating-point type; legal: an integer type",
               line_);
      }
      type = words.next_word();
    }
    property.type = parse_type(type);
    property.name = words.next_word();
    properties.push_back(std::move(property));
  }

  Type parse_type(std::string_view word) {
    const auto* const found = std::find_if(kTypeNames.begin(), kTypeNames.end(),
                                           [&](const TypeName& candidate) { return candidate.name == word; });
    if (found == kTypeNames.end()) {
      refuse(name_, "header line {}: type is {}; legal: char to double, int8 to float64", line_, quote(word));
    }
    return found->type;
  }

  std::string_view name_;
  Text text_;
  std::uint64_t line_ = 1;
  Header header_;
};

/// The numbers of the body, one after the other.
class Body {
 public:
  Body(std::string_view name, Encoding encoding, std::string_view bytes)
      : name_(name), encoding_(encoding), text_(bytes), bytes_(bytes) {}

  /// Throws unless `count` records of these properties can be in what is left: the check before any
  /// allocation.
  void check_room(const Element& element) const {
    std::uint64_t least = 0;
    for (const Property& property : element.properties) {
      least += encoding_ == Encoding::kAscii ? 2 : size_of(property.count_type.value_or(property.type));
    }
    // The last number of a text needs no separator.
    const std::uint64_t left = encoding_ == Encoding::kAscii ? text_.rest().size() + 1 : bytes_.size();
    if (element.count * least > left) {
      refuse(name_,
             "element {} has {} records of {} bytes or more, the file {} bytes for them; legal: all within",
             quote(element.name), element.count, least, left);
    }
  }

  double next(Type type) { return encoding_ == Encoding::kAscii ? next_text() : next_binary(type); }

  /// An integer that may only be `legal_low` to `legal_high`.
  std::int64_t next_integer(Type type, const Property& property, std::int64_t low, std::int64_t high) {
    const double value = next(type);
    if (!(value >= static_cast<double>(low) && value <= static_cast<double>(high)) ||
        value != std::floor(value)) {
      refuse(name_, "property {} has the value {}; legal: an integer from {} to {}", quote(property.name),
             value, low, high);
    }
    return static_cast<std::int64_t>(value);
  }

 private:
  double next_text() {
    std::string_view word = text_.next_word();
    const std::string_view whole = word;
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (whole.empty()) refuse(name_, "body ends too early; legal: all the records of the header");
    if (error != std::errc() || end != word.data() + word.size()) {
      refuse(name_, "body has {}; legal: a number", quote(whole));
    }
    return value;
  }

  template <typename T>
  double take() {
    if (bytes_.size() < sizeof(T)) refuse(name_, "body ends too early; legal: all the records of the header");
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), bytes_.data(), sizeof(T));
    bytes_.remove_prefix(sizeof(T));
    const bool little = encoding_ == Encoding::kLittleEndian;
    if (little != (std::endian::native == std::endian::little)) std::reverse(raw.begin(), raw.end());
    return static_cast<double>(std::bit_cast<T>(raw));
  }

  double next_binary(Type type) {
    switch (type) {
      case Type::kInt8:
        return take<std::int8_t>();
      case Type::kUint8:
        return take<std::uint8_t>();
      case Type::kInt16:
        return take<std::int16_t>();
      case Type::kUint16:
        return take<std::uint16_t>();
      case Type::kInt32:
        return take<std::int32_t>();
      case Type::kUint32:
        return take<std::uint32_t>();
      case Type::kFloat32:
        return take<float>();
      case Type::kFloat64:
        break;
    }
    return take<double>();
  }

  std::string_view name_;
  Encoding encoding_;
  Text text_;               // what is left of an ascii body
  std::string_view bytes_;  // what is left of a binary body
};

/// Faces as they stand in the file: they may come before the vertices.
struct Faces {
  std::vector<std::uint32_t> sizes;
  std::vector<std::uint32_t> corners;
};

class BodyParser {
 public:
  BodyParser(std::string_view name, const Header& header, std::string_view body)
      : name_(name), header_(header), body_(name, *header.encoding, body), builder_(name) {}

  Mesh run() {
    for (const Element& element : header_.elements) {
      if (element.properties.empty() && element.count > 0) {
        refuse(name_, "element {} has no property; legal: one or more", quote(element.name));
      }
      body_.check_room(element);
      if (element.name == "vertex") {
        parse_vertices(element);
      } else if (element.name == "face") {
        parse_faces(element);
      } else {
        if (element.name == "edge") builder_.leave_out("edges", element.count);
        pass_over(element);
      }
    }
    cut_up_faces();
    builder_.end_part("face");
    return std::move(builder_).finish();
  }

 private:
  /// A list's count, checked against the size of a mesh (the body's end is met long before memory is).
  std::uint32_t next_count(const Property& property) {
    return static_cast<std::uint32_t>(
        body_.next_integer(*property.count_type, property, 0, std::numeric_limits<std::int32_t>::max()));
  }

  void pass_over(const Property& property) {
    const std::uint32_t count = property.count_type ? next_count(property) : 1;
    for (std::uint32_t i = 0; i < count; ++i) body_.next(property.type);
  }

  void pass_over(const Element& element) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const Property& property : element.properties) pass_over(property);
    }
  }

  static std::size_t find(const Element& element, std::string_view property_name, bool list) {
    const auto found =
        std::find_if(element.properties.begin(), element.properties.end(), [&](const Property& property) {
          return property.name == property_name && property.count_type.has_value() == list;
        });
    return static_cast<std::size_t>(found - element.properties.begin());
  }

  void parse_vertices(const Element& element) {
    if (builder_.vertex_count() > 0) refuse(name_, "header has a second element \"vertex\"; legal: one");
    const std::array<std::size_t, 3> axes{find(element, "x", false), find(element, "y", false),
                                          find(element, "z", false)};
    if (*std::max_element(axes.begin(), axes.end()) == element.properties.size()) {
      refuse(name_, "element \"vertex\" lacks x, y or z; legal: all three, not lists");
    }
    builder_.reserve_vertices(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      glm::dvec3 position{0};
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const auto* const axis = std::find(axes.begin(), axes.end(), p);
        if (axis == axes.end()) {
          pass_over(element.properties[p]);
        } else {
          position[static_cast<int>(axis - axes.begin())] = body_.next(element.properties[p].type);
        }
      }
      builder_.add_vertex(position);
    }
  }

  void parse_faces(const Element& element) {
    std::size_t corners = find(element, "vertex_indices", true);
    if (corners == element.properties.size()) corners = find(element, "vertex_index", true);
    if (corners == element.properties.size() || is_float(element.properties[corners].type)) {
      refuse(name_, "element \"face\" has no list of integers vertex_indices or vertex_index; legal: one");
    }
    std::uint64_t triangles = faces_.corners.size();  // an upper bound, for a second element "face"
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const Property& property = element.properties[p];
        if (p != corners) {
          pass_over(property);
          continue;
        }
        const std::uint32_t count = next_count(property);
        if (count > 2) triangles += count - 2;
        builder_.check_room(0, triangles);
        faces_.sizes.push_back(count);
        for (std::uint32_t c = 0; c < count; ++c) {
          faces_.corners.push_back(static_cast<std::uint32_t>(
              body_.next_integer(property.type, property, 0, std::numeric_limits<std::uint32_t>::max())));
        }
      }
    }
  }

  void cut_up_faces() {
    std::size_t first = 0;
    for (std::size_t i = 0; i < faces_.sizes.size(); ++i) {
      const auto polygon = std::span(faces_.corners).subspan(first, faces_.sizes[i]);
      first += polygon.size();
      for (const std::uint32_t corner : polygon) {
        if (corner >= builder_.vertex_count()) {
          refuse(name_, "face {} has vertex {}; legal: below {}", i, corner, builder_.vertex_count());
        }
      }
      builder_.add_face(polygon);
    }
  }

  std::string_view name_;
  const Header& header_;
  Body body_;
  MeshBuilder builder_;
  Faces faces_;
};

}  // namespace

Mesh parse_ply(std::span<const std::byte> bytes, std::string_view name) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  HeaderParser parser(name, text);
  const Header header = parser.run();
  return BodyParser(name, header, parser.body()).run();
}

}  // namespace halfspace
