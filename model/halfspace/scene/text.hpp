/// What the readers of text files share: characters, numbers, encodings.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace halfspace {

[[nodiscard]] constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

[[nodiscard]] constexpr bool is_line_end(char c) { return c == '\n' || c == '\r'; }

/// The bytes as text, without a byte order mark of UTF-8. Throws InputError for text of UTF-16 or UTF-32 that
/// its mark gives away.
[[nodiscard]] std::string_view text_of(std::span<const std::byte> bytes, std::string_view name);

/// Reads the number that `text` begins with, decimal and with a point in every locale, rounded to the nearest
/// double. A number beyond all doubles is infinite. What programs write for numbers that are not finite is
/// read, too: "inf", "-nan(ind)", "1.#QNAN". Returns how many characters that are; 0 when it is no number.
[[nodiscard]] std::size_t read_number(std::string_view text, double& value);

}  // namespace halfspace
