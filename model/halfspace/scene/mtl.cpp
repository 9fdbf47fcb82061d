#include "halfspace/scene/mtl.hpp"

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

#include "halfspace/scene/text.hpp"

namespace halfspace {
namespace {

/// The words of one line.
class MtlLine {
 public:
  explicit MtlLine(std::string_view line) : rest_(line.substr(0, line.find('#'))) { trim(); }

  [[nodiscard]] bool empty() const { return rest_.empty(); }
  /// All that is left, without blanks around it.
  [[nodiscard]] std::string_view rest() const { return rest_; }

  std::string_view word() {
    const char* const end = rest_.data() + rest_.size();
    const auto size = static_cast<std::size_t>(find_any(rest_.data(), end, kBlank) - rest_.data());
    const std::string_view word = rest_.substr(0, size);
    rest_.remove_prefix(size);
    trim();
    return word;
  }

  /// Moves behind the number that is next, if a number is.
  std::optional<double> number() {
    double value = 0;
    const std::size_t size = read_number(rest_, value);
    if (size == 0 || (size < rest_.size() && !is(rest_[size], kBlank))) return std::nullopt;
    word();
    return value;
  }

 private:
  void trim() {
    while (!rest_.empty() && is(rest_.front(), kBlank)) rest_.remove_prefix(1);
    while (!rest_.empty() && is(rest_.back(), kBlank)) rest_.remove_suffix(1);
  }

  std::string_view rest_;
};

bool is_same_word(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char l, char r) {
    const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return small(l) == small(r);
  });
}

/// Kd r [g b]; g and b are r where they are not there.
void read_diffuse(MtlLine line, MtlMaterial& material) {
  const auto r = line.number();
  if (!r) return;  // spectral or xyz
  const auto g = line.number();
  const auto b = line.number();
  material.diffuse = {*r, g.value_or(*r), b.value_or(*r)};
}

/// map_Kd [-option words]... name; the name may have blanks.
void read_image_name(MtlLine line, MtlMaterial& material) {
  constexpr std::array<std::string_view, 3> kVectors{"-o", "-s", "-t"};
  material.clamp = false;
  while (line.rest().starts_with('-')) {
    const std::string_view option = line.word();
    if (is_same_word(option, "-clamp")) {
      material.clamp = is_same_word(line.word(), "on");
      continue;
    }
    material.has_options = true;
    if (std::ranges::find(kVectors, option) != kVectors.end()) {
      for (int i = 0; i < 3 && line.number(); ++i) {
      }
    } else {
      line.word();
      if (is_same_word(option, "-mm")) line.word();
    }
  }
  material.image = line.rest();
}

}  // namespace

void parse_mtl(std::string_view text, MtlLibrary& library) {
  MtlMaterial* material = nullptr;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    MtlLine line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string_view statement = line.word();
    if (is_same_word(statement, "newmtl")) {
      material = &(library[std::string(line.rest())] = {});
    } else if (material != nullptr && is_same_word(statement, "kd")) {
      read_diffuse(line, *material);
    } else if (material != nullptr && is_same_word(statement, "map_kd")) {
      read_image_name(line, *material);
    }
  }
}

std::optional<std::filesystem::path> file_below(const std::filesystem::path& folder, std::string name) {
  if (name.empty() || name.find('\0') != std::string::npos) return std::nullopt;
  std::ranges::replace(name, '\\', '/');
  const std::filesystem::path base = folder.empty() ? "." : folder;
  const std::filesystem::path path = base / name;
  const std::filesystem::path below = path.lexically_normal().lexically_relative(base.lexically_normal());
  std::error_code error;
  if (below.empty() || *below.begin() == ".." || !std::filesystem::is_regular_file(path, error)) {
    return std::nullopt;
  }
  return path;
}

}  // namespace halfspace
