#include "halfspace/scene/load.hpp"

#include <fmt/format.h>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/byte_source.hpp"
#include "halfspace/scene/input_name.hpp"
#include "halfspace/scene/mesh.hpp"
#include "halfspace/scene/ptf.hpp"
#include "halfspace/scene/quote.hpp"
#include "halfspace/scene/synthetic.hpp"

namespace halfspace {

Frame load(const std::filesystem::path& path, const Camera& camera, MeshContent content) {
  const InputName name = input_name(path);
  if (name.kind == InputKind::kSynthetic) return synthetic_frame(name.stem);
  if (name.kind == InputKind::kFrame) return read_ptf(path);
  if (name.is_mesh()) {
    Frame frame = frame_from_mesh(read_mesh(path, content), camera, display_name(path));
    frame.name = printable(name.stem);
    return frame;
  }
  throw InputError(fmt::format("{}: extension is {}; legal: {}, {}, {}, or {}NAME", display_name(path),
                               quote(name.extension), kFrameExtensions, kMeshExtensions, kPackedExtensions,
                               kSyntheticPrefix));
}

Frame load(const std::filesystem::path& path, const Camera& camera) {
  return load(path, camera, MeshContent::kGeometry);
}

}  // namespace halfspace
