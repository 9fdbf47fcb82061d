/// What somebody meant who typed a name that is none.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace halfspace {

/// Edits that make one word the other: a letter more, less or other, or two neighbours exchanged, no letter
/// edited twice (optimal string alignment: Damerau 1964). Capitals are their small letters.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// " (did you mean 'NAME'?)" with the names that are closest to `word`, where a third of its letters or less,
/// and three at most, are edited; empty where no name or more than two are.
[[nodiscard]] std::string did_you_mean(std::string_view word, std::span<const std::string_view> names);

/// The same of the names of the members of a table, or of names of any type.
template <class Table, class Name = std::identity>
[[nodiscard]] std::string did_you_mean(std::string_view word, const Table& table, Name name = {}) {
  std::vector<std::string_view> names;
  names.reserve(std::size(table));
  for (const auto& each : table) {
    names.emplace_back(std::invoke(name, each));
  }
  return did_you_mean(word, std::span<const std::string_view>(names));
}

}  // namespace halfspace
