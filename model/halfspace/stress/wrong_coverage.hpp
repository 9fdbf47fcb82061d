/// Ways to cover a triangle that are wrong, each in one thing; the depth is right.
#pragma once

#include <vector>

#include "halfspace/reference/coverage_method.hpp"

namespace halfspace::stress::wrong {

using Fragments = std::vector<reference::Fragment>;

void owns_nothing(const reference::Piece& piece, Fragments& fragments);
void owns_everything(const reference::Piece& piece, Fragments& fragments);
void bottom_right(const reference::Piece& piece, Fragments& fragments);
void no_top(const reference::Piece& piece, Fragments& fragments);
void every_horizontal(const reference::Piece& piece, Fragments& fragments);
void unturned_ties(const reference::Piece& piece, Fragments& fragments);
void float_edges(const reference::Piece& piece, Fragments& fragments);
void float_difference(const reference::Piece& piece, Fragments& fragments);
void float_increments(const reference::Piece& piece, Fragments& fragments);
void coarse_grid(const reference::Piece& piece, Fragments& fragments);
void edges_of_32_bits(const reference::Piece& piece, Fragments& fragments);
void drops_tiny(const reference::Piece& piece, Fragments& fragments);
void one_winding(const reference::Piece& piece, Fragments& fragments);
void short_box(const reference::Piece& piece, Fragments& fragments);
void late_box(const reference::Piece& piece, Fragments& fragments);
void corner_samples(const reference::Piece& piece, Fragments& fragments);
void swapped_reject(const reference::Piece& piece, Fragments& fragments);
void hasty_accept(const reference::Piece& piece, Fragments& fragments);
void saturates_to_16_bits(const reference::Piece& piece, Fragments& fragments);
void cuts_steps(const reference::Piece& piece, Fragments& fragments);
void widens_slivers(const reference::Piece& piece, Fragments& fragments);
void no_prestep(const reference::Piece& piece, Fragments& fragments);
void unsigned_box(const reference::Piece& piece, Fragments& fragments);

}  // namespace halfspace::stress::wrong
