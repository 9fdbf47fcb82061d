/// Text from outside, made fit for an error message.
#pragma once

#include <string>
#include <string_view>

namespace halfspace {

/// The text with '?' for each control character, so that it stays on one line.
[[nodiscard]] std::string printable(std::string_view text);

/// The text in double quotes, printable and cut to 60 characters.
[[nodiscard]] std::string quote(std::string_view text);

}  // namespace halfspace
