/// Where depth lies in memory.
///
/// Surface after surface from the base address on; in a surface tile after tile in row order, in a tile its
/// parts from top to bottom, each a line of the z cache, in a line its samples in row order. A sample has 2
/// bytes in unorm16 and 4 in the other formats, little endian:
///
///     address = base + bytes of the surfaces before + (line - first line of the surface) * bytes of a line
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/machine/frame_result.hpp"
#include "halfspace/units/z_line.hpp"

namespace halfspace::systemc {

class DepthLayout {
 public:
  DepthLayout() = default;
  DepthLayout(const std::vector<Surface>& surfaces, const std::vector<ZSurface>& places, int parts,
              std::uint64_t base);

  /// The surface that a line of memory is of.
  [[nodiscard]] std::uint32_t surface(std::uint32_t line) const;
  [[nodiscard]] std::uint64_t address(std::uint32_t line) const;
  [[nodiscard]] std::uint32_t line_bytes(std::uint32_t line) const { return place(line).line_bytes; }
  /// Samples of a line.
  [[nodiscard]] std::size_t samples(std::uint32_t line) const;
  /// First byte after the last surface.
  [[nodiscard]] std::uint64_t end() const { return end_; }

  /// The bytes of a line, and back.
  void pack(std::uint32_t line, std::span<const std::uint32_t> codes, std::vector<std::uint8_t>& bytes) const;
  void unpack(std::uint32_t line, std::span<const std::uint8_t> bytes,
              std::vector<std::uint32_t>& codes) const;

 private:
  struct Place {
    std::uint32_t first_line;
    std::uint32_t line_bytes;
    std::uint64_t address;
    int sample_bytes;
  };
  [[nodiscard]] const Place& place(std::uint32_t line) const { return places_[surface(line)]; }

  std::vector<Place> places_;
  std::uint64_t end_ = 0;
};

}  // namespace halfspace::systemc
