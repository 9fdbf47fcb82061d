#include "halfspace/shade/shader.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <optional>
#include <vector>

#include "halfspace/machine/vertex_attributes.hpp"
#include "halfspace/scene/mesh_attributes.hpp"
#include "halfspace/scene/srgb.hpp"
#include "halfspace/shade/mip_map.hpp"
#include "halfspace/units/interpolator.hpp"

namespace halfspace {
namespace {

constexpr float kAmbient = 0.06f;  // light that comes from everywhere
constexpr float kUnit = 1.0f / (1 << kAttributeFraction);

/// One triangle of the frame, and all that its pixels need. Lines, points, triangles that are drawn as such,
/// and those without area, which conservative rasterization draws, have one colour, that of their first
/// vertex, and no light.
struct Visible {
  std::uint32_t triangle;
  bool is_filled;
  const Command* draw;
  AttributePlanes planes;
  AtVertices colors;
  AtVertices uvs;
  AtVertices normals;
  glm::dvec3 face{0};  ///< its own normal
  glm::vec4 base_color{1};
  const MipMap* image = nullptr;
  Texture texture;
};

/// By a whole number of repeats, so that no bit of the attribute is spent on them.
void move_near_zero(std::array<glm::dvec4, 3>& uvs, int axis, Wrap wrap) {
  if (wrap == Wrap::kClamp) return;
  const double least = std::min({uvs[0][axis], uvs[1][axis], uvs[2][axis]});
  const double moved = wrap == Wrap::kMirror ? 2 * std::floor(least / 2) : std::floor(least);
  for (glm::dvec4& uv : uvs) uv[axis] -= moved;
}

class Shader {
 public:
  Shader(const Frame& frame, const Surface& surface, int sub_pixel_bits, Interpolation how)
      : frame_(frame),
        attributes_(*frame.attributes->mesh),
        surface_(surface),
        sub_pixel_bits_(sub_pixel_bits),
        how_(how) {
    for (const Image& image : attributes_.images) mip_maps_.emplace_back(image);
    if (attributes_.images.empty() && !attributes_.uvs.empty()) mip_maps_.emplace_back(checker_image());
    std::uint32_t next = 0;
    for (std::uint32_t i = 0; i < frame.commands.size(); ++i) {
      if (frame.commands[i].kind != CommandKind::kDraw) continue;
      first_of_draws_[next] = i;
      next += frame.commands[i].primitive_count();
    }
  }

  Picture run() {
    Picture picture(surface_.codes.width(), surface_.codes.height());
    std::ranges::fill(picture.pixels, kBackground);
    for (int y = 0; y < picture.height; y += 2) {
      for (int x = 0; x < picture.width; x += 2) shade_quad(picture, x, y);
    }
    return picture;
  }

 private:
  /// Pixels of the quad that the picture has.
  struct Quad {
    int x;
    int y;
    std::array<std::uint32_t, 4> triangles;
  };

  void shade_quad(Picture& picture, int x, int y) {
    Quad quad{.x = x, .y = y, .triangles = {}};
    for (int p = 0; p < 4; ++p) {
      const bool inside = x + p % 2 < picture.width && y + p / 2 < picture.height;
      quad.triangles[static_cast<std::size_t>(p)] =
          inside ? surface_.visible.at(x + p % 2, y + p / 2) : kNothingVisible;
    }
    unsigned done = 0;
    for (unsigned p = 0; p < 4; ++p) {
      const std::uint32_t triangle = quad.triangles[p];
      if ((done >> p & 1) != 0 || triangle == kNothingVisible) continue;
      done |= shade_piece(picture, quad, p, visible(triangle));
    }
  }

