#include "halfspace/units/lazy_array.hpp"

#include <sys/mman.h>

namespace halfspace::detail {
namespace {

constexpr std::size_t kCacheLine = 64;
constexpr std::size_t kLargePage = std::size_t{1} << 21;
constexpr std::size_t kMostInLargePages = std::size_t{32} << 20;

}  // namespace

// Not by aligned_alloc: glibc's does not use again what it gave before, so each run would pay for fresh
// pages.
Reserved reserve(std::size_t bytes, Pages pages) {
  const std::size_t rounded = (bytes + kLargePage - 1) / kLargePage * kLargePage;
  if (pages == Pages::kSmall || bytes < kLargePage || rounded > kMostInLargePages) {
    return {.memory = std::malloc(bytes + kCacheLine), .alignment = kCacheLine};
  }
  void* const memory = std::malloc(rounded + kLargePage);
#ifdef MADV_HUGEPAGE
  if (memory != nullptr) {
    // The system may not have any: then the pages are small ones.
    (void)madvise(first_multiple(memory, kLargePage), rounded, MADV_HUGEPAGE);
  }
#endif
  return {.memory = memory, .alignment = kLargePage};
}

}  // namespace halfspace::detail
