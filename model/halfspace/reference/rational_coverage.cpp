#include "halfspace/reference/rational_coverage.hpp"

namespace halfspace::reference {
namespace {

/// Signs of the two steps.
struct Nudge {
  int x;
  int y;
};

Nudge nudge_of(TieRule rule) {
  switch (rule) {
    case TieRule::kTopLeft:
      return {1, 1};
    case TieRule::kBottomLeft:
      return {1, -1};
    case TieRule::kTopRight:
      return {-1, 1};
    case TieRule::kBottomRight:
      return {-1, -1};
    case TieRule::kNormalSign:
      // Inside where A, else B, is positive: where the edge function grows along x, else along y.
      return {1, 1};
  }
  return {1, 1};
}

/// The sign of the determinant | b - a, p - a | of the nudged p: of it, or where it is 0 of its slope along
/// x, or where that is 0 too along y.
int side_of_line(const RationalPoint& a, const RationalPoint& b, const RationalPoint& p, const Nudge& nudge) {
  const mpq_class determinant = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
  if (sgn(determinant) != 0) return sgn(determinant);
  const mpq_class slope_x = a.y - b.y;
  if (sgn(slope_x) != 0) return sgn(slope_x) * nudge.x;
  const mpq_class slope_y = b.x - a.x;
  return sgn(slope_y) * nudge.y;
}

}  // namespace

RationalPoint rational_point(const GridPoint& p, int subpixel_bits) {
  const mpq_class unit(1, 1L << subpixel_bits);
  return {unit * static_cast<long>(p.x), unit * static_cast<long>(p.y)};
}

bool rational_covers(const RationalTriangle& triangle, const RationalPoint& sample, TieRule rule) {
  const Nudge nudge = nudge_of(rule);
  const int first = side_of_line(triangle[0], triangle[1], sample, nudge);
  return first != 0 && first == side_of_line(triangle[1], triangle[2], sample, nudge) &&
         first == side_of_line(triangle[2], triangle[0], sample, nudge);
}

}  // namespace halfspace::reference
