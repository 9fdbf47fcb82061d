#include <vector>

#include "fuzz_input.hpp"
#include "halfspace/scene/compression.hpp"
#include "halfspace/scene/ptf.hpp"

// Plain bytes go to the parser as they are, those that start as gzip or xz by way of the decompressor.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace halfspace;
  constexpr std::uint64_t kMost = std::uint64_t{16} << 20;
  const auto bytes = fuzz::as_bytes(data, size);
  const auto plain = fuzz::read_or_reject(
      [&] { return decompress(std::vector<std::byte>(bytes.begin(), bytes.end()), "fuzz", kMost); });
  if (!plain) return 0;
  const auto frame = fuzz::read_or_reject([&] { return parse_ptf(*plain, "fuzz"); });
  if (!frame) return 0;
  // What was read must be written and read again to the same bytes.
  const std::vector<std::byte> written = format_ptf(*frame);
  if (format_ptf(parse_ptf(written, "fuzz")) != written) std::abort();
  return 0;
}
