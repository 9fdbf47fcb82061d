/// Packets of the RTL's links whose model counterparts are larger or nested, field by field as the wires
/// carry them, and how they are made. See packets.hpp for what fields() is.
#pragma once

#include <array>
#include <cstdint>

#include "halfspace/numerics/widths.hpp"
#include "halfspace/units/depth_plane.hpp"
#include "halfspace/units/hi_z.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/setup.hpp"
#include "halfspace/units/square_edges.hpp"
#include "halfspace/units/z_test.hpp"

namespace halfspace {

/// Quads of the widest beat.
inline constexpr std::size_t kMostBeatQuads = 16;

/// Of a thin line vertices 0 and 1 are its ends, and vertex 2 means nothing.
struct ScreenTrianglePacket {
  std::array<std::int32_t, 3> x{};
  std::array<std::int32_t, 3> y{};
  std::array<std::int64_t, 3> z{};
  std::int64_t offset = 0;
  std::uint8_t by_square = 0;   ///< drawn by squares, not by centres, where the machine is conservative
  std::uint8_t line_rule = 0;   ///< 0: a triangle; else LineRule of a thin line
  std::uint8_t line_width = 0;  ///< of a thin line, in pixels of a column

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    visit("x", &ScreenTrianglePacket::x, &Widths::CoordBits, Sign::kSigned);
    visit("y", &ScreenTrianglePacket::y, &Widths::CoordBits, Sign::kSigned);
    visit("z", &ScreenTrianglePacket::z, &Widths::VertexDepthBits, Sign::kSigned);
    visit("offset", &ScreenTrianglePacket::offset, &Widths::VertexDepthBits, Sign::kSigned);
    visit("by_square", &ScreenTrianglePacket::by_square, &Widths::FlagBits, Sign::kUnsigned);
    visit("line_rule", &ScreenTrianglePacket::line_rule, &Widths::LineRuleBits, Sign::kUnsigned);
    visit("line_width", &ScreenTrianglePacket::line_width, &Widths::LineWidthBits, Sign::kUnsigned);
  }
};

/// `state` is that of its draw. Thin lines have no squares.
inline ScreenTrianglePacket to_packet(const ScreenTriangle& triangle, const SetupState& state) {
  const std::array<ScreenVertex, 3>& v = triangle.v;
  const bool is_line = triangle.shape == ScreenShape::kThinLine;
  return {.x = {v[0].x, v[1].x, v[2].x},
          .y = {v[0].y, v[1].y, v[2].y},
          .z = {v[0].z, v[1].z, v[2].z},
          .offset = triangle.offset,
          .by_square = static_cast<std::uint8_t>(!is_line && state.conservative != Conservative::kOff),
          .line_rule = static_cast<std::uint8_t>(is_line ? state.line_rule : LineRule{}),
          .line_width = static_cast<std::uint8_t>(is_line ? state.line_width : 0)};
}

/// The way back. What setup has to know of a thin line goes to `state`.
inline ScreenTriangle screen_triangle(const ScreenTrianglePacket& packet, SetupState& state) {
  ScreenTriangle triangle{.v = {}, .offset = packet.offset};
  for (std::size_t i = 0; i < 3; ++i) {
    triangle.v[i] = {.x = packet.x[i], .y = packet.y[i], .z = packet.z[i]};
  }
  if (packet.line_rule != 0) {
    triangle.shape = ScreenShape::kThinLine;
    state.line_rule = static_cast<LineRule>(packet.line_rule);
    state.line_width = packet.line_width;
  }
  return triangle;
}

