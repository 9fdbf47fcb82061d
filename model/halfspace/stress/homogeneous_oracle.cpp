#include "halfspace/stress/homogeneous_oracle.hpp"

namespace halfspace::stress {
namespace {

using Vector = std::array<mpq_class, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

mpq_class dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The least common denominator of all.
mpz_class denominator(const Vector& v) {
  mpz_class all = 1;
  for (const mpq_class& value : v) {
    all = lcm(all, value.get_den());
  }
  return all;
}

}  // namespace

HomogeneousTriangle::HomogeneousTriangle(const std::array<glm::vec4, 3>& vertices, std::uint32_t size,
                                         int sub_pixel_bits) {
  std::array<Vector, 3> v;
  for (std::size_t i = 0; i < 3; ++i) {
    v[i] = {mpq_class(vertices[i].x), mpq_class(vertices[i].y), mpq_class(vertices[i].w)};
  }
  const mpq_class determinant = dot(v[0], cross(v[1], v[2]));
  if (sgn(determinant) == 0) {
    return;  // seen from its edge, or without area
  }
  // The weights of (x, y, 1); z is their sum of the vertices' z, and 1 - z is 0 where z is w.
  std::array<Vector, 5> forms;
  forms[4] = {0, 0, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    forms[i] = cross(v[(i + 1) % 3], v[(i + 2) % 3]);
    for (std::size_t k = 0; k < 3; ++k) {
      forms[i][k] /= determinant;
      const mpq_class part = forms[i][k] * mpq_class(vertices[i].z);
      forms[3][k] += part;
      forms[4][k] -= part;
    }
  }
  // From clip units to 1/256 pixel: x = X 2 / (256 size) - 1.
  const mpq_class scale(2, 256UL * size);
  for (Vector& form : forms) {
    form = {form[0] * scale, form[1] * scale, form[2] - form[0] - form[1]};
    const mpz_class all = denominator(form);
    Linear side{.a = mpz_class(form[0] * all),
                .b = mpz_class(form[1] * all),
                .c = mpz_class(form[2] * all),
                .reach = 0};
    side.reach = (2UL << (8 - sub_pixel_bits)) * (abs(side.a) + abs(side.b));
    sides_.push_back(side);
  }
}

Certainty HomogeneousTriangle::covers(std::uint32_t x, std::uint32_t y, const SamplePosition& sample) const {
  if (sides_.empty()) {
    return Certainty::kUncertain;
  }
  Certainty result = Certainty::kInside;
  for (const Linear& side : sides_) {
    const mpz_class value =
        side.a * (256UL * x + 16UL * sample.x) + side.b * (256UL * y + 16UL * sample.y) + side.c;
    if (value < -side.reach) {
      return Certainty::kOutside;
    }
    if (value <= side.reach) {
      result = Certainty::kUncertain;
    }
  }
  return result;
}

}  // namespace halfspace::stress
