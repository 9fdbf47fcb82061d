// Without a guard that stops a second inclusion: once for each target of Highway.
#if defined(HALFSPACE_FAST_SET_UP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_FAST_SET_UP_INL
#undef HALFSPACE_FAST_SET_UP_INL
#else
#define HALFSPACE_FAST_SET_UP_INL
#endif

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstdint>

#include "halfspace/fast/front_end_task.hpp"
#include "halfspace/fast/set_up.hpp"
#include "halfspace/fast/tallies.hpp"
#include "halfspace/fast/vertices-inl.hpp"
#include "halfspace/units/depth_plane.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::fast::HWY_NAMESPACE {
namespace {

HWY_INLINE WideLanes product(NarrowVector left, NarrowVector right) {
  const Wide wide;
  const WideLanes l = hn::PromoteTo(wide, left);
  const WideLanes r = hn::PromoteTo(wide, right);
#if HWY_TARGET == HWY_SCALAR
  return hn::Mul(l, r);
#else
  const hn::Repartition<std::int32_t, Wide> halves;
  return hn::MulEven(hn::BitCast(halves, l), hn::BitCast(halves, r));
#endif
}

/// As setup, for triangles whose vertices are in a chunk.
class Batch {
 public:
  Batch(const FrontEndTask& task, const VertexChunk& chunk) : task_(task), chunk_(chunk) {}

  /// Takes kTriangles triangles from `first` on. False where one of them is not for vectors; then nothing has
  /// changed.
  bool take(std::uint32_t first, SetUpTriangles& out, FrontEndCounters& front_end, SetupCounters& setup) {
    return load(first) && (!task_.has_depth || !task_.is_float || has_near_depths()) &&
           set_up(first, out, front_end, setup);
  }

 private:
  /// Fills x_, y_, z_.
  HWY_INLINE bool load(std::uint32_t first) {
    const Narrow narrow;
    if (chunk_.in_order) {
      const std::size_t at = std::size_t{first - chunk_.first} * 3;
      const auto corners = [&](const auto& field, auto& to) HWY_ATTR {
        hn::LoadInterleaved3(narrow, field.data() + at, to[0], to[1], to[2]);
      };
      corners(chunk_.x, x_);
      corners(chunk_.y, y_);
      corners(chunk_.z, z_);
      if (!chunk_.some_strange) {
        return true;
      }
      NarrowVector strange[3];
      corners(chunk_.strange, strange);
      return find_away(strange);
    }
    const auto* const index = reinterpret_cast<const std::int32_t*>(task_.indices) + std::size_t{first} * 3;
    NarrowVector vertex[3];
    hn::LoadInterleaved3(narrow, index, vertex[0], vertex[1], vertex[2]);
    const NarrowVector lowest = hn::Set(narrow, static_cast<std::int32_t>(chunk_.lowest));
    const auto gather = [&](const auto& field, auto& to) HWY_ATTR {
      for (std::size_t i = 0; i < 3; ++i) {
        to[i] = hn::GatherIndex(narrow, field.data(), hn::Sub(vertex[i], lowest));
      }
    };
    gather(chunk_.x, x_);
    gather(chunk_.y, y_);
    gather(chunk_.z, z_);
    if (!chunk_.some_strange) {
      return true;
    }
    NarrowVector strange[3];
    gather(chunk_.strange, strange);
    return find_away(strange);
  }

  /// Triangles that are clipped away as a whole: all vertices are outside the first plane that one is outside
  /// of. False where others than these have a strange vertex.
  HWY_INLINE bool find_away(const NarrowVector* strange) {
    const Narrow narrow;
    const NarrowVector zero = hn::Zero(narrow);
    const NarrowVector some = hn::Or(strange[0], hn::Or(strange[1], strange[2]));
    const NarrowVector all = hn::And(strange[0], hn::And(strange[1], strange[2]));
    const NarrowVector planes = hn::And(some, hn::Set(narrow, VertexChunk::kPlanes));
    const NarrowVector first = hn::And(planes, hn::Neg(planes));
    const auto finite = hn::Eq(hn::And(some, hn::Set(narrow, VertexChunk::kNotFinite)), zero);
    const unsigned away = lane_bits(narrow, hn::And(finite, hn::Ne(hn::And(all, first), zero)));
    away_ = away;
    return (lane_bits(narrow, hn::Eq(some, zero)) | away) == kAllTriangles;
  }

