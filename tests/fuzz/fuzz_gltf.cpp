#include "fuzz_mesh.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace halfspace;
  // A folder that does not exist: buffers are read from the input alone.
  const auto mesh =
      fuzz::read_or_reject([&] { return parse_gltf(fuzz::as_bytes(data, size), "fuzz", "/nonexistent"); });
  const auto shaded = fuzz::read_or_reject([&] {
    return parse_gltf(fuzz::as_bytes(data, size), "fuzz", "/nonexistent", MeshContent::kAttributes);
  });
  if (shaded) fuzz::check_mesh(*shaded);
  if (!mesh) return 0;
  fuzz::check_mesh(*mesh);
  if (mesh->cameras.empty()) return 0;
  Camera camera;
  camera.of_mesh = mesh->cameras.front().name;
  const auto frame = fuzz::read_or_reject([&] { return frame_from_mesh(*mesh, camera, "fuzz"); });
  if (frame) validate(*frame);
  return 0;
}