  /// The pixels from `first` on that show the same piece of the same triangle. Returns which.
  unsigned shade_piece(Picture& picture, const Quad& quad, unsigned first, const Visible& of) {
    const auto at = [&](unsigned p) {
      return std::pair{quad.x + static_cast<int>(p % 2), quad.y + static_cast<int>(p / 2)};
    };
    if (!of.is_filled) {
      picture.at(at(first).first, at(first).second) = unlit(of.base_color);
      return 1u << first;
    }
    unsigned pixels = 0;
    std::size_t piece = 0;
    for (unsigned p = first; p < 4; ++p) {
      if (quad.triangles[p] != of.triangle) continue;
      const std::size_t its = of.planes.piece_at(at(p).first, at(p).second);
      if (pixels == 0) piece = its;
      pixels |= its == piece ? 1u << p : 0;
    }
    const auto mask =
        static_cast<std::uint8_t>(pixels & of.planes.mask(piece, quad.x, quad.y));  // else as helpers
    const auto values = [&](const AtVertices& attribute) {
      return attribute ? of.planes.values(piece, quad.x, quad.y, mask, *attribute, how_) : QuadValues{};
    };
    const QuadValues colors = values(of.colors);
    const QuadValues uvs = values(of.uvs);
    const QuadValues normals = values(of.normals);
    for (unsigned p = 0; p < 4; ++p) {
      if ((pixels >> p & 1) == 0) continue;
      glm::vec4 color = of.base_color;
      if (of.colors) color *= number(colors[p]);
      if (of.image != nullptr) color *= texel(of, uvs, p);
      const glm::dvec3 normal = of.normals ? glm::dvec3(number(normals[p])) : of.face;
      const auto [x, y] = at(p);
      picture.at(x, y) = lit(color, normal, to_eye(*of.draw, x, y));
    }
    return pixels;
  }

  static glm::vec4 number(const std::array<std::int32_t, 4>& value) {
    return glm::vec4(value[0], value[1], value[2], value[3]) * kUnit;
  }

  /// Derivatives are differences within the quad, of the row and the column that the pixel is in.
  static glm::vec4 texel(const Visible& of, const QuadValues& uvs, unsigned p) {
    const auto uv = [&](unsigned pixel) { return glm::vec2(number(uvs[pixel])); };
    const glm::vec2 right = uv(p | 1u) - uv(p & ~1u);
    const glm::vec2 down = uv(p | 2u) - uv(p & ~2u);
    return of.image->sample(uv(p), of.image->level_of(right, down), of.texture);
  }

  static Rgb unlit(const glm::vec4& color) {
    const auto channel = [](float value) {
      return static_cast<std::uint8_t>(std::lround(255 * linear_to_srgb(std::clamp(value, 0.0f, 1.0f))));
    };
    return {channel(color.r), channel(color.g), channel(color.b)};
  }

  static Rgb lit(const glm::vec4& color, const glm::dvec3& normal, const glm::dvec3& eye) {
    const double lengths = glm::length(normal) * glm::length(eye);
    const double facing = lengths > 0 ? std::abs(glm::dot(normal, eye)) / lengths : 1;
    return unlit(color * (kAmbient + (1 - kAmbient) * static_cast<float>(facing)));
  }

  /// From what the pixel shows to the eye: along the line of all that is at the pixel's centre, from the near
  /// plane on, of which clip space knows two points.
  [[nodiscard]] glm::dvec3 to_eye(const Command& draw, int x, int y) const {
    const double across = (x + 0.5 - draw.viewport.x) / draw.viewport.z * 2 - 1;
    const double down = (y + 0.5 - draw.viewport.y) / draw.viewport.w * 2 - 1;
    const glm::dmat4& from_clip = frame_.attributes->from_clip;
    const glm::dvec4 near = from_clip * glm::dvec4(across, down, -1, 1);
    const glm::dvec4 far = from_clip * glm::dvec4(across, down, 1, 1);
    return glm::normalize(glm::dvec3(near) * far.w - glm::dvec3(far) * near.w);
  }

  /// Found anew only when another triangle is asked for than the last ones: neighbours show the same.
  const Visible& visible(std::uint32_t triangle) {
    std::optional<Visible>& kept = kept_[triangle % kept_.size()];
    if (!kept || kept->triangle != triangle) kept.emplace(make(triangle));
    return *kept;
  }

