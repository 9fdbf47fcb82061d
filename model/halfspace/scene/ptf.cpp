#include "halfspace/scene/ptf.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/byte_source.hpp"
#include "halfspace/scene/compression.hpp"
#include "halfspace/scene/input_name.hpp"
#include "halfspace/scene/quote.hpp"
#include "halfspace/scene/validate.hpp"

namespace halfspace {
namespace {

static_assert(std::endian::native == std::endian::little, "PTF1 is copied to and from memory as it is");

constexpr std::array<char, 4> kMagic{'P', 'T', 'F', '1'};
constexpr std::uint32_t kVersion = 1;
constexpr std::array<std::uint32_t, 4> kTopology{4, 1, 0, 1};  // by primitive, as in OpenGL: lists

struct FileHeader {
  std::array<char, 4> magic = kMagic;
  std::uint32_t version = kVersion;
  std::uint32_t header_size = sizeof(FileHeader);
  std::uint32_t target_size = 0;
  std::uint32_t command_size = 0;
  std::uint32_t target_count = 0;
  std::uint32_t command_count = 0;
  std::uint32_t vertex_count = 0;
  std::uint32_t index_count = 0;
  std::uint32_t meta_size = 0;
  std::array<std::uint32_t, 6> reserved{};
};
static_assert(sizeof(FileHeader) == 64);

struct FileTarget {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t samples = 0;
  std::uint32_t depth_format = 0;
  std::uint32_t color_count = 0;
  std::uint32_t presented = 0;
  std::uint32_t depth_surface = 0;
  std::uint32_t reserved = 0;
};
static_assert(sizeof(FileTarget) == 32);

struct FileCommand {
  std::uint32_t kind = 0;
  std::uint32_t source_event = 0;
  std::uint32_t target = 0;
  std::uint32_t flags = 0;
  std::uint32_t depth_func = 0;
  std::uint32_t source_topology = 0;
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  std::uint32_t first_vertex = 0;
  std::uint32_t vertex_count = 0;
  std::uint32_t instance = 0;
  std::uint32_t clear_stencil = 0;
  std::array<float, 4> viewport{};
  std::array<float, 2> depth_range{};
  float clear_depth = 0;
  float offset_factor = 0;
  float offset_units = 0;
  float offset_clamp = 0;
  std::array<std::int32_t, 4> scissor{};
  std::uint32_t primitive = 0;
  std::uint32_t polygon_mode = 0;
  std::uint32_t line_rule = 0;
  float line_width = 0;  // 0: 1
  std::uint16_t stipple_pattern = 0;
  std::uint16_t stipple_factor = 0;  // 0: no stipple
  float point_size = 0;              // 0: 1
};
static_assert(sizeof(FileCommand) == 128);
static_assert(sizeof(glm::vec4) == 16);

template <typename T>
T load_record(std::span<const std::byte> bytes) {
  T record;
  std::memcpy(&record, bytes.data(), sizeof(T));
  return record;
}

/// Cuts sections off the front of the bytes.
class Sections {
 public:
  Sections(std::span<const std::byte> bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  std::span<const std::byte> take(std::string_view section, std::uint64_t count, std::uint64_t size) {
    // Both are below 2^32, so that the product fits 64 bits.
    if (count * size > bytes_.size() - at_) {
      throw InputError(
          fmt::format("{}: {} are {} x {} bytes from byte {}, the file has {}; legal: within the file", name_,
                      section, count, size, at_, bytes_.size()));
    }
    const auto taken = bytes_.subspan(at_, count * size);
    at_ += taken.size();
    return taken;
  }

  void finish() const {
    if (at_ != bytes_.size()) {
      throw InputError(fmt::format("{}: {} bytes follow the last section at byte {}; legal: nothing", name_,
                                   bytes_.size() - at_, at_));
    }
  }

 private:
  std::span<const std::byte> bytes_;
  std::string_view name_;
  std::size_t at_ = 0;
};

void check_at_least(std::string_view name, std::string_view field, std::uint32_t value, std::uint64_t least) {
  if (value < least)
    throw InputError(fmt::format("{}: {} is {}; legal: {} or more", name, field, value, least));
}

FileHeader parse_header(std::span<const std::byte> bytes, std::string_view name) {
  if (bytes.size() < sizeof(FileHeader)) {
    throw InputError(fmt::format("{}: has {} bytes; legal: {} or more, a PTF1 header", name, bytes.size(),
                                 sizeof(FileHeader)));
  }
  const auto header = load_record<FileHeader>(bytes);
  if (header.magic != kMagic) {
    throw InputError(fmt::format("{}: starts with bytes {:02x}; legal: 50 54 46 31 (\"PTF1\")", name,
                                 fmt::join(std::bit_cast<std::array<unsigned char, 4>>(header.magic), " ")));
  }
  if (header.version != kVersion) {
    throw InputError(fmt::format("{}: version is {}; legal: {}", name, header.version, kVersion));
  }
  check_at_least(name, "header_size", header.header_size, sizeof(FileHeader));
  check_at_least(name, "target_size", header.target_size, sizeof(FileTarget));
  check_at_least(name, "command_size", header.command_size, sizeof(FileCommand));
  return header;
}

Target to_target(const FileTarget& in) {
  return {.width = in.width,
          .height = in.height,
          .samples = in.samples,
          .depth_format = DepthFormat{in.depth_format},
          .color_count = in.color_count,
          .presented = in.presented != 0,
          .depth_surface = in.depth_surface};
}

FileTarget from_target(const Target& in) {
  return {.width = in.width,
          .height = in.height,
          .samples = in.samples,
          .depth_format = static_cast<std::uint32_t>(in.depth_format),
          .color_count = in.color_count,
          .presented = in.presented ? 1u : 0u,
          .depth_surface = in.depth_surface};
}

float or_one(float value) { return value == 0 ? 1 : value; }

LineStipple to_stipple(const FileCommand& in) {
  return in.stipple_factor == 0 ? LineStipple{}
                                : LineStipple{.factor = in.stipple_factor, .pattern = in.stipple_pattern};
}

Command to_command(const FileCommand& in) {
  return {.kind = CommandKind{in.kind},
          .source_event = in.source_event,
          .target = in.target,
          .flags = in.flags,
          .depth_func = DepthFunc{in.depth_func},
          .first_index = in.first_index,
          .index_count = in.index_count,
          .first_vertex = in.first_vertex,
          .vertex_count = in.vertex_count,
          .viewport = {in.viewport[0], in.viewport[1], in.viewport[2], in.viewport[3]},
          .depth_range = {in.depth_range[0], in.depth_range[1]},
          .clear_depth = in.clear_depth,
          .offset_factor = in.offset_factor,
          .offset_units = in.offset_units,
          .offset_clamp = in.offset_clamp,
          .scissor = {in.scissor[0], in.scissor[1], in.scissor[2], in.scissor[3]},
          .primitive = Primitive{in.primitive},
          .polygon_mode = PolygonMode{in.polygon_mode},
          .line_rule = LineRule{in.line_rule},
          .line_width = or_one(in.line_width),
          .stipple = to_stipple(in),
          .point_size = or_one(in.point_size)};
}

FileCommand from_command(const Command& in) {
  const auto or_zero = [](float value) { return value == 1 ? 0 : value; };
  const bool stippled = !in.stipple.draws_all();
  return {.kind = static_cast<std::uint32_t>(in.kind),
          .source_event = in.source_event,
          .target = in.target,
          .flags = in.flags,
          .depth_func = static_cast<std::uint32_t>(in.depth_func),
          .source_topology =
              in.kind == CommandKind::kDraw ? kTopology[static_cast<std::size_t>(in.primitive)] : 0,
          .first_index = in.first_index,
          .index_count = in.index_count,
          .first_vertex = in.first_vertex,
          .vertex_count = in.vertex_count,
          .viewport = {in.viewport.x, in.viewport.y, in.viewport.z, in.viewport.w},
          .depth_range = {in.depth_range.x, in.depth_range.y},
          .clear_depth = in.clear_depth,
          .offset_factor = in.offset_factor,
          .offset_units = in.offset_units,
          .offset_clamp = in.offset_clamp,
          .scissor = {in.scissor.x, in.scissor.y, in.scissor.width, in.scissor.height},
          .primitive = static_cast<std::uint32_t>(in.primitive),
          .polygon_mode = static_cast<std::uint32_t>(in.polygon_mode),
          .line_rule = static_cast<std::uint32_t>(in.line_rule),
          .line_width = or_zero(in.line_width),
          .stipple_pattern = static_cast<std::uint16_t>(stippled ? in.stipple.pattern : 0),
          .stipple_factor = static_cast<std::uint16_t>(stippled ? in.stipple.factor : 0),
          .point_size = or_zero(in.point_size)};
}

/// Copies an array of plain elements out of its section.
template <typename T>
std::vector<T> to_vector(std::span<const std::byte> section) {
  std::vector<T> out(section.size() / sizeof(T));
  if (!out.empty()) std::memcpy(out.data(), section.data(), section.size());
  return out;
}

template <typename T>
void append(std::vector<std::byte>& out, std::span<const T> items) {
  const std::size_t at = out.size();
  out.resize(at + items.size_bytes());
  if (!items.empty()) std::memcpy(out.data() + at, items.data(), items.size_bytes());
}

std::uint32_t count32(const Frame& frame, std::string_view section, std::size_t count) {
  constexpr auto kMost = std::numeric_limits<std::uint32_t>::max();
  if (count > kMost) {
    throw InputError(
        fmt::format("{}: {} has {} entries; legal: at most {}", frame.name, section, count, kMost));
  }
  return static_cast<std::uint32_t>(count);
}

}  // namespace

Frame parse_ptf(std::span<const std::byte> bytes, std::string_view name) {
  const FileHeader header = parse_header(bytes, name);
  Sections sections(bytes, name);
  sections.take("header bytes", header.header_size, 1);
  const auto targets = sections.take("targets", header.target_count, header.target_size);
  const auto commands = sections.take("commands", header.command_count, header.command_size);
  const auto vertices = sections.take("vertices", header.vertex_count, sizeof(glm::vec4));
  const auto indices = sections.take("indices", header.index_count, sizeof(std::uint32_t));
  const auto meta = sections.take("meta bytes", header.meta_size, 1);
  sections.finish();

  Frame frame;
  frame.name = name;
  frame.targets.reserve(header.target_count);
  for (std::uint32_t i = 0; i < header.target_count; ++i) {
    const auto record = targets.subspan(std::size_t{i} * header.target_size);
    frame.targets.push_back(to_target(load_record<FileTarget>(record)));
  }
  frame.commands.reserve(header.command_count);
  for (std::uint32_t i = 0; i < header.command_count; ++i) {
    const auto record = commands.subspan(std::size_t{i} * header.command_size);
    frame.commands.push_back(to_command(load_record<FileCommand>(record)));
  }
  frame.vertices = to_vector<glm::vec4>(vertices);
  frame.indices = to_vector<std::uint32_t>(indices);
  frame.meta.assign(reinterpret_cast<const char*>(meta.data()), meta.size());
  validate(frame);
  return frame;
}

Frame read_ptf(const std::filesystem::path& path) {
  Frame frame = parse_ptf(read_bytes(path), display_name(path));
  frame.name = printable(input_name(path).stem);
  return frame;
}

std::vector<std::byte> format_ptf(const Frame& frame) {
  FileHeader header;
  header.target_size = sizeof(FileTarget);
  header.command_size = sizeof(FileCommand);
  header.target_count = count32(frame, "targets", frame.targets.size());
  header.command_count = count32(frame, "commands", frame.commands.size());
  header.vertex_count = count32(frame, "vertices", frame.vertices.size());
  header.index_count = count32(frame, "indices", frame.indices.size());
  header.meta_size = count32(frame, "meta", frame.meta.size());

  std::vector<std::byte> out;
  append(out, std::span<const FileHeader>(&header, 1));
  for (const Target& target : frame.targets) {
    const FileTarget record = from_target(target);
    append(out, std::span<const FileTarget>(&record, 1));
  }
  for (const Command& command : frame.commands) {
    const FileCommand record = from_command(command);
    append(out, std::span<const FileCommand>(&record, 1));
  }
  append(out, std::span<const glm::vec4>(frame.vertices));
  append(out, std::span<const std::uint32_t>(frame.indices));
  append(out, std::span<const char>(frame.meta));
  return out;
}

void write_ptf(const Frame& frame, const std::filesystem::path& path) {
  const std::vector<std::byte> plain = format_ptf(frame);
  switch (input_name(path).packing) {
    case Packing::kNone:
      return write_bytes(path, plain);
    case Packing::kGzip:
      return write_bytes(path, compress_gzip(plain));
    case Packing::kXz:
      return write_bytes(path, compress_xz(plain));
  }
}

}  // namespace halfspace
