/// A per-pixel buffer stored tile by tile, as a unit that works on tiles wants it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/units/lazy_array.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace {

/// width x height values; each tile of tile_size^2 lies together in row order, tiles in row order. Tiles at
/// the right and bottom edge are stored whole. With several samples a pixel the tiles of a place lie side by
/// side, one for each sample, and all are columns of their own (see TileJob).
///
/// As hardware clears by flags, so does the image: each tile has a flag whether it has been touched since the
/// image was filled, and one that has not is the fill value, whatever its memory holds. So memory and time go
/// with the tiles that are touched, not with the area.
template <class Value>
class TiledImage {
 public:
  TiledImage() = default;
  TiledImage(int width, int height, int tile_size, Value value, int samples = 1)
      : width_(width),
        height_(height),
        tile_size_(tile_size),
        samples_(samples),
        tiles_x_((width + tile_size - 1) / tile_size * samples),
        tiles_y_((height + tile_size - 1) / tile_size),
        blank_(static_cast<std::size_t>(tile_size) * tile_size, value),
        values_(unset_array<Value>(tiles() * blank_.size())),
        touched_(zeroed_array<Epoch>(tiles())) {}

  TiledImage(const TiledImage& other)
      : TiledImage(other.width_, other.height_, other.tile_size_,
                   other.blank_.empty() ? Value{} : other.blank_[0], other.samples_) {
    for (std::size_t i = 0; i < tiles(); ++i) {
      if (other.touched(i)) {
        std::copy_n(other.values(i), blank_.size(), values(i));
        touched_[i] = epoch_;
      }
    }
  }
  TiledImage& operator=(const TiledImage& other) { return *this = TiledImage(other); }
  TiledImage(TiledImage&&) noexcept = default;
  TiledImage& operator=(TiledImage&&) noexcept = default;
  ~TiledImage() = default;

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int tile_size() const { return tile_size_; }
  [[nodiscard]] int samples() const { return samples_; }
  [[nodiscard]] int tiles_x() const { return tiles_x_; }
  [[nodiscard]] int tiles_y() const { return tiles_y_; }
  [[nodiscard]] bool empty() const { return tiles() == 0; }

  /// The values of a tile, to read and write: touches it.
  [[nodiscard]] Value* tile(int tile_x, int tile_y) { return tile(tile_number(tile_x, tile_y)); }
  /// Of the tile that is `number` in row order.
  [[nodiscard]] Value* tile(std::size_t number) {
    if (!touched(number)) [[unlikely]] {
      touch(number);
    }
    return values(number);
  }

  /// The values of all tiles, one after the other by number; those of tiles that tile() has not given since
  /// the image was filled are anything.
  [[nodiscard]] Value* memory() { return values_.get(); }

  /// The same to read, until the image is written: of a tile that has not been touched they are elsewhere.
  [[nodiscard]] const Value* tile(int tile_x, int tile_y) const {
    const std::size_t number = tile_number(tile_x, tile_y);
    return touched(number) ? values(number) : blank_.data();
  }

  [[nodiscard]] const Value& at(int x, int y, int sample = 0) const {
    return tile(x / tile_size_ * samples_ + sample, y / tile_size_)[in_tile(x, y)];
  }
  [[nodiscard]] Value& at(int x, int y, int sample = 0) {
    return tile(x / tile_size_ * samples_ + sample, y / tile_size_)[in_tile(x, y)];
  }

  /// All samples of the pixels. Touches no tile where `rect` is the whole image, else those that it changes.
  void fill(const PixelRect& rect, Value value) {
    if (rect.x_first == 0 && rect.y_first == 0 && rect.x_last == width_ - 1 && rect.y_last == height_ - 1) {
      std::fill(blank_.begin(), blank_.end(), value);
      forget_tiles();
      return;
    }
    if (rect.empty()) {
      return;
    }
    for (int y = rect.y_first / tile_size_; y <= rect.y_last / tile_size_; ++y) {
      for (int x = rect.x_first / tile_size_ * samples_; x < (rect.x_last / tile_size_ + 1) * samples_; ++x) {
        fill_in_tile(x, y, rect, value);
      }
    }
  }

 private:
  using Epoch = std::uint8_t;

  [[nodiscard]] std::size_t tiles() const { return static_cast<std::size_t>(tiles_x_) * tiles_y_; }
  [[nodiscard]] std::size_t tile_number(int tile_x, int tile_y) const {
    return static_cast<std::size_t>(tile_y) * tiles_x_ + tile_x;
  }
  [[nodiscard]] std::size_t in_tile(int x, int y) const {
    return static_cast<std::size_t>(y % tile_size_) * tile_size_ + x % tile_size_;
  }
  [[nodiscard]] Value* values(std::size_t tile) const {
    return values_.get() + tile * tile_size_ * tile_size_;
  }
  [[nodiscard]] bool touched(std::size_t tile) const { return touched_[tile] == epoch_; }

  void touch(std::size_t tile) {
    std::copy_n(blank_.data(), blank_.size(), values(tile));
    touched_[tile] = epoch_;
  }

  /// All tiles are untouched from now on. Flags of every epoch but the new one mean that; before a number
  /// comes again, all flags go back to zero, which is no epoch.
  void forget_tiles() {
    ++epoch_;
    if (epoch_ == 0) {
      touched_ = zeroed_array<Epoch>(tiles());
      epoch_ = 1;
    }
  }

  void fill_in_tile(int tile_x, int tile_y, const PixelRect& rect, Value value) {
    if (value == blank_[0] && !touched(tile_number(tile_x, tile_y))) {
      return;
    }
    Value* const row = tile(tile_x, tile_y);
    const int left = tile_x / samples_ * tile_size_;
    const int x_first = std::max(rect.x_first - left, 0);
    const int x_last = std::min(rect.x_last - left, tile_size_ - 1);
    const int y_first = std::max(rect.y_first - tile_y * tile_size_, 0);
    const int y_last = std::min(rect.y_last - tile_y * tile_size_, tile_size_ - 1);
    for (int y = y_first; y <= y_last; ++y) {
      std::fill(row + y * tile_size_ + x_first, row + y * tile_size_ + x_last + 1, value);
    }
  }

  int width_ = 0;
  int height_ = 0;
  int tile_size_ = 1;
  int samples_ = 1;  ///< of a pixel
  int tiles_x_ = 0;
  int tiles_y_ = 0;
  Epoch epoch_ = 1;           ///< of the last fill of the whole image
  std::vector<Value> blank_;  ///< a tile of the fill value
  LazyArray<Value> values_;   ///< of a tile that is not touched, anything
  LazyArray<Epoch> touched_;  ///< by tile: in which epoch last
};

}  // namespace halfspace
