#include "halfspace/cli/known_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "halfspace/config/did_you_mean.hpp"
#include "halfspace/scene/quote.hpp"

namespace halfspace {
namespace {

std::string meant_by(std::string word, const CLI::App& command) {
  std::vector<std::string> names;
  if (word.starts_with('-')) {
    word.resize(std::min(word.find('='), word.size()));
    for (const CLI::Option* option : command.get_options()) {
      for (const std::string& name : option->get_lnames()) {
        names.push_back("--" + name);
      }
    }
  } else {
    for (const CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; })) {
      names.push_back(subcommand->get_name());
    }
  }
  return did_you_mean(word, names);
}

}  // namespace

CLI::Validator one_of(std::vector<std::string> names) {
  std::string set = fmt::format("{{{}}}", fmt::join(names, ","));
  const auto check = [names = std::move(names), set](std::string& value) {
    return std::ranges::find(names, value) != names.end()
               ? std::string()
               : fmt::format("{} not in {}{}", value, set, did_you_mean(value, names));
  };
  return {check, std::move(set)};
}

std::string unknown_word(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining();
  if (!words.empty()) {
    return fmt::format("'{}' is unknown{}", printable(words.front()), meant_by(words.front(), app));
  }
  const std::vector<CLI::App*> subcommands = app.get_subcommands();
  return subcommands.empty() ? std::string() : unknown_word(*subcommands.front());
}

}  // namespace halfspace
