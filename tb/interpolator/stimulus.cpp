#include "stimulus.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include "halfspace/units/interpolator.hpp"
#include "halfspace/units/packing.hpp"

namespace halfspace::tb {
namespace {

constexpr std::uint32_t kFloatOne = 0x3F800000;
constexpr std::uint32_t kLeastFloat = 0x00800000;
constexpr std::uint32_t kMostFloat = 0x7F7FFFFF;
constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();

/// A signed number of any size up to `bits` with its sign.
std::int64_t any_size(int bits, Random& random) {
  const int size = static_cast<int>(random.range(0, bits - 1));
  const auto magnitude = static_cast<std::int64_t>(random.bits() & ((std::uint64_t{1} << size) - 1));
  return random.below(2) == 0 ? magnitude : -magnitude;
}

std::array<std::uint32_t, 3> any_q(Random& random) {
  std::array<std::uint32_t, 3> q{kFloatOne, kFloatOne, kFloatOne};
  const std::uint64_t kind = random.below(4);
  for (std::uint32_t& each : q) {
    const auto mantissa = static_cast<std::uint32_t>(random.below(1 << 23));
    const auto field = static_cast<std::uint32_t>(kind == 1   ? 127
                                                  : kind == 2 ? random.range(119, 135)
                                                              : random.range(1, 254));
    each = kind == 0 ? kFloatOne : field << 23 | mantissa;
  }
  return q;
}

void fill_values(AttributeQuad& quad, Random& random) {
  const std::uint64_t kind = random.below(4);
  for (std::int32_t& value : quad.value) {
    value = kind == 0   ? static_cast<std::int32_t>(random.range(0, 1 << kAttributeFraction))
            : kind == 1 ? (random.below(2) == 0 ? kLeast : kMost)
                        : static_cast<std::int32_t>(any_size(32, random));
  }
}

/// A quad at or near a triangle whose vertices are on the sub-pixel grid: the covered pixels are covered.
AttributeQuad triangle_quad(const InterpolatorParameters& parameters, Random& random) {
  AttributeQuad quad;
  const int bits = parameters.sub_pixel_bits;
  std::array<std::int64_t, 3> x{};
  std::array<std::int64_t, 3> y{};
  const int size = static_cast<int>(random.range(2, 12)) + bits;
  do {
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = any_size(size, random);
      y[i] = any_size(size, random);
    }
    quad.area2 = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
    if (quad.area2 < 0) {
      std::swap(x[1], x[2]);
      std::swap(y[1], y[2]);
      quad.area2 = -quad.area2;
    }
  } while (quad.area2 == 0);
  // A pixel centre near a point of the triangle.
  const std::int64_t u = random.range(0, 16);
  const std::int64_t v = random.range(0, 16 - u);
  const auto at = [&](const std::array<std::int64_t, 3>& p) {
    const std::int64_t inside = p[0] + (u * (p[1] - p[0]) + v * (p[2] - p[0])) / 16;
    return ((inside >> bits) + random.range(-1, 1)) * (std::int64_t{1} << bits) +
           (std::int64_t{1} << (bits - 1));
  };
  const std::int64_t px = at(x);
  const std::int64_t py = at(y);
  for (std::size_t i = 0; i < 2;
       ++i) {  // edge 1 is opposite to vertex 1, from vertex 2 to 0; edge 2 from 0 to 1
    const std::size_t from = i == 0 ? 2 : 0;
    const std::size_t to = i == 0 ? 0 : 1;
    quad.a[i] = static_cast<std::int32_t>(y[from] - y[to]);
    quad.b[i] = static_cast<std::int32_t>(x[to] - x[from]);
    quad.e[i] = quad.a[i] * (px - x[from]) + quad.b[i] * (py - y[from]);
  }
  for (int pixel = 0; pixel < 4; ++pixel) {
    std::int64_t rest = quad.area2;
    bool inside = true;
    for (std::size_t i = 0; i < 2; ++i) {
      const std::int64_t steps =
          std::int64_t{quad.a[i]} * (pixel % 2) + std::int64_t{quad.b[i]} * (pixel / 2);
      const std::int64_t e = quad.e[i] + steps * (std::int64_t{1} << bits);
      inside = inside && e >= 0;
      rest -= e;
    }
    inside = inside && rest >= 0;
    quad.mask = static_cast<std::uint8_t>(quad.mask | (inside ? 1u << pixel : 0u));
  }
  quad.q = any_q(random);
  fill_values(quad, random);
  return quad;
}

/// Edges of any size, which no triangle need have.
AttributeQuad any_quad(const InterpolatorParameters& parameters, Random& random) {
  const Widths widths = parameters.widths();
  AttributeQuad quad{.mask = static_cast<std::uint8_t>(random.below(16)), .q = any_q(random)};
  for (std::size_t i = 0; i < 2; ++i) {
    quad.e[i] = any_size(widths.EdgeBits - 4, random);
    quad.a[i] = static_cast<std::int32_t>(any_size(widths.StepBits, random));
    quad.b[i] = static_cast<std::int32_t>(any_size(widths.StepBits, random));
  }
  quad.area2 = 1 + std::abs(any_size(widths.EdgeBits - 4, random));
  fill_values(quad, random);
  return quad;
}

class QuadStimulus : public Stimulus {
 public:
  QuadStimulus(const InterpolatorParameters& parameters, InterpolatorCoverage& coverage)
      : parameters_(parameters),
        coverage_(coverage),
        words_(words_for(packed_bits<ShadedQuad>(parameters.widths()))) {}