  bool set_up(std::uint32_t first, SetUpTriangles& out, FrontEndCounters& front_end,
              SetupCounters& counters) {
    const Wide wide;
    const Narrow narrow;
    const SetupState& state = task_.setup;
    const int s = state.sub_pixel_bits;
    const WideLanes zero = hn::Zero(wide);
    const WideLanes area = hn::Sub(product(hn::Sub(x_[1], x_[0]), hn::Sub(y_[2], y_[0])),
                                   product(hn::Sub(x_[2], x_[0]), hn::Sub(y_[1], y_[0])));
    const unsigned here = kAllTriangles & ~away_;
    const unsigned flat = lane_bits(wide, hn::Eq(area, zero)) & here;
    const unsigned negative_area = lane_bits(wide, hn::Lt(area, zero));
    const unsigned front = (state.front_positive_area ? ~negative_area : negative_area) & here & ~flat;
    const unsigned culled = ((state.cull_front ? front : 0) | (state.cull_back ? here & ~front : 0)) & ~flat;

    const auto half = [&](std::int32_t add) { return hn::Set(narrow, (1 << (s - 1)) + add); };
    const NarrowVector x_min = hn::Min(x_[0], hn::Min(x_[1], x_[2]));
    const NarrowVector x_max = hn::Max(x_[0], hn::Max(x_[1], x_[2]));
    const NarrowVector y_min = hn::Min(y_[0], hn::Min(y_[1], y_[2]));
    const NarrowVector y_max = hn::Max(y_[0], hn::Max(y_[1], y_[2]));
    NarrowVector x_first = hn::ShiftRightSame(hn::Add(x_min, half(-1)), s);
    NarrowVector y_first = hn::ShiftRightSame(hn::Add(y_min, half(-1)), s);
    NarrowVector x_last = hn::ShiftRightSame(hn::Sub(x_max, half(0)), s);
    NarrowVector y_last = hn::ShiftRightSame(hn::Sub(y_max, half(0)), s);
    const auto empty = [&] {
      return lane_bits(narrow, hn::Or(hn::Lt(x_last, x_first), hn::Lt(y_last, y_first))) & here;
    };
    const unsigned no_sample = empty() & ~(flat | culled);
    x_first = hn::Max(x_first, hn::Set(narrow, state.bounds.x_first));
    y_first = hn::Max(y_first, hn::Set(narrow, state.bounds.y_first));
    x_last = hn::Min(x_last, hn::Set(narrow, state.bounds.x_last));
    y_last = hn::Min(y_last, hn::Set(narrow, state.bounds.y_last));
    const unsigned outside = empty() & ~(flat | culled | no_sample);
    const unsigned drawn = here & ~(flat | culled | no_sample | outside);

    const NarrowVector extent = hn::Add(hn::Sub(x_max, x_min), hn::Sub(y_max, y_min));
    if ((drawn & lane_bits(narrow, hn::Gt(extent, hn::Set(narrow, task_.most_extent)))) != 0) {
      return false;
    }
    const NarrowVector bounds[4] = {x_first, y_first, x_last, y_last};
    if (drawn != 0 && !store(first, counters.triangles, drawn, negative_area, area, bounds, out)) {
      return false;
    }
    front_end.triangles += kTriangles;
    front_end.emitted += ones(here);
    front_end.clipped_away += ones(away_);
    counters.triangles += ones(here);
    counters.zero_area += ones(flat);
    counters.culled += ones(culled);
    counters.no_sample += ones(no_sample);
    counters.outside += ones(outside);
    counters.drawn += ones(drawn);
    return true;
  }

