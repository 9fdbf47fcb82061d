// Without a guard that stops a second inclusion: once for each target of Highway.
#if defined(HALFSPACE_FAST_VISIT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_FAST_VISIT_INL
#undef HALFSPACE_FAST_VISIT_INL
#else
#define HALFSPACE_FAST_VISIT_INL
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "halfspace/fast/depth_bounds-inl.hpp"
#include "halfspace/fast/triangle-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::fast::HWY_NAMESPACE {
namespace {

/// A triangle in a group of tiles: those that it covers whole, and those of which it covers a part. Or in
/// blocks of a row that it covers whole.
struct Visit {
  Triangle* triangle;
  std::uint32_t block_x;
  std::uint32_t block_y;
  std::uint32_t blocks;  ///< covered whole, a bit each from block_x on; 0: the visit is of tiles, as follows
  std::uint32_t group;   ///< of the block
  std::uint16_t whole;   ///< a bit a tile
  std::uint16_t partial;
  std::uint32_t first_mask;  ///< of the partial ones
  CodeRange range;           ///< where the triangle has depth
};

}  // namespace
}  // namespace halfspace::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
