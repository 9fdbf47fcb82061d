/// The numbers in the body of a PLY file, one after the other. Each class is a place in a body; a copy stays
/// where it is. All throw InputError at the body's end.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/ply_header.hpp"
#include "halfspace/scene/quote.hpp"
#include "halfspace/scene/text.hpp"

namespace halfspace::ply {

template <typename... Args>
[[noreturn]] void refuse(std::string_view name, fmt::format_string<Args...> text, Args&&... args) {
  throw InputError(fmt::format("{}: {}", name, fmt::format(text, std::forward<Args>(args)...)));
}

[[noreturn]] inline void refuse_end(std::string_view name) {
  refuse(name, "body ends too early; legal: all the records of the header");
}

/// Words between blanks and line ends. Where lines end does not matter, and the types of the header neither:
/// a number is what its digits say.
class TextNumbers {
 public:
  TextNumbers(std::string_view name, std::string_view body) : name_(name), rest_(body) {}

  /// The bytes left, without blanks and line ends before the next number.
  std::uint64_t left() {
    to_word();
    return rest_.size();
  }

  /// The least bytes that a value of the type takes: a digit and a blank, which the last value goes without.
  static std::uint64_t least_size(Type /*type*/) { return 2; }
  [[nodiscard]] std::uint64_t room() const { return rest_.size() + 1; }

  double next_real(Type /*type*/) {
    to_word();
    double value = 0;
    take(read_number(rest_, value));
    return value;
  }

  /// Of the property, for errors.
  std::int64_t next_integer(Type type, std::string_view property) {
    to_word();
    std::int64_t value = 0;
    const auto [stop, error] = std::from_chars(rest_.data(), end(), value);
    const auto size = static_cast<std::size_t>(stop - rest_.data());
    if (error == std::errc() && is_word_end(size)) {
      rest_.remove_prefix(size);
      return value;
    }
    // "+1", "3.0" and "1e3" are integers, too.
    constexpr double kLargest = 9007199254740992.;  // below, doubles are exact
    const double real = next_real(type);
    if (!(std::abs(real) < kLargest) || real != std::floor(real)) {
      refuse(name_, "property {} has the value {}; legal: an integer", quote(property), real);
    }
    return static_cast<std::int64_t>(real);
  }

  void skip(Type type, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) next_real(type);
  }

 private:
  static constexpr int kSpace = kBlank | kLineEnd;

  [[nodiscard]] const char* end() const { return rest_.data() + rest_.size(); }
  [[nodiscard]] bool is_word_end(std::size_t at) const { return at == rest_.size() || is(rest_[at], kSpace); }

  void to_word() { rest_ = {skip_all(rest_.data(), end(), kSpace), end()}; }

  /// Moves behind a number of `size` characters.
  void take(std::size_t size) {
    if (rest_.empty()) refuse_end(name_);
    if (size == 0 || !is_word_end(size)) {
      refuse(name_, "body has {}; legal: a number",
             quote({rest_.data(), find_any(rest_.data(), end(), kSpace)}));
    }
    rest_.remove_prefix(size);
  }

  std::string_view name_;
  std::string_view rest_;
};

template <std::endian Order>
class BinaryNumbers {
 public:
  BinaryNumbers(std::string_view name, std::string_view body) : name_(name), rest_(body) {}

  [[nodiscard]] std::uint64_t left() const { return rest_.size(); }

  static std::uint64_t least_size(Type type) { return size_of(type); }
  [[nodiscard]] std::uint64_t room() const { return rest_.size(); }

  double next_real(Type type) {
    return with_type(
        type, [this](auto value) { return static_cast<double>(this->template take<decltype(value)>()); });
  }

  /// The type is one of integers.
  std::int64_t next_integer(Type type, std::string_view /*property*/) {
    return with_type(type, [this](auto value) -> std::int64_t {
      if constexpr (std::is_integral_v<decltype(value)>) {
        return this->template take<decltype(value)>();
      } else {
        return 0;
      }
    });
  }

  void skip(Type type, std::uint64_t count) {
    if (count > rest_.size() / size_of(type)) refuse_end(name_);
    rest_.remove_prefix(count * size_of(type));
  }

 private:
  template <typename T>
  T take() {
    if (rest_.size() < sizeof(T)) refuse_end(name_);
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
    if constexpr (Order != std::endian::native) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
  }

  std::string_view name_;
  std::string_view rest_;
};

}  // namespace halfspace::ply
