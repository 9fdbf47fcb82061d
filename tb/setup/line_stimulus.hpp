/// Thin lines for the setup bench.
#pragma once

#include <cstdint>
#include <vector>

#include "common/random.hpp"
#include "job.hpp"
#include "places.hpp"

namespace halfspace::tb {

/// Ends on corners, sides and centres of diamonds, at each other pixel's border, in every direction; and
/// lines between the corners of the guard band. By every rule.
void add_lines(std::vector<SetupJob>& jobs, const Band& band);

/// Makes a line of a job: from vertex 0 to vertex 1 as they are now and then; else on the corners and sides
/// of diamonds, in a pixel, along the axes or at the borders of octants, about the pixel `centre`.
void make_random_line(SetupJob& job, const Band& band, const Point& centre, int block_size, Random& random);

}  // namespace halfspace::tb
