#include "halfspace/report/pictures.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#define GLM_ENABLE_EXPERIMENTAL  // rgbColor; GLM marks all of gtx so
#include <glm/gtx/color_space.hpp>

#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

Rgb to_rgb(const glm::vec3& color) {
  const auto channel = [](float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255));
  };
  return {channel(color.r), channel(color.g), channel(color.b)};
}

/// From dark blue over red and yellow to white, for t in [0, 1].
glm::vec3 heat(float t) {
  static const std::array<glm::vec3, 6> kStops{{{0.05f, 0.05f, 0.15f},
                                                {0.15f, 0.2f, 0.6f},
                                                {0.6f, 0.15f, 0.55f},
                                                {0.95f, 0.35f, 0.2f},
                                                {1.0f, 0.8f, 0.25f},
                                                {1.0f, 1.0f, 0.95f}}};
  const float at = std::clamp(t, 0.0f, 1.0f) * (kStops.size() - 1);
  const auto stop = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  return glm::mix(kStops[stop], kStops[stop + 1], at - static_cast<float>(stop));
}

/// Hues far apart for neighbouring numbers: steps of the golden ratio round the circle.
glm::vec3 draw_color(std::uint32_t draw) {
  const float turn = std::fmod(static_cast<float>(draw) * 0.618034f + 0.58f, 1.0f);
  return glm::rgbColor(glm::vec3(turn * 360, 0.25f, 0.9f));
}

/// Which draw a triangle of the frame belongs to. Triangles are counted through all draws, in order.
class DrawLookup {
 public:
  struct Found {
    std::uint32_t command;
    std::uint32_t triangle;  ///< in the draw
  };

  explicit DrawLookup(const Frame& frame) {
    std::uint32_t next = 0;
    for (std::uint32_t i = 0; i < frame.commands.size(); ++i) {
      if (frame.commands[i].kind == CommandKind::kDraw) {
        first_.emplace_back(next, i);
        next += frame.commands[i].primitive_count();
      }
    }
  }
  [[nodiscard]] Found find(std::uint32_t triangle) const {
    const auto [first, command] =
        *std::prev(std::upper_bound(first_.begin(), first_.end(), std::pair{triangle, 0xFFFFFFFFu}));
    return {command, triangle - first};
  }

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> first_;  ///< (first triangle, command) of each draw
};

glm::vec3 face_normal(const Frame& frame, const Command& draw, std::uint32_t triangle) {
  if (draw.primitive != Primitive::kTriangles) {
    return {0, 0, 1};  // lines and points face the eye
  }
  constexpr float kTangent = 0.57735f;  // of half the assumed view of 60 degrees
  const float aspect = std::abs(draw.viewport.z / draw.viewport.w);
  std::array<glm::vec3, 3> v;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec4& p =
        frame.vertices[std::size_t{draw.first_vertex} +
                       frame.indices[std::size_t{draw.first_index} + std::size_t{triangle} * 3 + i]];
    v[i] = {p.x * kTangent * aspect, p.y * kTangent * (draw.viewport.w < 0 ? 1.0f : -1.0f), -p.w};
  }
  const bool orthographic = v[0].z == v[1].z && v[1].z == v[2].z;
  for (std::size_t i = 0; orthographic && i < 3; ++i) {
    v[i].z = -frame
                  .vertices[std::size_t{draw.first_vertex} +
                            frame.indices[std::size_t{draw.first_index} + std::size_t{triangle} * 3 + i]]
                  .z;
  }
  const glm::vec3 normal = glm::cross(v[1] - v[0], v[2] - v[0]);
  const float length = glm::length(normal);
  const glm::vec3 unit = length > 0 && std::isfinite(length) ? normal / length : glm::vec3(0, 0, 1);
  const glm::vec3 away_from_eye = orthographic ? glm::vec3(0, 0, -1) : v[0] + v[1] + v[2];
  return glm::dot(unit, away_from_eye) > 0 ? -unit : unit;
}

/// Calls color(x, y, sample) for each sample and stores the mean of a pixel's: the box filter.
template <class Paint>
Picture paint(const Surface& surface, const Paint& color) {
  Picture picture(surface.codes.width(), surface.codes.height());
  const int samples = surface.codes.samples();
  const auto pixel = [&](int x, int y) {
    std::array<int, 3> sum{};
    for (int sample = 0; sample < samples; ++sample) {
      const Rgb one = color(x, y, sample);
      for (std::size_t i = 0; i < 3; ++i) {
        sum[i] += one[i];
      }
    }
    Rgb mean{};
    for (std::size_t i = 0; i < 3; ++i) {
      mean[i] = static_cast<std::uint8_t>((sum[i] + samples / 2) / samples);
    }
    return mean;
  };
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      picture.at(x, y) = pixel(x, y);
    }
  }
  return picture;
}

