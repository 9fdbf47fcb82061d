#include "halfspace/report/result_files.hpp"

#include <fmt/format.h>

#include "halfspace/report/npy.hpp"
#include "halfspace/report/pictures.hpp"
#include "halfspace/report/stats.hpp"
#include "halfspace/shade/shader.hpp"

namespace halfspace {
namespace {

/// Writes an image with value(x, y, sample) for each sample of each pixel: of several, sample 0 of all pixels
/// first.
template <class Value, class Get>
void write_array(const std::filesystem::path& path, const char* descr, const TiledImage<std::uint32_t>& size,
                 const Get& value) {
  const int width = size.width();
  const int height = size.height();
  const int samples = size.samples();
  std::string tail = fmt::format(" {}", width);
  std::size_t record = sizeof(Value) * static_cast<std::size_t>(width);
  if (samples > 1) {
    tail = fmt::format(" {},{}", height, tail);
    record *= static_cast<std::size_t>(height);
  }
  NpyWriter writer(path, descr, record, tail);
  std::vector<Value> row(static_cast<std::size_t>(width));
  for (int sample = 0; sample < samples; ++sample) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        row[static_cast<std::size_t>(x)] = value(x, y, sample);
      }
      writer.append(std::as_bytes(std::span(row)));
    }
  }
  writer.finish();
}

void write_arrays(OutputFolder& folder, const Surface& surface, const std::string& label) {
  const TiledImage<std::uint32_t>& codes = surface.codes;
  const auto array = [&](const char* kind) { return folder.file(fmt::format("{}{}.npy", kind, label)); };
  if (!surface.target) {
    write_array<float>(array("depth"), "'<f4'", codes, [&](int x, int y, int sample) {
      return depth_of_code(surface.format, codes.at(x, y, sample));
    });
  }
  write_array<std::uint16_t>(array("fragments"), "'<u2'", codes,
                             [&](int x, int y, int sample) { return surface.fragments.at(x, y, sample); });
  write_array<std::uint16_t>(array("survivors"), "'<u2'", codes,
                             [&](int x, int y, int sample) { return surface.survivors.at(x, y, sample); });
}

}  // namespace

std::string surface_label(const FrameResult& result, std::size_t number) {
  const std::optional<std::uint32_t>& target = result.surfaces[number].target;
  return target ? fmt::format("_target{}", *target) : fmt::format("{}", number);
}

void write_result_files(OutputFolder& folder, const Frame& frame, const Config& config, Fidelity fidelity,
                        const StallPlan& stalls, const RunResult& result,
                        const std::optional<WhatIfReport>& what_if, const PictureOptions& pictures) {
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
    const auto write = [&](const char* kind, const Picture& picture) {
      write_png(folder.file(fmt::format("{}{}.png", kind, label)),
                frame.magnified == 1 ? picture : shrink(picture, frame.magnified, pictures.filter));
    };
    write("shaded", frame.attributes
                        ? shade(frame, result.frame, i, config.raster.sub_pixel_bits, pictures.interpolation)
                        : shaded_picture(frame, result.frame, i));
    if (!surface.target) {
      write("depth", depth_picture(surface));
    }
    write("overdraw", overdraw_picture(surface));
    if (!result.reference) {  // a reference has no tiles
      write("tiles", tile_picture(surface, config.tile_walker.tile_size));
    }
    write("quads", quad_picture(surface));
  }
  const std::filesystem::path stats = folder.file(kStatsFile);
  write_stats(stats, frame, config, fidelity, stalls, result, what_if, folder.files());
}

}  // namespace halfspace
