/// The scenes of reports(), by file.
#pragma once

#include <cstdint>

#include "halfspace/stress/case.hpp"

namespace halfspace::stress::report {

Case shared_diagonal(const Precision& precision, std::uint64_t seed);
Case fading_screen(const Precision& precision, std::uint64_t seed);
Case polygon_strip(const Precision& precision, std::uint64_t seed);
Case far_edges(const Precision& precision, std::uint64_t seed);
Case lod_border(const Precision& precision, std::uint64_t seed);
Case fractional_rows(const Precision& precision, std::uint64_t seed);
Case distant_mesh(const Precision& precision, std::uint64_t seed);
Case screen_border(const Precision& precision, std::uint64_t seed);
Case sixteen_bits(const Precision& precision, std::uint64_t seed);
Case pixel_centres(const Precision& precision, std::uint64_t seed);

Case near_camera(const Precision& precision, std::uint64_t seed);
Case across_near(const Precision& precision, std::uint64_t seed);
Case corner_cut_off(const Precision& precision, std::uint64_t seed);
Case cut_apart(const Precision& precision, std::uint64_t seed);
Case vertex_behind_eye(const Precision& precision, std::uint64_t seed);
Case hidden_by_near(const Precision& precision, std::uint64_t seed);
Case beyond_far(const Precision& precision, std::uint64_t seed);

Case odd_scissor(const Precision& precision, std::uint64_t seed);
Case viewport_above(const Precision& precision, std::uint64_t seed);
Case flipped_culling(const Precision& precision, std::uint64_t seed);

Case overlay_tile(const Precision& precision, std::uint64_t seed);
Case depth_prepass(const Precision& precision, std::uint64_t seed);
Case floor_decal(const Precision& precision, std::uint64_t seed);

}  // namespace halfspace::stress::report
