#include "halfspace/scene/gltf/cameras.hpp"

#include <string>

#include "halfspace/scene/quote.hpp"

namespace halfspace::gltf {

MeshCamera read_camera(const Document& document, std::size_t number, const Object& node,
                       const glm::dmat4& world) {
  const Object from = document.get(kCameras, number);
  MeshCamera camera;
  camera.name = node.text_or("name", "");
  if (camera.name.empty()) camera.name = from.text_or("name", "");
  if (camera.name.empty()) camera.name = fmt::format("camera {}", number);
  camera.world = world;
  const std::string type = from.text_or("type", "");
  if (type == "perspective") {
    const Object perspective = from.object("perspective");
    camera.fov_y = perspective.real("yfov");
    camera.aspect = perspective.find_real("aspectRatio");
    camera.near = perspective.real("znear");
    camera.far = perspective.find_real("zfar");
  } else if (type == "orthographic") {
    const Object orthographic = from.object("orthographic");
    camera.half_size = {orthographic.real("xmag"), orthographic.real("ymag")};
    camera.near = orthographic.real("znear");
    camera.far = orthographic.real("zfar");
  } else {
    from.fail("type is {}; legal: \"perspective\", \"orthographic\"", quote(type));
  }
  return camera;
}

}  // namespace halfspace::gltf