/// All that the units know of a draw.
struct DrawStatePacket {
  std::uint8_t front_positive_area = 0;
  std::uint8_t cull_front = 0;
  std::uint8_t cull_back = 0;
  std::uint8_t fill_rule = 0;
  std::uint8_t empty = 0;  ///< the bounds hold no pixel
  std::uint16_t x_first = 0;
  std::uint16_t x_last = 0;
  std::uint16_t y_first = 0;
  std::uint16_t y_last = 0;
  std::uint8_t format = 0;
  std::uint32_t least_code = 0;  ///< no fragment's stored code is less
  std::uint32_t most_code = 0;   ///< nor more
  std::uint8_t test = 0;
  std::uint8_t write = 0;
  std::uint8_t late = 0;  ///< what passes writes after the shader
  std::uint8_t func = 0;
  std::uint32_t clear_code = 0;   ///< of the surface's last fast clear
  std::uint32_t first_tile = 0;   ///< of the surface, among the tiles of all surfaces
  std::uint16_t tiles_x = 0;      ///< tiles in a row of the surface, less 1
  std::uint32_t first_block = 0;  ///< of the surface, among the blocks of all surfaces
  std::uint16_t blocks_x = 0;     ///< blocks in a row of the surface, less 1

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using P = DrawStatePacket;
    visit("front_positive_area", &P::front_positive_area, &Widths::FlagBits, Sign::kUnsigned);
    visit("cull_front", &P::cull_front, &Widths::FlagBits, Sign::kUnsigned);
    visit("cull_back", &P::cull_back, &Widths::FlagBits, Sign::kUnsigned);
    visit("fill_rule", &P::fill_rule, &Widths::FillRuleBits, Sign::kUnsigned);
    visit("empty", &P::empty, &Widths::FlagBits, Sign::kUnsigned);
    visit("x_first", &P::x_first, &Widths::PixelBits, Sign::kUnsigned);
    visit("x_last", &P::x_last, &Widths::PixelBits, Sign::kUnsigned);
    visit("y_first", &P::y_first, &Widths::PixelBits, Sign::kUnsigned);
    visit("y_last", &P::y_last, &Widths::PixelBits, Sign::kUnsigned);
    visit("format", &P::format, &Widths::FormatBits, Sign::kUnsigned);
    visit("least_code", &P::least_code, &Widths::CodeBits, Sign::kUnsigned);
    visit("most_code", &P::most_code, &Widths::CodeBits, Sign::kUnsigned);
    visit("test", &P::test, &Widths::FlagBits, Sign::kUnsigned);
    visit("write", &P::write, &Widths::FlagBits, Sign::kUnsigned);
    visit("late", &P::late, &Widths::FlagBits, Sign::kUnsigned);
    visit("func", &P::func, &Widths::FuncBits, Sign::kUnsigned);
    visit("clear_code", &P::clear_code, &Widths::CodeBits, Sign::kUnsigned);
    visit("first_tile", &P::first_tile, &Widths::LineBits, Sign::kUnsigned);
    visit("tiles_x", &P::tiles_x, &Widths::TileColumnBits, Sign::kUnsigned);
    visit("first_block", &P::first_block, &Widths::LineBits, Sign::kUnsigned);
    visit("blocks_x", &P::blocks_x, &Widths::BlockCoordBits, Sign::kUnsigned);
  }
};

/// What setup looks at in it.
inline SetupState setup_state(const DrawStatePacket& draw, int sub_pixel_bits,
                              DepthInterpolator interpolator) {
  SetupState state{.sub_pixel_bits = sub_pixel_bits,
                   .front_positive_area = draw.front_positive_area != 0,
                   .cull_front = draw.cull_front != 0,
                   .cull_back = draw.cull_back != 0,
                   .fill_rule = static_cast<FillRule>(draw.fill_rule),
                   .bounds = {},
                   .depth_format = static_cast<DepthFormat>(draw.format),
                   .limits = {.least = draw.least_code, .most = draw.most_code},
                   .interpolator = interpolator};
  if (draw.empty == 0) {
    state.bounds = {
        .x_first = draw.x_first, .y_first = draw.y_first, .x_last = draw.x_last, .y_last = draw.y_last};
  }
  return state;
}

/// What early_z looks at in it.
inline EarlyZState early_z_state(const DrawStatePacket& draw, int sub_pixel_bits,
                                 DepthInterpolator interpolator) {
  return {.test = draw.test != 0,
          .write = draw.write != 0,
          .late = draw.late != 0,
          .func = static_cast<DepthFunc>(draw.func),
          .format = static_cast<DepthFormat>(draw.format),
          .interpolator = interpolator,
          .sub_pixel_bits = sub_pixel_bits};
}

