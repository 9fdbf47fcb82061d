// Does a frame survive the file format, and is the format the documented one?
#include "halfspace/scene/ptf.hpp"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "fixture.hpp"
#include "halfspace/scene/byte_source.hpp"
#include "halfspace/scene/compression.hpp"

using namespace halfspace;
using namespace halfspace::test;

namespace {

void check_equal(const Frame& a, const Frame& b) {
  CHECK(a.meta == b.meta);
  CHECK(a.indices == b.indices);
  REQUIRE(a.vertices.size() == b.vertices.size());
  for (std::size_t i = 0; i < a.vertices.size(); ++i) CHECK(same_bits(a.vertices[i], b.vertices[i]));
  REQUIRE(a.targets.size() == b.targets.size());
  for (std::size_t i = 0; i < a.targets.size(); ++i) {
    const Target& s = a.targets[i];
    const Target& t = b.targets[i];
    CHECK(s.width == t.width);
    CHECK(s.height == t.height);
    CHECK(s.samples == t.samples);
    CHECK(s.depth_format == t.depth_format);
    CHECK(s.color_count == t.color_count);
    CHECK(s.presented == t.presented);
    CHECK(s.depth_surface == t.depth_surface);
  }
  REQUIRE(a.commands.size() == b.commands.size());
  for (std::size_t i = 0; i < a.commands.size(); ++i) {
    const Command& s = a.commands[i];
    const Command& t = b.commands[i];
    CHECK(s.kind == t.kind);
    CHECK(s.source_event == t.source_event);
    CHECK(s.target == t.target);
    CHECK(s.flags == t.flags);
    CHECK(s.depth_func == t.depth_func);
    CHECK(s.first_index == t.first_index);
    CHECK(s.index_count == t.index_count);
    CHECK(s.first_vertex == t.first_vertex);
    CHECK(s.vertex_count == t.vertex_count);
    CHECK(s.viewport == t.viewport);
    CHECK(s.depth_range == t.depth_range);
    CHECK(s.clear_depth == t.clear_depth);
    CHECK(s.offset_factor == t.offset_factor);
    CHECK(s.offset_units == t.offset_units);
    CHECK(s.offset_clamp == t.offset_clamp);
    CHECK(same_bits(s.scissor, t.scissor));
    CHECK(s.primitive == t.primitive);
    CHECK(s.polygon_mode == t.polygon_mode);
    CHECK(s.line_rule == t.line_rule);
    CHECK(s.line_width == t.line_width);
    CHECK(s.stipple.factor == t.stipple.factor);
    CHECK(s.stipple.pattern == t.stipple.pattern);
    CHECK(s.point_size == t.point_size);
  }
}

}  // namespace

TEST_CASE("a frame survives being written and read, plain and packed") {
  const TempFolder folder;
  Frame frame = small_frame();
  frame.vertices[0] = glm::vec4(std::numeric_limits<float>::quiet_NaN(), -INFINITY, -0.0f, 1e-40f);
  const std::string name = GENERATE("small.ptf", "small.ptf.gz", "small.ptf.xz");
  write_ptf(frame, folder.path(name));
  const Frame read = read_ptf(folder.path(name));
  CHECK(read.name == "small");
  check_equal(read, frame);
  CHECK_FALSE(std::filesystem::exists(folder.path(name + ".part")));
}

TEST_CASE("packing is found by content, whatever the file is called") {
  const TempFolder folder;
  write_ptf(small_frame(), folder.path("a.xz"));
  std::filesystem::rename(folder.path("a.xz"), folder.path("b.ptf"));
  check_equal(read_ptf(folder.path("b.ptf")), small_frame());
}

TEST_CASE("gzip members and xz streams in a row are joined") {
  const std::vector<std::byte> plain = format_ptf(small_frame());
  const auto pack = GENERATE(compress_gzip, compress_xz);
  std::vector<std::byte> packed = pack(std::span(plain).first(100));
  const std::vector<std::byte> rest = pack(std::span(plain).subspan(100));
  packed.insert(packed.end(), rest.begin(), rest.end());
  CHECK(decompress(packed, "packed", plain.size()) == plain);
}

