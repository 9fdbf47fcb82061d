// Is the number read that is written, to the last bit?
#include "halfspace/scene/text.hpp"

#include <fmt/format.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

#include "fixture.hpp"

using namespace halfspace;
using namespace halfspace::test;

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

/// The number that is all of `text`, as bits, so that -0 and 0 differ.
std::uint64_t bits_of_number(const std::string& text) {
  double value = -7;
  INFO(text);
  CHECK(read_number(text, value) == text.size());
  return std::bit_cast<std::uint64_t>(value);
}

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

}  // namespace

TEST_CASE("numbers in text: every legal spelling, rounded to the nearest double") {
  const std::pair<std::string, double> cases[] = {
      {"0", 0.0},
      {"-0", -0.0},
      {"-0.0e5", -0.0},
      {"1", 1},
      {"+1", 1},
      {"1.", 1},
      {".5", 0.5},
      {"-.5", -0.5},
      {"+.5e1", 5},
      {"1e5", 100000},
      {"1E+5", 100000},
      {"00012.50", 12.5},
      {"1e-2", 0.01},
      {"388096.123", 388096.123},
      {"0.1000000000000000055511151231257827021181583404541015625", 0.1},
      {"9007199254740993", 9007199254740992.0},                 // a tie: to even
      {"9007199254740993.00000000000001", 9007199254740994.0},  // a trace above it
      {"123456789012345678901234567890", 123456789012345678901234567890.0},
      {"2.2250738585072011e-308", 0x0.fffffffffffffp-1022},  // the largest denormal
      {"4.9e-324", 0x1p-1074},
      {"2e-324", 0.0},
      {"-1e-400", -0.0},
      {"1e-99999999999999999999", 0.0},
      {"0.0000000001e-316", 0.0},
      {"1.7976931348623157e308", std::numeric_limits<double>::max()},
      {"1e309", kInf},
      {"-1e400", -kInf},
      {"1e+99999999999999999999", kInf},
      {"0.001e312", kInf},
      {"12345e305", kInf},
      {std::string(400, '9'), kInf},
      {"-" + std::string(400, '9') + ".5e1", -kInf},
      {std::string(400, '9') + "e-800", 0.0},
      {"0." + std::string(400, '0') + "1", 0.0},
      {"0." + std::string(400, '0') + "1e800", kInf},
      {"0." + std::string(400, '0') + "1e401", 1.0},
  };
  for (const auto& [text, value] : cases) CHECK(bits_of_number(text) == bits(value));
}

TEST_CASE("numbers in text: what programs write for numbers that are not finite") {
  for (const std::string text :
       {"nan",       "NaN",     "NAN",     "-nan",          "+nan",   "nan(ind)",  "-nan(ind)",
        "nan(snan)", "inf",     "-inf",    "+inf",          "INF",    "Infinity",  "-infinity",
        "1.#QNAN",   "1.#SNAN", "-1.#IND", "-1.#IND000000", "1.#INF", "-1.#INF00", "1.#QNAN0",
        "1.#J",      "1.#IO",   "-1.#J",   "+1.#INF"}) {
    double value = 0;
    INFO(text);
    CHECK(read_number(text, value) == text.size());
    CHECK_FALSE(std::isfinite(value));
  }
}

TEST_CASE("numbers in text: the reader stops where the number does") {
  const std::pair<std::string_view, std::size_t> cases[] = {
      {"", 0},     {"x", 0},        {"-", 0},   {"+", 0},     {".", 0},        {"e5", 0},   {"+-1", 0},
      {"--1", 0},  {"++1", 0},      {" 1", 0},  {"#", 0},     {",5", 0},       {"1,5", 1},  {"1.5f", 3},
      {"0x10", 1}, {"1d5", 1},      {"1e", 1},  {"1e+", 1},   {"1.2.3", 3},    {"1#x", 1},  {"1.#", 2},
      {"1.#x", 2}, {"1.# QNAN", 2}, {"1 2", 1}, {"1/2/3", 1}, {"1.#QNANx", 7}, {"infx", 3}, {"1.#INF01", 7}};
  for (const auto& [text, size] : cases) {
    double value = 0;
    INFO(text);
    CHECK(read_number(text, value) == size);
  }
}

TEST_CASE("numbers in text: as the C library reads them") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200000; ++i) {
    const double number = std::bit_cast<double>(random());
    if (!std::isfinite(number)) continue;
    // All digits, or fewer: then the text is in general between two doubles.
    const int digits = static_cast<int>(random() % 20);
    const double scaled =
        random() % 2 == 0 ? number : std::ldexp(std::frexp(number, std::array<int, 1>{}.data()), 9);
    std::array<char, 400> text{};
    const int size =
        std::snprintf(text.data(), text.size(), random() % 2 == 0 ? "%.*e" : "%.*g", digits, scaled);
    const std::string word(text.data(), static_cast<std::size_t>(size));
    const std::uint64_t expected = bits(std::strtod(text.data(), nullptr));
    if (bits_of_number(word) != expected) FAIL(word);
  }
}

TEST_CASE("text of UTF-8 loses its byte order mark, text of UTF-16 is refused") {
  CHECK(text_of(as_bytes("\xEF\xBB\xBFv"), "f") == "v");
  CHECK(text_of(as_bytes("v\xEF\xBB\xBF"), "f") == "v\xEF\xBB\xBF");
  CHECK(text_of(as_bytes("\xEF\xBB"), "f") == "\xEF\xBB");
  CHECK(text_of({}, "f").empty());
  const std::string error = "f: byte order mark is that of UTF-16 or UTF-32; legal: UTF-8, or none";
  for (const std::string_view mark :
       {std::string_view("\xFF\xFE"), std::string_view("\xFE\xFF"), std::string_view("\xFF\xFE\0\0", 4),
        std::string_view("\0\0\xFE\xFF", 4)}) {
    CHECK(error_of([&] { return text_of(as_bytes(std::string(mark) + "v"), "f"); }) == error);
  }
}
