/// The links that the C API speaks of, and the bits of their packets.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "halfspace/c_api/halfspace.h"
#include "halfspace/units/field_text.hpp"
#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/packing.hpp"

namespace halfspace::c_api {

/// In the order of the units.
enum class LinkId : std::uint8_t {
  kTriangle = HALFSPACE_TRIANGLE,
  kSetupTriangle = HALFSPACE_SETUP_TRIANGLE,
  kSlot = HALFSPACE_SLOT,
  kBlockJob = HALFSPACE_BLOCK_JOB,
  kTileJob = HALFSPACE_TILE_JOB,
  kCoverage = HALFSPACE_COVERAGE,
  kQuadBeat = HALFSPACE_QUAD_BEAT,
  kTestedBeat = HALFSPACE_TESTED_BEAT,
};

/// Where block_walker has a triangle kept.
struct SlotNumber {
  std::uint8_t slot = 0;

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    visit("slot", &SlotNumber::slot, &Widths::SlotBits, Sign::kUnsigned);
  }
};

/// A link that carries these packets side by side, the first in the highest bits.
template <class... Packets>
struct Layout {
  static int bits(const Widths& widths) { return (packed_bits<Packets>(widths) + ...); }

  static void pack(const Widths& widths, std::span<std::uint32_t> words, const Packets&... packets) {
    int lsb = bits(widths);
    std::ranges::fill(words, 0u);
    (pack_at(widths, words, lsb, packets), ...);
  }

  static std::tuple<Packets...> unpack(const Widths& widths, std::span<const std::uint32_t> words) {
    int lsb = bits(widths);
    return std::tuple<Packets...>{unpack_at<Packets>(widths, words, lsb)...};  // in this order
  }

 private:
  template <class Packet>
  static void pack_at(const Widths& widths, std::span<std::uint32_t> words, int& lsb, const Packet& packet) {
    const int size = packed_bits<Packet>(widths);
    std::vector<std::uint32_t> part(words_for(size));
    halfspace::pack(packet, widths, part);
    lsb -= size;
    for (int done = 0; done < size; done += 32) {
      insert_bits(words, lsb + done, std::min(32, size - done), part[static_cast<std::size_t>(done / 32)]);
    }
  }

  template <class Packet>
  static Packet unpack_at(const Widths& widths, std::span<const std::uint32_t> words, int& lsb) {
    const int size = packed_bits<Packet>(widths);
    std::vector<std::uint32_t> part(words_for(size));
    lsb -= size;
    for (int done = 0; done < size; done += 32) {
      part[static_cast<std::size_t>(done / 32)] =
          static_cast<std::uint32_t>(extract_bits(words, lsb + done, std::min(32, size - done)));
    }
    return halfspace::unpack<Packet>(part, widths);
  }
};

using TriangleLink = Layout<ScreenTrianglePacket, DrawStatePacket>;
using SetupTriangleLink = Layout<SetupTrianglePacket, DepthEquationPacket, DrawStatePacket>;
using SlotLink = Layout<SlotNumber, DepthEquationPacket, DrawStatePacket>;
using BlockJobLink = Layout<BlockJob>;
using TileJobLink = Layout<TileJob>;
using CoverageLink = Layout<Coverage>;
using QuadBeatLink = Layout<QuadBeat>;
using TestedBeatLink = Layout<TestedBeat>;

/// "coverage"; "?" for a number that is no link.
const char* link_name(int number);
inline const char* link_name(LinkId link) { return link_name(static_cast<int>(link)); }

/// Throws InputError for a number outside `first` to `last`.
LinkId link_of(int number, LinkId first, LinkId last);

int link_bits(LinkId link, const Widths& widths);

/// The fields of a link's packet, the most significant first; "state.format" where it carries several
/// structs.
std::vector<FieldSlot> link_fields(LinkId link, const Widths& widths);

/// Every field that differs: "mask: expected 0x3, got 0x1; ...", eight of them at most. Empty when none does.
std::string differences(const std::vector<FieldSlot>& fields, std::span<const std::uint32_t> expected,
                        std::span<const std::uint32_t> got);

}  // namespace halfspace::c_api
