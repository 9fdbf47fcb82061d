// Without a guard that stops a second inclusion: once for each target of Highway.
#if defined(HALFSPACE_FAST_WINDOW_DEPTH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_FAST_WINDOW_DEPTH_INL
#undef HALFSPACE_FAST_WINDOW_DEPTH_INL
#else
#define HALFSPACE_FAST_WINDOW_DEPTH_INL
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstddef>
#include <cstdint>

#include "halfspace/fast/plane-inl.hpp"
#include "halfspace/fast/set_up.hpp"
#include "halfspace/units/z_test.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::fast::HWY_NAMESPACE {
namespace {

/// The depth of small triangles, one a lane, at samples of their windows: tile_plane (units/depth_plane.hpp),
/// which PlaneWords does for a tile.
///
/// An anchor is the first pixel of a square of kAnchorSize. A window has samples of one square or, where it
/// crosses borders, of the next ones: as its tiles, left, right, and below.
class WindowDepth {
 public:
  /// Fragments in the lanes of a vector: the lane of the triangle, and the pixel.
  struct Fragments {
    Vector lane;
    Vector x;
    Vector y;
    hn::Mask<Tag> right;  ///< beyond the window's first anchors
    hn::Mask<Tag> below;
  };

  explicit WindowDepth(const EarlyZState& state)
      : sub_pixel_bits_(state.sub_pixel_bits),
        fraction_(vertex_depth_fraction(state.format)),
        is_float_(state.format == DepthFormat::kFloat32) {}

  /// Triangles from `first` on.
  void load(const SetUpTriangles& in, std::size_t first) {
    const Tag tag;
    const AnchorWords low = anchor_words(in, first);
    const AnchorWords high = kWidth > 1 ? anchor_words(in, first + kWideWidth) : low;
    if (is_float_) {
      keep_wide(low, 0);
      keep_wide(high, kWidth > 1 ? kWideWidth : 0);
      return;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      hn::Store(narrow(low.origin[i], high.origin[i]), tag, origin_[i]);
    }
    hn::Store(narrow(low.step_x, high.step_x), tag, step_x_);
    hn::Store(narrow(low.step_y, high.step_y), tag, step_y_);
  }

  /// Codes of fragments, not yet within the ranges of their triangles, which say all of flat ones.
  [[nodiscard]] HWY_INLINE Vector codes(const Fragments& at) const {
    return is_float_ ? long_codes(at) : short_codes(at);
  }

 private:
  static constexpr int kAnchorShift = std::countr_zero(static_cast<unsigned>(kAnchorSize));

  /// Words modulo 2^64, of which those of unorm surfaces need the low half.
  struct AnchorWords {
    WideVector origin[4];
    WideVector step_x;
    WideVector step_y;
    WideVector rebias;
  };

  /// A gradient in units of a word, and what is below them: so that products with pixels need no more than 64
  /// bits, the whole ones modulo 2^64.
  struct Gradient {
    WideVector whole;
    WideVector rest;
  };

  HWY_INLINE Gradient gradient(const SetUpTriangles::Field<std::uint64_t>& low_bits,
                               const SetUpTriangles::Field<std::int64_t>& high_bits, std::size_t at) const {
    const WideTag wide;
    constexpr int f = kGradientFraction;
    const WideVector low = hn::LoadU(wide, reinterpret_cast<const std::int64_t*>(low_bits.data()) + at);
    const WideVector rest = hn::And(low, hn::Set(wide, (std::int64_t{1} << f) - 1));
    if (!is_float_) {
      return {.whole = hn::ShiftRight<f>(low), .rest = rest};
    }
    const WideVector high = hn::LoadU(wide, high_bits.data() + at);
    const WideVector low_whole =
        hn::And(hn::ShiftRight<f>(low), hn::Set(wide, (std::int64_t{1} << (64 - f)) - 1));
    return {.whole = hn::Or(low_whole, hn::ShiftLeft<64 - f>(high)), .rest = rest};
  }

  /// Of kWideWidth triangles.
  HWY_INLINE AnchorWords anchor_words(const SetUpTriangles& in, std::size_t at) const {
    const WideTag wide;
    const int s = sub_pixel_bits_;
    const hn::Rebind<std::int32_t, WideTag> half_tag;
    const auto field = [&](const SetUpTriangles::Field<std::int32_t>& values)
                           HWY_ATTR { return hn::PromoteTo(wide, hn::LoadU(half_tag, values.data() + at)); };
    const Gradient x = gradient(in.dx, in.dx_high, at);
    const Gradient y = gradient(in.dy, in.dy_high, at);
    const WideVector half = hn::Set(wide, std::int64_t{1} << (kGradientFraction - 1));
    const WideVector square = hn::Set(wide, ~std::int64_t{kAnchorSize - 1});
    const WideVector half_pixel = hn::Set(wide, std::int64_t{1} << (s - 1));
    const WideVector next = hn::Set(wide, std::int64_t{kAnchorSize} << s);
    const WideVector z = hn::Add(hn::LoadU(wide, in.z.data() + at), hn::LoadU(wide, in.added.data() + at));
    // From the vertex to the first anchor.
    const auto distance = [&](const SetUpTriangles::Field<std::int32_t>& pixel,
                              const SetUpTriangles::Field<std::int32_t>& vertex) HWY_ATTR {
      return hn::Add(hn::ShiftLeftSame(hn::And(field(pixel), square), s), hn::Sub(half_pixel, field(vertex)));
    };
    const WideVector to_x = distance(in.x_first, in.x);
    const WideVector to_y = distance(in.y_first, in.y);
    const auto kind = field(in.kind);
    const auto is_flat = hn::Eq(kind, hn::Set(wide, static_cast<std::int64_t>(DepthKind::kFlat)));
    const auto origin = [&](WideVector dx, WideVector dy) HWY_ATTR {
      const WideVector whole = hn::Add(hn::Mul(x.whole, dx), hn::Mul(y.whole, dy));
      const WideVector rest = hn::Add(hn::Add(hn::Mul(x.rest, dx), hn::Mul(y.rest, dy)), half);
      return hn::IfThenZeroElse(is_flat, hn::Add(hn::Add(z, whole), hn::ShiftRight<kGradientFraction>(rest)));
    };
    const auto step = [&](const Gradient& of) HWY_ATTR {
      const WideVector rest = hn::ShiftRight<kGradientFraction>(hn::Add(hn::ShiftLeftSame(of.rest, s), half));
      return hn::IfThenZeroElse(is_flat, hn::Add(hn::ShiftLeftSame(of.whole, s), rest));
    };
    const WideVector right = hn::Add(to_x, next);
    const WideVector below = hn::Add(to_y, next);
    AnchorWords words{
        .origin = {origin(to_x, to_y), origin(right, to_y), origin(to_x, below), origin(right, below)},
        .step_x = step(x),
        .step_y = step(y),
        .rebias = hn::Zero(wide)};
    if (is_float_) {
      const WideVector exponent = hn::Add(field(in.exponent), hn::Set(wide, float_rebias_of_zero()));
      words.rebias = hn::IfThenZeroElse(is_flat, hn::ShiftLeft<kDoubleMantissa>(exponent));
    }
    return words;
  }

