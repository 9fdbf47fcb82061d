/// NumPy's .npy files, version 1.0 (numpy.lib.format): the arrays and record streams of a run, and their
/// reader.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace halfspace {

/// Writes a file record by record; the length is filled in by finish(). Throws InputError when the disk does
/// not take it.
class NpyWriter {
 public:
  /// `descr` is the Python literal of the dtype, `record_size` its size in bytes; `shape_tail` are the
  /// dimensions after the first, as in ", 1920".
  NpyWriter(std::filesystem::path path, std::string descr, std::size_t record_size,
            std::string shape_tail = "");

  /// Appends whole records.
  void append(std::span<const std::byte> bytes);

  /// Completes the header and closes the file.
  void finish();

 private:
  void write_header(std::uint64_t count);

  std::filesystem::path path_;
  std::string descr_;
  std::size_t record_size_;
  std::string shape_tail_;
  std::ofstream file_;
  std::uint64_t bytes_ = 0;
};

/// An array in memory, as it stands in the file.
struct NpyArray {
  std::string descr;  ///< Python literal, without spaces
  std::vector<std::uint64_t> shape;
  std::vector<std::byte> data;  ///< row order
};

/// Reads a file, packed or not (scene/byte_source.hpp). Throws InputError when it is not an .npy file in row
/// order.
NpyArray read_npy(const std::filesystem::path& path);

}  // namespace halfspace
