/// pixel_quads.npy: what a shader that runs once a pixel is given where a pixel has several samples.
#pragma once

#include <filesystem>

#include "halfspace/machine/pixel_rate.hpp"
#include "halfspace/report/npy.hpp"

namespace halfspace {

/// Streams quads of pixels to a file, in the order in which they leave.
class PixelQuadFile {
 public:
  explicit PixelQuadFile(const std::filesystem::path& path);

  void write(const PixelQuadEvent& event);

  /// Completes the file. Throws InputError.
  void finish() { file_.finish(); }

 private:
  NpyWriter file_;
};

}  // namespace halfspace
