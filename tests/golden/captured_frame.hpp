/// Frames of real programs, for tests. Some do not ship.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>

#include "halfspace/scene/ptf.hpp"

namespace halfspace::testing {

/// The folder that holds a frame; ends the test as skipped where there is none.
inline std::filesystem::path folder_of(const std::string& frame) {
  namespace fs = std::filesystem;
  const char* variable = std::getenv("HALFSPACE_FRAMES");
  for (const fs::path& folder :
       {fs::path(HALFSPACE_SCENES), fs::path(variable != nullptr ? variable : HALFSPACE_FRAMES)}) {
    if (fs::exists(folder / (frame + ".ptf.xz"))) {
      return folder;
    }
  }
  std::cout << "skipped: " << frame
            << ".ptf.xz does not ship; set HALFSPACE_FRAMES to a folder of captured frames\n";
  std::cout.flush();
  std::_Exit(77);  // SKIP_RETURN_CODE of tests/CMakeLists.txt
}

inline Frame captured_frame(const std::string& name) {
  return read_ptf(folder_of(name) / (name + ".ptf.xz"));
}

}  // namespace halfspace::testing
