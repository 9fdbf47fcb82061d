/// Pictures like those of the paper.
#pragma once

#include <vector>

#include "halfspace/report/pictures.hpp"
#include "halfspace/study/orientation/grid.hpp"

namespace halfspace::study {

/// Signs in the paper's colours, y up: red negative, yellow 0, blue positive, and black where the line
/// through q and r passes by `exact`. Darker where `shade` is not 0, if there is one.
Picture sign_picture(const Values& signs, const Values& exact, const Values& shade = {});

/// White once, black not at all, red twice.
Picture owner_picture(const Values& owners);

/// `pictures` of one size side by side, `columns` in a row.
Picture montage(const std::vector<Picture>& pictures, int columns);

}  // namespace halfspace::study
