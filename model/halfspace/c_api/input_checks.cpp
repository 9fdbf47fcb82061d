#include "halfspace/c_api/input_checks.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <vector>

#include "halfspace/c_api/depth_surfaces.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/units/float_parts.hpp"

namespace halfspace::c_api {
namespace {

void check_order(const char* first_name, int first, const char* last_name, int last) {
  if (last < first) {
    throw InputError(fmt::format("{} is {}; legal: at least {} ({})", last_name, last, first_name, first));
  }
}

/// The float32 whose word it is.
std::int64_t float_of_signed_word(std::int64_t word, int exponent) {
  const Int128 magnitude = word < 0 ? -Int128{word} : Int128{word};
  return code_of_word(magnitude, exponent) | (word < 0 ? 1u << 31 : 0);
}

/// E of an edge, `e` at pixel (0, 0), fits its width at all samples of x and y, which are first and last
/// column and row. E is linear: its extremes are at corners.
void check_e(const Edge& edge, const std::array<std::int64_t, 2>& x, const std::array<std::int64_t, 2>& y,
             const Widths& widths, const std::string& field, std::int64_t value) {
  for (const std::int64_t at_x : x) {
    for (const std::int64_t at_y : y) {
      const std::int64_t e = edge.c + ((edge.a * at_x + edge.b * at_y) << widths.SubPixelBits);
      if (!detail::fits(widths.EdgeBits, Sign::kSigned, e)) {
        throw InputError(fmt::format("{} is {}, so E is {} at pixel ({}, {}); legal: {} signed bits", field,
                                     value, e, at_x, at_y, widths.EdgeBits));
      }
    }
  }
}

void demand_equal(const char* field, std::int64_t value, std::int64_t legal, const char* why) {
  if (value != legal) {
    throw InputError(fmt::format("{} is {}; legal: {}, {}", field, value, legal, why));
  }
}

}  // namespace

void check_draw(const DrawStatePacket& draw) {
  constexpr std::array<bool, 8> kLegalFormat = {true, true, true, false, true, false, false, false};
  if (!kLegalFormat[draw.format]) {
    throw InputError(fmt::format("state.format is {}; legal: 0 (none), 1 (unorm16), 2 (unorm24), 4 (float32)",
                                 draw.format));
  }
  if (draw.test != 0 && draw.format == 0) {
    throw InputError("state.test is 1; legal: 0, since state.format is 0 (none)");
  }
  if (draw.late != 0) {
    throw InputError("state.late is 1; legal: 0, since nobody here can say what the shader keeps");
  }
  const std::uint32_t largest = largest_code(static_cast<DepthFormat>(draw.format));
  if (draw.most_code > largest || draw.least_code > draw.most_code) {
    throw InputError(
        fmt::format("state.least_code and most_code are {:#x} and {:#x}; legal: 0 to {:#x}, in this order",
                    draw.least_code, draw.most_code, largest));
  }
  if (draw.empty == 0) {
    check_order("state.x_first", draw.x_first, "state.x_last", draw.x_last);
    check_order("state.y_first", draw.y_first, "state.y_last", draw.y_last);
  }
}

void check_vertex_depths(const std::array<std::int64_t, 3>& z, std::uint8_t format, const char* field) {
  for (std::size_t i = 0; i < 3; ++i) {
    check_vertex_depth(z[i], format, fmt::format("{}[{}]", field, i));
  }
}

void check_vertex_depth(std::int64_t z, std::uint8_t format, const std::string& field) {
  if (format == 0) {
    return;
  }
  constexpr int kRange = 1 << kVertexDepthRange;
  if (static_cast<DepthFormat>(format) == DepthFormat::kFloat32) {
    const auto bits = static_cast<std::uint32_t>(z);
    if (z != bits || !(std::abs(std::bit_cast<float>(bits)) <= kRange)) {
      throw InputError(
          fmt::format("{} is {:#x}; legal: the bits of a float32 in [-{}, {}]", field, z, kRange, kRange));
    }
    return;
  }
  constexpr std::int64_t kMost = std::int64_t{kRange} << kVertexDepthBits;
  if (z < -kMost || z > kMost) {
    throw InputError(fmt::format("{} is {}; legal: {} to {}", field, z, -kMost, kMost));
  }
}

void check_line(const ScreenTrianglePacket& packet, const DrawStatePacket& draw, bool barycentric) {
  if (packet.line_rule == 0) {
    return;
  }
  const int last = static_cast<int>(kLineRuleName.size()) - 1;
  if (packet.line_rule > last) {
    throw InputError(
        fmt::format("triangle.line_rule is {}; legal: 0 (a triangle) to {}", packet.line_rule, last));
  }
  if (packet.line_width < 1 || packet.line_width > kMaxLineWidth) {
    throw InputError(
        fmt::format("triangle.line_width is {}; legal: 1 to {}", packet.line_width, kMaxLineWidth));
  }
  if (barycentric && draw.format != 0) {
    throw InputError(fmt::format(
        "triangle.line_rule is {}, with a depth format and depth.interpolator barycentric; legal: 0 "
        "(a triangle)",
        packet.line_rule));
  }
}

void check_walk(const SetupTrianglePacket& packet, const SetupTriangle& triangle, const Widths& widths) {
  check_order("triangle.x_first", packet.x_first, "triangle.x_last", packet.x_last);
  check_order("triangle.y_first", packet.y_first, "triangle.y_last", packet.y_last);
  // The walk looks at whole blocks.
  const auto columns = [&](int first, int last) {
    const int size = widths.BlockSize;
    return std::array<std::int64_t, 2>{first / size * size, last / size * size + size - 1};
  };
  for (std::size_t i = 0; i < 3; ++i) {
    check_e(triangle.edge[i], columns(packet.x_first, packet.x_last), columns(packet.y_first, packet.y_last),
            widths, fmt::format("triangle.e[{}]", i), packet.e[i]);
  }
}

void check_block(const BlockJob& block, const Widths& widths) {
  check_order("x_first", block.x_first, "x_last", block.x_last);
  check_order("y_first", block.y_first, "y_last", block.y_last);
  if (block.tiles == 0) {
    throw InputError("tiles is 0; legal: a tile or more");
  }
  const int row_tiles = widths.BlockSize / widths.TileSize;
  const auto touched = [&](int tile, int first, int last) {
    return tile >= first / widths.TileSize && tile <= last / widths.TileSize;
  };
  for (std::uint64_t left = block.tiles; left != 0; left &= left - 1) {
    const int x = std::countr_zero(left) % row_tiles;
    const int y = std::countr_zero(left) / row_tiles;
    if (!touched(x, block.x_first, block.x_last) || !touched(y, block.y_first, block.y_last)) {
      throw InputError(
          fmt::format("tiles is {:#x}, with tile ({}, {}) of the block; legal: ({}, {}) to ({}, {}), which "
                      "the bounds touch",
                      block.tiles, x, y, block.x_first / widths.TileSize, block.y_first / widths.TileSize,
                      block.x_last / widths.TileSize, block.y_last / widths.TileSize));
    }
  }
  const int size = widths.BlockSize;
  const std::int64_t x = std::int64_t{block.block_x} * size;
  const std::int64_t y = std::int64_t{block.block_y} * size;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t at_zero = block.e[i] - ((block.a[i] * x + block.b[i] * y) << widths.SubPixelBits);
    check_e({.a = block.a[i], .b = block.b[i], .c = at_zero}, {x, x + size - 1}, {y, y + size - 1}, widths,
            fmt::format("e[{}]", i), block.e[i]);
  }
}