/// What the walk needs of a triangle. It starts at the first block of the bounds.
struct SetupTrianglePacket {
  std::array<std::int64_t, 3> e{};  ///< at the centre of the first pixel of that block
  std::int64_t z = 0;               ///< HiZPlane there
  std::int64_t z_dx = 0;
  std::int64_t z_dy = 0;
  std::uint8_t z_known = 0;
  std::array<std::int32_t, 3> a{};
  std::array<std::int32_t, 3> b{};
  std::uint16_t x_first = 0;  ///< bounds, in pixels, inclusive
  std::uint16_t x_last = 0;
  std::uint16_t y_first = 0;
  std::uint16_t y_last = 0;

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using P = SetupTrianglePacket;
    visit("e", &P::e, &Widths::EdgeBits, Sign::kSigned);
    visit("z", &P::z, &Widths::HiZWordBits, Sign::kSigned);
    visit("z_dx", &P::z_dx, &Widths::HiZStepBits, Sign::kSigned);
    visit("z_dy", &P::z_dy, &Widths::HiZStepBits, Sign::kSigned);
    visit("z_known", &P::z_known, &Widths::FlagBits, Sign::kUnsigned);
    visit("a", &P::a, &Widths::StepBits, Sign::kSigned);
    visit("b", &P::b, &Widths::StepBits, Sign::kSigned);
    visit("x_first", &P::x_first, &Widths::PixelBits, Sign::kUnsigned);
    visit("x_last", &P::x_last, &Widths::PixelBits, Sign::kUnsigned);
    visit("y_first", &P::y_first, &Widths::PixelBits, Sign::kUnsigned);
    visit("y_last", &P::y_last, &Widths::PixelBits, Sign::kUnsigned);
  }
};

inline SetupTrianglePacket to_packet(const SetupTriangle& triangle, const WalkerConfig& walker) {
  const PixelRect& bounds = triangle.bounds;
  const std::int64_t x = bounds.x_first / walker.block_size * walker.block_size;
  const std::int64_t y = bounds.y_first / walker.block_size * walker.block_size;
  SetupTrianglePacket packet{.x_first = static_cast<std::uint16_t>(bounds.x_first),
                             .x_last = static_cast<std::uint16_t>(bounds.x_last),
                             .y_first = static_cast<std::uint16_t>(bounds.y_first),
                             .y_last = static_cast<std::uint16_t>(bounds.y_last)};
  const HiZPlane& plane = triangle.plane;
  packet.z = hi_z_wrap(plane.z + plane.dx * x + plane.dy * y);
  packet.z_dx = plane.dx;
  packet.z_dy = plane.dy;
  packet.z_known = plane.known ? 1 : 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Edge& edge = triangle.edge[i];
    packet.e[i] = edge.c + ((edge.a * x + edge.b * y) << walker.sub_pixel_bits);
    packet.a[i] = edge.a;
    packet.b[i] = edge.b;
  }
  return packet;
}

/// What early_z needs of a triangle. What only the other interpolator uses is 0. Index 0 of a and b is
/// edge 1.
struct DepthEquationPacket {
  // Barycentric.
  std::array<std::int32_t, 2> a{};
  std::array<std::int32_t, 2> b{};
  std::array<std::int64_t, 3> z{};
  std::array<std::uint8_t, 3> bias{};
  std::int64_t area2 = 0;
  std::uint32_t reciprocal = 0;
  std::int8_t shift = 0;
  // Plane; gradients as halves, the upper one last.
  std::array<std::uint64_t, 2> dx{};
  std::array<std::uint64_t, 2> dy{};
  std::int64_t word = 0;  ///< at vertex 0
  std::int32_t x = 0;     ///< of vertex 0
  std::int32_t y = 0;
  // Both.
  std::uint8_t beyond = 0;
  std::int16_t exponent = 0;
  std::int64_t offset = 0;
  std::uint32_t min_code = 0;
  std::uint32_t max_code = 0;

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using P = DepthEquationPacket;
    visit("a", &P::a, &Widths::StepBits, Sign::kSigned);
    visit("b", &P::b, &Widths::StepBits, Sign::kSigned);
    visit("z", &P::z, &Widths::VertexDepthBits, Sign::kSigned);
    visit("bias", &P::bias, &Widths::FlagBits, Sign::kUnsigned);
    visit("area2", &P::area2, &Widths::EdgeBits, Sign::kSigned);
    visit("reciprocal", &P::reciprocal, &Widths::ReciprocalBits, Sign::kUnsigned);
    visit("shift", &P::shift, &Widths::ShiftBits, Sign::kSigned);
    visit("dx", &P::dx, &Widths::HalfGradientBits, Sign::kUnsigned);
    visit("dy", &P::dy, &Widths::HalfGradientBits, Sign::kUnsigned);
    visit("word", &P::word, &Widths::WordBits, Sign::kSigned);
    visit("x", &P::x, &Widths::CoordBits, Sign::kSigned);
    visit("y", &P::y, &Widths::CoordBits, Sign::kSigned);
    visit("beyond", &P::beyond, &Widths::FlagBits, Sign::kUnsigned);
    visit("exponent", &P::exponent, &Widths::ExponentBits, Sign::kSigned);
    visit("offset", &P::offset, &Widths::WordBits, Sign::kSigned);
    visit("min_code", &P::min_code, &Widths::CodeBits, Sign::kUnsigned);
    visit("max_code", &P::max_code, &Widths::CodeBits, Sign::kUnsigned);
  }
};

