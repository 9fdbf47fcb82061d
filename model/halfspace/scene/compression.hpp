/// gzip and xz, on bytes in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace halfspace {

/// The plain bytes of `raw`: unpacked when it starts with the magic of gzip or xz (several members in a row
/// are joined), itself otherwise. Memory stays below `limit` plus the decoder's own (256 MiB at most for xz).
/// Throws InputError, with `name` in front, when the stream is cut short, damaged, followed by anything else,
/// needs too large a dictionary, or holds more than `limit` bytes.
[[nodiscard]] std::vector<std::byte> decompress(std::vector<std::byte> raw, std::string_view name,
                                                std::uint64_t limit);

[[nodiscard]] std::vector<std::byte> compress_gzip(std::span<const std::byte> plain);
[[nodiscard]] std::vector<std::byte> compress_xz(std::span<const std::byte> plain);

}  // namespace halfspace