  /// The lanes of `drawn` that setup keeps, one after the other. Whole vectors are stored: what is behind
  /// comes later.
  struct Keep {
#if HWY_TARGET == HWY_SCALAR
    using Halves = Wide;
#else
    using Halves = hn::Repartition<std::int32_t, Wide>;
#endif
    hn::Mask<Halves> halves;  ///< of 64-bit lanes: both halves, which Highway compresses without a table
    hn::Mask<Narrow> lanes;
    std::size_t at;
    HWY_INLINE void put(NarrowVector v, SetUpTriangles::Field<std::int32_t>& field) const {
      hn::StoreU(hn::Compress(v, lanes), Narrow(), field.data() + at);
    }
    template <class T>
    HWY_INLINE void put(WideLanes v, SetUpTriangles::Field<T>& field) const {
      const auto kept = hn::BitCast(Wide(), hn::Compress(hn::BitCast(Halves(), v), halves));
      hn::StoreU(kept, Wide(), reinterpret_cast<std::int64_t*>(field.data()) + at);
    }
  };
  static HWY_INLINE Keep keep(unsigned drawn, const SetUpTriangles& out) {
    unsigned twice = (drawn | drawn << 4) & 0x0F0Fu;
    twice = (twice | twice << 2) & 0x3333u;
    twice = (twice | twice << 1) & 0x5555u;
    twice = HWY_TARGET == HWY_SCALAR ? drawn : twice | twice << 1;
    return {.halves = hn::LoadMaskBits(Keep::Halves(), bytes(twice)),
            .lanes = hn::LoadMaskBits(Narrow(), bytes(drawn)),
            .at = out.count};
  }

  /// Setup does not see those that are clipped away.
  HWY_INLINE NarrowVector order(std::int32_t seen) const {
    const Narrow narrow;
    if (HWY_LIKELY(away_ == 0)) {
      return hn::Iota(narrow, seen);
    }
    alignas(64) std::int32_t number[kTriangles];
    for (std::size_t i = 0; i < kTriangles; ++i) {
      number[i] = seen;
      seen += (away_ >> i & 1) != 0 ? 0 : 1;
    }
    return hn::Load(narrow, number);
  }

  // Vectors one by one: arrays of them would be copied by the byte.
  static HWY_INLINE void turn(hn::Mask<Narrow> lanes, NarrowVector* v) {
    const NarrowVector one = v[1];
    v[1] = hn::IfThenElse(lanes, v[2], one);
    v[2] = hn::IfThenElse(lanes, one, v[2]);
  }

  /// Vertex 1 comes first in some lanes, vertex 2 in others.
  static HWY_INLINE void rotate(hn::Mask<Narrow> first1, hn::Mask<Narrow> first2, NarrowVector* v) {
    const NarrowVector v0 = v[0];
    const NarrowVector v1 = v[1];
    const NarrowVector v2 = v[2];
    v[0] = hn::IfThenElse(first2, v2, hn::IfThenElse(first1, v1, v0));
    v[1] = hn::IfThenElse(first2, v0, hn::IfThenElse(first1, v2, v1));
    v[2] = hn::IfThenElse(first2, v1, hn::IfThenElse(first1, v0, v2));
  }

  /// Appends the triangles that are drawn; setup has seen `seen` before them. False where one of them is not
  /// for vectors.
  bool store(std::uint32_t first, std::uint64_t seen, unsigned drawn, unsigned negative_area,
             WideLanes signed_area, const NarrowVector* bounds, SetUpTriangles& out) {
    const Wide wide;
    const Narrow narrow;
    const SetupState& state = task_.setup;
    const int s = state.sub_pixel_bits;
    const WideLanes area = hn::Abs(signed_area);
    // Positive order, and the topmost, then leftmost vertex first.
    const auto turned = hn::LoadMaskBits(narrow, bytes(negative_area));
    turn(turned, x_);
    turn(turned, y_);
    turn(turned, z_);
    const auto above = [&](std::size_t i, std::size_t k) HWY_ATTR {
      return hn::Or(hn::Lt(y_[i], y_[k]), hn::And(hn::Eq(y_[i], y_[k]), hn::Lt(x_[i], x_[k])));
    };
    const auto begins1 = hn::And(above(1, 0), above(1, 2));
    const auto begins2 = hn::And(above(2, 0), above(2, 1));
    rotate(begins1, begins2, x_);
    rotate(begins1, begins2, y_);
    rotate(begins1, begins2, z_);

    const Keep kept = keep(drawn, out);
    const NarrowVector zero = hn::Zero(narrow);
    const NarrowVector centre = hn::Set(narrow, 1 << (s - 1));
    NarrowVector a[3];
    NarrowVector b[3];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t from = (i + 1) % 3;
      const std::size_t to = (i + 2) % 3;
      a[i] = hn::Sub(y_[from], y_[to]);
      b[i] = hn::Sub(x_[to], x_[from]);
      const auto side = owns_right(state.fill_rule) ? hn::Lt(a[i], zero) : hn::Gt(a[i], zero);
      const auto level = owns_bottom(state.fill_rule) ? hn::Lt(b[i], zero) : hn::Gt(b[i], zero);
      const auto owns = hn::Or(side, hn::And(hn::Eq(a[i], zero), level));
      const WideLanes c =
          hn::Add(product(a[i], hn::Sub(centre, x_[from])), product(b[i], hn::Sub(centre, y_[from])));
      const WideLanes rule = hn::PromoteTo(wide, hn::IfThenElseZero(hn::Not(owns), hn::Set(narrow, 1)));
      kept.put(hn::ShiftRightSame(hn::Sub(c, rule), s), out.e[i]);
      kept.put(a[i], out.a[i]);
      kept.put(b[i], out.b[i]);
    }
    if (task_.has_depth && !store_depth(a, b, area, drawn, out)) {
      return false;
    }
    if (!task_.has_depth) {
      kept.put(hn::Set(narrow, static_cast<std::int32_t>(DepthKind::kNone)), out.kind);
    }
    kept.put(x_[0], out.x);
    kept.put(y_[0], out.y);
    kept.put(bounds[0], out.x_first);
    kept.put(bounds[1], out.y_first);
    kept.put(bounds[2], out.x_last);
    kept.put(bounds[3], out.y_last);
    kept.put(hn::Iota(narrow, static_cast<std::int32_t>(first)), out.number);
    kept.put(order(static_cast<std::int32_t>(seen)), out.order);
    out.count += static_cast<std::size_t>(std::popcount(drawn));
    return true;
  }

