// Wavefront OBJ, read here (docs/adr/0003-mesh-readers.md says why), after Appendix B1 of the Advanced
// Visualizer manual: "Object Files (.obj)".
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/mesh_builder.hpp"
#include "halfspace/scene/mesh_formats.hpp"
#include "halfspace/scene/obj_attributes.hpp"
#include "halfspace/scene/quote.hpp"
#include "halfspace/scene/text.hpp"

namespace halfspace {
namespace {

enum class Statement {
  kVertex,
  kFace,
  kMaterial,
  kTextureCoordinate,  // passed over, as the next two are, where no attributes are wanted
  kNormal,
  kLibrary,
  kPassedOver,  // says nothing about where triangles are
  kPoint,
  kLine,
  kCurve,
  kSurface,
  kOtherFile,  // could add vertices, which later faces would count from
  kUnknown
};

struct Keyword {
  std::string_view word;
  Statement statement;
};
// The most frequent ones first. Behind "call": what older versions of the format had.
constexpr std::array<Keyword, 45> kKeywords{{{"v", Statement::kVertex},
                                             {"f", Statement::kFace},
                                             {"vt", Statement::kTextureCoordinate},
                                             {"vn", Statement::kNormal},
                                             {"usemtl", Statement::kMaterial},
                                             {"g", Statement::kPassedOver},
                                             {"s", Statement::kPassedOver},
                                             {"o", Statement::kPassedOver},
                                             {"mtllib", Statement::kLibrary},
                                             {"p", Statement::kPoint},
                                             {"l", Statement::kLine},
                                             {"curv", Statement::kCurve},
                                             {"curv2", Statement::kCurve},
                                             {"surf", Statement::kSurface},
                                             {"vp", Statement::kPassedOver},
                                             {"cstype", Statement::kPassedOver},
                                             {"deg", Statement::kPassedOver},
                                             {"bmat", Statement::kPassedOver},
                                             {"step", Statement::kPassedOver},
                                             {"parm", Statement::kPassedOver},
                                             {"trim", Statement::kPassedOver},
                                             {"hole", Statement::kPassedOver},
                                             {"scrv", Statement::kPassedOver},
                                             {"sp", Statement::kPassedOver},
                                             {"end", Statement::kPassedOver},
                                             {"con", Statement::kPassedOver},
                                             {"mg", Statement::kPassedOver},
                                             {"bevel", Statement::kPassedOver},
                                             {"c_interp", Statement::kPassedOver},
                                             {"d_interp", Statement::kPassedOver},
                                             {"lod", Statement::kPassedOver},
                                             {"maplib", Statement::kPassedOver},
                                             {"usemap", Statement::kPassedOver},
                                             {"shadow_obj", Statement::kPassedOver},
                                             {"trace_obj", Statement::kPassedOver},
                                             {"ctech", Statement::kPassedOver},
                                             {"stech", Statement::kPassedOver},
                                             {"csh", Statement::kOtherFile},
                                             {"call", Statement::kOtherFile},
                                             {"fo", Statement::kFace},
                                             {"cdc", Statement::kCurve},
                                             {"bsp", Statement::kSurface},
                                             {"bzp", Statement::kSurface},
                                             {"cdp", Statement::kSurface},
                                             {"res", Statement::kPassedOver}}};

Statement statement_of(std::string_view word) {
  const auto* const found = std::find_if(kKeywords.begin(), kKeywords.end(),
                                         [&](const Keyword& keyword) { return keyword.word == word; });
  return found == kKeywords.end() ? Statement::kUnknown : found->statement;
}

class ObjParser {
 public:
  ObjParser(std::string_view text, std::string_view name)
      : name_(name), begin_(text.data()), at_(begin_), end_(begin_ + text.size()), builder_(name) {}

  /// Material libraries and images are in the folder or below.
  void want_attributes(const std::filesystem::path& folder) { attributes_.emplace(folder, builder_); }

  Mesh run() {
    if (const std::size_t zero = rest(begin_).find('\0'); zero != std::string_view::npos) {
      const std::size_t before = rest(begin_).substr(0, zero).find_last_of("\r\n");
      fail(begin_ + zero, "character {} is a zero byte; legal: text",
           before == std::string_view::npos ? zero : zero - before - 1);
    }
    while (at_ != end_) {
      if (to_word()) parse_statement();
      to_next_line();
    }
    end_part();
    leave_out("free-form curves", Statement::kCurve);
    leave_out("free-form surfaces", Statement::kSurface);
    leave_out("unknown statements", Statement::kUnknown);
    Mesh mesh = std::move(builder_).finish();
    if (attributes_) std::move(*attributes_).finish(mesh);
    return mesh;
  }

