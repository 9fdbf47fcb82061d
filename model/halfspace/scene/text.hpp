/// What the readers of text files share: characters, numbers, encodings.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace halfspace {

/// What a character is to readers: a set of these.
enum Character : std::uint8_t { kBlank = 1, kLineEnd = 2, kBackslash = 4, kHash = 8, kSlash = 16 };

inline constexpr std::array<std::uint8_t, 256> kCharacters = [] {
  std::array<std::uint8_t, 256> out{};
  for (const unsigned char c : {' ', '\t', '\v', '\f'}) out[c] = kBlank;
  for (const unsigned char c : {'\n', '\r'}) out[c] = kLineEnd;
  out['\\'] = kBackslash;
  out['#'] = kHash;
  out['/'] = kSlash;
  return out;
}();

/// Whether the character is one of the set.
[[nodiscard]] constexpr bool is(char c, int characters) {
  return (kCharacters[static_cast<unsigned char>(c)] & characters) != 0;
}

/// The first character of the set from `begin` on, or `end`.
[[nodiscard]] constexpr const char* find_any(const char* begin, const char* end, int characters) {
  while (begin != end && !is(*begin, characters)) ++begin;
  return begin;
}

/// The first character that is none of the set from `begin` on, or `end`.
[[nodiscard]] constexpr const char* skip_all(const char* begin, const char* end, int characters) {
  while (begin != end && is(*begin, characters)) ++begin;
  return begin;
}

/// The bytes as text, without a byte order mark of UTF-8. Throws InputError for text of UTF-16 or UTF-32 that
/// its mark gives away.
[[nodiscard]] std::string_view text_of(std::span<const std::byte> bytes, std::string_view name);

/// Reads the number that `text` begins with, decimal and with a point in every locale, rounded to the nearest
/// double. A number beyond all doubles is infinite. What programs write for numbers that are not finite is
/// read, too: "inf", "-nan(ind)", "1.#QNAN". Returns how many characters that are; 0 when it is no number.
[[nodiscard]] std::size_t read_number(std::string_view text, double& value);

}  // namespace halfspace