  bool store_depth(const NarrowVector* a, const NarrowVector* b, WideLanes area, unsigned drawn,
                   SetUpTriangles& out) {
    return task_.is_float ? store_long(a, b, area, drawn, out) : store_short(a, b, area, drawn, out);
  }

  static HWY_INLINE NarrowVector least(const NarrowVector* v) { return hn::Min(v[0], hn::Min(v[1], v[2])); }
  static HWY_INLINE NarrowVector most(const NarrowVector* v) { return hn::Max(v[0], hn::Max(v[1], v[2])); }

  static HWY_INLINE NarrowVector kind_of(hn::Mask<Narrow> flat, DepthKind sloped) {
    const Narrow narrow;
    return hn::IfThenElse(flat, hn::Set(narrow, static_cast<std::int32_t>(DepthKind::kFlat)),
                          hn::Set(narrow, static_cast<std::int32_t>(sloped)));
  }

  bool store_short(const NarrowVector* a, const NarrowVector* b, WideLanes area, unsigned drawn,
                   SetUpTriangles& out) {
    const Wide wide;
    const Narrow narrow;
    const int fraction = task_.fraction;
    const auto code = [&](NarrowVector depth) HWY_ATTR {
      const NarrowVector within =
          hn::Min(hn::Max(depth, hn::Set(narrow, task_.least)), hn::Set(narrow, task_.most));
      return hn::ShiftRightSame(hn::Add(within, hn::Set(narrow, 1 << (fraction - 1))), fraction);
    };
    const NarrowVector low = code(least(z_));
    const NarrowVector high = code(most(z_));
    const NarrowVector rise1 = hn::Sub(z_[1], z_[0]);
    const NarrowVector rise2 = hn::Sub(z_[2], z_[0]);
    auto steep = hn::FirstN(wide, 0);
    const WideLanes dx = gradient(hn::Add(product(rise1, a[1]), product(rise2, a[2])), area, steep);
    const WideLanes dy = gradient(hn::Add(product(rise1, b[1]), product(rise2, b[2])), area, steep);
    const auto flat = hn::Eq(low, high);
    if ((lane_bits(wide, steep) & drawn & ~lane_bits(narrow, flat)) != 0) {
      return false;
    }
    const Keep kept = keep(drawn, out);
    kept.put(low, out.low);
    kept.put(high, out.high);
    kept.put(kind_of(flat, DepthKind::kShort), out.kind);
    kept.put(hn::Set(wide, std::int64_t{1} << (fraction - 1)), out.added);
    kept.put(hn::PromoteTo(wide, z_[0]), out.z);
    kept.put(dx, out.dx);
    kept.put(dy, out.dy);
    return true;
  }

  // ---- float32: words are mantissas, shifted ----

