/// The families of the stress campaign: what their cases look like, and the law that they must obey.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "halfspace/stress/case.hpp"

namespace halfspace::stress {

struct Family {
  std::string_view name;
  std::string_view looks;  ///< of its triangles, for people
  std::string_view law;
  Case (*make)(const Precision& precision, std::uint64_t seed);
  std::string_view report = {};   ///< address of the public report that a scene comes from
  std::string_view suspect = {};  ///< the rasterizer, wrong or textbook, that does what is reported there
};

/// Of its cases the definition names every triangle that has a pixel, so that they may be drawn
/// conservatively: none leaves clipping in several pieces, or as an edge of itself.
bool is_unclipped(const Family& family);

/// Those of the campaign.
std::span<const Family> families();

/// Small scenes from public reports of seams and holes. A seed varies what a report leaves open.
std::span<const Family> reports();

/// Throws InputError, with the legal names.
const Family& family_of(std::string_view name);

/// Case `index` of a family in the campaign of `seed`: the same with every compiler.
Case make_case(const Family& family, const Precision& precision, std::uint64_t seed, std::uint64_t index);

/// Writes the first `count` cases of each family as NAME.ptf, and their twins as NAME-twin.ptf. Throws
/// InputError.
void write_cases(std::span<const Family* const> families, const Precision& precision, std::uint64_t seed,
                 std::uint64_t count, const std::filesystem::path& folder);

// By file.
Case sliver(const Precision& precision, std::uint64_t seed);
Case sub_pixel(const Precision& precision, std::uint64_t seed);
Case on_samples(const Precision& precision, std::uint64_t seed);
Case collinear(const Precision& precision, std::uint64_t seed);
Case near_miss(const Precision& precision, std::uint64_t seed);
Case guard_band(const Precision& precision, std::uint64_t seed);

Case fan(const Precision& precision, std::uint64_t seed);
Case mesh(const Precision& precision, std::uint64_t seed);
Case cut_mesh(const Precision& precision, std::uint64_t seed);
Case far_fan(const Precision& precision, std::uint64_t seed);

Case permuted(const Precision& precision, std::uint64_t seed);
Case translated(const Precision& precision, std::uint64_t seed);

Case beyond_band(const Precision& precision, std::uint64_t seed);
Case extreme_w(const Precision& precision, std::uint64_t seed);
Case not_finite(const Precision& precision, std::uint64_t seed);
Case grazer(const Precision& precision, std::uint64_t seed);

Case grid_depth(const Precision& precision, std::uint64_t seed);
Case steep_depth(const Precision& precision, std::uint64_t seed);
Case depth_stack(const Precision& precision, std::uint64_t seed);
Case clamp_and_offset(const Precision& precision, std::uint64_t seed);

}  // namespace halfspace::stress
