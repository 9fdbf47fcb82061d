/// Attributes and materials of an OBJ file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/scene/mesh_attributes.hpp"
#include "halfspace/scene/mesh_builder.hpp"
#include "halfspace/scene/mtl.hpp"

namespace halfspace {

class ObjAttributes {
 public:
  /// Material libraries and images are files in the folder or below.
  ObjAttributes(std::filesystem::path folder, MeshBuilder& mesh) : folder_(std::move(folder)), mesh_(mesh) {}

  /// The numbers behind v's x, y and z: r, g, b, or a weight and r, g, b.
  void add_color(std::uint32_t vertex, const std::vector<double>& numbers);
  void add_uv(const std::vector<double>& numbers);
  void add_normal(const std::vector<double>& numbers);

  /// A corner of the face that is being read, as it stands there: v, v/t, v//n or v/t/n.
  void add_corner(std::string_view corner);
  /// The face has become triangles: three corners each, as places among those that were added.
  void end_face(const std::vector<std::uint32_t>& order);

  /// mtllib: one name with blanks, or several.
  void add_libraries(const std::string& names);
  /// All parts that the mesh has so far and that have no material have this one.
  void end_part(const std::string& material);

  void finish(Mesh& mesh) &&;

 private:
  struct Corner {
    std::uint32_t uv;
    std::uint32_t normal;
  };

  bool add_library(const std::string& name);
  [[nodiscard]] std::uint32_t number_of(const std::string& material);
  [[nodiscard]] std::optional<std::uint32_t> image(const std::string& name);

  std::filesystem::path folder_;
  MeshBuilder& mesh_;
  AttributeBuilder builder_;
  std::vector<Corner> corners_;
  MtlLibrary library_;
  std::map<std::string, std::uint32_t, std::less<>> materials_;  ///< their numbers
  std::map<std::string, std::optional<std::uint32_t>, std::less<>> images_;
};

}  // namespace halfspace
