#include "halfspace/timing/systemc/depth_layout.hpp"

#include <algorithm>

namespace halfspace::systemc {

DepthLayout::DepthLayout(const std::vector<Surface>& surfaces, const std::vector<ZSurface>& places, int parts,
                         std::uint64_t base)
    : end_(base) {
  const auto lines_a_tile = static_cast<std::uint32_t>(parts);
  for (std::size_t i = 0; i < places.size(); ++i) {
    places_.push_back({.first_line = places[i].first_tile * lines_a_tile,
                       .line_bytes = places[i].line_bytes,
                       .address = end_,
                       .sample_bytes = sample_bytes(surfaces[i].format)});
    end_ += std::uint64_t{places[i].tiles} * lines_a_tile * places[i].line_bytes;
  }
}

std::uint32_t DepthLayout::surface(std::uint32_t line) const {
  const auto after = std::upper_bound(places_.begin(), places_.end(), line,
                                      [](std::uint32_t l, const Place& p) { return l < p.first_line; });
  return static_cast<std::uint32_t>(after - places_.begin()) - 1;
}

std::uint64_t DepthLayout::address(std::uint32_t line) const {
  const Place& here = place(line);
  return here.address + std::uint64_t{line - here.first_line} * here.line_bytes;
}

std::size_t DepthLayout::samples(std::uint32_t line) const {
  const Place& here = place(line);
  return here.line_bytes / static_cast<std::uint32_t>(here.sample_bytes);
}

void DepthLayout::pack(std::uint32_t line, std::span<const std::uint32_t> codes,
                       std::vector<std::uint8_t>& bytes) const {
  bytes.clear();
  const int width = place(line).sample_bytes;
  for (const std::uint32_t code : codes) {
    for (int i = 0; i < width; ++i) {
      bytes.push_back(static_cast<std::uint8_t>(code >> (8 * i)));
    }
  }
}

void DepthLayout::unpack(std::uint32_t line, std::span<const std::uint8_t> bytes,
                         std::vector<std::uint32_t>& codes) const {
  codes.clear();
  const auto width = static_cast<std::size_t>(place(line).sample_bytes);
  for (std::size_t at = 0; at < bytes.size(); at += width) {
    std::uint32_t code = 0;
    for (std::size_t i = 0; i < width; ++i) {
      code |= std::uint32_t{bytes[at + i]} << (8 * i);
    }
    codes.push_back(code);
  }
}

}  // namespace halfspace::systemc
