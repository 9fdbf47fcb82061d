/// A per-pixel buffer stored tile by tile, as a unit that works on tiles wants it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/units/packets.hpp"

namespace halfspace {

/// width x height values; each tile of tile_size^2 lies together in row order, tiles in row order. Tiles at
/// the right and bottom edge are stored whole.
template <class Value>
class TiledImage {
 public:
  TiledImage() = default;
  TiledImage(int width, int height, int tile_size, Value value)
      : width_(width),
        height_(height),
        tile_size_(tile_size),
        tiles_x_((width + tile_size - 1) / tile_size),
        tiles_y_((height + tile_size - 1) / tile_size),
        values_(static_cast<std::size_t>(tiles_x_) * tiles_y_ * tile_size * tile_size, value) {}

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int tiles_x() const { return tiles_x_; }
  [[nodiscard]] int tiles_y() const { return tiles_y_; }
  [[nodiscard]] bool empty() const { return values_.empty(); }

  [[nodiscard]] Value* tile(int tile_x, int tile_y) {
    return &values_[(static_cast<std::size_t>(tile_y) * tiles_x_ + tile_x) * tile_size_ * tile_size_];
  }

  [[nodiscard]] const Value& at(int x, int y) const { return values_[index(x, y)]; }
  [[nodiscard]] Value& at(int x, int y) { return values_[index(x, y)]; }

  void fill(const PixelRect& rect, Value value) {
    if (rect.x_first == 0 && rect.y_first == 0 && rect.x_last == width_ - 1 && rect.y_last == height_ - 1) {
      std::fill(values_.begin(), values_.end(), value);
      return;
    }
    for (int y = rect.y_first; y <= rect.y_last; ++y) {
      for (int x = rect.x_first; x <= rect.x_last; ++x) {
        at(x, y) = value;
      }
    }
  }

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    const std::size_t tile = static_cast<std::size_t>(y / tile_size_) * tiles_x_ + x / tile_size_;
    return tile * tile_size_ * tile_size_ + y % tile_size_ * tile_size_ + x % tile_size_;
  }

  int width_ = 0;
  int height_ = 0;
  int tile_size_ = 1;
  int tiles_x_ = 0;
  int tiles_y_ = 0;
  std::vector<Value> values_;
};

}  // namespace halfspace
