#include "halfspace/c_api/link.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "halfspace/numerics/error.hpp"

namespace halfspace::c_api {
namespace {

constexpr std::array<const char*, HALFSPACE_LINKS> kNames = {
    "triangle", "setup_triangle", "slot", "block_job", "tile_job", "coverage", "quad_beat", "tested_beat"};

/// Calls visit(Layout) for the layout of a link.
template <class Visit>
auto with_layout(LinkId link, Visit&& visit) {
  switch (link) {
    case LinkId::kTriangle:
      return visit(TriangleLink{});
    case LinkId::kSetupTriangle:
      return visit(SetupTriangleLink{});
    case LinkId::kSlot:
      return visit(SlotLink{});
    case LinkId::kBlockJob:
      return visit(BlockJobLink{});
    case LinkId::kTileJob:
      return visit(TileJobLink{});
    case LinkId::kCoverage:
      return visit(CoverageLink{});
    case LinkId::kQuadBeat:
      return visit(QuadBeatLink{});
    case LinkId::kTestedBeat:
      break;
  }
  return visit(TestedBeatLink{});
}

template <class Packet>
void append_fields(std::vector<FieldSlot>& fields, const Widths& widths, int& lsb,
                   const std::string& prefix) {
  lsb -= packed_bits<Packet>(widths);
  for (FieldSlot& field : field_slots<Packet>(widths)) {
    field.lsb += lsb;
    field.name.insert(0, prefix);
    fields.push_back(std::move(field));
  }
}

// The names that the RTL gives the parts of a link.
template <class Packet>
constexpr const char* kPrefix = "";
template <>
constexpr const char* kPrefix<ScreenTrianglePacket> = "triangle.";
template <>
constexpr const char* kPrefix<SetupTrianglePacket> = "triangle.";
template <>
constexpr const char* kPrefix<DepthEquationPacket> = "equation.";
template <>
constexpr const char* kPrefix<DrawStatePacket> = "state.";

template <class... Packets>
std::vector<FieldSlot> fields_of(Layout<Packets...> /*layout*/, const Widths& widths) {
  std::vector<FieldSlot> fields;
  int lsb = Layout<Packets...>::bits(widths);
  (append_fields<Packets>(fields, widths, lsb, kPrefix<Packets>), ...);
  return fields;
}

}  // namespace

const char* link_name(int number) {
  return number >= 0 && number < HALFSPACE_LINKS ? kNames[static_cast<std::size_t>(number)] : "?";
}

LinkId link_of(int number, LinkId first, LinkId last) {
  if (number < static_cast<int>(first) || number > static_cast<int>(last)) {
    throw InputError(fmt::format("link {} ({}) cannot be used here; legal: {} ({}) to {} ({})", number,
                                 link_name(number), static_cast<int>(first), link_name(first),
                                 static_cast<int>(last), link_name(last)));
  }
  return static_cast<LinkId>(number);
}

int link_bits(LinkId link, const Widths& widths) {
  return with_layout(link, [&](auto layout) { return layout.bits(widths); });
}

std::vector<FieldSlot> link_fields(LinkId link, const Widths& widths) {
  return with_layout(link, [&](auto layout) { return fields_of(layout, widths); });
}

std::string differences(const std::vector<FieldSlot>& fields, std::span<const std::uint32_t> expected,
                        std::span<const std::uint32_t> got) {
  constexpr int kMost = 8;
  std::string text;
  int count = 0;
  for (const FieldSlot& field : fields) {
    const std::string want = field_text(field, expected);
    const std::string have = field_text(field, got);
    if (want != have && count++ < kMost) {
      text += fmt::format("{}{}: expected {}, got {}", count > 1 ? "; " : "", field.name, want, have);
    }
  }
  return count > kMost ? fmt::format("{}; and {} fields more", text, count - kMost) : text;
}

}  // namespace halfspace::c_api
