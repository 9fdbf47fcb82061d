/// Arrays whose memory costs nothing before it is touched: the system reserves their pages, and gives each
/// when it is used for the first time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace halfspace {

/// Frees the memory that an array is in.
struct FreeMemory {
  void* memory = nullptr;
  void operator()(const void* /*array*/) const { std::free(memory); }
};

template <class Value>
using LazyArray = std::unique_ptr<Value[], FreeMemory>;

enum class Pages { kSmall, kLargeIfItFits };

namespace detail {

/// Memory, or null, with room for an array from its first multiple of `alignment` on.
struct Reserved {
  void* memory;
  std::size_t alignment;
};

inline void* first_multiple(void* memory, std::size_t alignment) {
  const std::size_t past = reinterpret_cast<std::uintptr_t>(memory) % alignment;
  return static_cast<char*>(memory) + (past == 0 ? 0 : alignment - past);
}

/// Large pages are asked for where the array is one or more of them, and not so large that their unused rest
/// would matter.
Reserved reserve(std::size_t bytes, Pages pages);

/// The array in `memory`, from its first multiple of `alignment` on.
template <class Value>
LazyArray<Value> array_in(void* memory, std::size_t alignment) {
  static_assert(std::is_trivially_copyable_v<Value> && std::is_trivially_destructible_v<Value>);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return {static_cast<Value*>(first_multiple(memory, alignment)), FreeMemory{memory}};
}

}  // namespace detail

/// `count` values of zero bytes. Memory that the process used before is cleared for them.
template <class Value>
LazyArray<Value> zeroed_array(std::size_t count) {
  return detail::array_in<Value>(std::calloc(count == 0 ? 1 : count, sizeof(Value)), alignof(Value));
}

/// `count` values that must be written before they are read, from the begin of a cache line on. Small pages
/// are for lists of which little may be used.
template <class Value>
LazyArray<Value> unset_array(std::size_t count, Pages pages = Pages::kLargeIfItFits) {
  const detail::Reserved reserved = detail::reserve(count * sizeof(Value), pages);
  return detail::array_in<Value>(reserved.memory, reserved.alignment);
}

}  // namespace halfspace
