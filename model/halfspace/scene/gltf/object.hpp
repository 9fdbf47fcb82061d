/// Checked access to the JSON of a glTF file.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "halfspace/numerics/error.hpp"

namespace halfspace::gltf {

/// One object, and what errors call it: "FILE: node 3: …", or "FILE: accessor 3 sparse: …" for an object in
/// it. Every function throws InputError when the value is of the wrong type. It keeps pointers only.
class Object {
 public:
  /// `kind`, `part`: text that outlives the object.
  Object(const nlohmann::json& value, std::string_view file, std::string_view kind,
         std::optional<std::size_t> number = std::nullopt, std::string_view part = "");

  [[nodiscard]] bool has(const char* key) const { return value_->contains(key); }
  /// The value as it is, or null.
  [[nodiscard]] const nlohmann::json* find(const char* key) const;

  /// A whole number, 0 or more.
  [[nodiscard]] std::optional<std::uint64_t> find_number(const char* key) const;
  [[nodiscard]] std::uint64_t number(const char* key) const;
  [[nodiscard]] std::uint64_t number_or(const char* key, std::uint64_t fallback) const;

  [[nodiscard]] std::optional<double> find_real(const char* key) const;
  [[nodiscard]] double real(const char* key) const;
  [[nodiscard]] bool truth_or(const char* key, bool fallback) const;
  /// The text itself: it can be all of the file.
  [[nodiscard]] const std::string* find_text(const char* key) const;
  [[nodiscard]] std::string text_or(const char* key, std::string_view fallback) const;

  /// A list of numbers; empty when there is none.
  [[nodiscard]] std::vector<double> reals(const char* key) const;
  /// The same, but `size` numbers when there is a list.
  [[nodiscard]] std::vector<double> reals(const char* key, std::size_t size) const;
  /// A list of whole numbers, 0 or more.
  [[nodiscard]] std::vector<std::uint64_t> numbers(const char* key) const;
  [[nodiscard]] std::vector<std::string> texts(const char* key) const;

  [[nodiscard]] std::optional<Object> find_object(const char* key) const;
  [[nodiscard]] Object object(const char* key) const;
  /// How many values a list has; 0 when there is no list.
  [[nodiscard]] std::size_t count(const char* key) const;
  /// An object of a list, below count().
  [[nodiscard]] Object item(const char* key, std::size_t index) const;
  [[nodiscard]] std::optional<Object> extension(const char* name) const;

  /// What errors call it.
  [[nodiscard]] std::string name() const;

  /// The keys, each with a whole number, 0 or more.
  [[nodiscard]] std::vector<std::pair<std::string, std::uint64_t>> numbers_by_name() const;

  template <typename... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> text, Args&&... args) const {
    throw InputError(
        fmt::format("{}: {}: {}", file_, name(), fmt::format(text, std::forward<Args>(args)...)));
  }

 private:
  [[nodiscard]] const nlohmann::json* find_list(const char* key) const;
  [[noreturn]] void fail_type(const char* key, const nlohmann::json& value, std::string_view legal) const;

  const nlohmann::json* value_;
  std::string_view file_;
  std::string_view kind_;
  std::optional<std::size_t> number_;
  std::string_view part_;
};

/// The number, when it is a whole one that is 0 or more; also if it is written with a point ("4.0").
[[nodiscard]] std::optional<std::uint64_t> as_number(const nlohmann::json& value);

/// The value's text for an error message.
[[nodiscard]] std::string to_text(const nlohmann::json& value);

}  // namespace halfspace::gltf