  static constexpr int kMantissaBits = 23;
  static constexpr int kMostApart = 13;        ///< exponents of the three depths
  static constexpr int kMostExtent = 1 << 23;  ///< sub-pixels: so products fit 64 bits
  /// Of a word below the mantissas' common place.
  static constexpr int kPlace = kLongWordFraction - 1 - kMantissaBits - kMostApart;

  /// Whether the depths of all triangles are as near to each other, and as far from 0, as setup and front end
  /// need.
  HWY_INLINE bool has_near_depths() const {
    const Narrow narrow;
    constexpr int kLeastExponent = 64;  // the least word is a normal float
    const NarrowVector highest = hn::ShiftRight<kMantissaBits>(most(z_));
    const NarrowVector lowest = hn::ShiftRight<kMantissaBits>(least(z_));
    return hn::AllFalse(narrow, hn::Or(hn::Gt(hn::Sub(highest, lowest), hn::Set(narrow, kMostApart)),
                                       hn::Lt(lowest, hn::Set(narrow, kLeastExponent))));
  }

  bool store_long(const NarrowVector* a, const NarrowVector* b, WideLanes area, unsigned drawn,
                  SetUpTriangles& out) {
    const Wide wide;
    const Narrow narrow;
    const NarrowVector low_bits = least(z_);
    const NarrowVector high_bits = most(z_);
    const NarrowVector limit_low = hn::Set(narrow, task_.least);
    const NarrowVector limit_high = hn::Set(narrow, task_.most);
    const NarrowVector low = hn::Min(hn::Max(low_bits, limit_low), limit_high);
    const NarrowVector high = hn::Min(hn::Max(high_bits, limit_low), limit_high);
    const auto flat = hn::Eq(low, high);
    const NarrowVector highest = hn::ShiftRight<kMantissaBits>(high_bits);
    auto strange = hn::FirstN(narrow, 0);
    for (std::size_t i = 0; i < 3; ++i) {
      strange = hn::Or(strange, hn::Gt(hn::Or(hn::Abs(a[i]), hn::Abs(b[i])), hn::Set(narrow, kMostExtent)));
    }
    WideLanes m[3];
    for (std::size_t i = 0; i < 3; ++i) {
      const NarrowVector bits = hn::Or(hn::And(z_[i], hn::Set(narrow, (1 << kMantissaBits) - 1)),
                                       hn::Set(narrow, 1 << kMantissaBits));
      const NarrowVector up = hn::Max(
          hn::Sub(hn::Set(narrow, kMostApart), hn::Sub(highest, hn::ShiftRight<kMantissaBits>(z_[i]))),
          hn::Zero(narrow));
      m[i] = hn::Shl(hn::PromoteTo(wide, bits), hn::PromoteTo(wide, up));
    }
    const WideLanes rise1 = hn::Sub(m[1], m[0]);
    const WideLanes rise2 = hn::Sub(m[2], m[0]);
    const auto sum = [&](const NarrowVector* step) HWY_ATTR {
      return hn::Add(hn::Mul(rise1, hn::PromoteTo(wide, step[1])),
                     hn::Mul(rise2, hn::PromoteTo(wide, step[2])));
    };
    auto steep = hn::FirstN(wide, 0);
    const LongGradient dx = long_gradient(sum(a), area, steep);
    const LongGradient dy = long_gradient(sum(b), area, steep);
    if (((lane_bits(wide, steep) | lane_bits(narrow, strange)) & drawn & ~lane_bits(narrow, flat)) != 0) {
      return false;
    }
    const Keep kept = keep(drawn, out);
    kept.put(low, out.low);
    kept.put(high, out.high);
    kept.put(kind_of(flat, DepthKind::kLong), out.kind);
    kept.put(hn::Zero(wide), out.added);
    kept.put(hn::ShiftLeft<kPlace>(m[0]), out.z);
    kept.put(dx.low, out.dx);
    kept.put(dx.high, out.dx_high);
    kept.put(dy.low, out.dy);
    kept.put(dy.high, out.dy_high);
    kept.put(hn::Sub(highest, hn::Set(narrow, 126)), out.exponent);
    return true;
  }

  struct LongGradient {
    WideLanes low;
    WideLanes high;
  };

