#include "halfspace/study/precision/edge_subjects.hpp"

#include <array>

#include "halfspace/study/precision/edge_arithmetic.hpp"

namespace halfspace::study {
namespace {

template <class Arithmetic>
void cover_pixels(const FloatTriangle& triangle, const PixelRect& target,
                  std::vector<std::uint32_t>& pixels) {
  cover(Arithmetic(triangle, target), [&](std::int64_t x, std::int64_t y) {
    pixels.push_back(static_cast<std::uint32_t>((y - target.first_y) * (target.end_x - target.first_x) + x -
                                                target.first_x));
  });
}

template <class Arithmetic>
std::uint64_t count_pixels(std::span<const FloatTriangle> triangles, const PixelRect& target) {
  std::uint64_t count = 0;
  for (const FloatTriangle& triangle : triangles) {
    cover(Arithmetic(triangle, target), [&](std::int64_t, std::int64_t) { ++count; });
  }
  return count;
}

template <class Arithmetic>
constexpr int grid_bits() {
  if constexpr (requires { Arithmetic::kBits; }) {
    return Arithmetic::kBits;
  } else {
    return 0;
  }
}

template <class Arithmetic>
constexpr EdgeSubject subject(std::string_view name, std::string_view computes, std::string_view source) {
  return {
      name, computes, source, grid_bits<Arithmetic>(), cover_pixels<Arithmetic>, count_pixels<Arithmetic>};
}

// clang-format off
constexpr std::array kSubjects{
    subject<ExactInteger>("exact_integer", "integers of 128 bits, positions not snapped", "the definition, docs/numerics.md"),
    subject<Fixed<8>>("fixed_8", "integers, positions on 1/256 pixel: the baseline", "the unit setup"),
    subject<Fixed<6>>("fixed_6", "integers, positions on 1/64 pixel", "the unit setup"),
    subject<Fixed<4>>("fixed_4", "integers, positions on 1/16 pixel", "the unit setup"),
    subject<DoubleDifference>("double", "A x + B y + C in double, C by difference", "Pineda 1988"),
    subject<FloatDifference>("float_difference", "A x + B y + C in float32, C by difference", "Pineda 1988"),
    subject<FloatAverage>("float_average", "the same, C the mean of both ends'", "McMillan, MIT 6.837, 2000"),
    subject<FloatVertex>("float_vertex", "A (x - x0) + B (y - y0) in float32", "Pineda 1988"),
    subject<FloatIncrements>("float_increments", "float32, A added for each pixel, B for each row", "Pineda 1988"),
    subject<FloatEpsilon>("float_epsilon", "float32, E within 0.001 of 0 taken for a tie", "reference/float_epsilon"),
    subject<Normalised>("normalised", "16.16 fixed point, divided by the triangle's largest A or B", "Vortex"),
};
// clang-format on

}  // namespace

std::span<const EdgeSubject> edge_subjects() { return kSubjects; }

}  // namespace halfspace::study
