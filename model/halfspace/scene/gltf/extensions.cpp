#include "halfspace/scene/gltf/extensions.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "halfspace/scene/quote.hpp"

namespace halfspace::gltf {
namespace {

constexpr std::array<std::string_view, 6> kRead{"EXT_mesh_gpu_instancing", "EXT_meshopt_compression",
                                                "KHR_accessor_float64",    "KHR_draco_mesh_compression",
                                                "KHR_mesh_quantization",   "KHR_node_visibility"};

/// Names are PREFIX_scope_feature by the registry's rules (github.com/KhronosGroup/glTF,
/// extensions/README.md): these scopes are not geometry.
constexpr std::array<std::string_view, 5> kHarmlessScopes{"audio", "lights", "materials", "packing",
                                                          "texture"};

/// Of the registry's ratified, multi-vendor, vendor, archived and draft extensions, and Cesium's, those that
/// neither move nor add a triangle. MSFT_lod adds coarser meshes to the one that is drawn; EXT_mesh_manifold
/// orders triangles anew; splats are points. Not here: AGI_articulations, KHR_techniques_webgl,
/// MPEG_accessor_timed, MPEG_animation_timing, MPEG_buffer_circular, MPEG_mesh_linking, MPEG_scene_dynamic.
constexpr std::array<std::string_view, 21> kHarmless{"AGI_stk_metadata",
                                                     "CESIUM_primitive_outline",
                                                     "EXT_instance_features",
                                                     "EXT_mesh_features",
                                                     "EXT_mesh_manifold",
                                                     "EXT_structural_metadata",
                                                     "FB_geometry_metadata",
                                                     "GODOT_single_root",
                                                     "GRIFFEL_bim_data",
                                                     "KHR_collision_shapes",
                                                     "KHR_gaussian_splatting",
                                                     "KHR_implicit_shapes",
                                                     "KHR_interactivity",
                                                     "KHR_node_hoverability",
                                                     "KHR_node_selectability",
                                                     "KHR_physics_rigid_bodies",
                                                     "KHR_xmp",
                                                     "KHR_xmp_json_ld",
                                                     "MPEG_media",
                                                     "MPEG_viewport_recommended",
                                                     "MSFT_lod"};

template <std::size_t kCount>
bool is_among(const std::array<std::string_view, kCount>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_harmless(std::string_view name) {
  if (is_among(kHarmless, name)) return true;
  const std::size_t prefix = std::min(name.find('_'), name.size());
  const std::string_view rest = name.substr(std::min(prefix + 1, name.size()));
  return is_among(kHarmlessScopes, rest.substr(0, rest.find('_')));
}

/// Its channels are left out one by one, and said.
bool is_said_elsewhere(std::string_view name) { return name == "KHR_animation_pointer"; }

}  // namespace

void check_extensions(const Document& document, MeshBuilder& mesh) {
  const auto is_known = [](std::string_view name) {
    return is_among(kRead, name) || is_harmless(name) || is_said_elsewhere(name);
  };
  for (const std::string& name : document.root().texts("extensionsRequired")) {
    if (!is_known(name)) {
      document.fail("extension {} is required; legal: {}, and those that cannot touch geometry", quote(name),
                    fmt::join(kRead, ", "));
    }
  }
  for (const std::string& name : document.root().texts("extensionsUsed")) {
    if (!is_known(name)) mesh.leave_out(fmt::format("extensions {} that may touch geometry", quote(name)));
  }
}

}  // namespace halfspace::gltf
