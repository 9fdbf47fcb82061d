// Does an image that is cleared by flags hold what an array of pixels holds, and touch no more than it must?
#include "halfspace/units/tiled_image.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <utility>
#include <vector>

#include "../property/random.hpp"

using namespace halfspace;
using halfspace::testing::Random;

namespace {

using Image = TiledImage<std::uint32_t>;

PixelRect whole(const Image& image) { return {.x_last = image.width() - 1, .y_last = image.height() - 1}; }

std::vector<std::uint32_t> rows(const Image& image) {
  std::vector<std::uint32_t> values;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      values.push_back(image.at(x, y));
    }
  }
  return values;
}

}  // namespace

TEST_CASE("tiled image: a new one is the fill value everywhere, edge tiles too") {
  const Image image(19, 10, 8, 7);
  CHECK(image.tiles_x() == 3);
  CHECK(image.tiles_y() == 2);
  CHECK(rows(image) == std::vector<std::uint32_t>(190, 7));
  CHECK(std::vector<std::uint32_t>(image.tile(2, 1), image.tile(2, 1) + 64) ==
        std::vector<std::uint32_t>(64, 7));
}

TEST_CASE("tiled image: an image without pixels is empty, and can be filled and copied") {
  Image image;
  CHECK(image.empty());
  image.fill(whole(image), 3);
  const Image copy = image;
  CHECK(copy.empty());
  CHECK_FALSE(Image(1, 1, 8, 0).empty());
}

TEST_CASE("tiled image: tiles lie one after the other in row order, to read and to write") {
  Image image(24, 16, 8, 5);
  std::uint32_t* const first = image.tile(0, 0);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) {
      CHECK(image.tile(x, y) == first + (y * 3 + x) * 64);
      CHECK(std::as_const(image).tile(x, y) == image.tile(x, y));
    }
  }
  first[(1 * 3 + 2) * 64 + 3 * 8 + 4] = 9;
  CHECK(std::as_const(image).at(2 * 8 + 4, 8 + 3) == 9);
  CHECK(reinterpret_cast<std::uintptr_t>(first) % 64 == 0);
}

TEST_CASE("tiled image: reading touches nothing, writing touches the tile alone") {
  Image image(32, 32, 8, 5);
  const Image& seen = image;
  const std::uint32_t* const blank = seen.tile(0, 0);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      CHECK(seen.at(x * 8 + 1, y * 8 + 2) == 5);
      CHECK(seen.tile(x, y) == blank);
    }
  }
  image.at(9, 17) = 6;  // in tile (1, 2)
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      CHECK((seen.tile(x, y) == blank) == (x != 1 || y != 2));
    }
  }
  CHECK(seen.at(9, 17) == 6);
  CHECK(seen.at(10, 17) == 5);
}

TEST_CASE("tiled image: a fill of all pixels forgets what was written, and touches nothing") {
  Image image(20, 20, 8, 5);
  image.at(3, 3) = 1;
  image.fill(whole(image), 8);
  CHECK(rows(image) == std::vector<std::uint32_t>(400, 8));
  CHECK(std::as_const(image).tile(0, 0) == std::as_const(image).tile(1, 0));
  image.tile(0, 0)[1] = 2;
  CHECK(image.at(0, 0) == 8);
  CHECK(image.at(1, 0) == 2);
  CHECK(image.at(3, 3) == 8);
}

TEST_CASE("tiled image: a fill of a rectangle touches only the tiles that it changes") {
  Image image(32, 32, 8, 5);
  const Image& seen = image;
  const std::uint32_t* const blank = seen.tile(3, 3);
  image.fill({.x_first = 4, .y_first = 9, .x_last = 11, .y_last = 12}, 6);  // of the tiles (0, 1) and (1, 1)
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      CHECK(seen.at(x, y) == (x >= 4 && x <= 11 && y >= 9 && y <= 12 ? 6 : 5));
    }
  }
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      CHECK((seen.tile(x, y) == blank) == (y != 1 || x > 1));
    }
  }
  image.fill({.x_first = 16, .y_first = 0, .x_last = 31, .y_last = 7}, 5);  // what these tiles are already
  CHECK(seen.tile(2, 0) == blank);
  image.fill({.x_first = 5, .y_first = 20, .x_last = 3, .y_last = 20}, 1);  // no pixel
  CHECK(seen.tile(0, 2) == blank);
}

