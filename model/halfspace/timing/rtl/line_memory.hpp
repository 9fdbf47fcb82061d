/// Memory behind the verilated pipeline: lines of depth, with the timing of docs/units/early_z.md, *Memory*.
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/units/z_line.hpp"

namespace halfspace::rtl {

class LineMemory {
 public:
  /// At first all surfaces are at depth 1.
  LineMemory(const Config& config, const std::vector<Surface>& surfaces, const std::vector<ZSurface>& places);

  /// A request in `cycle`: its data is what the line holds now in its first `bytes`.
  void request(std::uint64_t cycle, std::uint32_t line, std::uint32_t bytes);
  /// The beat of the read channel in `cycle`; false where it has none.
  bool fill(std::uint64_t cycle, std::span<std::uint32_t> words);
  /// A beat of the write channel. Returns true with the last of the line's `bytes`.
  bool write(std::uint32_t line, std::uint32_t bytes, std::span<const std::uint32_t> words);

  /// The lines of a surface are only marked cleared, until they are written.
  void clear(const ZSurface& place);
  /// The surface as whoever knows of its clear sees it.
  void read_surface(const ZSurface& place, std::uint32_t clear_code, Surface& surface) const;

  /// Bytes of a line that is not coded, or 0 where there is none.
  [[nodiscard]] std::uint32_t line_bytes(std::uint32_t line) const {
    return line < bytes_of_line_.size() ? bytes_of_line_[line] : 0;
  }

 private:
  struct Fill {
    std::uint64_t first = 0;  ///< cycle of the first beat
    std::uint32_t next = 0;   ///< byte
    std::vector<std::uint8_t> bytes;
  };

  [[nodiscard]] std::span<std::uint8_t> bytes(std::uint32_t line) {
    return {&bytes_[std::size_t{line} * stride_], bytes_of_line_[line]};
  }

  int parts_;
  int tile_size_;
  std::uint32_t samples_;  ///< of a line
  std::uint64_t latency_;
  std::uint32_t read_bytes_;
  std::uint32_t write_bytes_;
  std::size_t stride_;  ///< of the lines in bytes_
  std::vector<std::uint8_t> bytes_;
  std::vector<std::uint32_t> bytes_of_line_;
  std::vector<std::uint32_t> stored_;  ///< bytes that were written last, by line
  std::vector<bool> cleared_;          ///< by line
  std::deque<Fill> fills_;
  std::uint64_t read_free_ = 0;  ///< first cycle in which the read channel has nothing to move
  std::uint32_t written_ = 0;    ///< bytes of the line that is being written
};

}  // namespace halfspace::rtl
