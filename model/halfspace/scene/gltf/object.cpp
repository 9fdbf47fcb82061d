#include "halfspace/scene/gltf/object.hpp"

#include <cmath>

#include "halfspace/scene/quote.hpp"

namespace halfspace::gltf {

using nlohmann::json;

std::optional<std::uint64_t> as_number(const json& value) {
  if (value.is_number_unsigned()) return value.get<std::uint64_t>();
  if (!value.is_number_float()) return std::nullopt;
  constexpr double kExact = 1ull << 53;  // whole numbers up to here are exact
  const auto real = value.get<double>();
  if (!(real >= 0 && real <= kExact) || real != std::floor(real)) return std::nullopt;
  return static_cast<std::uint64_t>(real);
}

std::string to_text(const json& value) {
  if (value.is_number() || value.is_boolean() || value.is_null()) return value.dump();
  if (value.is_string()) return quote(value.get_ref<const std::string&>());
  return value.is_array() ? "a list" : "an object";
}

Object::Object(const json& value, std::string_view file, std::string_view kind,
               std::optional<std::size_t> number, std::string_view part)
    : value_(&value), file_(file), kind_(kind), number_(number), part_(part) {
  if (!value.is_object()) {
    throw InputError(fmt::format("{}: {} is not an object; legal: a list of objects", file_, name()));
  }
}

std::string Object::name() const {
  return fmt::format("{}{}{}{}", kind_, number_ ? fmt::format(" {}", *number_) : "", part_.empty() ? "" : " ",
                     part_);
}

void Object::fail_type(const char* key, const json& value, std::string_view legal) const {
  fail("{} is {}; legal: {}", key, to_text(value), legal);
}

const json* Object::find(const char* key) const {
  const auto found = value_->find(key);
  return found == value_->end() ? nullptr : &*found;
}

std::optional<std::uint64_t> Object::find_number(const char* key) const {
  const json* const value = find(key);
  if (value == nullptr) return std::nullopt;
  const auto number = as_number(*value);
  if (!number) fail_type(key, *value, "a whole number, 0 or more");
  return number;
}

std::uint64_t Object::number(const char* key) const {
  const auto number = find_number(key);
  if (!number) fail("{} is missing; legal: a whole number, 0 or more", key);
  return *number;
}

std::uint64_t Object::number_or(const char* key, std::uint64_t fallback) const {
  return find_number(key).value_or(fallback);
}

std::optional<double> Object::find_real(const char* key) const {
  const json* const value = find(key);
  if (value == nullptr) return std::nullopt;
  if (!value->is_number()) fail_type(key, *value, "a number");
  return value->get<double>();
}

double Object::real(const char* key) const {
  const auto real = find_real(key);
  if (!real) fail("{} is missing; legal: a number", key);
  return *real;
}

bool Object::truth_or(const char* key, bool fallback) const {
  const json* const value = find(key);
  if (value == nullptr) return fallback;
  if (!value->is_boolean()) fail_type(key, *value, "true or false");
  return value->get<bool>();
}

const std::string* Object::find_text(const char* key) const {
  const json* const value = find(key);
  if (value == nullptr) return nullptr;
  if (!value->is_string()) fail_type(key, *value, "a text");
  return &value->get_ref<const std::string&>();
}

std::string Object::text_or(const char* key, std::string_view fallback) const {
  const std::string* const text = find_text(key);
  return text == nullptr ? std::string(fallback) : *text;
}

const json* Object::find_list(const char* key) const {
  const json* const value = find(key);
  if (value != nullptr && !value->is_array()) fail_type(key, *value, "a list");
  return value;
}

std::vector<double> Object::reals(const char* key) const {
  std::vector<double> reals;
  if (const json* const list = find_list(key)) {
    reals.reserve(list->size());
    for (const json& value : *list) {
      if (!value.is_number()) fail_type(key, value, "a list of numbers");
      reals.push_back(value.get<double>());
    }
  }
  return reals;
}

std::vector<double> Object::reals(const char* key, std::size_t size) const {
  std::vector<double> values = reals(key);
  if (has(key) && values.size() != size) fail("{} has {} numbers; legal: {}", key, values.size(), size);
  return values;
}

std::vector<std::uint64_t> Object::numbers(const char* key) const {
  std::vector<std::uint64_t> numbers;
  if (const json* const list = find_list(key)) {
    numbers.reserve(list->size());
    for (const json& value : *list) {
      const auto number = as_number(value);
      if (!number) fail_type(key, value, "a list of whole numbers, 0 or more");
      numbers.push_back(*number);
    }
  }
  return numbers;
}

std::vector<std::string> Object::texts(const char* key) const {
  std::vector<std::string> texts;
  if (const json* const list = find_list(key)) {
    for (const json& value : *list) {
      if (!value.is_string()) fail_type(key, value, "a list of texts");
      texts.push_back(value.get<std::string>());
    }
  }
  return texts;
}

std::optional<Object> Object::find_object(const char* key) const {
  const json* const value = find(key);
  if (value == nullptr) return std::nullopt;
  if (!value->is_object()) fail_type(key, *value, "an object");
  return Object(*value, file_, kind_, number_, key);
}

Object Object::object(const char* key) const {
  const auto object = find_object(key);
  if (!object) fail("{} is missing; legal: an object", key);
  return *object;
}

std::size_t Object::count(const char* key) const {
  const json* const list = find_list(key);
  return list == nullptr ? 0 : list->size();
}

Object Object::item(const char* key, std::size_t index) const {
  const json& value = (*find_list(key))[index];
  if (!value.is_object()) fail_type(key, value, "a list of objects");
  return {value, file_, kind_, number_, key};
}

std::optional<Object> Object::extension(const char* name) const {
  const auto extensions = find_object("extensions");
  return extensions ? extensions->find_object(name) : std::nullopt;
}

std::vector<std::pair<std::string, std::uint64_t>> Object::numbers_by_name() const {
  std::vector<std::pair<std::string, std::uint64_t>> numbers;
  for (const auto& [key, value] : value_->items()) {
    const auto number = as_number(value);
    if (!number) fail_type(key.c_str(), value, "a whole number, 0 or more");
    numbers.emplace_back(key, *number);
  }
  return numbers;
}

}  // namespace halfspace::gltf
