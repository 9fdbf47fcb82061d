/// What the units demand of packets that come from outside, beyond the widths of their fields. All throw
/// InputError.
#pragma once

#include "halfspace/c_api/link.hpp"
#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/square_edges.hpp"

namespace halfspace::c_api {

/// For setup and early_z: a format that there is, no test without one, bounds that hold a pixel unless
/// `empty` is set.
void check_draw(const DrawStatePacket& draw);

/// For setup: depths between 0 and 1.
void check_vertex_depths(const std::array<std::int64_t, 3>& z, std::uint8_t format, const char* field);
void check_vertex_depth(std::int64_t z, std::uint8_t format, const std::string& field);

/// For setup: a rule of lines that there is, a width with it, and an interpolator that can have them.
void check_line(const ScreenTrianglePacket& packet, const DrawStatePacket& draw, bool barycentric);

/// For block_walker: bounds that hold a pixel, and E within its width at all samples of the blocks that the
/// walk looks at.
void check_walk(const SetupTrianglePacket& packet, const SetupTriangle& triangle, const Widths& widths);

/// For tile_walker: bounds that hold a pixel, a tile or more, all of them such as the bounds touch, and E
/// within its width at all samples of the block. The widths alone keep the block on the screen.
void check_block(const BlockJob& block, const Widths& widths);

/// For early_z: the equation is that of some triangle, in the format of the draw.
void check_equation(const DepthEquationPacket& equation, const DrawStatePacket& draw);

/// The same where the interpolator is the plane: codes and exponent are possible.
void check_plane(const DepthEquationPacket& equation, const DrawStatePacket& draw);

/// For early_z, where it works on what comes out of the walk: the equation is that of this triangle.
void check_equation_of(const DepthEquationPacket& equation, const SetupTriangle& triangle);

/// The same for what comes out of a block job, whose triangle is kept in its slot.
void check_block_of(const BlockJob& block, const SetupTriangle& kept);

/// For early_z: the covered samples of the coverage are inside the triangle.
void check_samples(const Coverage& coverage, const SetupTriangle& triangle, const Widths& widths);

}  // namespace halfspace::c_api