/// The halves of a gradient; of one for short words the bits that they need.
constexpr std::array<std::uint64_t, 2> gradient_halves(Modular gradient, bool short_words) {
  constexpr int kHalf = Widths{}.HalfGradientBits;
  constexpr Modular kMask = (Modular{1} << kHalf) - 1;
  constexpr Modular kShort = (Modular{1} << (8 * sizeof(ShortWord) + kGradientFraction)) - 1;
  const Modular kept = short_words ? gradient & kShort : gradient;
  return {static_cast<std::uint64_t>(kept & kMask), static_cast<std::uint64_t>(kept >> kHalf & kMask)};
}

/// The equation of a triangle. Where the draw has no depth surface there is none: a, b and bias of the
/// barycentric one are the edges' all the same, and so is 2A for inner coverage; everything else is 0.
inline DepthEquationPacket to_packet(const SetupTriangle& triangle, DepthFormat format,
                                     DepthInterpolator interpolator) {
  const std::array<Edge, 3>& edge = triangle.edge;
  const DepthEquation& depth = triangle.depth;
  const bool barycentric = interpolator == DepthInterpolator::kBarycentric;
  DepthEquationPacket packet;
  if (barycentric) {
    packet.a = {edge[1].a, edge[2].a};
    packet.b = {edge[1].b, edge[2].b};
    packet.bias = depth.bias;
  }
  if (barycentric) {
    packet.area2 = depth.area2;  // 0 where nobody asks for it
  }
  if (format == DepthFormat::kNone) {
    return packet;
  }
  if (barycentric) {
    packet.z = depth.z;
    packet.reciprocal = depth.reciprocal;
    packet.shift = depth.shift;
  } else {
    const bool short_words = format != DepthFormat::kFloat32 && !depth.beyond;
    packet.dx = gradient_halves(depth.plane.dx, short_words);
    packet.dy = gradient_halves(depth.plane.dy, short_words);
    packet.word = depth.plane.z;
    packet.x = depth.plane.x;
    packet.y = depth.plane.y;
  }
  packet.beyond = depth.beyond ? 1 : 0;
  packet.exponent = depth.exponent;
  packet.offset = depth.offset;
  packet.min_code = depth.min_code;
  packet.max_code = depth.max_code;
  return packet;
}

/// A beat of a burst: up to QuadWidth quads of one tile. Quads beyond the last have mask 0 and index 0.
struct QuadBeat {
  std::uint8_t slot = 0;
  std::uint16_t tile_x = 0;
  std::uint16_t tile_y = 0;
  std::array<std::int64_t, 2> e{};      ///< of edges 1 and 2 at the tile origin
  std::uint8_t last = 0;                ///< of the burst
  std::array<std::uint8_t, 4> parts{};  ///< bands of rows in which the burst has quads
  std::array<std::uint8_t, 4> sure{};   ///< those that it overwrites whole
  std::array<std::uint8_t, kMostBeatQuads> index{};
  std::array<std::uint8_t, kMostBeatQuads> mask{};

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using P = QuadBeat;
    visit("slot", &P::slot, &Widths::SlotBits, Sign::kUnsigned);
    visit("tile_x", &P::tile_x, &Widths::TileColumnBits, Sign::kUnsigned);
    visit("tile_y", &P::tile_y, &Widths::TileCoordBits, Sign::kUnsigned);
    visit("e", &P::e, &Widths::EdgeBits, Sign::kSigned);
    visit("last", &P::last, &Widths::FlagBits, Sign::kUnsigned);
    visit("parts", &P::parts, &Widths::FlagBits, Sign::kUnsigned, &Widths::ZParts);
    visit("sure", &P::sure, &Widths::FlagBits, Sign::kUnsigned, &Widths::ZParts);
    visit("index", &P::index, &Widths::QuadIndexBits, Sign::kUnsigned, &Widths::QuadWidth);
    visit("mask", &P::mask, &Widths::QuadMaskBits, Sign::kUnsigned, &Widths::QuadWidth);
  }
};

