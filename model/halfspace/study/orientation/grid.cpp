#include "halfspace/study/orientation/grid.hpp"

namespace halfspace::study {

Grid double_grid(const Setting& setting) { return {setting.points, 0x1p-53}; }

Grid float_grid(const Setting& setting) {
  Triple points = setting.points;
  for (Point& p : points) {
    p = {static_cast<float>(p.x), static_cast<float>(p.y)};
  }
  return {points, 0x1p-24};
}

Values over(const Grid& grid, const std::function<int(const Triple&)>& value) {
  Values values;
  values.reserve(std::size_t{kGridSide} * kGridSide);
  for (int y = 0; y < kGridSide; ++y) {
    for (int x = 0; x < kGridSide; ++x) {
      values.push_back(value(grid.at(x, y)));
    }
  }
  return values;
}

Errors errors(const Values& exact, const Values& computed) {
  Errors errors;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    if (exact[i] != computed[i]) {
      ++(computed[i] == 0 ? errors.false_zero : exact[i] == 0 ? errors.false_sign : errors.opposite);
    }
  }
  return errors;
}

}  // namespace halfspace::study
