/// Fields of packed packets, for people.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>

#include "halfspace/units/packing.hpp"

namespace halfspace {

/// "0x1f" for masks and the like, "-3" where the field is signed.
inline std::string field_text(const FieldSlot& field, std::span<const std::uint32_t> words) {
  if (field.width <= 64) {
    const std::uint64_t bits = extract_bits(words, field.lsb, field.width);
    return field.sign == Sign::kSigned ? fmt::format("{}", sign_extend(bits, field.width))
                                       : fmt::format("{:#x}", bits);
  }
  std::string text = "0x";
  for (int done = (field.width - 1) / 32 * 32; done >= 0; done -= 32) {
    text += fmt::format("{:08x}", extract_bits(words, field.lsb + done, std::min(32, field.width - done)));
  }
  return text;
}

/// The first field that differs: "field e.1.: model 0x3, RTL 0x1", with these names for the two sides; empty
/// where none does.
template <class Fields>
std::string first_difference(const Fields& fields, const char* ours, std::span<const std::uint32_t> want,
                             const char* theirs, std::span<const std::uint32_t> got) {
  for (const FieldSlot& field : fields) {
    const std::string a = field_text(field, want);
    const std::string b = field_text(field, got);
    if (a != b) {
      return fmt::format("field {}: {} {}, {} {}", field.name, ours, a, theirs, b);
    }
  }
  return {};
}

}  // namespace halfspace
