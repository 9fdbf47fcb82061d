#include "halfspace/scene/gltf/animation.hpp"

#include <set>
#include <string>
#include <utility>

#include "halfspace/scene/gltf/accessor.hpp"
#include "halfspace/scene/gltf/morph.hpp"
#include "halfspace/scene/quote.hpp"

namespace halfspace::gltf {
namespace {

/// A channel that moves a node or its mesh.
struct Channel {
  std::size_t node;
  std::string path;
  Object sampler;

  [[nodiscard]] std::pair<std::size_t, std::string> target() const { return {node, path}; }
};

class AnimationReader {
 public:
  AnimationReader(const Document& document, Buffers& buffers, MeshBuilder& mesh)
      : document_(document), buffers_(buffers), mesh_(mesh) {}

  Poses run() {
    for (std::size_t i = 0; i < document_.size(kAnimations); ++i) {
      const std::vector<Channel> channels = read_channels(document_.get(kAnimations, i));
      bool is_free = true;
      for (const Channel& channel : channels) is_free = is_free && !taken_.contains(channel.target());
      if (!is_free) {
        mesh_.leave_out("animations that move what an earlier one moves");
        continue;
      }
      for (const Channel& channel : channels) {
        taken_.insert(channel.target());
        apply(channel);
      }
    }
    return std::move(poses_);
  }

 private:
  std::vector<Channel> read_channels(const Object& animation) {
    std::vector<Channel> channels;
    const std::size_t samplers = animation.count("samplers");
    for (std::size_t i = 0; i < animation.count("channels"); ++i) {
      const Object channel = animation.item("channels", i);
      const Object target = channel.object("target");
      const std::string path = target.text_or("path", "");
      if (path == "pointer") {
        mesh_.leave_out("animation channels that name their target by a pointer");
        continue;
      }
      const auto node = document_.find_index(kNodes, target, "node");
      if (!node) continue;  // an extension's, and to be ignored by glTF 2.0, 3.11
      if (path != "translation" && path != "rotation" && path != "scale" && path != "weights") {
        target.fail("path is {}; legal: \"translation\", \"rotation\", \"scale\", \"weights\"", quote(path));
      }
      const std::uint64_t sampler = channel.number("sampler");
      if (sampler >= samplers) {
        channel.fail("sampler is {}; legal: 0 or more and below {}", sampler, samplers);
      }
      channels.push_back({*node, path, animation.item("samplers", static_cast<std::size_t>(sampler))});
    }
    return channels;
  }

  /// The first value of the sampler's output: the one at t = 0, whether the first key is there or later, and
  /// whatever the interpolation. `width`: elements of a value.
  Accessor output_at_start(const Channel& channel, const Use& use, std::size_t width, std::size_t& first) {
    const Object& sampler = channel.sampler;
    const Accessor times(document_, buffers_, sampler.number("input"), kTimeUse);
    if (times.count() == 0) sampler.fail("input has 0 elements; legal: 1 or more");
    if (!(times.scalar(0) >= 0)) sampler.fail("input begins with {}; legal: 0 or more", times.scalar(0));
    Accessor output(document_, buffers_, sampler.number("output"), use);
    // A key of a cubic spline is a tangent, the value and a tangent.
    first = sampler.text_or("interpolation", "LINEAR") == "CUBICSPLINE" ? width : 0;
    if (output.count() < first + width) {
      sampler.fail("output has {} elements; legal: {} or more", output.count(), first + width);
    }
    return output;
  }

  void apply(const Channel& channel) {
    Pose& pose = poses_[channel.node];
    std::size_t first = 0;
    if (channel.path == "translation") {
      pose.translation = output_at_start(channel, kTranslationUse, 1, first).vec3(first);
    } else if (channel.path == "rotation") {
      pose.rotation = output_at_start(channel, kRotationUse, 1, first).vec4(first);
    } else if (channel.path == "scale") {
      pose.scale = output_at_start(channel, kScaleUse, 1, first).vec3(first);
    } else if (const auto mesh = document_.find(kMeshes, document_.get(kNodes, channel.node), "mesh")) {
      const std::size_t targets = count_targets(*mesh);
      const Accessor output = output_at_start(channel, kMorphWeightUse, targets, first);
      pose.weights.emplace();
      for (std::size_t i = 0; i < targets; ++i) pose.weights->push_back(output.scalar(first + i));
    }
  }

  const Document& document_;
  Buffers& buffers_;
  MeshBuilder& mesh_;
  Poses poses_;
  std::set<std::pair<std::size_t, std::string>> taken_;
};

}  // namespace

Poses poses_at_start(const Document& document, Buffers& buffers, MeshBuilder& mesh) {
  return AnimationReader(document, buffers, mesh).run();
}

}  // namespace halfspace::gltf
