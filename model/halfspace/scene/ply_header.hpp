/// The header of a PLY file: what its body holds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace halfspace::ply {

enum class Encoding { kAscii, kLittleEndian, kBigEndian };

enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

/// use(T{}) with the C++ type that `type` stands for.
template <typename Use>
constexpr auto with_type(Type type, Use use) {
  switch (type) {
    case Type::kInt8:
      return use(std::int8_t{});
    case Type::kUint8:
      return use(std::uint8_t{});
    case Type::kInt16:
      return use(std::int16_t{});
    case Type::kUint16:
      return use(std::uint16_t{});
    case Type::kInt32:
      return use(std::int32_t{});
    case Type::kUint32:
      return use(std::uint32_t{});
    case Type::kFloat32:
      return use(float{});
    case Type::kFloat64:
      break;
  }
  return use(double{});
}

[[nodiscard]] constexpr std::size_t size_of(Type type) {
  return with_type(type, [](auto value) { return sizeof(value); });
}

[[nodiscard]] constexpr bool is_float(Type type) { return type == Type::kFloat32 || type == Type::kFloat64; }

struct Property {
  std::string name;
  std::optional<Type> count_type;  ///< of a list
  Type type = Type::kFloat32;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;           ///< of records, below 2^32
  std::vector<Property> properties;  ///< at most 256

  /// Where the property is among the properties; their number if there is none, or if it is a list and should
  /// not be, or the other way around.
  [[nodiscard]] std::size_t find(std::string_view property, bool list) const;
};

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::vector<Element> elements;
  std::string_view body;  ///< what follows the header in the file
};

/// Lines end as the first one does: in CR alone, else in LF with or without CR before it. So a body of binary
/// numbers may begin with any byte. Throws InputError.
[[nodiscard]] Header parse_header(std::string_view file, std::string_view name);

}  // namespace halfspace::ply