 private:
  template <typename... Args>
  [[noreturn]] void fail(const char* place, fmt::format_string<Args...> text, Args&&... args) const {
    std::uint64_t line = 1;
    for (const char* c = begin_; c != place; ++c) {
      line += static_cast<std::uint64_t>(*c == '\n' || (*c == '\r' && (c + 1 == end_ || c[1] != '\n')));
    }
    throw InputError(
        fmt::format("{}: line {}: {}", name_, line, fmt::format(text, std::forward<Args>(args)...)));
  }

  [[nodiscard]] std::string_view rest(const char* from) const {
    return {from, static_cast<std::size_t>(end_ - from)};
  }

  /// Behind the line end at `place`.
  [[nodiscard]] const char* next_line(const char* place) const {
    return place + (rest(place).starts_with("\r\n") ? 2 : 1);
  }

  /// The start of the next line if the \ at `place` is the last of its line but for blanks; nullptr
  /// otherwise.
  [[nodiscard]] const char* continued(const char* place) const {
    const char* const after = skip_all(place + 1, end_, kBlank);
    if (after == end_) return end_;
    return is(*after, kLineEnd) ? next_line(after) : nullptr;
  }

  [[nodiscard]] bool is_word_end(const char* place) const {
    return place == end_ || is(*place, kBlank | kLineEnd) || (*place == '\\' && continued(place) != nullptr);
  }

  /// As is_word_end(), where a comment may follow without a blank.
  [[nodiscard]] bool is_number_end(const char* place) const { return is_word_end(place) || *place == '#'; }

  /// Moves to the next word of the statement; false when there is none.
  bool to_word() {
    for (;;) {
      at_ = skip_all(at_, end_, kBlank);
      if (at_ == end_ || is(*at_, kLineEnd | kHash)) return false;
      if (*at_ != '\\') return true;
      const char* const next = continued(at_);
      if (next == nullptr) return true;
      at_ = next;
    }
  }

  std::string_view take_word() {
    const char* const first = at_;
    while (!is_word_end(at_)) at_ = find_any(at_ + 1, end_, kBlank | kLineEnd | kBackslash);
    return {first, static_cast<std::size_t>(at_ - first)};
  }

  /// Moves behind the statement's last line. Comments are not continued: they may end in the path of a
  /// folder.
  void to_next_line() {
    if (skip_plain_line()) return;
    while (to_word()) take_word();
    at_ = find_any(at_, end_, kLineEnd);
    if (at_ != end_) at_ = next_line(at_);
  }

  /// As to_next_line(), where the line ends in LF, or CR LF, not far from here, and in no \. Most lines do,
  /// and the C library finds characters many at a time.
  bool skip_plain_line() {
    const std::size_t size = plain_size();
    if (size == std::string_view::npos) return false;
    at_ += size + 1;
    return true;
  }

  /// Up to the LF of such a line; npos where the rest is none.
  [[nodiscard]] std::size_t plain_size() const {
    constexpr std::size_t kFar = 256;  // else lines that end in CR would be searched to the end of the file
    const std::string_view near = rest(at_).substr(0, kFar);
    const std::size_t size = near.find('\n');
    if (size == std::string_view::npos) return size;
    std::string_view line = near.substr(0, size);
    if (line.ends_with('\r')) line.remove_suffix(1);
    const bool plain = line.find('\r') == std::string_view::npos && line.find('\\') == std::string_view::npos;
    return plain ? size : std::string_view::npos;
  }

  void parse_statement() {
    const char* const first = at_;
    const std::string_view word = take_word();
    const Statement statement = statement_of(word);
    switch (statement) {
      case Statement::kVertex:
        return parse_vertex();
      case Statement::kFace:
        return parse_face();
      case Statement::kMaterial:
        return parse_material();
      case Statement::kTextureCoordinate:
        if (attributes_) return attributes_->add_uv(rest_of_numbers());
        return pass_numbers();
      case Statement::kNormal:
        if (attributes_) return attributes_->add_normal(rest_of_numbers());
        return pass_numbers();
      case Statement::kLibrary:
        if (attributes_) attributes_->add_libraries(rest_of_words());
        return;
      case Statement::kPassedOver:
        return;
      case Statement::kPoint:
        return parse_points();
      case Statement::kLine:
        return parse_line();
      case Statement::kCurve:
      case Statement::kSurface:
      case Statement::kUnknown:
        ++left_out_[static_cast<std::size_t>(statement)];
        return;
      case Statement::kOtherFile:
        fail(first, "statement is {}; legal: a file that is whole without others", quote(word));
    }
  }

  /// What follows the third number is a weight, a colour, or both.
  void parse_vertex() {
    glm::dvec3 position{0};
    for (int i = 0; i < 3; ++i) {
      const std::size_t size = to_word() ? read_number(rest(at_), position[i]) : 0;
      if (size == 0 || !is_number_end(at_ + size)) {
        fail(at_, "coordinate {} is {}; legal: three numbers", i, quote(to_word() ? take_word() : ""));
      }
      at_ += size;
    }
    if (attributes_) {
      attributes_->add_color(builder_.vertex_count(), rest_of_numbers());
    } else {
      pass_numbers();
    }
    builder_.add_vertex(position);
  }

