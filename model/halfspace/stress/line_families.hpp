/// Families of thin lines, each by all rules: the definitions of reference/exact_line.hpp judge.
#pragma once

#include <span>

#include "halfspace/stress/family.hpp"

namespace halfspace::stress {

/// Their cases have one sample at the centre of a pixel.
std::span<const Family> line_families();

}  // namespace halfspace::stress
