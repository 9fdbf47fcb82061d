/// Supersampling of a run: the frame drawn larger, its pictures filtered down.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "halfspace/scene/frame.hpp"
#include "halfspace/shade/picture_filter.hpp"

namespace halfspace {

/// --supersample and --filter.
struct SupersampleOptions {
  int times = 1;
  std::string filter;

  void add_to(CLI::App& command);
  /// Magnifies the frames. Throws InputError, and OptionError where a filter has no picture to act on.
  void apply(std::vector<Frame>& frames, bool pictures) const;
  [[nodiscard]] PictureFilter picture_filter() const;
};

}  // namespace halfspace
