#include "halfspace/report/result_files.hpp"

#include <fmt/format.h>

#include "halfspace/report/npy.hpp"
#include "halfspace/report/pictures.hpp"
#include "halfspace/report/stats.hpp"
#include "halfspace/shade/shader.hpp"

namespace halfspace {
namespace {

/// Writes an image with value(x, y) at each pixel.
template <class Value, class Get>
void write_array(const std::filesystem::path& path, const char* descr, int width, int height,
                 const Get& value) {
  NpyWriter writer(path, descr, sizeof(Value) * static_cast<std::size_t>(width), fmt::format(" {}", width));
  std::vector<Value> row(static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      row[static_cast<std::size_t>(x)] = value(x, y);
    }
    writer.append(std::as_bytes(std::span(row)));
  }
  writer.finish();
}

void write_arrays(OutputFolder& folder, const Surface& surface, const std::string& label) {
  const int width = surface.codes.width();
  const int height = surface.codes.height();
  const auto array = [&](const char* kind) { return folder.file(fmt::format("{}{}.npy", kind, label)); };
  if (!surface.target) {
    write_array<float>(array("depth"), "'<f4'", width, height,
                       [&](int x, int y) { return depth_of_code(surface.format, surface.codes.at(x, y)); });
  }
  write_array<std::uint16_t>(array("fragments"), "'<u2'", width, height,
                             [&](int x, int y) { return surface.fragments.at(x, y); });
  write_array<std::uint16_t>(array("survivors"), "'<u2'", width, height,
                             [&](int x, int y) { return surface.survivors.at(x, y); });
}

}  // namespace

std::string surface_label(const FrameResult& result, std::size_t number) {
  const std::optional<std::uint32_t>& target = result.surfaces[number].target;
  return target ? fmt::format("_target{}", *target) : fmt::format("{}", number);
}

void write_result_files(OutputFolder& folder, const Frame& frame, const Config& config, Fidelity fidelity,
                        const StallPlan& stalls, const RunResult& result,
                        const std::optional<WhatIfReport>& what_if, Interpolation interpolation) {
  for (std::size_t i = 0; i < result.frame.surfaces.size(); ++i) {
    const Surface& surface = result.frame.surfaces[i];
    if (surface.codes.empty()) {
      continue;  // no target uses this number
    }
    const std::string label = surface_label(result.frame, i);
    write_arrays(folder, surface, label);
    if (surface.sums.empty()) {
      continue;  // no pictures asked for
    }
    const auto picture = [&](const char* kind) { return folder.file(fmt::format("{}{}.png", kind, label)); };
    write_png(picture("shaded"),
              frame.attributes ? shade(frame, result.frame, i, config.raster.sub_pixel_bits, interpolation)
                               : shaded_picture(frame, result.frame, i));
    if (!surface.target) {
      write_png(picture("depth"), depth_picture(surface));
    }
    write_png(picture("overdraw"), overdraw_picture(surface));
    if (!result.reference) {  // a reference has no tiles
      write_png(picture("tiles"), tile_picture(surface, config.tile_walker.tile_size));
    }
    write_png(picture("quads"), quad_picture(surface));
  }
  const std::filesystem::path stats = folder.file(kStatsFile);
  write_stats(stats, frame, config, fidelity, stalls, result, what_if, folder.files());
}

}  // namespace halfspace
