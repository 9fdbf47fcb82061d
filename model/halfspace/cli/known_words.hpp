/// Words that the command line knows, and which of them was meant.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace halfspace {

/// CLI::IsMember, which says too which name was meant.
[[nodiscard]] CLI::Validator one_of(std::vector<std::string> names);

/// The same of the names of a table.
template <class Table, class Name = std::identity>
[[nodiscard]] CLI::Validator one_of_table(const Table& table, Name name = {}) {
  std::vector<std::string> names;
  for (const auto& each : table) {
    names.emplace_back(std::invoke(name, each));
  }
  return one_of(std::move(names));
}

/// What to say of the first word that found no place, and of what it may mean; empty where all did.
[[nodiscard]] std::string unknown_word(const CLI::App& app);

}  // namespace halfspace
