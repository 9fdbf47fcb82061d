/// Verilated pipelines, one configuration a library, loaded when they are needed: who needs none needs no
/// Verilator.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "halfspace/config/config.hpp"
#include "halfspace/timing/rtl/verilated_pipeline.hpp"

namespace halfspace::rtl {

/// The pipeline of `config` from one of the libraries halfspace_rtl_*.so in `folder`. `seed` decides what its
/// registers hold before reset. Throws InputError that names the folder and what it has when none fits, and
/// OptionError for a configuration that no RTL has.
[[nodiscard]] std::unique_ptr<VerilatedPipeline> load_pipeline(const Config& config,
                                                               const std::filesystem::path& folder,
                                                               std::uint64_t seed);

}  // namespace halfspace::rtl
