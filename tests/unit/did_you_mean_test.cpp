// Is the name found that somebody meant, and none where he meant none?
#include "halfspace/config/did_you_mean.hpp"

#include <array>
#include <catch2/catch.hpp>

using namespace halfspace;

TEST_CASE("edit_distance is that of optimal string alignment") {
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("abc", "") == 3);
  CHECK(edit_distance("kitten", "sitting") == 3);  // Levenshtein 1966's insertions and replacements
  CHECK(edit_distance("saturday", "sunday") == 3);
  CHECK(edit_distance("form", "from") == 1);  // Damerau 1964: neighbours exchanged
  CHECK(edit_distance("ca", "abc") == 3);     // 2 where a letter may be edited twice
  CHECK(edit_distance("abcdef", "badcfe") == 3);
  CHECK(edit_distance("Recurrence", "rECURRENCE") == 0);
  CHECK(edit_distance("\xC3\xA4", "a") == 2);  // bytes
}

TEST_CASE("did_you_mean names what is close, and nothing else") {
  constexpr std::array<std::string_view, 6> kNames{"functional", "recurrence", "systemc",
                                                   "rtl",        "hi_z",       "fast"};
  CHECK(did_you_mean("functionel", kNames) == " (did you mean 'functional'?)");
  CHECK(did_you_mean("Functional", kNames) == " (did you mean 'functional'?)");
  CHECK(did_you_mean("recurence", kNames) == " (did you mean 'recurrence'?)");
  CHECK(did_you_mean("ssytemc", kNames) == " (did you mean 'systemc'?)");
  CHECK(did_you_mean("rtll", kNames) == " (did you mean 'rtl'?)");
  CHECK(did_you_mean("RTL", kNames) == " (did you mean 'rtl'?)");
  for (const char* word : {"", "x", "rt", "xyz", "vhdl", "lost", "analytic", "current", "sequence"}) {
    CAPTURE(word);
    CHECK(did_you_mean(word, kNames).empty());
  }
  CHECK(did_you_mean(std::string(100'000, 'r'), kNames).empty());
  CHECK(did_you_mean("rtl", std::array<std::string_view, 0>{}).empty());
}

TEST_CASE("did_you_mean names two that are as close, and no three") {
  constexpr std::array<std::string_view, 3> kTwo{"--lag", "--log", "--leg"};
  CHECK(did_you_mean("--lig", kTwo).empty());
  CHECK(did_you_mean("--lig", std::array<std::string_view, 2>{"--lag", "--log"}) ==
        " (did you mean '--lag' or '--log'?)");
  CHECK(did_you_mean("--laag", kTwo) == " (did you mean '--lag'?)");
}
