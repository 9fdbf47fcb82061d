#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "halfspace/speed/roof.cpp"
#include <hwy/foreach_target.h>
// after foreach_target, as Highway asks
#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "halfspace/speed/roof.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

std::uint64_t test_vectors(std::span<std::uint32_t> stored, std::uint32_t first, std::uint32_t step) {
  const hn::ScalableTag<std::uint32_t> tag;
  const std::size_t lanes = hn::Lanes(tag);
  constexpr std::size_t kAtOnce = 4;
  const auto down = hn::Set(tag, step * static_cast<std::uint32_t>(lanes));
  auto code = hn::Add(hn::Set(tag, first), hn::Mul(hn::Iota(tag, 0), hn::Set(tag, step)));
  std::uint64_t passed = 0;
  for (std::size_t at = 0; at + kAtOnce * lanes <= stored.size(); at += kAtOnce * lanes) {
    for (std::size_t i = 0; i < kAtOnce; ++i) {
      std::uint32_t* const here = stored.data() + at + i * lanes;
      const auto old = hn::LoadU(tag, here);
      passed += hn::CountTrue(tag, hn::Lt(code, old));
      hn::StoreU(hn::Min(code, old), tag, here);
      code = hn::Add(code, down);
    }
  }
  return passed;
}

}  // namespace
}  // namespace halfspace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace halfspace {

HWY_EXPORT(test_vectors);

std::uint64_t test_in_a_row(std::span<std::uint32_t> stored, std::uint32_t first, std::uint32_t step) {
  return HWY_DYNAMIC_DISPATCH(test_vectors)(stored, first, step);
}

}  // namespace halfspace
#endif
