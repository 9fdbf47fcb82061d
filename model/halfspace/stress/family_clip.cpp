/// Families that are hard on clipping and division.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "halfspace/stress/draw_list.hpp"
#include "halfspace/stress/family.hpp"
#include "halfspace/stress/homogeneous_oracle.hpp"

namespace halfspace::stress {
namespace {

/// Counts the samples of a square target that clip-space triangles cover, where no rounding can decide.
class CertainCounts {
 public:
  CertainCounts(std::uint32_t size, const Precision& precision, int sample)
      : size_(size),
        sub_pixel_bits_(precision.sub_pixel_bits),
        sample_(precision.samples.at[static_cast<std::size_t>(sample)]),
        counts_(std::size_t{size} * size, 0) {}

  void add(const std::array<glm::vec4, 3>& triangle) {
    const HomogeneousTriangle exact(triangle, size_, sub_pixel_bits_);
    for (std::uint32_t y = 0; y < size_; ++y) {
      for (std::uint32_t x = 0; x < size_; ++x) {
        std::int32_t& count = counts_[std::size_t{y} * size_ + x];
        const Certainty certainty = exact.covers(x, y, sample_);
        if (certainty == Certainty::kUncertain) {
          count = kUncertain;
        } else if (count != kUncertain) {
          count += certainty == Certainty::kInside ? 1 : 0;
        }
      }
    }
  }

  std::vector<std::int32_t> take() { return std::move(counts_); }

 private:
  std::uint32_t size_;
  int sub_pixel_bits_;
  SamplePosition sample_;
  std::vector<std::int32_t> counts_;
};

}  // namespace

Case beyond_band(const Precision& precision, std::uint64_t seed) {
  constexpr std::uint32_t kSize = 16;
  DrawList list(precision, kSize, seed);
  list.draw();
  const auto real = [&](double low, double high) { return list.random.real(low, high); };
  CertainCounts counts(kSize, precision, list.sample());
  for (int n = 0; n < 12; ++n) {
    std::array<glm::vec4, 3> triangle{};
    // From a point of the target far along a line that crosses it; the guard band ends at 2^12 of the clip
    // volume here.
    const glm::dvec2 crossed{real(-1, 1), real(-1, 1)};
    for (glm::vec4& v : triangle) {
      const glm::dvec2 direction{real(-1, 1), real(-1, 1)};
      const double reach = list.one_in(3) ? 1 : std::ldexp(1.0, static_cast<int>(list.between(10, 40)));
      const double w = std::ldexp(real(0.5, 1), static_cast<int>(list.between(-4, 4)));
      v = glm::dvec4((crossed + direction * reach) * w, real(0.1, 0.9) * w, w);
    }
    list.add_clip(triangle);
    counts.add(triangle);
  }
  Case made{.frame = list.take_frame(), .sample = list.sample()};
  made.fragments = counts.take();
  return made;
}

Case extreme_w(const Precision& precision, std::uint64_t seed) {
  constexpr std::uint32_t kSize = 16;
  DrawList list(precision, kSize, seed);
  list.draw();
  // Vertices farther apart than this may be cut in the wrong place by arithmetic in double: docs/numerics.md.
  constexpr int kApart = 40;
  const auto sign = [&] { return list.one_in(2) ? 1.0F : -1.0F; };
  const auto real = [&] { return static_cast<float>(list.random.real(0.5, 1)); };
  CertainCounts counts(kSize, precision, list.sample());
  for (int n = 0; n < 12; ++n) {
    // All of a triangle on a scale of its own: huge, denormal.
    const int scale = static_cast<int>(list.one_in(2) ? list.between(-146, 80) : list.between(-4, 4));
    std::array<glm::vec4, 3> triangle{};
    for (glm::vec4& v : triangle) {
      const int w = scale + static_cast<int>(list.one_in(3) ? list.between(0, kApart) : list.between(0, 3));
      const auto within = [&] {
        return sign() * std::ldexp(real(), w - static_cast<int>(list.between(0, 3)) + 1);
      };
      v.w = std::ldexp(real(), w) * (list.one_in(3) ? -1.0F : 1.0F);
      v.x = within();
      v.y = within();
      v.z = std::abs(within()) * (list.one_in(4) ? -1.0F : 1.0F);
      switch (list.between(0, 9)) {
        case 0:
          v.w = 0;
          break;
        case 1:
          v.w = -0.0F;
          break;
        case 2:
          v.z = v.w;
          break;
        case 3:
          v.z = 0;
          break;
        default:
          break;
      }
    }
    list.add_clip(triangle);
    counts.add(triangle);
  }
  Case made{.frame = list.take_frame(), .sample = list.sample()};
  made.fragments = counts.take();
  return made;
}

Case not_finite(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, 16, seed);
  list.draw();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr std::array kBad{std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::quiet_NaN(),
                            kInfinity, -kInfinity};
  for (int n = 0; n < 60; ++n) {
    if (list.one_in(2)) {
      list.add({list.point_on_target(), list.point_on_target(), list.point_on_target()});
      continue;
    }
    std::array<glm::vec4, 3> triangle{};
    for (glm::vec4& v : triangle) {
      v = {static_cast<float>(list.random.real(-1, 1)), static_cast<float>(list.random.real(-1, 1)),
           list.depth(), 1};
    }
    for (auto bad = list.between(1, 3); bad > 0; --bad) {
      triangle[static_cast<std::size_t>(list.between(0, 2))][static_cast<int>(list.between(0, 3))] =
          kBad[static_cast<std::size_t>(list.between(0, 3))];
    }
    list.add_clip(triangle);
  }
  // Of a finite triangle 0 may be negative.
  Case made = list.take_defined();
  for (glm::vec4& v : made.frame.vertices) {
    for (int k = 0; k < 3; ++k) {
      v[k] = v[k] == 0 && list.one_in(2) ? -0.0F : v[k];
    }
  }
  return made;
}

Case grazer(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, 16, seed);
  list.draw();
  constexpr float kLeast = std::numeric_limits<float>::denorm_min();
  for (int n = 0; n < 60; ++n) {
    GridTriangle triangle;
    for (GridPoint& p : triangle) {
      p = list.one_in(2) ? list.point_on_target() : list.point(-list.extent(), 2 * list.extent());
      if (list.one_in(3)) {  // on the sides of the clip volume
        (list.one_in(2) ? p.x : p.y) = list.one_in(2) ? 0 : list.extent();
      }
    }
    std::array<float, 3> z{};
    for (float& value : z) {
      constexpr std::array kOn{0.0F, -0.0F, kLeast, 1.0F, 1.0F - 0x1p-24F, 0.5F};
      value = kOn[static_cast<std::size_t>(list.between(0, 5))];
    }
    if (list.one_in(4)) {
      // Outside, but for an edge or a vertex on the plane: nothing is left.
      std::array<glm::vec4, 3> gone{};
      const bool is_near = list.one_in(2);
      const auto beyond = static_cast<std::size_t>(list.between(0, 2));
      for (std::size_t i = 0; i < 3; ++i) {
        const bool out = i == beyond || list.one_in(2);
        const float past =
            is_near ? (list.one_in(2) ? -kLeast : -0.5F) : (list.one_in(2) ? 1 + 0x1p-23F : 2.0F);
        gone[i] = {static_cast<float>(list.random.real(-1, 1)), static_cast<float>(list.random.real(-1, 1)),
                   out       ? past
                   : is_near ? 0.0F
                             : 1.0F,
                   1};
      }
      list.add_clip(gone);
      continue;
    }
    list.add(triangle, z);
  }
  return list.take_defined();
}

}  // namespace halfspace::stress