/// The same with color(column, row) for each square of `side` pixels.
template <class Color>
Picture paint_squares(const Surface& surface, int side, const Color& color) {
  Picture picture(surface.codes.width(), surface.codes.height());
  for (int top = 0; top < picture.height; top += side) {
    for (int left = 0; left < picture.width; left += side) {
      const Rgb rgb = color(left / side, top / side);
      const int width = std::min(side, picture.width - left);
      for (int y = top; y < std::min(top + side, picture.height); ++y) {
        std::fill_n(&picture.at(left, y), width, rgb);
      }
    }
  }
  return picture;
}

}  // namespace

Picture shaded_picture(const Frame& frame, const FrameResult& result, std::size_t surface) {
  const glm::vec3 light = glm::normalize(glm::vec3(-0.45f, 0.75f, 0.6f));
  const DrawLookup draws(frame);
  return paint(result.surfaces[surface], [&](int x, int y, int sample) {
    const std::uint32_t triangle = result.surfaces[surface].visible.at(x, y, sample);
    if (triangle == kNothingVisible) {
      return kBackground;
    }
    const auto [command, in_draw] = draws.find(triangle);
    const glm::vec3 normal = face_normal(frame, frame.commands[command], in_draw);
    const float diffuse = std::max(glm::dot(normal, light), 0.0f);
    const float facing = std::max(normal.z, 0.0f);
    return to_rgb(draw_color(command) * (0.15f + 0.65f * diffuse + 0.2f * facing));
  });
}

Picture depth_picture(const Surface& surface) {
  std::vector<std::int32_t> sorted;
  const std::uint32_t far = largest_code(surface.format);
  for (int y = 0; y < surface.codes.height(); y += 2) {
    for (int x = 0; x < surface.codes.width(); x += 2) {
      if (surface.codes.at(x, y) != far) {
        sorted.push_back(code_order(surface.codes.at(x, y)));
      }
    }
  }
  std::sort(sorted.begin(), sorted.end());
  return paint(surface, [&](int x, int y, int sample) {
    const std::uint32_t code = surface.codes.at(x, y, sample);
    if (code == far || sorted.empty()) {
      return kBackground;
    }
    const auto rank =
        static_cast<float>(std::lower_bound(sorted.begin(), sorted.end(), code_order(code)) - sorted.begin());
    return to_rgb(glm::vec3(0.1f + 0.9f * (1 - rank / static_cast<float>(sorted.size()))));
  });
}

Picture overdraw_picture(const Surface& surface) {
  std::vector<std::uint16_t> counts;
  for (int y = 0; y < surface.fragments.height(); y += 2) {
    for (int x = 0; x < surface.fragments.width(); x += 2) {
      counts.push_back(surface.fragments.at(x, y));
    }
  }
  // The scale ends where all but one pixel in a thousand do, so that a few hot spots do not hide the rest.
  std::sort(counts.begin(), counts.end());
  const float most = std::max<float>(1, counts[counts.size() - 1 - counts.size() / 1000]);
  return paint(surface, [&](int x, int y, int sample) {
    const std::uint16_t count = surface.fragments.at(x, y, sample);
    return count == 0 ? Rgb{} : to_rgb(heat(0.15f + 0.85f * static_cast<float>(count) / most));
  });
}

Picture tile_picture(const Surface& surface, int tile_size) {
  return paint_squares(surface, tile_size, [&](int column, int row) {
    const TileDecisions& tile = surface.sums.decisions.at(column, row);
    const auto all = static_cast<float>(tile.rejected + tile.accepted + tile.partial);
    if (all == 0) {
      return Rgb{};
    }
    const glm::vec3 share = glm::vec3(tile.rejected, tile.accepted, tile.partial) / all;
    return to_rgb(share * (0.35f + 0.65f * std::min(1.0f, std::log2(1 + all) / 6)));
  });
}

Picture quad_picture(const Surface& surface) {
  return paint_squares(surface, 2, [&](int column, int row) {
    const QuadLanes& place = surface.sums.quads.at(column, row);
    if (place.quads == 0) {
      return Rgb{};
    }
    const float live = static_cast<float>(place.covered) / (4 * static_cast<float>(place.quads));
    const float t = (live - 0.25f) / 0.75f;
    return to_rgb(glm::mix(glm::vec3(0.95f, 0.2f, 0.15f), glm::vec3(0.15f, 0.6f, 0.3f), t));
  });
}

void write_png(const std::filesystem::path& path, const Picture& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  if (png_image_write_to_file(&image, path.c_str(), 0, picture.pixels.data(), 0, nullptr) == 0) {
    throw InputError(fmt::format("{}: cannot be written: {}", path.string(), image.message));
  }
}

}  // namespace halfspace
