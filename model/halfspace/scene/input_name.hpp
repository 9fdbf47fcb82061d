/// What an input is by its name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace halfspace {

inline constexpr std::string_view kSyntheticPrefix = "synthetic:";

enum class InputKind : std::uint8_t { kFrame, kObj, kPly, kGltf, kSynthetic };

enum class Packing : std::uint8_t { kNone, kGzip, kXz };

/// A name taken apart. Extensions count in capitals too.
struct InputName {
  /// Without folder and extensions that are known; of a synthetic frame what follows the prefix.
  std::string stem;
  std::string extension;          ///< with the one of its packing, as it is written: ".obj.gz"
  std::optional<InputKind> kind;  ///< none: no extension of an input
  Packing packing = Packing::kNone;

  [[nodiscard]] bool is_mesh() const;
};

[[nodiscard]] InputName input_name(const std::filesystem::path& path);

/// Extensions of inputs, for an error message.
inline constexpr std::string_view kFrameExtensions = ".ptf";
inline constexpr std::string_view kMeshExtensions = ".obj, .ply, .gltf, .glb";
inline constexpr std::string_view kPackedExtensions = "each also with .gz or .xz";

}  // namespace halfspace