  void reference(std::span<const std::uint32_t> packet, Scoreboard& scoreboard) final {
    const auto quad = unpack<AttributeQuad>(packet, parameters_.widths());
    const ShadedQuad shaded = interpolator(quad, parameters_.sub_pixel_bits, parameters_.bits);
    coverage_.quad(quad, shaded);
    pack(shaded, parameters_.widths(), words_);
    scoreboard.expect(words_);
  }

 protected:
  InterpolatorParameters parameters_;

 private:
  InterpolatorCoverage& coverage_;
  std::vector<std::uint32_t> words_;
};

class RandomStimulus final : public QuadStimulus {
 public:
  RandomStimulus(const InterpolatorParameters& parameters, InterpolatorCoverage& coverage, std::uint64_t seed,
                 std::uint64_t count)
      : QuadStimulus(parameters, coverage), random_(seed), left_(count) {}

  bool next(std::span<std::uint32_t> packet) override {
    if (left_ == 0) {
      return false;
    }
    --left_;
    pack(random_.below(4) == 0 ? any_quad(parameters_, random_) : triangle_quad(parameters_, random_),
         parameters_.widths(), packet);
    return true;
  }

 private:
  Random random_;
  std::uint64_t left_;
};

class ListStimulus final : public QuadStimulus {
 public:
  ListStimulus(const InterpolatorParameters& parameters, InterpolatorCoverage& coverage,
               std::vector<AttributeQuad> quads)
      : QuadStimulus(parameters, coverage), quads_(std::move(quads)) {}

  bool next(std::span<std::uint32_t> packet) override {
    if (next_ == quads_.size()) {
      return false;
    }
    pack(quads_[next_++], parameters_.widths(), packet);
    return true;
  }

 private:
  std::vector<AttributeQuad> quads_;
  std::size_t next_ = 0;
};

/// With other values at each vertex and component, and none of them 0.
AttributeQuad numbered_quad(const std::array<std::int64_t, 3>& e, const std::array<std::uint32_t, 3>& q,
                            std::uint8_t mask) {
  AttributeQuad quad{.mask = mask, .e = {e[1], e[2]}, .area2 = e[0] + e[1] + e[2], .q = q};
  for (std::size_t i = 0; i < quad.value.size(); ++i) {
    quad.value[i] = static_cast<std::int32_t>(1 + i) * (i % 2 == 0 ? 0x01234567 : -0x00654321);
  }
  return quad;
}

}  // namespace

std::vector<AttributeQuad> directed_quads(const InterpolatorParameters& parameters) {
  const std::int64_t most = (std::int64_t{1} << (parameters.widths().EdgeBits - 4)) - 1;
  const std::array<std::int64_t, 6> sizes{
      0, 1, (std::int64_t{1} << parameters.bits) - 1, std::int64_t{1} << parameters.bits, most / 3, most};
  const std::array<std::array<std::uint32_t, 3>, 6> ratios = {{{kFloatOne, kFloatOne, kFloatOne},
                                                               {kLeastFloat, kMostFloat, kFloatOne},
                                                               {kMostFloat, kFloatOne, kLeastFloat},
                                                               {kFloatOne, kLeastFloat, kMostFloat},
                                                               {kLeastFloat, kLeastFloat, kLeastFloat},
                                                               {kMostFloat, kMostFloat, kMostFloat}}};
  std::vector<AttributeQuad> quads;
  for (const std::int64_t e0 : sizes) {
    for (const std::int64_t e1 : sizes) {
      for (const std::int64_t e2 : sizes) {
        for (const auto& q : ratios) {
          if (e0 + e1 + e2 > 0) {
            quads.push_back(numbered_quad({e0, e1, e2}, q, 15));
          }
          // Each edge below 0 in turn, as at helpers.
          for (std::size_t i = 0; i < 3; ++i) {
            std::array<std::int64_t, 3> e{e0, e1, e2};
            e[i] = -e[i];
            if (e[0] + e[1] + e[2] > 0) {
              quads.push_back(numbered_quad(e, q, 0));
            }
          }
        }
      }
    }
  }
  // Values at the ends of the format.
  for (unsigned ends = 0; ends < 8; ++ends) {
    for (const std::int64_t e1 :
         {std::int64_t{-900}, std::int64_t{0}, std::int64_t{500}, std::int64_t{990}}) {
      for (const std::uint8_t mask : {std::uint8_t{0}, std::uint8_t{15}}) {
        AttributeQuad quad = numbered_quad({1000 - e1, e1, 0}, ratios[0], mask);
        for (std::size_t i = 0; i < quad.value.size(); ++i) {
          quad.value[i] = (ends >> i / kComponents & 1) != 0 ? kMost : kLeast;
        }
        quads.push_back(quad);
      }
    }
  }
  return quads;
}

std::unique_ptr<Stimulus> random_stimulus(const InterpolatorParameters& parameters,
                                          InterpolatorCoverage& coverage, std::uint64_t seed,
                                          std::uint64_t count) {
  return std::make_unique<RandomStimulus>(parameters, coverage, seed, count);
}

std::unique_ptr<Stimulus> list_stimulus(const InterpolatorParameters& parameters,
                                        InterpolatorCoverage& coverage, std::vector<AttributeQuad> quads) {
  return std::make_unique<ListStimulus>(parameters, coverage, std::move(quads));
}

}  // namespace halfspace::tb