  static constexpr int kDoubleMantissa = 52;
  /// float_rebias is linear in the exponent.
  static constexpr std::int64_t float_rebias_of_zero() { return float_rebias(0) >> kDoubleMantissa; }

  void keep_wide(const AnchorWords& words, int lane) {
    const WideTag wide;
    for (int i = 0; i < 4; ++i) {
      hn::Store(words.origin[i], wide, long_origin_ + i * kWidth + lane);
    }
    hn::Store(words.step_x, wide, long_step_x_ + lane);
    hn::Store(words.step_y, wide, long_step_y_ + lane);
    hn::Store(words.rebias, wide, rebias_ + lane);
  }

  [[nodiscard]] HWY_INLINE Vector short_codes(const Fragments& at) const {
    const Tag tag;
    const auto lane = hn::IndicesFromVec(tag, at.lane);
    const auto of_lane = [&](const std::int32_t* values)
                             HWY_ATTR { return hn::TableLookupLanes(hn::Load(tag, values), lane); };
    const Vector origin =
        hn::IfThenElse(at.below, hn::IfThenElse(at.right, of_lane(origin_[3]), of_lane(origin_[2])),
                       hn::IfThenElse(at.right, of_lane(origin_[1]), of_lane(origin_[0])));
    const Vector in_square = set(kAnchorSize - 1);
    const Vector steps = hn::Add(hn::Mul(hn::And(at.x, in_square), of_lane(step_x_)),
                                 hn::Mul(hn::And(at.y, in_square), of_lane(step_y_)));
    return hn::ShiftRightSame(hn::Add(origin, steps), fraction_);
  }

  [[nodiscard]] HWY_INLINE Vector long_codes(const Fragments& at) const {
    const Tag tag;
    const Vector in_square = set(kAnchorSize - 1);
    const Vector anchor = hn::Add(hn::IfThenElseZero(at.right, set(1)), hn::IfThenElseZero(at.below, set(2)));
    alignas(64) std::int32_t lane[kWidth];
    alignas(64) std::int32_t origin[kWidth];
    alignas(64) std::int32_t x[kWidth];
    alignas(64) std::int32_t y[kWidth];
    hn::Store(at.lane, tag, lane);
    hn::Store(hn::Add(hn::ShiftLeft<std::countr_zero(static_cast<unsigned>(kWidth))>(anchor), at.lane), tag,
              origin);
    hn::Store(hn::And(at.x, in_square), tag, x);
    hn::Store(hn::And(at.y, in_square), tag, y);
    const auto half_codes = [&](int i) HWY_ATTR {
      const WideTag wide;
      const hn::Rebind<std::int32_t, WideTag> half;
      const auto all = [&](const std::int32_t* from)
                           HWY_ATTR { return hn::PromoteTo(wide, hn::LoadU(half, from + i)); };
      const auto of_lane = [&](const std::int64_t* from)
                               HWY_ATTR { return hn::GatherIndex(wide, from, all(lane)); };
      const WideVector steps =
          hn::Add(hn::Mul(all(x), of_lane(long_step_x_)), hn::Mul(all(y), of_lane(long_step_y_)));
      return float_codes(hn::Add(hn::GatherIndex(wide, long_origin_, all(origin)), steps), of_lane(rebias_));
    };
    const WideVector low = half_codes(0);
    return narrow(low, kWidth > 1 ? half_codes(kWideWidth) : low);
  }

  const int sub_pixel_bits_;
  const int fraction_;
  const bool is_float_;
  // Of the triangles: the word at each anchor, then for a pixel.
  alignas(64) std::int32_t origin_[4][kWidth];
  alignas(64) std::int32_t step_x_[kWidth];
  alignas(64) std::int32_t step_y_[kWidth];
  // Of a float32 surface.
  alignas(64) std::int64_t long_origin_[4 * kWidth];
  alignas(64) std::int64_t long_step_x_[kWidth];
  alignas(64) std::int64_t long_step_y_[kWidth];
  alignas(64) std::int64_t rebias_[kWidth];
};

}  // namespace
}  // namespace halfspace::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
