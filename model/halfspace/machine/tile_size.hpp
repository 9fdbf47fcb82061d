/// The one place where the tile size of a configuration becomes a constant of the compiler.
#pragma once

#include <type_traits>
#include <utility>

namespace halfspace {

/// Calls visit(std::integral_constant<int, tile_size>{}). `tile_size`: 4, 8 or 16.
template <class Visit>
decltype(auto) with_tile_size(int tile_size, Visit&& visit) {
  switch (tile_size) {
    case 4:
      return std::forward<Visit>(visit)(std::integral_constant<int, 4>{});
    case 16:
      return std::forward<Visit>(visit)(std::integral_constant<int, 16>{});
    default:
      return std::forward<Visit>(visit)(std::integral_constant<int, 8>{});
  }
}

}  // namespace halfspace
