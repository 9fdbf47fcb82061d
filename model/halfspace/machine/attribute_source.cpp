#include "halfspace/machine/attribute_source.hpp"

#include <algorithm>

#include "halfspace/machine/vertex_attributes.hpp"
#include "halfspace/scene/mesh_attributes.hpp"
#include "halfspace/units/interpolator.hpp"

namespace halfspace {
namespace {

constexpr std::array<glm::dvec4, 3> kCoordinates{glm::dvec4{1, 0, 0, 0}, glm::dvec4{0, 1, 0, 0},
                                                 glm::dvec4{0, 0, 1, 0}};

/// Of a primitive whose first corner is `corner`.
template <typename Value>
std::array<glm::dvec4, 3> row(const std::vector<Value>& values, const std::vector<std::uint32_t>& which,
                              std::size_t corner, bool is_triangle) {
  if (is_triangle) {
    return at_vertices(values, which, corner).value_or(std::array<glm::dvec4, 3>{});
  }
  const glm::dvec4 first = at_corner(values, which, corner).value_or(glm::dvec4{0});
  return {first, first, first};
}

}  // namespace

AttributeSource::AttributeSource(const Frame& frame, const Command& draw, const Config& config)
    : frame_(frame),
      draw_(draw),
      config_(config),
      samples_(sample_pattern(config)),
      front_end_(frame, draw, DepthFormat::kNone, config.raster.sub_pixel_bits) {}

std::vector<std::array<glm::dvec4, 3>> AttributeSource::attributes(std::uint32_t triangle) const {
  std::vector<std::array<glm::dvec4, 3>> rows;
  const bool is_triangle = draw_.fills_triangles();
  if (frame_.attributes != nullptr) {
    const MeshAttributes& mesh = *frame_.attributes->mesh;
    const std::size_t corner = first_corner(draw_, triangle);
    const auto add = [&](const auto& values, const std::vector<std::uint32_t>& which) {
      if (!values.empty()) {
        rows.push_back(row(values, which.empty() ? mesh.vertex_of : which, corner, is_triangle));
      }
    };
    add(mesh.colors, {});
    add(mesh.uvs, mesh.uv_of);
    add(mesh.normals, mesh.normal_of);
  }
  const std::array<glm::dvec4, 3> first{kCoordinates[0], kCoordinates[0], kCoordinates[0]};
  rows.resize(static_cast<std::size_t>(config_.interpolator.attributes), is_triangle ? kCoordinates : first);
  return rows;
}

const AttributeSource::Rows& AttributeSource::rows(std::uint32_t triangle) const {
  if (!rows_ || rows_->triangle != triangle) {
    rows_.emplace(Rows{.triangle = triangle, .planes = {}, .attributes = attributes(triangle)});
    if (draw_.fills_triangles()) {
      rows_->planes = AttributePlanes(front_end_, triangle, config_.raster.sub_pixel_bits);
    }
  }
  return *rows_;
}

std::vector<QuadAttribute> AttributeSource::quad(std::uint32_t triangle, std::uint8_t piece, int x, int y,
                                                 std::uint8_t sample, std::uint8_t passed) const {
  const Rows& of = rows(triangle);
  std::vector<QuadAttribute> values;
  for (const std::array<glm::dvec4, 3>& at_vertices : of.attributes) {
    if (of.planes.size() != 0) {
      const AttributeQuad packet = of.planes.packet(of.planes.place_of(piece), x, y, passed, at_vertices,
                                                    Interpolation::kPerspective, samples_.at[sample]);
      values.push_back(interpolator(packet, config_.raster.sub_pixel_bits, config_.interpolator.bits).value);
      continue;
    }
    QuadAttribute& same = values.emplace_back();
    for (std::size_t i = 0; i < same.size(); ++i) {
      same[i] = to_attribute(at_vertices[0][static_cast<int>(i % kComponents)]);
    }
  }
  return values;
}

}  // namespace halfspace
