#include "halfspace/scene/gltf/instancing.hpp"

#include <algorithm>

#include "halfspace/scene/gltf/nodes.hpp"
#include "halfspace/scene/quote.hpp"

namespace halfspace::gltf {

Instances::Instances(const Document& document, Buffers& buffers, const Object& instancing) {
  std::optional<std::size_t> count;
  for (const auto& [name, index] : instancing.object("attributes").numbers_by_name()) {
    std::optional<Accessor>* const slot = name == "TRANSLATION" ? &translation_
                                          : name == "ROTATION"  ? &rotation_
                                          : name == "SCALE"     ? &scale_
                                                                : nullptr;
    std::size_t elements = 0;
    std::size_t bare = 0;
    if (slot != nullptr) {
      slot->emplace(document, buffers, index,
                    name == "TRANSLATION" ? kTranslationUse
                    : name == "ROTATION"  ? kRotationUse
                                          : kScaleUse);
      elements = (*slot)->count();
      bare = (*slot)->bare();
    } else {  // the application's, and not read; but it says how many there are
      elements = static_cast<std::size_t>(document.get(kAccessors, index).number("count"));
      bare = elements;
    }
    bare_ = count ? std::min(bare_, bare) : bare;
    if (count && *count != elements) {
      instancing.fail("{} has {} elements; legal: {}, as the other attributes", quote(name), elements,
                      *count);
    }
    count = elements;
  }
  count_ = count.value_or(0);
}

glm::dmat4 Instances::transform(std::size_t instance) const {
  return compose(translation_ ? translation_->vec3(instance) : glm::dvec3(0),
                 rotation_ ? rotation_->vec4(instance) : glm::dvec4(0, 0, 0, 1),
                 scale_ ? scale_->vec3(instance) : glm::dvec3(1));
}

}  // namespace halfspace::gltf
