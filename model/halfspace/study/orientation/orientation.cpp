#include "halfspace/study/orientation/orientation.hpp"

#include <gmpxx.h>

namespace halfspace::study {
namespace {

constexpr std::array kSettings{
    Setting{"a", {{{0.5, 0.5}, {12, 12}, {24, 24}}}},
    Setting{"b",
            {{{0.50000000000002531, 0.5000000000000171},
              {17.300000000000001, 17.300000000000001},
              {24.00000000000005, 24.0000000000000517765}}}},
    Setting{"c", {{{0.5, 0.5}, {8.8000000000000007, 8.8000000000000007}, {12.1, 12.1}}}},
};

}  // namespace

int exact_orientation(const Triple& points) {
  const auto& [p, q, r] = points;
  const auto difference = [](double to, double from) { return mpq_class(mpq_class(to) - mpq_class(from)); };
  const mpq_class value =
      difference(q.x, p.x) * difference(r.y, p.y) - difference(q.y, p.y) * difference(r.x, p.x);
  return sgn(value);
}

std::span<const Setting> settings() { return kSettings; }

}  // namespace halfspace::study
