/// The implementations of the units' function.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace halfspace {

/// kReadable is the definition: the units, one packet after the other (machine/in_order.hpp). kFast gives the
/// same results with vectors (fast/fast_core.hpp). kAuto is the fast one where it covers the run, else the
/// readable one.
enum class Core : std::uint8_t { kAuto, kFast, kReadable };

inline constexpr std::array<std::string_view, 3> kCoreName{"auto", "fast", "readable"};

}  // namespace halfspace
