/// A stream of tile jobs in a file: what `halfspace run` records and the edge_evaluator bench replays.
///
/// Little-endian 32-bit words. Header: "HSTJ", version (1), tile size, sub-pixel bits, words of a record.
/// Then one record after another: a TileJob as model/halfspace/units/packing.hpp packs it, bits above it
/// zero.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

#include "halfspace/numerics/widths.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace {

/// Writes a file whole or not at all: it gets its name in close().
class TileJobWriter {
 public:
  /// Throws InputError when the file cannot be created.
  TileJobWriter(std::filesystem::path path, const Widths& widths);
  TileJobWriter(const TileJobWriter&) = delete;
  TileJobWriter& operator=(const TileJobWriter&) = delete;
  /// Removes what was written, unless close() was called.
  ~TileJobWriter();

  /// `job` must satisfy the widths of its packet.
  void write(const TileJob& job);
  /// Throws InputError when the file could not be written.
  void close();

 private:
  std::filesystem::path path_;
  std::filesystem::path partial_;
  Widths widths_;
  std::vector<std::uint32_t> words_;
  std::ofstream stream_;
};

struct TileJobFile {
  Widths widths;
  std::vector<TileJob> jobs;
};

/// Throws InputError on anything that TileJobWriter does not write.
[[nodiscard]] TileJobFile read_tile_jobs(const std::filesystem::path& path);

}  // namespace halfspace
