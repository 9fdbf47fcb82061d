#include "halfspace/reference/exact.hpp"

#include "halfspace/reference/pixel_square.hpp"

namespace halfspace::reference {
namespace {

bool has_pixel(const Piece& piece, std::int64_t x, std::int64_t y) {
  if (piece.pixels == Pixels::kCentres) return covers(piece.grid, piece.centre(x, y), piece.rule);
  const PixelSquare square = pixel_square(x, y, piece.subpixel_bits, piece.uncertainty);
  return piece.pixels == Pixels::kTouched ? touches(piece.grid, square) : fills(piece.grid, square);
}

}  // namespace

void cover_exactly(const Piece& piece, std::vector<Fragment>& fragments) {
  const PixelRect& box = piece.bounds;
  for (std::int64_t y = box.first_y; y < box.end_y; ++y) {
    for (std::int64_t x = box.first_x; x < box.end_x; ++x) {
      if (has_pixel(piece, x, y)) fragments.push_back(piece.fragment(x, y));
    }
  }
}

}  // namespace halfspace::reference
