#include "halfspace/scene/input_name.hpp"

#include <algorithm>
#include <utility>

namespace halfspace {
namespace {

constexpr std::pair<std::string_view, Packing> kPackings[] = {{".gz", Packing::kGzip}, {".xz", Packing::kXz}};

constexpr std::pair<std::string_view, InputKind> kFormats[] = {{".ptf", InputKind::kFrame},
                                                               {".obj", InputKind::kObj},
                                                               {".ply", InputKind::kPly},
                                                               {".gltf", InputKind::kGltf},
                                                               {".glb", InputKind::kGltf}};

/// From the last dot on; empty where there is none.
std::string_view extension_of(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string_view::npos ? std::string_view{} : name.substr(dot);
}

/// What `table` says of the extension. Its letters are those of ASCII, in any locale.
template <class Meaning, std::size_t kSize>
std::optional<Meaning> meaning_of(const std::pair<std::string_view, Meaning> (&table)[kSize],
                                  std::string_view extension) {
  const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  for (const auto& [known, meaning] : table) {
    if (std::ranges::equal(known, extension, {}, {}, small)) return meaning;
  }
  return std::nullopt;
}

}  // namespace

bool InputName::is_mesh() const {
  return kind == InputKind::kObj || kind == InputKind::kPly || kind == InputKind::kGltf;
}

InputName input_name(const std::filesystem::path& path) {
  if (std::string_view(path.native()).starts_with(kSyntheticPrefix)) {
    return {path.native().substr(kSyntheticPrefix.size()), "", InputKind::kSynthetic};
  }
  const std::string file = path.filename().string();
  std::string_view stem = file;
  const std::optional<Packing> packing = meaning_of(kPackings, extension_of(stem));
  if (packing) stem.remove_suffix(extension_of(stem).size());
  const std::string_view extension = extension_of(stem);
  const std::optional<InputKind> kind = meaning_of(kFormats, extension);
  const std::string whole_extension = file.substr(stem.size() - extension.size());
  if (kind) stem.remove_suffix(extension.size());
  return {std::string(stem), whole_extension, kind, packing.value_or(Packing::kNone)};
}

}  // namespace halfspace