/// early_z -> hi_z, for each burst: what is stored in the parts of its tile that it touched, none where it
/// has nothing to do with stored depth. Codes of other parts are 0.
struct HiZUpdatePacket {
  std::array<std::uint8_t, 4> touched{};
  std::array<std::uint32_t, 4> least{};
  std::array<std::uint32_t, 4> most{};

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using P = HiZUpdatePacket;
    visit("touched", &P::touched, &Widths::FlagBits, Sign::kUnsigned, &Widths::ZParts);
    visit("least", &P::least, &Widths::CodeBits, Sign::kUnsigned, &Widths::ZParts);
    visit("most", &P::most, &Widths::CodeBits, Sign::kUnsigned, &Widths::ZParts);
  }
};

/// A beat of a burst after the test: up to TestWidth quads, with what passed and the depth of every covered
/// sample (0 at the others, and where the target has no depth surface); and, with inner coverage, which of
/// the covered pixels the triangle fills.
struct TestedBeat {
  std::uint8_t slot = 0;
  std::uint16_t tile_x = 0;
  std::uint16_t tile_y = 0;
  std::uint8_t last = 0;
  std::array<std::uint8_t, kMostBeatQuads> index{};
  std::array<std::uint8_t, kMostBeatQuads> mask{};
  std::array<std::uint8_t, kMostBeatQuads> passed{};
  std::array<std::uint8_t, kMostBeatQuads> inner{};
  std::array<std::uint32_t, 4 * kMostBeatQuads> depth{};  ///< four samples a quad

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using P = TestedBeat;
    visit("inner", &P::inner, &Widths::QuadMaskBits, Sign::kUnsigned, &Widths::TestWidth);
    visit("slot", &P::slot, &Widths::SlotBits, Sign::kUnsigned);
    visit("tile_x", &P::tile_x, &Widths::TileColumnBits, Sign::kUnsigned);
    visit("tile_y", &P::tile_y, &Widths::TileCoordBits, Sign::kUnsigned);
    visit("last", &P::last, &Widths::FlagBits, Sign::kUnsigned);
    visit("index", &P::index, &Widths::QuadIndexBits, Sign::kUnsigned, &Widths::TestWidth);
    visit("mask", &P::mask, &Widths::QuadMaskBits, Sign::kUnsigned, &Widths::TestWidth);
    visit("passed", &P::passed, &Widths::QuadMaskBits, Sign::kUnsigned, &Widths::TestWidth);
    visit("depth", &P::depth, &Widths::CodeBits, Sign::kUnsigned, &Widths::TestSamples);
  }
};

/// early_z -> interpolator: a quad, one attribute, and what they need of their triangle.
struct AttributeQuad {
  std::uint8_t mask = 0;            ///< covered samples, as in QuadBeat; the others are helpers
  std::array<std::int64_t, 2> e{};  ///< unbiased E of edges 1 and 2 at the first sample of the quad
  std::array<std::int32_t, 2> a{};  ///< of these edges
  std::array<std::int32_t, 2> b{};
  std::int64_t area2 = 0;                ///< 2A, the sum of the three unbiased E: above 0
  std::array<std::uint32_t, 3> q{};      ///< 1/w of each vertex: float32, positive and normal; the same three
                                         ///< for what is linear in the picture
  std::array<std::int32_t, 12> value{};  ///< component c of vertex v at 4 v + c

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using P = AttributeQuad;
    visit("mask", &P::mask, &Widths::QuadMaskBits, Sign::kUnsigned);
    visit("e", &P::e, &Widths::EdgeBits, Sign::kSigned);
    visit("a", &P::a, &Widths::StepBits, Sign::kSigned);
    visit("b", &P::b, &Widths::StepBits, Sign::kSigned);
    visit("area2", &P::area2, &Widths::EdgeBits, Sign::kSigned);
    visit("q", &P::q, &Widths::FloatBits, Sign::kUnsigned);
    visit("value", &P::value, &Widths::AttributeBits, Sign::kSigned, &Widths::VertexValues);
  }
};

/// interpolator -> fragment shader: the attribute at the four pixels of the quad, helpers included.
struct ShadedQuad {
  std::array<std::int32_t, 16> value{};  ///< component c of pixel p at 4 p + c
  std::uint8_t mask = 0;

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using P = ShadedQuad;
    visit("value", &P::value, &Widths::AttributeBits, Sign::kSigned, &Widths::QuadValues);
    visit("mask", &P::mask, &Widths::QuadMaskBits, Sign::kUnsigned);
  }
};

}  // namespace halfspace
