/// The other yardstick of `bench speed`: Mesa's llvmpipe, the software rasterizer that Linux desktops use, on
/// one thread and without colour. It is loaded when it is asked for, through EGL, so nothing needs it to be
/// there.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "halfspace/config/config.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace {

/// A context of llvmpipe and at most one frame in it. Throws InputError where GL itself reports an error.
class Llvmpipe {
 public:
  /// Null where there is none; `why` then says so in a few words. Sets GALLIUM_DRIVER, LIBGL_ALWAYS_SOFTWARE
  /// and LP_NUM_THREADS of the process.
  static std::unique_ptr<Llvmpipe> open(std::string& why);
  virtual ~Llvmpipe() = default;

  /// The renderer's name, its version included.
  [[nodiscard]] virtual std::string name() const = 0;

  /// Takes a frame in place of the one before: its positions in clip space as they are, and its depth
  /// surfaces. `frame` and `config` must outlive what is done with it.
  virtual void load(const Frame& frame, const Config& config) = 0;
  /// The clears before the first draw, to the end.
  virtual void clear() = 0;
  /// The rest of the frame, to the end: it returns when the last pixel is there.
  virtual void draw() = 0;
  /// clear() and draw(), and counts the samples that passed the depth test.
  virtual std::uint64_t count() = 0;
};

}  // namespace halfspace
