#include "halfspace/study/orientation/grid_picture.hpp"

#include <array>

namespace halfspace::study {
namespace {

using Colour = std::array<std::uint8_t, 3>;

constexpr Colour kBlack{0, 0, 0};
constexpr Colour kWhite{255, 255, 255};
constexpr Colour kRed{220, 30, 30};
constexpr Colour kYellow{250, 220, 40};
constexpr Colour kBlue{40, 70, 200};

std::size_t index(int x, int y) {
  return static_cast<std::size_t>(y) * kGridSide + static_cast<std::size_t>(x);
}

/// On the line, or the last point before it in a row.
bool on_line(const Values& exact, int x, int y) {
  const int sign = exact[index(x, y)];
  return sign == 0 || (x + 1 < kGridSide && exact[index(x + 1, y)] == -sign);
}

}  // namespace

Picture sign_picture(const Values& signs, const Values& exact, const Values& shade) {
  Picture picture(kGridSide, kGridSide);
  for (int y = 0; y < kGridSide; ++y) {
    for (int x = 0; x < kGridSide; ++x) {
      const int sign = signs[index(x, y)];
      Colour colour = sign < 0 ? kRed : sign == 0 ? kYellow : kBlue;
      if (!shade.empty() && shade[index(x, y)] != 0) {
        for (std::uint8_t& channel : colour) {
          channel = static_cast<std::uint8_t>(channel * 3 / 4);
        }
      }
      picture.at(x, kGridSide - 1 - y) = on_line(exact, x, y) ? kBlack : colour;
    }
  }
  return picture;
}

Picture owner_picture(const Values& owners) {
  constexpr std::array kColours{kBlack, kWhite, kRed};
  Picture picture(kGridSide, kGridSide);
  for (int y = 0; y < kGridSide; ++y) {
    for (int x = 0; x < kGridSide; ++x) {
      picture.at(x, kGridSide - 1 - y) = kColours[static_cast<std::size_t>(owners[index(x, y)])];
    }
  }
  return picture;
}

Picture montage(const std::vector<Picture>& pictures, int columns) {
  constexpr int kGap = 8;
  const int rows = (static_cast<int>(pictures.size()) + columns - 1) / columns;
  const int width = pictures.front().width;
  const int height = pictures.front().height;
  Picture all(columns * (width + kGap) - kGap, rows * (height + kGap) - kGap);
  for (Colour& pixel : all.pixels) {
    pixel = kWhite;
  }
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    Picture picture = pictures[i];
    const int left = static_cast<int>(i) % columns * (width + kGap);
    const int top = static_cast<int>(i) / columns * (height + kGap);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        all.at(left + x, top + y) = picture.at(x, y);
      }
    }
  }
  return all;
}

}  // namespace halfspace::study