TEST_CASE("tiled image: tiles touched 255, 256 and 257 fills ago are untouched, whatever their flags hold") {
  Image image(64, 8, 8, 0);
  for (std::uint32_t fill = 1; fill <= 1100; ++fill) {
    image.fill(whole(image), fill);
    REQUIRE(rows(image) == std::vector<std::uint32_t>(512, fill));
    if (fill % 100 < 3) {  // others keep flags of long ago
      image.at(static_cast<int>(fill % 8) * 8, 0) = 5000;
    }
  }
  for (const int others : {254, 255, 256, 509, 510, 511, 512}) {
    CAPTURE(others);
    image.fill(whole(image), 1);
    image.at(0, 0) = 7;
    for (int i = 0; i < others; ++i) {
      image.fill(whole(image), 2);
    }
    image.at(8, 0) = 9;
    CHECK(std::as_const(image).at(0, 0) == 2);
    CHECK(std::as_const(image).at(8, 0) == 9);
    CHECK(std::as_const(image).at(9, 0) == 2);
  }
}

TEST_CASE("tiled image: copies and moves have values of their own, and copies touch what the original did") {
  Image image(24, 8, 8, 5);
  image.fill(whole(image), 6);
  image.at(9, 1) = 7;
  Image copy = image;
  CHECK(rows(copy) == rows(image));
  CHECK(std::as_const(copy).tile(0, 0) == std::as_const(copy).tile(2, 0));
  copy.at(9, 1) = 1;
  copy.at(0, 0) = 2;
  CHECK(image.at(9, 1) == 7);
  CHECK(std::as_const(image).at(0, 0) == 6);
  copy.fill(whole(copy), 3);
  CHECK(image.at(9, 1) == 7);
  const std::vector<std::uint32_t> before = rows(image);
  const Image moved = std::move(image);
  CHECK(rows(moved) == before);
  image = copy;
  CHECK(rows(image) == std::vector<std::uint32_t>(192, 3));
  image = moved;
  CHECK(rows(image) == before);
}

TEST_CASE("tiled image: random writes, fills, copies and reads are those of an array") {
  Random random(halfspace::testing::seed());
  for (int run = 0; run < 20; ++run) {
    const int tile_size = 4 << random.between(0, 2);
    const int width = static_cast<int>(random.between(1, 70));
    const int height = static_cast<int>(random.between(1, 50));
    Image image(width, height, tile_size, 1);
    std::vector<std::uint32_t> expected(static_cast<std::size_t>(width) * height, 1);
    for (int step = 0; step < 400; ++step) {
      const auto value = static_cast<std::uint32_t>(random.between(0, 3));
      const int x = static_cast<int>(random.between(0, width - 1));
      const int y = static_cast<int>(random.between(0, height - 1));
      const auto kind = random.between(0, 9);
      if (kind < 6) {
        image.at(x, y) = value;
        expected[static_cast<std::size_t>(y) * width + x] = value;
      } else if (kind < 8) {
        const PixelRect rect{.x_first = x,
                             .y_first = y,
                             .x_last = static_cast<int>(random.between(x, width - 1)),
                             .y_last = static_cast<int>(random.between(y, height - 1))};
        image.fill(rect, value);
        for (int row = rect.y_first; row <= rect.y_last; ++row) {
          const auto from = expected.begin() + static_cast<std::ptrdiff_t>(row) * width;
          std::fill(from + rect.x_first, from + rect.x_last + 1, value);
        }
      } else if (kind < 9) {
        image.fill(whole(image), value);
        std::fill(expected.begin(), expected.end(), value);
      } else {
        image = Image(image);
      }
      if (step % 10 == 0) {
        REQUIRE(rows(image) == expected);
      }
    }
    REQUIRE(rows(image) == expected);
  }
}

TEST_CASE("lazy arrays: of every size all values can be written, and those of zeros are zero") {
  constexpr std::size_t kLargePage = std::size_t{1} << 21;
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{1}, kLargePage - 1, kLargePage, kLargePage + 1,
                                  16 * kLargePage, 16 * kLargePage + 1}) {
    CAPTURE(bytes);
    const LazyArray<char> unset = unset_array<char>(bytes);
    CHECK(reinterpret_cast<std::uintptr_t>(unset.get()) % 64 == 0);
    std::fill_n(unset.get(), bytes, 'x');
    CHECK(std::count(unset.get(), unset.get() + bytes, 'x') == static_cast<std::ptrdiff_t>(bytes));
    const LazyArray<char> zeros = zeroed_array<char>(bytes);
    CHECK(std::count(zeros.get(), zeros.get() + bytes, 0) == static_cast<std::ptrdiff_t>(bytes));
  }
}
