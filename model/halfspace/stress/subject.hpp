/// What the stress campaign draws with: an engine of this library, or somebody else's rasterizer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace::stress {

/// The only target of a frame after it, row by row, row 0 on top. With several samples a pixel, sample 0 of
/// all pixels, then sample 1, and so on.
struct Picture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint32_t> fragments{};  ///< that covered each sample
  std::vector<std::uint32_t> survivors{};  ///< of these, the ones that passed the depth test
  std::vector<std::uint32_t> codes{};      ///< stored depth
  bool culls = false;                      ///< fragments that would fail the depth test may be missing
  int tile_size = 0;                       ///< of the decisions; 0: there are none
  std::vector<DecisionEvent> decisions{};  ///< of the walker
};

class Subject {
 public:
  virtual ~Subject() = default;
  /// For people, and to tell campaigns apart.
  [[nodiscard]] virtual std::string name() const = 0;
  /// May throw: the case has then failed.
  virtual Picture draw(const Frame& frame) = 0;
};

/// A shared library with the function of halfspace_rasterizer.h. Throws InputError.
std::unique_ptr<Subject> library_subject(const std::filesystem::path& file, int sub_pixel_bits);

/// Results that another program left: for each frame of write_cases() a folder of its name with
/// fragments0.npy, survivors0.npy and depth0.npy as `halfspace run --out` writes them. Throws InputError.
std::unique_ptr<Subject> files_subject(const std::filesystem::path& folder);

}  // namespace halfspace::stress