TEST_CASE("every field stands where the format says") {
  const std::vector<std::byte> bytes = format_ptf(small_frame());
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
  };
  const auto number = [&](std::size_t at) {
    float value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
  };
  REQUIRE(bytes.size() == 64 + 2 * 32 + 2 * 128 + 5 * 16 + 6 * 4 + 23);
  CHECK(as_text(bytes).substr(0, 4) == "PTF1");
  const std::vector<std::uint32_t> header{1, 64, 32, 128, 2, 2, 5, 6, 23, 0, 0, 0, 0, 0, 0};
  for (std::size_t i = 0; i < header.size(); ++i) CHECK(word(4 + 4 * i) == header[i]);
  const std::vector<std::uint32_t> target{8, 6, 1, 2, 1, 1, 0, 0};
  for (std::size_t i = 0; i < target.size(); ++i) CHECK(word(64 + 4 * i) == target[i]);
  CHECK(word(96 + 12) == 0);           // no depth format,
  CHECK(word(96 + 24) == 0xFFFFFFFF);  // hence no depth surface
  const std::size_t clear = 128;
  CHECK(word(clear) == 2);
  CHECK(word(clear + 12) == 1u << 18);
  CHECK(number(clear + 72) == 0.5f);
  CHECK(word(clear + 88) == 0xFFFFFFFF);  // scissor.x is -1
  const std::size_t draw = clear + 128;
  const std::vector<std::uint32_t> words{1, 7, 0, 3, 3, 4, 0, 6, 1, 4, 0, 0};
  for (std::size_t i = 0; i < words.size(); ++i) CHECK(word(draw + 4 * i) == words[i]);
  const std::vector<float> numbers{0, 6, 8, -6, 0.25f, 0.75f, 1, -1, 2, 0.125f};
  for (std::size_t i = 0; i < numbers.size(); ++i) CHECK(number(draw + 48 + 4 * i) == numbers[i]);
  CHECK(word(draw + 96) == 1u << 24);  // scissor.width
  const std::size_t vertices = draw + 128;
  CHECK(number(vertices + 16) == -1);
  CHECK(word(vertices + 5 * 16 + 5 * 4) == 3);  // the last index
}

TEST_CASE("lines and points stand where the format says, and 0 is what files without them mean") {
  Frame frame = small_frame();
  const std::size_t draw = 64 + 2 * 32 + 128;
  std::vector<std::byte> bytes = format_ptf(frame);
  CHECK(std::all_of(bytes.begin() + draw + 104, bytes.begin() + draw + 128,
                    [](std::byte byte) { return byte == std::byte{0}; }));
  Command& command = frame.commands[1];
  command.primitive = Primitive::kLineStrip;
  command.polygon_mode = PolygonMode::kPoint;
  command.line_rule = LineRule::kDiamondExit;
  command.line_width = 2.5F;
  command.stipple = {.factor = 3, .pattern = 0xF00D};
  command.point_size = 0.75F;
  bytes = format_ptf(frame);
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
  };
  CHECK(word(draw + 20) == 1);  // GL_LINES
  CHECK(word(draw + 104) == 3);
  CHECK(word(draw + 108) == 2);
  CHECK(word(draw + 112) == 2);
  CHECK(word(draw + 116) == std::bit_cast<std::uint32_t>(2.5F));
  CHECK(word(draw + 120) == (3u << 16 | 0xF00D));
  CHECK(word(draw + 124) == std::bit_cast<std::uint32_t>(0.75F));
  check_equal(parse_ptf(bytes, "lines"), frame);
}

TEST_CASE("longer headers and records are read, what is unknown in them is passed over") {
  const std::string plain = as_text(format_ptf(small_frame()));
  std::string out = plain.substr(0, 64) + "12345678";
  const auto put = [&](std::size_t at, std::uint32_t value) { std::memcpy(out.data() + at, &value, 4); };
  put(8, 72);
  put(12, 32 + 4);
  put(16, 128 + 12);
  for (std::size_t i = 0; i < 2; ++i) out += plain.substr(64 + 32 * i, 32) + "tail";
  for (std::size_t i = 0; i < 2; ++i) out += plain.substr(128 + 128 * i, 128) + "tail of 12 b";
  out += plain.substr(128 + 256);
  check_equal(parse_ptf(as_bytes(out), "long"), small_frame());
}

TEST_CASE("unknown flags are kept") {
  Frame frame = small_frame();
  frame.commands[1].flags |= 1u << 31;
  CHECK(parse_ptf(format_ptf(frame), "flags").commands[1].flags == frame.commands[1].flags);
}

TEST_CASE("the empty frame is legal") {
  const Frame frame = parse_ptf(format_ptf(Frame{}), "empty");
  CHECK(frame.name == "empty");
  CHECK(frame.commands.empty());
}
