#include "halfspace/scene/gltf/accessor.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <vector>

#include "halfspace/scene/quote.hpp"

namespace halfspace::gltf {
namespace {

constexpr std::size_t kMaxStride = 252;  // glTF 2.0, 5.11.4

constexpr std::array kAnyNumber{Component::kByte,          Component::kUnsignedByte, Component::kShort,
                                Component::kUnsignedShort, Component::kFloat,        Component::kDouble};
constexpr std::array kUnsignedFraction{Component::kUnsignedByte, Component::kUnsignedShort, Component::kFloat,
                                       Component::kDouble};
constexpr std::array kIndexNumber{Component::kUnsignedByte, Component::kUnsignedShort,
                                  Component::kUnsignedInt};
constexpr std::array kJointNumber{Component::kUnsignedByte, Component::kUnsignedShort};
constexpr std::array kFloatNumber{Component::kFloat, Component::kDouble};

std::size_t size_of(Component component) {
  switch (component) {
    case Component::kByte:
    case Component::kUnsignedByte:
      return 1;
    case Component::kShort:
    case Component::kUnsignedShort:
      return 2;
    case Component::kUnsignedInt:
    case Component::kFloat:
      return 4;
    case Component::kDouble:
      break;
  }
  return 8;
}

bool is_real(Component component) {
  return component == Component::kFloat || component == Component::kDouble;
}

unsigned width_of(std::string_view type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  return type == "VEC4" ? 4 : 16;
}

/// The number at `from`, little-endian as this machine.
template <typename Number>
Number load(const std::byte* from) {
  Number number;
  std::memcpy(&number, from, sizeof(number));
  return number;
}

std::uint32_t load_whole(const std::byte* from, Component component) {
  switch (component) {
    case Component::kUnsignedByte:
      return load<std::uint8_t>(from);
    case Component::kUnsignedShort:
      return load<std::uint16_t>(from);
    default:
      return load<std::uint32_t>(from);
  }
}

/// The fraction that a normalized whole number stands for: glTF 2.0, 3.11 (Animations).
template <typename Number>
double fraction(Number number, bool normalized) {
  if (!normalized) return number;
  return std::max(static_cast<double>(number) / std::numeric_limits<Number>::max(), -1.0);
}

/// The bytes of `count` elements of `size` bytes from `offset` in the view.
const std::byte* find_elements(const Document& document, Buffers& buffers, const Object& from,
                               std::uint64_t count, std::size_t size) {
  const std::uint64_t index = from.number("bufferView");
  const View view = buffers.view(index);
  const std::uint64_t offset = from.number_or("byteOffset", 0);
  if (view.stride != 0 && view.stride != size) {
    document.fail("bufferView {} has byteStride {}; legal: {}, without gaps", index, view.stride, size);
  }
  const std::uint64_t most = offset <= view.bytes.size() ? (view.bytes.size() - offset) / size : 0;
  if (count > most) {
    document.fail("{} has {} elements from byte {}; legal: at most {} in bufferView {}", from.name(), count,
                  offset, most, index);
  }
  return view.bytes.data() + offset;
}

}  // namespace

const Use kPositionUse{"POSITION", "VEC3", kAnyNumber};
const Use kIndexUse{"indices", "SCALAR", kIndexNumber};
const Use kJointUse{"JOINTS", "VEC4", kJointNumber};
const Use kWeightUse{"WEIGHTS", "VEC4", kUnsignedFraction, true};
const Use kInverseBindUse{"inverseBindMatrices", "MAT4", kFloatNumber};
const Use kNormalUse{"NORMAL", "VEC3", kAnyNumber};
const Use kTextureUse{"TEXCOORD", "VEC2", kAnyNumber};
const Use kColor3Use{"COLOR", "VEC3", kUnsignedFraction, true};
const Use kColor4Use{"COLOR", "VEC4", kUnsignedFraction, true};
const Use kTranslationUse{"TRANSLATION", "VEC3", kAnyNumber};
const Use kRotationUse{"ROTATION", "VEC4", kAnyNumber, true};
const Use kScaleUse{"SCALE", "VEC3", kAnyNumber};
const Use kTimeUse{"an animation's input", "SCALAR", kFloatNumber};
const Use kMorphWeightUse{"an animation's weights", "SCALAR", kAnyNumber, true};

Accessor Accessor::declared(const Document& document, std::uint64_t index, const Use& use) {
  Accessor accessor(index);
  accessor.read_type(document.get(kAccessors, index), use);
  return accessor;
}

bool Accessor::has_view(const Document& document, std::uint64_t index) {
  return document.get(kAccessors, index).has("bufferView");
}

void Accessor::read_type(const Object& accessor, const Use& use) {
  const std::uint64_t component = accessor.number("componentType");
  const std::string type = accessor.text_or("type", "");
  const auto allowed = std::find_if(use.components.begin(), use.components.end(),
                                    [&](Component c) { return static_cast<std::uint64_t>(c) == component; });
  if (type != use.type || allowed == use.components.end()) {
    std::vector<int> legal;
    for (const Component c : use.components) legal.push_back(static_cast<int>(c));
    accessor.fail("as {} it is {} of component type {}; legal: {} of {}", use.name, quote(type), component,
                  use.type, fmt::join(legal, ", "));
  }
  component_ = *allowed;
  normalized_ = accessor.truth_or("normalized", false);
  if (use.must_be_normalized && !normalized_ && !is_real(component_)) {
    accessor.fail("as {} it is of component type {} and not normalized; legal: normalized, or floats",
                  use.name, component);
  }
  width_ = width_of(use.type);
  size_ = width_ * size_of(component_);
  count_ = static_cast<std::size_t>(accessor.number("count"));
}

Accessor::Accessor(const Document& document, Buffers& buffers, std::uint64_t index, const Use& use)
    : index_(index) {
  const Object accessor = document.get(kAccessors, index);
  read_type(accessor, use);
  if (accessor.has("bufferView")) {
    const std::uint64_t slice = accessor.number("bufferView");
    const View view = buffers.view(slice);
    stride_ = view.stride == 0 ? size_ : view.stride;
    if (stride_ < size_ || stride_ > kMaxStride) {
      document.fail("bufferView {} has byteStride {}; legal: {} to {}", slice, stride_, size_, kMaxStride);
    }
    const std::uint64_t offset = accessor.number_or("byteOffset", 0);
    const bool starts_within = offset <= view.bytes.size();
    const std::size_t room = starts_within ? view.bytes.size() - offset : 0;
    const std::size_t most = room < size_ ? 0 : (room - size_) / stride_ + 1;
    if (!starts_within || count_ > most) {
      document.fail("accessor {} has {} elements from byte {}; legal: at most {} in bufferView {}", index,
                    count_, offset, most, slice);
    }
    base_ = view.bytes.subspan(offset);
  }
  if (const auto sparse = accessor.find_object("sparse")) read_sparse(document, buffers, *sparse);
}

Accessor::Accessor(const Document& document, std::uint64_t index, const Use& use,
                   std::span<const std::byte> packed)
    : index_(index) {
  const Object accessor = document.get(kAccessors, index);
  read_type(accessor, use);
  if (count_ != packed.size() / size_) {
    accessor.fail("count is {}; legal: {}, as in the compressed data", count_, packed.size() / size_);
  }
  base_ = packed;
  stride_ = size_;
}

void Accessor::read_sparse(const Document& document, Buffers& buffers, const Object& sparse) {
  const std::uint64_t count = sparse.number("count");
  if (count > count_) sparse.fail("count is {}; legal: at most {}, as the accessor", count, count_);
  const Object indices = sparse.object("indices");
  const std::uint64_t component = indices.number("componentType");
  const auto legal = std::find_if(kIndexNumber.begin(), kIndexNumber.end(),
                                  [&](Component c) { return static_cast<std::uint64_t>(c) == component; });
  if (legal == kIndexNumber.end()) {
    sparse.fail("its indices are of component type {}; legal: 5121, 5123, 5125", component);
  }
  replaced_component_ = *legal;
  replaced_indices_ = find_elements(document, buffers, indices, count, size_of(replaced_component_));
  replaced_values_ = find_elements(document, buffers, sparse.object("values"), count, size_);
  replaced_ = static_cast<std::size_t>(count);
  for (std::size_t i = 0; i < replaced_; ++i) {
    const std::size_t element = replaced_element(i);
    if (element >= count_ || (i > 0 && element <= replaced_element(i - 1))) {
      sparse.fail("its index {} is {}; legal: above the one before, below {}", i, element, count_);
    }
  }
}

std::size_t Accessor::replaced_element(std::size_t at) const {
  return load_whole(replaced_indices_ + at * size_of(replaced_component_), replaced_component_);
}

const std::byte* Accessor::at(std::size_t element) const {
  std::size_t low = 0;  // the first index that is not below `element`
  std::size_t high = replaced_;
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (replaced_element(middle) < element) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  if (low < replaced_ && replaced_element(low) == element) return replaced_values_ + low * size_;
  return base_.data() == nullptr ? nullptr : base_.data() + element * stride_;
}

double Accessor::real(const std::byte* element, unsigned at) const {
  if (element == nullptr) return 0;
  const std::byte* const from = element + at * (size_ / width_);
  switch (component_) {
    case Component::kByte:
      return fraction(load<std::int8_t>(from), normalized_);
    case Component::kUnsignedByte:
      return fraction(load<std::uint8_t>(from), normalized_);
    case Component::kShort:
      return fraction(load<std::int16_t>(from), normalized_);
    case Component::kUnsignedShort:
      return fraction(load<std::uint16_t>(from), normalized_);
    case Component::kUnsignedInt:
      return load<std::uint32_t>(from);
    case Component::kFloat:
      return load<float>(from);
    case Component::kDouble:
      break;
  }
  return load<double>(from);
}

glm::dvec2 Accessor::vec2(std::size_t element) const {
  const std::byte* const from = at(element);
  return {real(from, 0), real(from, 1)};
}

glm::dvec3 Accessor::vec3(std::size_t element) const {
  const std::byte* const from = at(element);
  return {real(from, 0), real(from, 1), real(from, 2)};
}

glm::dvec4 Accessor::vec4(std::size_t element) const {
  const std::byte* const from = at(element);
  return {real(from, 0), real(from, 1), real(from, 2), real(from, 3)};
}

glm::dmat4 Accessor::mat4(std::size_t element) const {
  const std::byte* const from = at(element);
  glm::dmat4 matrix;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row)
      matrix[column][row] = real(from, static_cast<unsigned>(4 * column + row));
  }
  return matrix;
}

std::uint32_t Accessor::whole(std::size_t element, unsigned at_number) const {
  const std::byte* const from = at(element);
  return from == nullptr ? 0 : load_whole(from + at_number * (size_ / width_), component_);
}

}  // namespace halfspace::gltf
