#include "halfspace/stress/family.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "halfspace/numerics/error.hpp"
#include "halfspace/numerics/split_mix.hpp"
#include "halfspace/scene/ptf.hpp"
#include "halfspace/stress/line_families.hpp"

namespace halfspace::stress {
namespace {

constexpr std::string_view kDefinition = "each sample as the definition has it";
constexpr std::string_view kBound = "depth within its bound and the range of its vertices";

// clang-format off
constexpr std::array kFamilies{
    Family{"sliver", "long, with twice the area from 1 square sub-pixel", kDefinition, sliver},
    Family{"sub_pixel", "within a pixel, most of them around a sample", kDefinition, sub_pixel},
    Family{"on_samples", "vertices and edges on samples", kDefinition, on_samples},
    Family{"collinear", "without area, or a sub-pixel from it", kDefinition, collinear},
    Family{"near_miss", "edges that pass a sample at the least distance there is, or go through it", kDefinition, near_miss},
    Family{"guard_band", "vertices at the corners and edges of the guard band", kDefinition, guard_band},
    Family{"fan", "fans around a sample", "the sample belongs to one triangle; each as the definition has it", fan},
    Family{"mesh", "jittered, tiling the plane, with T-junctions", "each sample exactly once", mesh},
    Family{"cut_mesh", "in perspective, cut by all six planes", "each sample inside exactly once, none outside", cut_mesh},
    Family{"far_fan", "fans around the target, cut by the guard band", "each sample exactly once", far_fan},
    Family{"permuted", "the same triangles, their vertices in another order", "the same picture, depth too", permuted},
    Family{"translated", "the same triangles, moved by whole pixels", "the same coverage, moved", translated},
    Family{"beyond_band", "vertices up to 2^40 times the clip volume away, cut by the guard band", "samples two sub-pixels from every edge as exact arithmetic has them", beyond_band},
    Family{"extreme_w", "w near 0, negative, huge, denormal", "samples two sub-pixels from every edge as exact arithmetic has them", extreme_w},
    Family{"not_finite", "NaN, infinities, negative zero among other triangles", "only the others, as the definition has them", not_finite},
    Family{"grazer", "vertices on clip planes and just beside", kDefinition, grazer},
    Family{"grid_depth", "vertices on the 1/16 grid of 2x2 pixels", kBound, grid_depth},
    Family{"steep_depth", "slivers and others, depth from 0 to 1", kBound, steep_depth},
    Family{"depth_stack", "layers one code apart, every function, clears between", "survivors as integers have them", depth_stack},
    Family{"clamp_and_offset", "depth clamp and polygon offset", kBound, clamp_and_offset},
};
// clang-format on

}  // namespace

std::span<const Family> families() { return kFamilies; }

bool is_unclipped(const Family& family) {
  static constexpr std::array kClipped{cut_mesh, far_fan, beyond_band, extreme_w, grazer};
  return family.report.empty() && std::ranges::find(kClipped, family.make) == kClipped.end();
}

const Family& family_of(std::string_view name) {
  std::string names;
  for (const std::span<const Family> list : {families(), line_families(), reports()}) {
    for (const Family& family : list) {
      if (family.name == name) {
        return family;
      }
      names += fmt::format("{}{}", names.empty() ? "" : ", ", family.name);
    }
  }
  throw OptionError(fmt::format("family is '{}'; it must be one of {}", name, names));
}

std::string to_text(const Precision& precision) {
  std::string_view rule;
  for (const reference::TieRuleInfo& info : reference::kTieRules) {
    rule = info.rule == precision.rule ? info.name : rule;
  }
  std::string pixels = precision.conservative == Conservative::kOff
                           ? fmt::format("fill rule {}", rule)
                           : fmt::format("{} pixels, uncertainty {}",
                                         precision.conservative == Conservative::kOuter ? "outer" : "inner",
                                         precision.uncertainty);
  if (!precision.samples.is_centre()) {
    pixels += fmt::format(", {} samples:", precision.samples.count);
    for (const SamplePosition& each : precision.samples.positions()) {
      pixels += fmt::format(" {},{}", each.x, each.y);
    }
  }
  return fmt::format("{} sub-pixel bits, {}, {}", precision.sub_pixel_bits, name(precision.format), pixels);
}

Case make_case(const Family& family, const Precision& precision, std::uint64_t seed, std::uint64_t index) {
  SplitMix64 mix(seed);
  std::uint64_t state = mix.next();
  for (const char c : family.name) {
    state = SplitMix64(state ^ static_cast<unsigned char>(c)).next();
  }
  Case made = family.make(precision, SplitMix64(state ^ index).next());
  made.frame.name = fmt::format("{}-{}-{}", family.name, seed, index);
  if (made.twin) {
    made.twin->frame.name = made.frame.name + "-twin";
  }
  return made;
}

void write_cases(std::span<const Family* const> families, const Precision& precision, std::uint64_t seed,
                 std::uint64_t count, const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw InputError(fmt::format("{} cannot be written: {}", folder.string(), error.message()));
  }
  for (const Family* family : families) {
    for (std::uint64_t index = 0; index < count; ++index) {
      const Case made = make_case(*family, precision, seed, index);
      write_ptf(made.frame, folder / (made.frame.name + ".ptf"));
      if (made.twin) {
        write_ptf(made.twin->frame, folder / (made.twin->frame.name + ".ptf"));
      }
    }
  }
}

}  // namespace halfspace::stress
