#include "halfspace/scene/ply_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <system_error>
#include <utility>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/quote.hpp"
#include "halfspace/scene/text.hpp"

namespace halfspace::ply {
namespace {

constexpr std::size_t kMaxProperties = 256;  // of one element

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

/// Cuts the next word off the line; empty at its end.
std::string_view next_word(std::string_view& line) {
  const char* const end = line.data() + line.size();
  const char* const first = skip_all(line.data(), end, kBlank | kLineEnd);
  const char* const last = find_any(first, end, kBlank | kLineEnd);
  line = {last, end};
  return {first, last};
}

class HeaderParser {
 public:
  HeaderParser(std::string_view file, std::string_view name) : name_(name), rest_(file) {
    const std::size_t first = file.find_first_of("\r\n");
    const bool carriage_return = first != std::string_view::npos && !file.substr(first).starts_with("\r\n");
    line_end_ = carriage_return ? file[first] : '\n';
  }

  Header run() {
    to_next_line();
    if (next_word(line_) != "ply" || !next_word(line_).empty()) {
      refuse("does not start with a line \"ply\"; legal: a PLY header");
    }
    for (;;) {
      to_next_line();
      const std::string_view keyword = next_word(line_);
      if (keyword == "end_header") break;
      if (keyword == "format") {
        parse_format();
      } else if (keyword == "element") {
        parse_element();
      } else if (keyword == "property") {
        parse_property();
      } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
        refuse(
            "header line {} starts with {}; legal: format, element, property, comment, obj_info, end_header",
            number_, quote(keyword));
      }
    }
    if (!has_format_) refuse("header has no format line; legal: one");
    header_.body = rest_;
    return std::move(header_);
  }

 private:
  template <typename... Args>
  [[noreturn]] void refuse(fmt::format_string<Args...> text, Args&&... args) const {
    throw InputError(fmt::format("{}: {}", name_, fmt::format(text, std::forward<Args>(args)...)));
  }

  void to_next_line() {
    ++number_;
    const std::size_t end = rest_.find(line_end_);
    if (end == std::string_view::npos) {
      if (number_ == 1) refuse("does not start with a line \"ply\"; legal: a PLY header");
      refuse("header ends without \"end_header\" after {} lines; legal: a whole header", number_);
    }
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
  }

  void parse_format() {
    constexpr std::array<std::pair<std::string_view, Encoding>, 3> kEncodings{
        {{"ascii", Encoding::kAscii},
         {"binary_little_endian", Encoding::kLittleEndian},
         {"binary_big_endian", Encoding::kBigEndian}}};
    const std::string_view word = next_word(line_);
    const auto* const found = std::find_if(kEncodings.begin(), kEncodings.end(),
                                           [&](const auto& encoding) { return encoding.first == word; });
    if (found == kEncodings.end()) {
      refuse("header line {}: format is {}; legal: ascii, binary_little_endian, binary_big_endian", number_,
             quote(word));
    }
    header_.encoding = found->second;
    has_format_ = true;
  }

  void parse_element() {
    Element element;
    element.name = next_word(line_);
    const std::string_view count = next_word(line_);
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (element.name.empty() || error != std::errc() || end != count.data() + count.size() ||
        element.count > std::numeric_limits<std::uint32_t>::max()) {
      refuse("header line {}: element {} has count {}; legal: a name and 0 to {}", number_,
             quote(element.name), quote(count), std::numeric_limits<std::uint32_t>::max());
    }
    header_.elements.push_back(std::move(element));
  }

  void parse_property() {
    if (header_.elements.empty()) {
      refuse("header line {} is a property before any element; legal: after one", number_);
    }
    std::vector<Property>& properties = header_.elements.back().properties;
    if (properties.size() == kMaxProperties) {
      refuse("header line {} is property {} of its element; legal: at most {}", number_, kMaxProperties + 1,
             kMaxProperties);
    }
    Property property;
    std::string_view type = next_word(line_);
    if (type == "list") {
      property.count_type = parse_type(next_word(line_));
      if (is_float(*property.count_type)) {
        refuse("header line {}: list is counted in a floating-point type; legal: an integer type", number_);
      }
      type = next_word(line_);
    }
    property.type = parse_type(type);
    property.name = next_word(line_);
    properties.push_back(std::move(property));
  }

  [[nodiscard]] Type parse_type(std::string_view word) const {
    const auto* const found = std::find_if(kTypeNames.begin(), kTypeNames.end(),
                                           [&](const TypeName& candidate) { return candidate.name == word; });
    if (found == kTypeNames.end()) {
      refuse("header line {}: type is {}; legal: char to double, int8 to float64", number_, quote(word));
    }
    return found->type;
  }

  std::string_view name_;
  std::string_view rest_;
  char line_end_ = '\n';
  std::string_view line_;  // what is left of it
  std::uint64_t number_ = 0;
  Header header_;
  bool has_format_ = false;
};

}  // namespace

std::size_t Element::find(std::string_view property, bool list) const {
  const auto found = std::find_if(properties.begin(), properties.end(), [&](const Property& candidate) {
    return candidate.name == property && candidate.count_type.has_value() == list;
  });
  return static_cast<std::size_t>(found - properties.begin());
}

Header parse_header(std::string_view file, std::string_view name) { return HeaderParser(file, name).run(); }

}  // namespace halfspace::ply
