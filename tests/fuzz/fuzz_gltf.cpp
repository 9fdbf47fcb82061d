#include "fuzz_mesh.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace halfspace;
  // A folder that does not exist: buffers are read from the input alone.
  const auto mesh =
      fuzz::read_or_reject([&] { return parse_gltf(fuzz::as_bytes(data, size), "fuzz", "/nonexistent"); });
  if (mesh) fuzz::check_mesh(*mesh);
  return 0;
}
