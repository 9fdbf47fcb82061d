/// Depth as the buffer stores it: a code of 16, 24 or 32 bits whose order as a signed number of 32 bits is
/// that of depth.
#pragma once

#include <cstdint>

namespace halfspace::reference {

/// How a depth buffer stores its values; the numbers are those of the frame format.
enum class Storage : std::uint32_t { kNone = 0, kUnorm16 = 1, kUnorm24 = 2, kUnorm32 = 3, kFloat32 = 4 };

/// 16, 24 or 32 for the unorm formats, 0 for the others.
[[nodiscard]] int unorm_bits(Storage storage);

/// The code of a depth. Unorm: round(depth * (2^bits - 1)), ties to even, of the depth clamped to [0,1] (NaN
/// to 0); float32: the bits of the nearest float, of a negative one its magnitude's as a negative number.
[[nodiscard]] std::uint32_t encode_depth(double depth, Storage storage);

/// The float32 nearest to the value that a code stands for.
[[nodiscard]] float decode_depth(std::uint32_t code, Storage storage);

/// The depth test, incoming against stored code. `func` is 0 never, 1 less, 2 equal, 3 lequal, 4 greater, 5
/// notequal, 6 gequal, 7 always, as in the frame format; anything else throws InputError.
[[nodiscard]] bool depth_test(std::uint32_t func, std::uint32_t incoming_code, std::uint32_t stored_code);

}  // namespace halfspace::reference
