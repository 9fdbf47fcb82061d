/// Arrays whose memory costs nothing before it is touched: the system reserves their pages, and gives each
/// when it is used for the first time.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace halfspace {

struct FreeMemory {
  void operator()(void* memory) const { std::free(memory); }
};

template <class Value>
using LazyArray = std::unique_ptr<Value[], FreeMemory>;

namespace detail {

template <class Value>
LazyArray<Value> owned(void* memory) {
  static_assert(std::is_trivially_copyable_v<Value> && std::is_trivially_destructible_v<Value>);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return LazyArray<Value>(static_cast<Value*>(memory));
}

}  // namespace detail

/// `count` values of zero bytes. Memory that the process used before is cleared for them.
template <class Value>
LazyArray<Value> zeroed_array(std::size_t count) {
  return detail::owned<Value>(std::calloc(count == 0 ? 1 : count, sizeof(Value)));
}

/// `count` values that must be written before they are read, from the begin of a cache line on.
template <class Value>
LazyArray<Value> unset_array(std::size_t count) {
  constexpr std::size_t kCacheLine = 64;
  const std::size_t lines = count * sizeof(Value) / kCacheLine + 1;
  return detail::owned<Value>(std::aligned_alloc(kCacheLine, lines * kCacheLine));
}

}  // namespace halfspace
