/// Whole files, in and out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace halfspace {

/// Most bytes of an input, both as stored and unpacked.
inline constexpr std::uint64_t kMaxInputBytes = std::uint64_t{2} << 30;

/// The file's name for one line of text: control characters are replaced by '?'.
[[nodiscard]] std::string display_name(const std::filesystem::path& path);

/// All bytes of a file as they are. Throws InputError when there is no such file, when it is a directory or
/// cannot be read, and when it has more than `limit` bytes.
[[nodiscard]] std::vector<std::byte> read_raw_bytes(const std::filesystem::path& path,
                                                    std::uint64_t limit = kMaxInputBytes);

/// All bytes of a file, unpacked if they are a gzip or xz stream (by content, whatever the extension).
/// Throws InputError as read_raw_bytes() and decompress() do.
[[nodiscard]] std::vector<std::byte> read_bytes(const std::filesystem::path& path,
                                                std::uint64_t limit = kMaxInputBytes);

/// Writes the file whole or not at all (by way of "<path>.part"). Throws InputError when it cannot.
void write_bytes(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace halfspace
