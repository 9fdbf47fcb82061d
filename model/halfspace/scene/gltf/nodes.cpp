#include "halfspace/scene/gltf/nodes.hpp"

#include <algorithm>
#include <glm/ext/quaternion_double.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace halfspace::gltf {

namespace {

[[noreturn]] void fail_twice(const Document& document, std::size_t node) {
  document.fail("node {} is reached twice; legal: each node has one parent and is in no cycle", node);
}

}  // namespace

glm::dmat4 compose(glm::dvec3 translation, glm::dvec4 rotation, glm::dvec3 scale) {
  // Of unit length by glTF 2.0, 3.5.3, but files round it.
  const glm::dquat unit = glm::normalize(glm::dquat(rotation.w, rotation.x, rotation.y, rotation.z));
  glm::dmat4 transform = glm::mat4_cast(unit);
  for (int axis = 0; axis < 3; ++axis) transform[axis] *= scale[axis];
  transform[3] = glm::dvec4(translation, 1);
  return transform;
}

Nodes::Nodes(const Document& document, const Poses& poses) : document_(document) {
  std::vector<bool> is_unreached = find_roots();
  const std::vector<bool> is_placed = placed_nodes();
  struct Visit {
    std::size_t node;
    std::size_t depth;
  };
  std::vector<glm::dmat4> path;  // worlds of the ancestors
  std::vector<Visit> open;
  for (const std::size_t root : roots_) {
    open.push_back({root, 0});
    while (!open.empty()) {
      const auto [node, depth] = open.back();
      open.pop_back();
      is_unreached[node] = false;
      path.resize(depth);
      const glm::dmat4 world = (depth == 0 ? glm::dmat4(1) : path.back()) * local(node, poses);
      path.push_back(world);
      if (is_placed[node]) world_.emplace(node, world);
      for (const std::size_t child : document.indices(kNodes, document.get(kNodes, node), "children")) {
        open.push_back({child, depth + 1});
      }
    }
  }
  const auto unreached = std::find(is_unreached.begin(), is_unreached.end(), true);
  if (unreached != is_unreached.end()) {
    fail_twice(document, static_cast<std::size_t>(unreached - is_unreached.begin()));
  }
}

/// Finds the nodes that are no node's child; the others are marked.
std::vector<bool> Nodes::find_roots() {
  std::vector<bool> is_child(document_.size(kNodes));
  for (std::size_t i = 0; i < is_child.size(); ++i) {
    for (const std::size_t child : document_.indices(kNodes, document_.get(kNodes, i), "children")) {
      if (is_child[child]) fail_twice(document_, child);
      is_child[child] = true;
    }
  }
  for (std::size_t i = 0; i < is_child.size(); ++i) {
    if (!is_child[i]) roots_.push_back(i);
  }
  return is_child;
}

/// The nodes whose place in the world counts.
std::vector<bool> Nodes::placed_nodes() const {
  std::vector<bool> is_placed(document_.size(kNodes));
  for (std::size_t i = 0; i < is_placed.size(); ++i) {
    const Object node = document_.get(kNodes, i);
    is_placed[i] = node.has("mesh") || node.has("camera");
  }
  for (std::size_t i = 0; i < document_.size(kSkins); ++i) {
    for (const std::size_t joint : document_.indices(kNodes, document_.get(kSkins, i), "joints")) {
      is_placed[joint] = true;
    }
  }
  return is_placed;
}

glm::dmat4 Nodes::local(std::size_t node, const Poses& poses) const {
  const Object object = document_.get(kNodes, node);
  const auto posed = poses.find(node);
  const Pose pose = posed == poses.end() ? Pose{} : posed->second;
  if (object.has("matrix")) {
    if (pose.moves()) {
      object.fail(
          "it has a matrix and is animated; legal: translation, rotation and scale where it is animated");
    }
    return glm::make_mat4(object.reals("matrix", 16).data());
  }
  const auto three = [&](const char* key, double fallback) {
    const std::vector<double> v = object.reals(key, 3);
    return v.empty() ? glm::dvec3(fallback) : glm::dvec3(v[0], v[1], v[2]);
  };
  const std::vector<double> r = object.reals("rotation", 4);
  const glm::dvec4 rotation = r.empty() ? glm::dvec4(0, 0, 0, 1) : glm::dvec4(r[0], r[1], r[2], r[3]);
  return compose(pose.translation.value_or(three("translation", 0)), pose.rotation.value_or(rotation),
                 pose.scale.value_or(three("scale", 1)));
}

std::vector<std::size_t> Nodes::scene_roots() const {
  const auto scene = document_.find_index(kScenes, document_.root(), "scene");
  if (document_.size(kScenes) == 0) return roots_;
  return document_.indices(kNodes, document_.get(kScenes, scene.value_or(0)), "nodes");
}

std::vector<std::size_t> Nodes::shown(MeshBuilder& mesh) const {
  std::vector<std::size_t> open = scene_roots();
  std::reverse(open.begin(), open.end());
  std::vector<std::size_t> shown;
  std::vector<bool> seen(document_.size(kNodes));
  while (!open.empty()) {
    const std::size_t node = open.back();
    open.pop_back();
    if (seen[node]) fail_twice(document_, node);
    seen[node] = true;
    const Object object = document_.get(kNodes, node);
    const auto visibility = object.extension("KHR_node_visibility");
    if (visibility && !visibility->truth_or("visible", true)) {
      mesh.leave_out("hidden nodes");
      continue;
    }
    shown.push_back(node);
    const std::vector<std::size_t> children = document_.indices(kNodes, object, "children");
    open.insert(open.end(), children.rbegin(), children.rend());
  }
  return shown;
}

}  // namespace halfspace::gltf
