// The law of depth state: what a draw covers is a function of x, y and w alone. Polygon offset, depth clamp
// and depth range act on fragments, after interpolation.
#include <algorithm>
#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "../frames.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/reference/exact_depth.hpp"
#include "halfspace/scene/front_end.hpp"
#include "halfspace/scene/validate.hpp"
#include "random.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

constexpr int kSide = 64;

double fraction(Random& random) { return static_cast<double>(random.between(0, 1 << 24)) / (1 << 24); }

/// A mesh of clip-space vertices that covers the whole screen: a grid whose inner vertices are moved about,
/// or a fan around a point. With `crossing`, w and z differ so much that z / w leaves any range.
struct Mesh {
  std::vector<glm::vec4> vertices;
  std::vector<std::uint32_t> indices;
};

/// x, y from -1 to 1, and the height, which bends the depth of a terrain.
glm::vec4 clip_vertex(double x, double y, double height, bool crossing, Random& random) {
  const double w = crossing ? std::ldexp(1 + fraction(random), static_cast<int>(random.between(-8, 8))) : 1;
  const double z =
      crossing ? std::ldexp(2 * fraction(random) - 1, static_cast<int>(random.between(-4, 12))) : height;
  return {static_cast<float>(x * w), static_cast<float>(y * w), static_cast<float>(z * w),
          static_cast<float>(w)};
}

Mesh jittered_grid(Random& random, bool crossing) {
  const int cells = static_cast<int>(random.between(1, 12));
  Mesh mesh;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const auto at = [&](int k) {
        const bool border = k == 0 || k == cells;
        return (k + (border ? 0 : 0.4 * (fraction(random) - 0.5))) * 2.4 / cells - 1.2;
      };
      const double x = at(i);
      const double y = at(j);
      mesh.vertices.push_back(clip_vertex(x, y, fraction(random), crossing, random));
    }
  }
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const auto corner = static_cast<std::uint32_t>(j * (cells + 1) + i);
      const auto down = static_cast<std::uint32_t>(cells + 1);
      mesh.indices.insert(mesh.indices.end(),
                          {corner, corner + 1, corner + down, corner + 1, corner + down + 1, corner + down});
    }
  }
  return mesh;
}

Mesh fan(Random& random, bool crossing) {
  const auto rim = static_cast<std::uint32_t>(random.between(5, 40));
  Mesh mesh;
  mesh.vertices.push_back(
      clip_vertex(2 * fraction(random) - 1, 2 * fraction(random) - 1, fraction(random), crossing, random));
  for (std::uint32_t i = 0; i < rim; ++i) {
    const double angle = 2 * M_PI * (i + 0.5 * fraction(random)) / rim;
    mesh.vertices.push_back(
        clip_vertex(8 * std::cos(angle), 8 * std::sin(angle), fraction(random), crossing, random));
    mesh.indices.insert(mesh.indices.end(), {0, i + 1, i + 1 == rim ? 1 : i + 2});
  }
  return mesh;
}

/// Any depth state but depth clamp, which takes the near and the far plane away.
void randomise(Command& draw, Random& random) {
  const auto any = [&] {
    return std::ldexp(static_cast<float>(2 * fraction(random) - 1),
                      static_cast<int>(random.between(-30, 20)));
  };
  if (random.between(0, 1) == 0) {
    draw.flags |= bits({Flag::kPolygonOffset});
    draw.offset_factor = random.between(0, 2) == 0 ? 0 : any();
    draw.offset_units = any();
    draw.offset_clamp = random.between(0, 1) == 0 ? 0 : any();
  }
  if (random.between(0, 1) == 0) {
    draw.depth_range = {static_cast<float>(fraction(random)), static_cast<float>(fraction(random))};
  }
  draw.depth_func = static_cast<DepthFunc>(random.between(0, 7));
}

/// The first pixel that is not covered once.
std::string not_once(const Surface& surface) {
  for (int i = 0; i < kSide * kSide; ++i) {
    if (surface.fragments.at(i % kSide, i / kSide) != 1) {
      return std::to_string(i % kSide) + ", " + std::to_string(i / kSide);
    }
  }
  return "none";
}

