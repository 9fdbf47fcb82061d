#include "fuzz_mesh.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace halfspace;
  const auto mesh = fuzz::read_or_reject([&] { return parse_ply(fuzz::as_bytes(data, size), "fuzz"); });
  if (mesh) fuzz::check_mesh(*mesh);
  const auto shaded = fuzz::read_or_reject(
      [&] { return parse_ply(fuzz::as_bytes(data, size), "fuzz", MeshContent::kAttributes); });
  if (shaded.has_value() != mesh.has_value()) std::abort();
  if (shaded) fuzz::check_mesh(*shaded);
  return 0;
}
