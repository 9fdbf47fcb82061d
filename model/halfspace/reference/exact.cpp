#include "halfspace/reference/exact.hpp"

namespace halfspace::reference {

void cover_exactly(const Piece& piece, std::vector<Fragment>& fragments) {
  const PixelRect& box = piece.bounds;
  for (std::int64_t y = box.first_y; y < box.end_y; ++y) {
    for (std::int64_t x = box.first_x; x < box.end_x; ++x) {
      if (covers(piece.grid, piece.centre(x, y), piece.rule)) fragments.push_back(piece.fragment(x, y));
    }
  }
}

}  // namespace halfspace::reference