  /// The numbers up to the end of the statement or the first word that is none.
  std::vector<double> rest_of_numbers() {
    std::vector<double> numbers;
    double number = 0;
    while (numbers.size() < 4 && to_word()) {
      const std::size_t size = read_number(rest(at_), number);
      if (size == 0 || !is_number_end(at_ + size)) break;
      at_ += size;
      numbers.push_back(number);
    }
    return numbers;
  }

  /// Moves as rest_of_numbers() does where that counts: behind a number a comment may begin, and no
  /// \ continues it.
  void pass_numbers() {
    if (at_ != end_ && *at_ != '\n' && plain_size() == std::string_view::npos) rest_of_numbers();
  }

  /// The words up to the end of the statement, with one blank between them.
  std::string rest_of_words() {
    std::string words;
    while (to_word()) {
      if (!words.empty()) words += ' ';
      words += take_word();
    }
    return words;
  }

  void parse_face() {
    corners_.clear();
    const std::int64_t vertices = builder_.vertex_count();
    while (to_word()) {
      const char* const first = at_;
      corners_.push_back(parse_corner(vertices));
      if (attributes_) attributes_->add_corner({first, static_cast<std::size_t>(at_ - first)});
    }
    if (!attributes_) return builder_.add_face(corners_);
    builder_.add_face(corners_, order_);
    attributes_->end_face(order_);
  }

  void parse_points() {
    corners_.clear();
    const std::int64_t vertices = builder_.vertex_count();
    while (to_word()) corners_.push_back(parse_corner(vertices));
    for (const std::uint32_t corner : corners_) builder_.add_point(corner);
  }

  void parse_line() {
    corners_.clear();
    const std::int64_t vertices = builder_.vertex_count();
    while (to_word()) corners_.push_back(parse_corner(vertices));
    builder_.add_line_strip(corners_);
  }

  /// v, v/t, v//n or v/t/n, of which the first is a vertex; those below 0 count back from the last one.
  std::uint32_t parse_corner(std::int64_t vertices) {
    const char* const first = at_;
    std::int32_t number = 0;
    const auto [stop, error] = std::from_chars(*at_ == '+' ? at_ + 1 : at_, end_, number);
    int slashes = 0;
    at_ = stop;
    while (!is_number_end(at_) && (slashes > 0 || *at_ == '/')) {
      slashes += static_cast<int>(*at_ == '/');
      at_ = find_any(at_ + 1, end_, kBlank | kLineEnd | kBackslash | kHash | kSlash);
    }
    if (error != std::errc() || number == 0 || slashes > 2 || !is_number_end(at_)) {
      at_ = first;
      fail(first, "corner {} is {}; legal: v, v/t, v//n or v/t/n with v from 1, or from -1 down",
           corners_.size(), quote(take_word()));
    }
    const std::int64_t vertex = number > 0 ? number - 1 : vertices + number;
    if (vertex < 0 || vertex >= vertices) {
      fail(first, "corner {} is vertex {}; legal: 1 to {}, the vertices up to here", corners_.size(), number,
           vertices);
    }
    return static_cast<std::uint32_t>(vertex);
  }

  /// The faces from here on have the material; the name may have blanks.
  void parse_material() {
    std::string material = rest_of_words();
    if (material == material_) return;
    end_part();
    material_ = std::move(material);
  }

  void end_part() {
    builder_.end_part(material_);
    if (attributes_) attributes_->end_part(material_);
  }

  void leave_out(std::string_view what, Statement statement) {
    builder_.leave_out(what, left_out_[static_cast<std::size_t>(statement)]);
  }

  std::string_view name_;
  const char* begin_;
  const char* at_;
  const char* end_;
  MeshBuilder builder_;
  std::optional<ObjAttributes> attributes_;  // where they are wanted
  std::string material_;
  std::vector<std::uint32_t> corners_;  // of the face that is being read
  std::vector<std::uint32_t> order_;    // of its corners in triangles, where attributes are wanted
  std::array<std::uint64_t, static_cast<std::size_t>(Statement::kUnknown) + 1> left_out_{};
};

}  // namespace

Mesh parse_obj(std::span<const std::byte> bytes, std::string_view name) {
  return ObjParser(text_of(bytes, name), name).run();
}

Mesh parse_obj(std::span<const std::byte> bytes, std::string_view name, const std::filesystem::path& folder,
               MeshContent content) {
  ObjParser parser(text_of(bytes, name), name);
  if (content == MeshContent::kAttributes) parser.want_attributes(folder);
  return parser.run();
}

}  // namespace halfspace