  [[nodiscard]] Visible make(std::uint32_t triangle) const {
    const auto [first, command] = *std::prev(first_of_draws_.upper_bound(triangle));
    const Command& draw = frame_.commands[command];
    if (!draw.fills_triangles()) return outline(triangle, draw, triangle - first, command - 1);
    const AttributePlanes planes(FrontEnd(frame_, draw, DepthFormat::kNone, sub_pixel_bits_),
                                 triangle - first, sub_pixel_bits_);
    if (planes.size() == 0) return outline(triangle, draw, triangle - first, command - 1);
    const std::size_t corner = first_corner(draw, triangle - first);
    const auto& uv_of = attributes_.uv_of.empty() ? attributes_.vertex_of : attributes_.uv_of;
    const auto& normal_of = attributes_.normal_of.empty() ? attributes_.vertex_of : attributes_.normal_of;
    Visible out{.triangle = triangle,
                .is_filled = true,
                .draw = &draw,
                .planes = planes,
                .colors = at_vertices(attributes_.colors, attributes_.vertex_of, corner),
                .uvs = at_vertices(attributes_.uvs, uv_of, corner),
                .normals = at_vertices(attributes_.normals, normal_of, corner),
                .face = face_normal(draw, triangle - first),
                .base_color = glm::vec4(1),
                .image = nullptr,
                .texture = {}};
    if (out.normals) {
      for (glm::dvec4& normal : *out.normals) normal = glm::normalize(normal);
      const bool zero = std::ranges::any_of(*out.normals, [](const auto& n) { return !std::isfinite(n.x); });
      if (zero) out.normals.reset();
    }
    use_material(out, command - 1);
    return out;
  }

  [[nodiscard]] Visible outline(std::uint32_t visible, const Command& draw, std::uint32_t primitive,
                                std::uint32_t part) const {
    const std::uint32_t vertex = attributes_.vertex_of[first_corner(draw, primitive)];
    glm::vec4 color = material_of(part).base_color;
    if (vertex < attributes_.colors.size() && std::isfinite(attributes_.colors[vertex].r)) {
      color *= attributes_.colors[vertex];
    }
    return {.triangle = visible,
            .is_filled = false,
            .draw = &draw,
            .planes = {},
            .colors = {},
            .uvs = {},
            .normals = {},
            .base_color = color,
            .image = nullptr,
            .texture = {}};
  }

  [[nodiscard]] Material material_of(std::uint32_t part) const {
    const std::uint32_t number = attributes_.material_of[part];
    return number == kNoAttribute ? Material{} : attributes_.materials[number];
  }

  void use_material(Visible& of, std::uint32_t part) const {
    const Material material = material_of(part);
    of.base_color = material.base_color;
    const bool checker = attributes_.images.empty();
    if (!of.uvs || !(checker || material.texture)) return;
    of.texture = material.texture.value_or(Texture{});
    of.image = &mip_maps_[checker ? 0 : of.texture.image];
    move_near_zero(*of.uvs, 0, of.texture.wrap_u);
    move_near_zero(*of.uvs, 1, of.texture.wrap_v);
  }

  [[nodiscard]] glm::dvec3 face_normal(const Command& draw, std::uint32_t triangle) const {
    std::array<glm::dvec3, 3> v;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t at = std::size_t{draw.first_index} + std::size_t{3} * triangle + i;
      const glm::dvec4 point =
          frame_.attributes->from_clip *
          glm::dvec4(frame_.vertices[std::size_t{draw.first_vertex} + frame_.indices[at]]);
      v[i] = glm::dvec3(point) / point.w;
    }
    return glm::cross(v[1] - v[0], v[2] - v[0]);
  }

  const Frame& frame_;
  const MeshAttributes& attributes_;
  const Surface& surface_;
  int sub_pixel_bits_;
  Interpolation how_;
  std::vector<MipMap> mip_maps_;
  std::map<std::uint32_t, std::uint32_t> first_of_draws_;  ///< first triangle of each draw: its command
  std::array<std::optional<Visible>, 256> kept_;
};

}  // namespace

Picture shade(const Frame& frame, const FrameResult& result, std::size_t surface, int sub_pixel_bits,
              Interpolation how) {
  return Shader(frame, result.surfaces[surface], sub_pixel_bits, how).run();
}

}  // namespace halfspace
