/// The part of the study's JSON that is about edges.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>

namespace halfspace::study {

/// `samples`: of each family, at least. `rounds`: of the measurement of time. Throws InputError.
[[nodiscard]] nlohmann::ordered_json edge_report(std::uint64_t samples, std::uint64_t seed, int rounds,
                                                 std::span<const std::filesystem::path> frames);

}  // namespace halfspace::study
