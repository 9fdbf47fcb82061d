/// Packets of the verilated pipeline against those of the C++ units.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "halfspace/units/field_text.hpp"
#include "halfspace/units/packing.hpp"

namespace halfspace::rtl {

/// What the scoreboard of a run has seen.
struct PacketReport {
  std::uint64_t compared = 0;
  std::uint64_t different = 0;  ///< packets, lines and counters that are not what the model says
  std::string first;            ///< the first of them: link, packet, cycle, field, both values

  void differ(std::string what) {
    if (different++ == 0) {
      first = std::move(what);
    }
  }
};

/// The packets of one link.
template <class Packet>
class PacketCheck {
 public:
  PacketCheck(const char* link, const Widths& widths, PacketReport& report)
      : link_(link), widths_(widths), report_(report), words_(words_for(packed_bits<Packet>(widths))) {}

  /// The next packet of the link: what the model says and what the wires carry. True where they are the same.
  bool compare(std::uint64_t cycle, const Packet& model, std::span<const std::uint32_t> wires) {
    pack(model, widths_, words_);
    ++report_.compared;
    const bool same = std::ranges::equal(words_, wires.first(words_.size()));
    if (!same) {
      report_.differ(describe(cycle, wires));
    }
    ++packets_;
    return same;
  }

 private:
  [[nodiscard]] std::string describe(std::uint64_t cycle, std::span<const std::uint32_t> wires) const {
    const std::string text = first_difference(field_slots<Packet>(widths_), "model", words_, "RTL", wires);
    return fmt::format("{} packet {} in cycle {}, {}", link_, packets_, cycle,
                       text.empty() ? "bits beyond its fields" : text);
  }

  const char* link_;
  Widths widths_;
  PacketReport& report_;
  std::vector<std::uint32_t> words_;
  std::uint64_t packets_ = 0;
};

}  // namespace halfspace::rtl
