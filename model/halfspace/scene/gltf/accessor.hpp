/// Typed elements in the buffers of a glTF file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string_view>

#include "halfspace/scene/gltf/buffers.hpp"
#include "halfspace/scene/gltf/document.hpp"

namespace halfspace::gltf {

enum class Component : std::uint16_t {
  kByte = 5120,
  kUnsignedByte = 5121,
  kShort = 5122,
  kUnsignedShort = 5123,
  kUnsignedInt = 5125,
  kFloat = 5126,
  kDouble = 5130,  ///< KHR_accessor_float64
};

/// What the elements of an accessor are for, and so of which types they may be.
struct Use {
  std::string_view name;
  std::string_view type;
  std::span<const Component> components;
  bool must_be_normalized = false;  ///< where they are whole numbers
};
extern const Use kPositionUse;  ///< also of morph targets; the widest of KHR_mesh_quantization
extern const Use kIndexUse;
extern const Use kJointUse;
extern const Use kWeightUse;
extern const Use kInverseBindUse;
extern const Use kNormalUse;
extern const Use kTextureUse;
extern const Use kColor3Use;
extern const Use kColor4Use;
extern const Use kTranslationUse;
extern const Use kRotationUse;
extern const Use kScaleUse;
extern const Use kTimeUse;
extern const Use kMorphWeightUse;

/// An accessor's elements, read one by one where they lie, with those that `sparse` replaces.
class Accessor {
 public:
  /// Throws InputError when the accessor is not of a type that the use allows, or is not within its buffer
  /// views. The bytes stay the buffers'.
  Accessor(const Document& document, Buffers& buffers, std::uint64_t index, const Use& use);

  /// The same accessor, but for its bytes: elements without gaps that an extension provides.
  Accessor(const Document& document, std::uint64_t index, const Use& use, std::span<const std::byte> packed);

  /// Its type alone, without elements to read.
  [[nodiscard]] static Accessor declared(const Document& document, std::uint64_t index, const Use& use);

  /// Whether elements lie in a buffer view, be it all but those that are replaced.
  [[nodiscard]] static bool has_view(const Document& document, std::uint64_t index);

  [[nodiscard]] std::uint64_t index() const { return index_; }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] Component component() const { return component_; }
  [[nodiscard]] unsigned width() const { return width_; }
  /// How many elements no byte of the file stands for.
  [[nodiscard]] std::size_t bare() const { return base_.data() == nullptr ? count_ - replaced_ : 0; }

  /// Elements below count(); normalized whole numbers as fractions.
  [[nodiscard]] double scalar(std::size_t element) const { return real(at(element), 0); }
  [[nodiscard]] glm::dvec2 vec2(std::size_t element) const;
  [[nodiscard]] glm::dvec3 vec3(std::size_t element) const;
  [[nodiscard]] glm::dvec4 vec4(std::size_t element) const;
  [[nodiscard]] glm::dmat4 mat4(std::size_t element) const;
  /// One number of an element, as it is stored.
  [[nodiscard]] std::uint32_t whole(std::size_t element, unsigned at = 0) const;

 private:
  explicit Accessor(std::uint64_t index) : index_(index) {}
  void read_type(const Object& accessor, const Use& use);
  void read_sparse(const Document& document, Buffers& buffers, const Object& sparse);
  [[nodiscard]] std::size_t replaced_element(std::size_t at) const;
  /// Where the element lies; null where it is all zeros.
  [[nodiscard]] const std::byte* at(std::size_t element) const;
  [[nodiscard]] double real(const std::byte* element, unsigned at) const;

  std::uint64_t index_;
  Component component_ = Component::kFloat;
  unsigned width_ = 1;  // numbers of an element
  bool normalized_ = false;
  std::size_t size_ = 0;  // bytes of an element
  std::size_t count_ = 0;
  std::span<const std::byte> base_;  // none: zeros
  std::size_t stride_ = 0;

  std::size_t replaced_ = 0;
  Component replaced_component_ = Component::kUnsignedByte;
  const std::byte* replaced_indices_ = nullptr;
  const std::byte* replaced_values_ = nullptr;
};

}  // namespace halfspace::gltf