void check_equation(const DepthEquationPacket& equation, const DrawStatePacket& draw) {
  if (draw.format == 0) {
    return;  // early_z does not look at it
  }
  check_vertex_depths(equation.z, draw.format, "equation.z");
  const auto format = static_cast<DepthFormat>(draw.format);
  if (equation.area2 < 1) {
    throw InputError(fmt::format("equation.area2 is {}; legal: 1 or more", equation.area2));
  }
  const auto& z = equation.z;
  SetupTriangle triangle;
  triangle.edge[1] = {.a = equation.a[0], .b = equation.b[0]};
  triangle.edge[2] = {.a = equation.a[1], .b = equation.b[1]};
  triangle.depth.bias = equation.bias;
  const std::int64_t offset = format == DepthFormat::kFloat32
                                  ? float_of_signed_word(equation.offset, equation.exponent)
                                  : equation.offset;
  check_vertex_depth(offset, draw.format, "equation.offset, as a depth,");
  make_depth_equation({ScreenVertex{0, 0, z[0]}, ScreenVertex{0, 0, z[1]}, ScreenVertex{0, 0, z[2]}}, offset,
                      triangle.edge, equation.area2, format,
                      {.least = draw.least_code, .most = draw.most_code}, DepthInterpolator::kBarycentric,
                      triangle.depth);
  const DepthEquationPacket legal = to_packet(triangle, format, DepthInterpolator::kBarycentric);
  demand_equal("equation.reciprocal", equation.reciprocal, legal.reciprocal, "which follows from area2");
  demand_equal("equation.shift", equation.shift, legal.shift, "which follows from area2");
  demand_equal("equation.beyond", equation.beyond, legal.beyond, "which follows from z");
  demand_equal("equation.exponent", equation.exponent, legal.exponent, "which follows from z and offset");
  demand_equal("equation.offset", equation.offset, legal.offset, "which follows from exponent");
  demand_equal("equation.min_code", equation.min_code, legal.min_code, "which follows from z and offset");
  demand_equal("equation.max_code", equation.max_code, legal.max_code, "which follows from z and offset");
}

