#include "halfspace/scene/gltf/uri.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

namespace halfspace::gltf {
namespace {

constexpr std::string_view kDataScheme = "data:";

char to_lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same_but_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return to_lower(x) == to_lower(y); });
}

bool is_letter(char c) { return to_lower(c) >= 'a' && to_lower(c) <= 'z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

constexpr std::uint8_t kNoDigit = 64;

/// 0 to 63 for each character, or kNoDigit. The URL-safe digits are taken too.
constexpr std::array<std::uint8_t, 256> base64_digits() {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<std::uint8_t, 256> digits{};
  digits.fill(kNoDigit);
  for (std::size_t i = 0; i < kDigits.size(); ++i) {
    digits[static_cast<unsigned char>(kDigits[i])] = static_cast<std::uint8_t>(i);
  }
  digits['-'] = digits['+'];
  digits['_'] = digits['/'];
  return digits;
}

std::optional<std::vector<std::byte>> decode_base64(std::string_view text) {
  static constexpr std::array kDigits = base64_digits();
  while (text.ends_with('=')) text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::vector<std::byte> bytes(text.size() / 4 * 3 + text.size() % 4 * 3 / 4);
  std::uint32_t bits = 0;
  int count = 0;
  std::size_t size = 0;
  for (const char c : text) {
    const std::uint8_t digit = kDigits[static_cast<unsigned char>(c)];
    if (digit == kNoDigit) return std::nullopt;
    bits = bits << 6 | digit;
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes[size++] = static_cast<std::byte>(bits >> count & 0xFF);
    }
  }
  return bytes;
}

}  // namespace

std::string percent_decode(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned value = 0;
    const char* const digits = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
      out += static_cast<char>(value);
      i += 2;
    } else {
      out += text[i];
    }
  }
  return out;
}

bool is_data_uri(std::string_view uri) {
  return same_but_case(uri.substr(0, kDataScheme.size()), kDataScheme);
}

std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  constexpr std::string_view kMark = ";base64";
  const std::string_view header = uri.substr(0, comma);
  std::string_view data = uri.substr(comma + 1);
  std::string decoded;
  if (data.find('%') != std::string_view::npos) data = decoded = percent_decode(data);
  if (header.size() >= kMark.size() && same_but_case(header.substr(header.size() - kMark.size()), kMark)) {
    return decode_base64(data);
  }
  std::vector<std::byte> bytes(data.size());
  std::transform(data.begin(), data.end(), bytes.begin(), [](char c) { return static_cast<std::byte>(c); });
  return bytes;
}

bool has_scheme(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  if (colon == std::string_view::npos || colon == 0 || !is_letter(uri[0])) return false;
  return std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon),
                     [](char c) { return is_letter(c) || is_digit(c) || c == '+' || c == '-' || c == '.'; });
}

}  // namespace halfspace::gltf
