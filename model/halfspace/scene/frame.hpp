/// A frame: the draws and clears of one frame of a program, in order, with the state that decides coverage
/// and depth, and clip-space positions. It mirrors the PTF1 file format (docs/guides/frames.md); a mesh
/// becomes one too.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/numerics/line_rule.hpp"

namespace halfspace {

enum class CommandKind : std::uint32_t { kDraw = 1, kClear = 2 };

/// Bits of Command::flags, as in the file.
enum class Flag : std::uint32_t {
  kDepthTest = 1u << 0,
  kDepthWrite = 1u << 1,
  kDepthClamp = 1u << 2,
  kNdcZMinusOneToOne = 1u << 3,
  kFrontPositiveArea = 1u << 4,
  kCullFront = 1u << 5,
  kCullBack = 1u << 6,
  kBlend = 1u << 7,
  kShaderDiscards = 1u << 8,
  kShaderWritesDepth = 1u << 9,
  kStencilTest = 1u << 10,
  kColorWrite = 1u << 11,
  kAlphaToCoverage = 1u << 12,
  kNotFilled = 1u << 13,
  kEarlyTestsForced = 1u << 14,
  kPolygonOffset = 1u << 15,
  kShaderSideEffects = 1u << 16,
  kClearColor = 1u << 17,
  kClearDepth = 1u << 18,
  kClearStencil = 1u << 19,
  kBottomLeftRule = 1u << 20,
};

constexpr std::uint32_t bits(std::initializer_list<Flag> flags) {
  std::uint32_t all = 0;
  for (const Flag flag : flags) {
    all |= static_cast<std::uint32_t>(flag);
  }
  return all;
}

inline constexpr std::uint32_t kNoSurface = 0xFFFFFFFFu;
inline constexpr std::uint32_t kMaxTargetSize = 16384;  ///< pixels on a side

/// A render target. Targets with the same depth_surface share one depth buffer.
struct Target {
  std::uint32_t width = 0;  ///< 1 to kMaxTargetSize pixels
  std::uint32_t height = 0;
  std::uint32_t samples = 1;
  DepthFormat depth_format = DepthFormat::kNone;
  std::uint32_t color_count = 0;
  bool presented = false;  ///< this is the image that was shown
  std::uint32_t depth_surface = kNoSurface;
};

/// x, y of the top left pixel, width and height; may reach beyond the target.
struct Scissor {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t width = 1 << 24;
  std::int32_t height = 1 << 24;
};

/// A draw or a clear, with its state.
struct Command {
  CommandKind kind = CommandKind::kDraw;
  std::uint32_t source_event = 0;
  std::uint32_t target = 0;
  std::uint32_t flags = 0;
  DepthFunc depth_func = DepthFunc::kAlways;
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;  ///< a multiple of indices_each()
  std::uint32_t first_vertex = 0;
  std::uint32_t vertex_count = 0;
  glm::vec4 viewport{0};        ///< x, y, width, height in pixels; the height is negative for y-up programs
  glm::vec2 depth_range{0, 1};  ///< near, far
  float clear_depth = 1;
  float offset_factor = 0;
  float offset_units = 0;
  float offset_clamp = 0;
  Scissor scissor;  ///< of a clear: the cleared rectangle
  Primitive primitive = Primitive::kTriangles;
  PolygonMode polygon_mode = PolygonMode::kFill;  ///< where it is kFill, Flag::kNotFilled skips the draw
  LineRule line_rule = LineRule::kRectangular;
  float line_width = 1;  ///< pixels; thin lines round it
  LineStipple stipple;
  float point_size = 1;  ///< pixels: the side of a square

  [[nodiscard]] bool has(Flag flag) const { return (flags & static_cast<std::uint32_t>(flag)) != 0; }

  [[nodiscard]] std::uint32_t indices_each() const { return halfspace::indices_each(primitive); }
  [[nodiscard]] std::uint32_t primitive_count() const { return index_count / indices_each(); }
  /// Triangles of the input are drawn as triangles.
  [[nodiscard]] bool fills_triangles() const {
    return primitive == Primitive::kTriangles && polygon_mode == PolygonMode::kFill;
  }
  [[nodiscard]] bool draws_lines() const {
    return primitive == Primitive::kLines || primitive == Primitive::kLineStrip ||
           (primitive == Primitive::kTriangles && polygon_mode == PolygonMode::kLine);
  }
  [[nodiscard]] bool draws_thin_lines() const { return draws_lines() && is_thin(line_rule); }
  /// The draw is skipped: how its polygons are drawn is not known.
  [[nodiscard]] bool is_skipped() const { return fills_triangles() && has(Flag::kNotFilled); }

  /// On float32 surfaces a draw's depth range, and what a clear sets depth to, may leave [0, 1]
  /// (VK_EXT_depth_range_unrestricted; OpenGL's NV_depth_buffer_float).
  [[nodiscard]] bool is_unrestricted(DepthFormat format) const {
    const auto outside = [](float depth) { return depth < 0 || depth > 1; };
    return format == DepthFormat::kFloat32 &&
           (kind == CommandKind::kDraw ? outside(depth_range.x) || outside(depth_range.y)
                                       : has(Flag::kClearDepth) && outside(clear_depth));
  }
};

struct FrameAttributes;

struct Frame {
  std::string name;
  std::vector<Target> targets;
  std::vector<Command> commands;
  std::vector<glm::vec4> vertices;     ///< clip space
  std::vector<std::uint32_t> indices;  ///< relative to the draw's first_vertex
  std::string meta;                    ///< JSON for people; nothing in it is needed to rasterize
  std::vector<std::string> left_out;   ///< what of the input is not in the frame: "free-form curves (3)"
  std::vector<std::string> cameras;    ///< names of the cameras that stand in the mesh's file
  int magnified = 1;  ///< times as large on a side as its pictures will be (scene/magnify.hpp)
  /// Of the corners of its triangles (scene/mesh_attributes.hpp), where it is one mesh that has them.
  std::shared_ptr<const FrameAttributes> attributes;
};

}  // namespace halfspace
