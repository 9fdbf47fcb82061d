/// Pictures of a run, for people.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "halfspace/machine/frame_result.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace {

/// 8-bit RGB, row 0 on top.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::array<std::uint8_t, 3>> pixels;

  Picture(int w, int h)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  [[nodiscard]] std::array<std::uint8_t, 3>& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

/// The triangles that own the surface, lit from the upper left. A frame has no normals and no projection
/// matrix, so faces are rebuilt from clip space under an assumed vertical view of 60 degrees. One hue a draw.
/// Needs Surface::visible.
Picture shaded_picture(const Frame& frame, const FrameResult& result, std::size_t surface);

/// Depth, near bright and far dark, with histogram equalisation, since most depths are close to 1.
Picture depth_picture(const Surface& surface);

/// Fragments that covered each pixel.
Picture overdraw_picture(const Surface& surface);

/// Share of the decisions about each tile: red reject, green accept, blue partial; brighter with more
/// decisions. Needs Surface::sums.
Picture tile_picture(const Surface& surface, int tile_size);

/// Mean share of live lanes of the quads at each place: from red (one lane of four) to green (all four).
/// Needs Surface::sums.
Picture quad_picture(const Surface& surface);

/// Throws InputError.
void write_png(const std::filesystem::path& path, const Picture& picture);

}  // namespace halfspace
