/// Where the build found no headers of EGL and OpenGL.
#include "halfspace/speed/llvmpipe.hpp"

namespace halfspace {

std::unique_ptr<Llvmpipe> Llvmpipe::open(std::string& why) {
  why = "not built: no EGL/egl.h or GL/glcorearb.h (Debian: libegl-dev, libgl-dev)";
  return nullptr;
}

}  // namespace halfspace
