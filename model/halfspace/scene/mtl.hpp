/// Material libraries of OBJ files (.mtl).
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace halfspace {

/// What a picture shows of one: the diffuse colour and its image.
struct MtlMaterial {
  glm::vec3 diffuse{1};      ///< Kd, as it stands there
  std::string image;         ///< map_Kd; empty: none
  bool clamp = false;        ///< the image's option -clamp on
  bool has_options = false;  ///< it has options that are not followed: -o, -s, -t and others
};

using MtlLibrary = std::map<std::string, MtlMaterial, std::less<>>;

/// Reads Kd and map_Kd of all materials in the text; what is not understood is passed over. Statements are
/// those of "MTL material format" (Alias/Wavefront, 1995). The last of several materials of a name counts.
void parse_mtl(std::string_view text, MtlLibrary& library);

/// The file of this name in the folder or below; \ separates folders, too. None where there is no such file.
[[nodiscard]] std::optional<std::filesystem::path> file_below(const std::filesystem::path& folder,
                                                              std::string name);

}  // namespace halfspace