std::uint64_t case_seed(std::uint64_t n) { return seed() + n; }

}  // namespace

TEST_CASE("depth state never changes what is covered, and a mesh covers every sample once") {
  const std::uint64_t frames = samples(10'000'000) / (kSide * kSide);
  for (std::uint64_t n = 0; n < frames; ++n) {
    Random random(case_seed(n));
    CAPTURE(case_seed(n));
    const bool crossing = random.between(0, 1) == 0;
    const bool clamp = crossing || random.between(0, 1) == 0;
    const Mesh mesh = random.between(0, 2) == 0 ? fan(random, crossing) : jittered_grid(random, crossing);
    const DepthFormat format =
        std::array{DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32}[n % 3];
    FrameBuilder builder(kSide, format);
    Command& draw = builder.draw({});
    draw.index_count = static_cast<std::uint32_t>(mesh.indices.size());
    draw.vertex_count = static_cast<std::uint32_t>(mesh.vertices.size());
    if (clamp) {
      draw.flags |= bits({Flag::kDepthClamp});
    }
    builder.frame.vertices = mesh.vertices;
    builder.frame.indices = mesh.indices;
    Config config;
    config.raster.sub_pixel_bits = static_cast<int>(random.between(4, 8));
    config.depth.interpolator = n % 2 == 0 ? DepthInterpolator::kPlane : DepthInterpolator::kBarycentric;
    REQUIRE(not_once(run_functional(builder.frame, config).surfaces[0]) == "none");
    randomise(draw, random);
    validate(builder.frame);
    REQUIRE(not_once(run_functional(builder.frame, config).surfaces[0]) == "none");
  }
}

// Drawn again with EQUAL and one unit of offset more, nothing may pass.
TEST_CASE("one unit of polygon offset separates two equal triangles") {
  const std::uint64_t wanted = samples(10'000'000) / 6;  // as many combinations
  const DepthFormat format = GENERATE(DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32);
  const auto interpolator = GENERATE(DepthInterpolator::kPlane, DepthInterpolator::kBarycentric);
  CAPTURE(static_cast<int>(format), static_cast<int>(interpolator));
  Config config;
  config.depth.interpolator = interpolator;
  std::uint64_t compared = 0;
  for (std::uint64_t n = 0; compared < wanted; ++n) {
    Random random(case_seed(n));
    CAPTURE(case_seed(n));
    FrameBuilder builder(kSide, format);
    for (int i = 0; i < 50; ++i) {
      const auto depth = [&] {
        // away from 0 and 1, at which fragments are clamped
        const double z = 0.001 + 0.998 * fraction(random);
        return format == DepthFormat::kFloat32 && random.between(0, 3) == 0
                   ? std::max(std::ldexp(z, -static_cast<int>(random.between(0, 40))), 1e-30)
                   : z;
      };
      const double flat = depth();
      const bool is_flat = random.between(0, 3) == 0;
      const double reach = static_cast<double>(random.between(2, kSide));
      const glm::dvec2 centre{fraction(random) * kSide, fraction(random) * kSide};
      std::vector<glm::dvec3> triangle;
      for (int v = 0; v < 3; ++v) {
        triangle.emplace_back(centre.x + (fraction(random) - 0.5) * reach,
                              centre.y + (fraction(random) - 0.5) * reach, is_flat ? flat : depth());
      }
      builder.draw(triangle).depth_func = DepthFunc::kAlways;
      Command& again = builder.draw(triangle);
      again.flags |= bits({Flag::kPolygonOffset});
      again.depth_func = DepthFunc::kEqual;
      again.offset_units = i % 2 == 0 ? 1 : -1;
    }
    const FrameResult result = run_functional(builder.frame, config);
    for (std::size_t i = 1; i < result.draws.size(); i += 2) {
      CAPTURE(i);
      REQUIRE(result.draws[i].counters.early_z.survivors == 0);
      compared += result.draws[i].counters.early_z.tested;
    }
  }
}

