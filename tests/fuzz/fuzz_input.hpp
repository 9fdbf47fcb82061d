/// What every fuzz target does with a reader: it must return a value or throw an InputError of one line.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <string_view>

#include "halfspace/numerics/error.hpp"

namespace halfspace::fuzz {

inline std::span<const std::byte> as_bytes(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const std::byte*>(data), size};
}

/// read()'s value, or nothing when it threw InputError. Anything else ends the program.
template <typename Read>
auto read_or_reject(Read read) -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const InputError& error) {
    const std::string_view what = error.what();
    const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7F; };
    if (what.empty() || std::any_of(what.begin(), what.end(), is_control)) std::abort();
    return std::nullopt;
  }
}

}  // namespace halfspace::fuzz
