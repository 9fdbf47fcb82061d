/// PTF1, the file format of frames (docs/guides/frames.md).
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "halfspace/scene/frame.hpp"

namespace halfspace {

/// The frame in the plain bytes of a PTF1 file; `name` becomes the frame's name and stands in front of
/// errors. Nothing is allocated before the sizes in the header have been checked against the bytes present.
/// Throws InputError when the bytes are not exactly one PTF1 frame, and as validate() does.
[[nodiscard]] Frame parse_ptf(std::span<const std::byte> bytes, std::string_view name);

/// The frame in a file, plain, gzip or xz; it is named after the file, without folder and extensions.
/// Throws InputError as read_bytes() and parse_ptf() do.
[[nodiscard]] Frame read_ptf(const std::filesystem::path& path);

/// The plain bytes of the frame, the inverse of parse_ptf (the name is not part of the file).
/// Throws InputError when a section has more entries than 32 bits count. The frame is not validated.
[[nodiscard]] std::vector<std::byte> format_ptf(const Frame& frame);

/// Writes the frame, whole or not at all; packed if the path ends in .gz or .xz, as in input_name.hpp.
void write_ptf(const Frame& frame, const std::filesystem::path& path);

}  // namespace halfspace
