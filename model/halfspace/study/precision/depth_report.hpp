/// The part of the study's JSON that is about depth.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>

namespace halfspace::study {

/// `samples`: of each family and format. Throws InputError.
[[nodiscard]] nlohmann::ordered_json depth_report(std::uint64_t samples, std::uint64_t seed,
                                                  std::span<const std::filesystem::path> frames);

}  // namespace halfspace::study
