/// Pictures of a run, for people.
#pragma once

#include <cstddef>
#include <filesystem>

#include "halfspace/machine/frame_result.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/shade/picture.hpp"

namespace halfspace {

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
