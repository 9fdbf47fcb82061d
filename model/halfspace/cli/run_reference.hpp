/// halfspace run --reference: a reference rasterizer in place of the machine, with the same result files.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/attribute_planes.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace {

struct ReferenceRequest {
  std::string method;  ///< a name of reference/methods.hpp
  std::string out;     ///< folder for results; empty: none
  bool quads = false;  ///< write quads.npy
  bool pictures = true;
  Interpolation interpolation = Interpolation::kPerspective;  ///< of the shaded picture
};

void add_reference_option(CLI::App& command, std::string& method);

/// Draws `frame`, writes the result files and prints a table. Of `config` count the sub-pixel bits, the fill
/// rule, what late draws do, and the sizes of blocks and tiles, which decide the order of quads. Throws
/// InputError.
void run_reference(const ReferenceRequest& request, Frame frame, const Config& config);

}  // namespace halfspace
