/// What a command of a frame means for the units.
#pragma once

#include <array>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/setup.hpp"
#include "halfspace/units/tile_walker.hpp"
#include "halfspace/units/z_line.hpp"
#include "halfspace/units/z_test.hpp"

namespace halfspace {

/// Scissor and target, in pixels.
PixelRect drawable_rect(const Scissor& scissor, const Target& target);

/// The pixels whose sample lies in the viewport, which is x, y, width and height; a width or height may be
/// negative. Clipping to the sides of the clip volume would leave no sample outside of them.
PixelRect viewport_rect(const glm::vec4& viewport, FillRule rule, const SamplePosition& sample = {});

/// Depth clamp keeps fragments within the draw's depth range; without it they are kept within [0, 1], or
/// where that range is unrestricted not at all.
DepthLimits depth_limits(const Command& draw, DepthFormat format);

WalkerConfig walker_config(const Config& config);

/// Which pixels the triangles of a draw have, and how far the squares reach that decide, see
/// numerics/conservative.hpp. Lines, points and clears have those whose centres they cover.
Conservative conservative(const Command& draw, const Config& config);
int square_reach(const Command& draw, const Config& config);

/// Whether the quads of the draw say which pixels their triangles fill.
bool has_inner_coverage(const Command& draw, const Config& config);

/// That of the draw, or that of all draws where the configuration has one.
FillRule fill_rule(const Command& draw, const Config& config);

/// `format` is that of the target's depth surface, none where it has none. Throws InputError where the
/// viewport holds other samples of a pixel at one side than at the other: bounds are of whole pixels.
SetupState setup_state(const Command& draw, const Target& target, DepthFormat format, const Config& config);
EarlyZState early_z_state(const Command& draw, DepthFormat format, const Config& config);

/// What the shaders of late draws discard.
ShaderDiscard shader_discard(const Config& config);

/// The state of the draw for one triangle, with the bounds that the triangle itself has.
SetupState setup_state(const SetupState& draw, const ScreenTriangle& triangle);

/// All that travels with the triangles of a draw. `place`, `blocks` and `clear_code` are those of its depth
/// surface, if it has one.
DrawStatePacket draw_state_packet(const SetupState& setup, const EarlyZState& early_z, const ZSurface& place,
                                  const HiZSurface& blocks, std::uint32_t clear_code);

/// True where the clear is done by the z cache: it covers a whole surface, and fast clear is on.
bool clears_fast(const PixelRect& rect, const Surface& surface, const Config& config);

/// A clear that is not done by the z cache: a rectangle of two triangles that goes through the pipe.
struct DrawnClear {
  std::array<ScreenTriangle, 2> triangle;
  SetupState setup;
  EarlyZState early_z;
};

/// `rect` must not be empty; `code` is the clear value as stored.
DrawnClear drawn_clear(const PixelRect& rect, std::uint32_t code, DepthFormat format, const Config& config);

}  // namespace halfspace