  /// numerator * 2^(kPlace + kGradientFraction) / area, cut towards zero, in 128 bits.
  static HWY_INLINE LongGradient long_gradient(WideLanes numerator, WideLanes area, hn::Mask<Wide>& steep) {
    const Wide wide;
    constexpr int kHalf = kPlace / 2;
    static_assert(2 * kHalf == kPlace);
    WideLanes rest = hn::Abs(numerator);
    const WideLanes first = quotient<kGradientFraction>(rest, area, steep);
    const WideLanes second = quotient<kHalf>(rest, area, steep);
    const WideLanes third = quotient<kHalf>(rest, area, steep);
    const WideLanes low = hn::Add(hn::ShiftLeft<kPlace>(first), hn::Add(hn::ShiftLeft<kHalf>(second), third));
    const WideLanes high = hn::ShiftRight<64 - kPlace>(first);
    const WideLanes zero = hn::Zero(wide);
    const auto turned = hn::Lt(numerator, zero);
    const WideLanes carry = hn::IfThenElseZero(hn::Eq(low, zero), hn::Set(wide, std::int64_t{1}));
    return {.low = hn::IfThenElse(turned, hn::Neg(low), low),
            .high = hn::IfThenElse(turned, hn::Add(hn::Not(high), carry), high)};
  }

  /// numerator * 2^kGradientFraction / area, cut towards zero; see units/depth_plane.cpp.
  static HWY_INLINE WideLanes gradient(WideLanes numerator, WideLanes area, hn::Mask<Wide>& steep) {
    WideLanes rest = hn::Abs(numerator);
    const WideLanes magnitude = quotient<kGradientFraction>(rest, area, steep);
    return hn::IfThenElse(hn::Lt(numerator, hn::Zero(Wide())), hn::Neg(magnitude), magnitude);
  }

  /// rest * 2^Shift / area, cut; what is left over is in `rest`. Lanes in which the estimate may be off by
  /// more than 1 join `steep`. What wraps around cancels: the remainder is small.
  template <int Shift>
  static HWY_INLINE WideLanes quotient(WideLanes& rest, WideLanes area, hn::Mask<Wide>& steep) {
    const Wide wide;
    const Real real;
    const RealVector estimate = hn::Div(hn::Mul(hn::ConvertTo(real, rest), hn::Set(real, double{1 << Shift})),
                                        hn::ConvertTo(real, area));
    steep = hn::Or(steep, hn::RebindMask(wide, hn::Gt(estimate, hn::Set(real, 0x1p50))));
    WideLanes digits = hn::ConvertTo(wide, number_or_zero(estimate));  // 0 / 0 in lanes without a triangle
    rest = hn::Sub(hn::ShiftLeft<Shift>(rest), hn::Mul(digits, area));
    const WideLanes one = hn::Set(wide, std::int64_t{1});
    const auto over = hn::Lt(rest, hn::Zero(wide));
    digits = hn::Sub(digits, hn::IfThenElseZero(over, one));
    rest = hn::Add(rest, hn::IfThenElseZero(over, area));
    const auto under = hn::Not(hn::Lt(rest, area));
    digits = hn::Add(digits, hn::IfThenElseZero(under, one));
    rest = hn::Sub(rest, hn::IfThenElseZero(under, area));
    return digits;
  }

  static const std::uint8_t* bytes(const unsigned& bits) {
    return reinterpret_cast<const std::uint8_t*>(&bits);
  }

  const FrontEndTask& task_;
  const VertexChunk& chunk_;
  NarrowVector x_[3];
  NarrowVector y_[3];
  NarrowVector z_[3];
  unsigned away_ = 0;  ///< triangles that are clipped away
};

/// See set_up (front_end_task.hpp).
inline std::uint32_t set_up_triangles(const FrontEndTask& task, std::uint32_t first, std::uint32_t end,
                                      VertexChunk& chunk, SetUpTriangles& out, FrontEndCounters& front_end,
                                      SetupCounters& setup) {
  while (end - first >= kTriangles && out.count + kTriangles <= SetUpTriangles::kMost) {
    if (first < chunk.first || first + kTriangles > chunk.end) {
      make_chunk(task, first, end, chunk);
    }
    if (!Batch(task, chunk).take(first, out, front_end, setup)) {
      break;
    }
    first += kTriangles;
  }
  return first;
}

}  // namespace
}  // namespace halfspace::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