// The formula of the specification in rational numbers, on the snapped triangle, at a sample.
TEST_CASE("polygon offset is within a unit of the last place of its formula") {
  const std::uint64_t wanted = samples(10'000'000) / 250;
  const DepthFormat format = GENERATE(DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32);
  const auto interpolator = GENERATE(DepthInterpolator::kPlane, DepthInterpolator::kBarycentric);
  CAPTURE(static_cast<int>(format), static_cast<int>(interpolator));
  Config config;
  config.depth.interpolator = interpolator;
  std::uint64_t compared = 0;
  for (std::uint64_t n = 0; compared < wanted; ++n) {
    Random random(case_seed(n));
    CAPTURE(case_seed(n));
    std::vector<glm::dvec3> triangle;
    reference::GridTriangle grid;
    for (std::size_t i = 0; i < 3; ++i) {
      grid[i] = {random.between(-16 * 256, 32 * 256), random.between(-16 * 256, 32 * 256)};
      triangle.emplace_back(grid[i].x / 256.0, grid[i].y / 256.0,
                            static_cast<double>(random.between(0, 1 << 20)) / (1 << 20));
    }
    if (reference::twice_area(grid[0], grid[1], grid[2]) == 0) {
      continue;
    }
    FrameBuilder builder(16, format);
    Command& draw = builder.draw(triangle);
    draw.depth_func = DepthFunc::kAlways;
    draw.flags |= bits({Flag::kPolygonOffset});
    const auto any = [&](int least, int most) {
      return std::ldexp(static_cast<float>(2 * fraction(random) - 1),
                        static_cast<int>(random.between(least, most)));
    };
    draw.offset_factor = random.between(0, 3) == 0 ? 0 : any(-10, 3);
    draw.offset_units = random.between(0, 3) == 0 ? 0 : any(0, 20);
    draw.offset_clamp = random.between(0, 1) == 0 ? 0 : any(-10, -1);

    std::array<mpq_class, 3> z;
    mpq_class z_max = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      z[i] = mpq_class(triangle[i].z);
      z_max = std::max(z_max, z[i]);
    }
    const auto at = [&](std::int64_t x, std::int64_t y) { return reference::exact_depth(grid, z, {x, y}); };
    const mpq_class slope =
        256 * std::max(mpq_class(abs(at(1, 0) - at(0, 0))), mpq_class(abs(at(0, 1) - at(0, 0))));
    const mpq_class unit = format == DepthFormat::kFloat32
                               ? mpq_class(z_max == 0 ? 0 : std::ldexp(1.0, std::ilogb(z_max.get_d()) - 23))
                               : mpq_class(1) / max_unorm_code(format);
    mpq_class offset = slope * mpq_class(draw.offset_factor) + unit * mpq_class(draw.offset_units);
    if (draw.offset_clamp > 0) {
      offset = std::min(offset, mpq_class(draw.offset_clamp));
    } else if (draw.offset_clamp < 0) {
      offset = std::max(offset, mpq_class(draw.offset_clamp));
    }
    const FrameResult result = run_functional(builder.frame, config);
    const Surface& surface = result.surfaces[0];
    for (int y = 0; y < 16; y += 5) {
      for (int x = 0; x < 16; x += 5) {
        if (surface.fragments.at(x, y) == 0) {
          continue;
        }
        const mpq_class before = at(x * 256 + 128, y * 256 + 128);
        const mpq_class exact = std::clamp<mpq_class>(before + offset, 0, 1);
        const std::uint32_t code = surface.codes.at(x, y);
        ++compared;
        if (format == DepthFormat::kFloat32) {
          // A sum that cancels keeps the last place of what was added.
          const mpq_class scale = std::max({exact, z_max, std::min<mpq_class>(abs(offset), 1)});
          const mpq_class off = abs(reference::float_value(std::bit_cast<float>(code)) - exact);
          REQUIRE(off <= std::ldexp(1.0, std::ilogb(scale.get_d()) - 23));
        } else {
          REQUIRE(reference::ulps_off_unorm(code, exact, unorm_bits(format)) <= 1);
        }
      }
    }
  }
}
