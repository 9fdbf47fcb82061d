#include "halfspace/scene/ply_attributes.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "halfspace/scene/srgb.hpp"

namespace halfspace::ply {
namespace {

double largest_of(Type type) {
  return with_type(type, [](auto value) {
    using Value = decltype(value);
    if constexpr (std::is_integral_v<Value>) return static_cast<double>(std::numeric_limits<Value>::max());
    return 1.0;
  });
}

}  // namespace

VertexAttributes::VertexAttributes(const Element& vertex, AttributeBuilder& builder)
    : builder_(builder), slots_(vertex.properties.size(), kNone), scales_(vertex.properties.size(), 1) {
  find(vertex, kNormal, {"nx", "ny", "nz"});
  find(vertex, kColor, {"red", "green", "blue", "alpha"});
  find(vertex, kUv, {"u", "v"});
  if (!has(kUv, 2)) find(vertex, kUv, {"s", "t"});
  if (!has(kUv, 2)) find(vertex, kUv, {"texture_u", "texture_v"});
  values_[kColor + 3] = 1;
}

void VertexAttributes::find(const Element& vertex, Slot first, const std::vector<const char*>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::size_t property = vertex.find(names[i], false);
    if (property == slots_.size()) continue;
    slots_[property] = static_cast<std::uint8_t>(first + i);
    found_[first + i] = true;
    if (first == kColor) scales_[property] = 1 / largest_of(vertex.properties[property].type);
  }
}

bool VertexAttributes::has(Slot first, std::size_t count) const {
  return std::all_of(found_.begin() + first, found_.begin() + first + static_cast<std::ptrdiff_t>(count),
                     [](bool found) { return found; });
}

void VertexAttributes::store(std::uint32_t vertex) {
  const auto at = [&](int slot) { return static_cast<float>(values_[static_cast<std::size_t>(slot)]); };
  if (has(kNormal, 3)) builder_.set_normal(vertex, {at(kNormal), at(kNormal + 1), at(kNormal + 2)});
  if (has(kColor, 3)) {
    const auto light = [&](int i) { return srgb_to_linear(std::clamp(at(kColor + i), 0.0f, 1.0f)); };
    builder_.set_color(vertex, {light(0), light(1), light(2), std::clamp(at(kColor + 3), 0.0f, 1.0f)});
  }
  if (has(kUv, 2)) builder_.set_uv(vertex, {at(kUv), 1 - at(kUv + 1)});
}

}  // namespace halfspace::ply