void check_plane(const DepthEquationPacket& equation, const DrawStatePacket& draw) {
  if (draw.format == 0) {
    return;
  }
  if (equation.min_code < draw.least_code || equation.max_code > draw.most_code ||
      equation.max_code < equation.min_code) {
    throw InputError(
        fmt::format("equation.min_code and max_code are {:#x} and {:#x}; legal: {:#x} to {:#x}, the draw's, "
                    "in this order",
                    equation.min_code, equation.max_code, draw.least_code, draw.most_code));
  }
  const bool is_float = static_cast<DepthFormat>(draw.format) == DepthFormat::kFloat32;
  const int least = is_float ? -125 : 0;
  const int most = kVertexDepthRange + 1;
  if (equation.exponent < least || equation.exponent > most) {
    throw InputError(fmt::format("equation.exponent is {}; legal: {} to {}", equation.exponent, least, most));
  }
}

void check_equation_of(const DepthEquationPacket& equation, const SetupTriangle& triangle) {
  const std::array<Edge, 3>& edge = triangle.edge;
  for (std::size_t i = 0; i < 2; ++i) {
    demand_equal(i == 0 ? "equation.a[0]" : "equation.a[1]", equation.a[i], edge[i + 1].a, "A of the edge");
    demand_equal(i == 0 ? "equation.b[0]" : "equation.b[1]", equation.b[i], edge[i + 1].b, "B of the edge");
  }
  demand_equal("triangle.a[0]", edge[0].a, -(edge[1].a + edge[2].a), "less the sum of the other two");
  demand_equal("triangle.b[0]", edge[0].b, -(edge[1].b + edge[2].b), "less the sum of the other two");
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    sum += edge[i].c + equation.bias[i];
  }
  demand_equal("equation.area2", equation.area2, sum, "the sum of E and bias of the three edges");
}

void check_block_of(const BlockJob& block, const SetupTriangle& kept) {
  for (std::size_t i = 1; i < 3; ++i) {
    demand_equal(i == 1 ? "a[1]" : "a[2]", block.a[i], kept.edge[i].a, "A of the edge in the slot");
    demand_equal(i == 1 ? "b[1]" : "b[2]", block.b[i], kept.edge[i].b, "B of the edge in the slot");
  }
  demand_equal("a[0]", block.a[0], -(block.a[1] + block.a[2]), "less the sum of the other two");
  demand_equal("b[0]", block.b[0], -(block.b[1] + block.b[2]), "less the sum of the other two");
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    sum += block.e[i] + kept.depth.bias[i];
  }
  demand_equal("the sum of e and bias of the slot", sum, kept.depth.area2, "area2 of the slot");
}

void check_samples(const Coverage& coverage, const SetupTriangle& triangle, const Widths& widths) {
  const int side = widths.TileSize;
  for (int bit = 0; bit < side * side; ++bit) {
    if ((coverage.mask.word[static_cast<std::size_t>(bit / 64)] >> (bit % 64) & 1) == 0) {
      continue;
    }
    std::array<std::int64_t, 2> e{};
    for (std::size_t i = 0; i < 2; ++i) {
      const Edge& edge = triangle.edge[i + 1];
      const std::int64_t steps = std::int64_t{edge.a} * (bit % side) + std::int64_t{edge.b} * (bit / side);
      e[i] = coverage.e[i] + triangle.depth.bias[i + 1] + (steps << widths.SubPixelBits);
    }
    if (e[0] < 0 || e[1] < 0 || e[0] + e[1] > triangle.depth.area2) {
      throw InputError(fmt::format(
          "mask covers sample ({}, {}) of the tile, where E of edges 1 and 2, unbiased, are {} and {}; "
          "legal: not negative, their sum at most area2 ({}) of slot {}",
          bit % side, bit / side, e[0], e[1], triangle.depth.area2, coverage.slot));
    }
  }
}

}  // namespace halfspace::c_api
