/// Records of frames on disk.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "halfspace/timing/record/frame_record.hpp"

namespace halfspace {

/// Writes a gzip file, whole or not at all: "HSRC", a version, the name, the configuration as TOML, and the
/// lists of FrameRecord in order, each with its length in front; all numbers are 32-bit, little endian.
/// Throws InputError.
void write_record(const std::filesystem::path& path, const FrameRecord& record);

/// Reads it back. Throws InputError where the file is damaged, inconsistent or of another version.
FrameRecord read_record(const std::filesystem::path& path);

/// The same from the unpacked bytes of a file; `name` stands for it in errors.
FrameRecord parse_record(std::span<const std::byte> bytes, const std::string& name);

}  // namespace halfspace
