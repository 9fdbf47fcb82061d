#include "halfspace/scene/load.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/byte_source.hpp"
#include "halfspace/scene/mesh.hpp"
#include "halfspace/scene/ptf.hpp"
#include "halfspace/scene/quote.hpp"
#include "halfspace/scene/synthetic.hpp"

namespace halfspace {
namespace {

bool is_frame(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  return name.ends_with(".ptf") || name.ends_with(".ptf.gz") || name.ends_with(".ptf.xz");
}

}  // namespace

Frame load(const std::filesystem::path& path, const Camera& camera) {
  if (path.native().starts_with(kSyntheticPrefix)) {
    return synthetic_frame(std::string_view(path.native()).substr(kSyntheticPrefix.size()));
  }
  if (is_frame(path)) return read_ptf(path);
  if (is_mesh(path)) {
    Frame frame = frame_from_mesh(read_mesh(path), camera, display_name(path));
    frame.name = display_name(path.stem());
    return frame;
  }
  throw InputError(
      fmt::format("{}: extension is {}; legal: .ptf, .ptf.gz, .ptf.xz, .obj, .ply, .gltf, .glb, or {}NAME",
                  display_name(path), quote(path.extension().string()), kSyntheticPrefix));
}

}  // namespace halfspace
