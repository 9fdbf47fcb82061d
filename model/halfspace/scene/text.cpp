#include "halfspace/scene/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <system_error>

#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Whether a number that is not near any double is too large, not too small: the sign of its exponent, were
/// it written with one digit before the point.
bool is_too_large(std::string_view number) {
  const std::size_t mark = std::min(number.find_first_of("eE"), number.size());
  const std::string_view digits = number.substr(0, mark);
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::size_t first = digits.find_first_of("123456789");
  number.remove_prefix(mark);
  if (!number.empty()) number.remove_prefix(1);
  if (number.starts_with('+')) number.remove_prefix(1);
  double exponent = 0;
  if (std::from_chars(number.data(), number.data() + number.size(), exponent).ec ==
      std::errc::result_out_of_range) {
    exponent = number.starts_with('-') ? -kInfinity : kInfinity;
  }
  return exponent + static_cast<double>(point) - static_cast<double>(first) > 0;
}

/// The length of "#QNAN", "#IND00", "#INF" and the like, which the C library of Microsoft wrote behind "1."
/// (rounded like digits: "#J" and "#IO" are what fewer decimals leave of "#INF"); 0 when it is not there.
std::size_t not_finite_tail(std::string_view text) {
  const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
  if (text.size() < 2 || text[0] != '#' || !is_capital(text[1])) return 0;
  std::size_t size = 2;
  while (size < text.size() && is_capital(text[size])) ++size;
  while (size < text.size() && text[size] == '0') ++size;
  return size;
}

}  // namespace

std::string_view text_of(std::span<const std::byte> bytes, std::string_view name) {
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF") ||
      text.starts_with(std::string_view("\0\0\xFE\xFF", 4))) {
    throw InputError(
        fmt::format("{}: byte order mark is that of UTF-16 or UTF-32; legal: UTF-8, or none", name));
  }
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

std::size_t read_number(std::string_view text, double& value) {
  const char* const begin = text.data() + (text.starts_with('+') && !text.starts_with("+-") ? 1 : 0);
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error == std::errc::invalid_argument) return 0;
  const auto size = static_cast<std::size_t>(stop - text.data());
  if (error == std::errc::result_out_of_range) {
    const bool negative = *begin == '-';
    const double size_of_it = is_too_large({begin, stop}) ? kInfinity : 0.;
    value = negative ? -size_of_it : size_of_it;
  }
  if (stop != end && *stop == '#' && stop[-1] == '.') {
    if (const std::size_t tail = not_finite_tail(text.substr(size)); tail > 0) {
      value = std::numeric_limits<double>::quiet_NaN();
      return size + tail;
    }
  }
  return size;
}

}  // namespace halfspace
