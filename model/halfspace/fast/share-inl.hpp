// Without a guard that stops a second inclusion: once for each target of Highway.
#if defined(HALFSPACE_FAST_SHARE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_FAST_SHARE_INL
#undef HALFSPACE_FAST_SHARE_INL
#else
#define HALFSPACE_FAST_SHARE_INL
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstddef>
#include <cstdint>

#include "halfspace/fast/lanes-inl.hpp"
#include "halfspace/fast/raster.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::fast::HWY_NAMESPACE {
namespace {

/// See take_share (raster.hpp).
inline void take_share_of(const SetUpTriangles& in, Columns columns, int block_size, SetUpTriangles& out) {
  const Tag tag;
  const int shift = std::countr_zero(static_cast<unsigned>(block_size));
  out.clear();
  out.first_whole = in.first_whole;
  const auto column = [&](const SetUpTriangles::Field<std::int32_t>& x, std::size_t at)
                          HWY_ATTR { return hn::ShiftRightSame(hn::LoadU(tag, x.data() + at), shift); };
  for (std::size_t at = 0; at < in.count; at += static_cast<std::size_t>(kWidth)) {
    // Columns from the first to the next one that is among them: does the triangle reach that far?
    const Vector first = column(in.x_first, at);
    const Vector ahead = hn::And(hn::Sub(set(columns.own), first), set(columns.mask));
    const auto reached = at_most(hn::Add(first, ahead), column(in.x_last, at));
    const auto lanes = hn::And(reached, hn::FirstN(tag, in.count - at));
    const std::uint32_t bits = bits_of(lanes);
    in.for_fields(out, [&](const auto& from, auto& to) HWY_ATTR {
      const auto* const values = from.data() + at;
      auto* const kept = to.data() + out.count;
      if constexpr (sizeof(*values) == sizeof(std::int32_t)) {
        hn::StoreU(hn::Compress(hn::LoadU(tag, values), lanes), tag, kept);
      } else {
        std::size_t n = 0;
        for (std::uint32_t left = bits; left != 0; left &= left - 1) {
          kept[n++] = values[std::countr_zero(left)];
        }
      }
    });
    out.count += static_cast<std::size_t>(std::popcount(bits));
  }
}

}  // namespace
}  // namespace halfspace::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
