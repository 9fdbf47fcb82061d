/// The roof of any exact depth test: what the processor does at best with samples that lie one after the
/// other, of one plane, with no raster around it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace halfspace {

/// Tests codes `first`, `first` + `step`, ... (modulo 2^32) against `stored`, with "less", and writes those
/// that pass. Returns how many do. The number of codes is a multiple of 64.
std::uint64_t test_in_a_row(std::span<std::uint32_t> stored, std::uint32_t first, std::uint32_t step);

}  // namespace halfspace
