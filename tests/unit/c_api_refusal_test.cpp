/// The C API: is everything refused that must be, with nothing changed by it?
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "c_api_fixture.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

/// A model of which every packet that is refused must leave nothing behind, and packets of one good triangle.
struct Refusals {
  Refusals() : reference(machine, format, kWidth, kHeight, largest_code(format)) {
    define_surface(model, format);
    reference.triangle(
        {{ScreenVertex{0, 0, 0}, ScreenVertex{20000, 800, 5}, ScreenVertex{300, 21000, 1 << 30}}, 0},
        draw_state(machine, format));
  }

  void refused(int link, const Words& words, const std::string& why) const {
    CAPTURE(link);
    CHECK(put(model, link, words) == HALFSPACE_REFUSED);
    CHECK_THAT(error(model), Catch::Contains(fmt::format("({}): ", halfspace_link_name(link)) + why));
    for (int watched = HALFSPACE_SETUP_TRIANGLE; watched < HALFSPACE_LINKS; ++watched) {
      CHECK(halfspace_pending(model.get(), watched) == 0);
    }
  }

  /// The words with another value in the field `name` of the struct whose lowest bit is `lsb`.
  static Words change(const Words& words, int lsb, const std::vector<FieldSlot>& fields,
                      const std::string& name, std::uint64_t value) {
    Words changed = words;
    for (const FieldSlot& field : fields) {
      for (int i = 0; field.name == name && i < field.width; ++i) {
        const int bit = lsb + field.lsb + i;
        std::uint32_t& word = changed[static_cast<std::size_t>(bit / 32)];
        word = (word & ~(1u << bit % 32)) | static_cast<std::uint32_t>(value >> i & 1) << bit % 32;
      }
    }
    REQUIRE(changed != words);
    return changed;
  }

  const Machine& machine = kMachines[0];
  const Widths& widths = machine.widths;
  const DepthFormat format = DepthFormat::kUnorm24;
  const Model model =
      make_model(machine, {HALFSPACE_SETUP_TRIANGLE, HALFSPACE_SLOT, HALFSPACE_BLOCK_JOB, HALFSPACE_TILE_JOB,
                           HALFSPACE_COVERAGE, HALFSPACE_QUAD_BEAT, HALFSPACE_TESTED_BEAT});
  Reference<8> reference;
  // Places of the structs in a setup triangle's words.
  const int equation_lsb = packed_bits<DrawStatePacket>(widths);
  const int triangle_lsb = equation_lsb + packed_bits<DepthEquationPacket>(widths);
  const std::vector<FieldSlot> triangle_fields = field_slots<SetupTrianglePacket>(widths);
  const std::vector<FieldSlot> equation_fields = field_slots<DepthEquationPacket>(widths);
};

}  // namespace

TEST_CASE("c_api: an illegal configuration is refused with what is legal") {
  const Model model(halfspace_create());
  CHECK(halfspace_set(model.get(), "tile_walker.tile_size=7") == HALFSPACE_REFUSED);
  CHECK(error(model) == "configuration key 'tile_walker.tile_size' is '7'; legal: 4, 8, 16");
  CHECK(halfspace_set(model.get(), "tile_walker.tilesize=8") == HALFSPACE_REFUSED);
  CHECK_THAT(error(model), Catch::Contains("unknown configuration key 'tile_walker.tilesize'"));
  CHECK(halfspace_set(model.get(), "a\nb") == HALFSPACE_REFUSED);
  CHECK(error(model).find('\n') == std::string::npos);
  CHECK(halfspace_configure(model.get(), "[tile_walker\n") == HALFSPACE_REFUSED);
  CHECK_THAT(error(model), Catch::Contains("configuration: line 1"));
  CHECK(halfspace_configure_file(model.get(), "no/such/file.toml") == HALFSPACE_REFUSED);
  CHECK_THAT(error(model), Catch::Contains("no/such/file.toml"));
  // What only fits together is checked when the configuration is first used; until it fits, it can be
  // changed.
  REQUIRE(halfspace_set(model.get(), "block_walker.block_size=8") == HALFSPACE_OK);
  CHECK(halfspace_packet_bits(model.get(), HALFSPACE_COVERAGE) == HALFSPACE_REFUSED);
  CHECK_THAT(error(model), Catch::Contains("'block_walker.block_size' is 8"));
  REQUIRE(halfspace_set(model.get(), "block_walker.block_size=16") == HALFSPACE_OK);
  CHECK(halfspace_watch(model.get(), HALFSPACE_COVERAGE) == HALFSPACE_OK);
  CHECK(error(model).empty());
}

TEST_CASE("c_api: null pointers, wrong links and wrong sizes are refused") {
  const Machine& machine = kMachines[0];
  const Model model = make_model(machine, {HALFSPACE_COVERAGE});
  std::uint32_t words[HALFSPACE_MAX_PACKET_WORDS] = {};
  const int bits = halfspace_packet_bits(model.get(), HALFSPACE_TILE_JOB);

  halfspace_destroy(nullptr);
  CHECK_THAT(halfspace_error(nullptr), Catch::Contains("null pointer"));
  CHECK(halfspace_set(nullptr, "a=b") == HALFSPACE_REFUSED);
  CHECK(halfspace_configure(nullptr, "") == HALFSPACE_REFUSED);
  CHECK(halfspace_configure_file(nullptr, "") == HALFSPACE_REFUSED);
  CHECK(halfspace_packet_bits(nullptr, 0) == HALFSPACE_REFUSED);
  CHECK(halfspace_watch(nullptr, HALFSPACE_COVERAGE) == HALFSPACE_REFUSED);
  CHECK(halfspace_put(nullptr, HALFSPACE_TILE_JOB, words, bits) == HALFSPACE_REFUSED);
  CHECK(halfspace_get(nullptr, HALFSPACE_COVERAGE, words, bits) == HALFSPACE_REFUSED);
  CHECK(halfspace_check(nullptr, HALFSPACE_COVERAGE, words, bits) == HALFSPACE_REFUSED);
  CHECK(halfspace_pending(nullptr, HALFSPACE_COVERAGE) == HALFSPACE_REFUSED);
  CHECK(halfspace_reset(nullptr) == HALFSPACE_REFUSED);
  CHECK(halfspace_define_surface(nullptr, 0, 1, 1, 1, 0) == HALFSPACE_REFUSED);
  CHECK(halfspace_clear_surface(nullptr, 0, 0) == HALFSPACE_REFUSED);
  CHECK(halfspace_read_depth(nullptr, 0, 0, 0, words) == HALFSPACE_REFUSED);
  CHECK(halfspace_write_depth(nullptr, 0, 0, 0, 0) == HALFSPACE_REFUSED);

  CHECK(halfspace_set(model.get(), nullptr) == HALFSPACE_REFUSED);
  CHECK(halfspace_put(model.get(), HALFSPACE_TILE_JOB, nullptr, bits) == HALFSPACE_REFUSED);
  CHECK_THAT(error(model), Catch::Contains("packet is a null pointer"));
  CHECK(halfspace_get(model.get(), HALFSPACE_COVERAGE, nullptr, bits) == HALFSPACE_REFUSED);
  CHECK(halfspace_check(model.get(), HALFSPACE_COVERAGE, nullptr, bits) == HALFSPACE_REFUSED);
  const Model fresh(halfspace_create());
  CHECK(halfspace_set(fresh.get(), nullptr) == HALFSPACE_REFUSED);
  CHECK(halfspace_configure(fresh.get(), nullptr) == HALFSPACE_REFUSED);
  CHECK(halfspace_configure_file(fresh.get(), nullptr) == HALFSPACE_REFUSED);
  CHECK_THAT(error(fresh), Catch::Contains("path is a null pointer"));

  for (const int size : {bits - 1, bits + 1, 0, -1}) {
    CHECK(halfspace_put(model.get(), HALFSPACE_TILE_JOB, words, size) == HALFSPACE_REFUSED);
    CHECK_THAT(error(model), Catch::Contains(fmt::format(
                                 "a packet of {} bits on link 4 (tile_job); legal: {}", size, bits)));
  }
  CHECK(halfspace_get(model.get(), HALFSPACE_COVERAGE, words, bits) == HALFSPACE_REFUSED);
  CHECK(halfspace_check(model.get(), HALFSPACE_COVERAGE, words, bits) == HALFSPACE_REFUSED);
  for (const int link :
       {-1, static_cast<int>(HALFSPACE_TESTED_BEAT), static_cast<int>(HALFSPACE_LINKS), 1 << 20}) {
    CHECK(halfspace_put(model.get(), link, words, bits) == HALFSPACE_REFUSED);
    CHECK_THAT(error(model), Catch::Contains("legal: 0 (triangle) to 6 (quad_beat)"));
  }
  for (const int link : {-1, static_cast<int>(HALFSPACE_TRIANGLE), static_cast<int>(HALFSPACE_LINKS)}) {
    CHECK(halfspace_watch(model.get(), link) == HALFSPACE_REFUSED);
    CHECK(halfspace_get(model.get(), link, words, bits) == HALFSPACE_REFUSED);
    CHECK(halfspace_pending(model.get(), link) == HALFSPACE_REFUSED);
  }
  CHECK(halfspace_packet_bits(model.get(), HALFSPACE_LINKS) == HALFSPACE_REFUSED);
  CHECK(halfspace_pending(model.get(), HALFSPACE_QUAD_BEAT) == HALFSPACE_REFUSED);
  CHECK_THAT(error(model), Catch::Contains("link 6 (quad_beat) is not watched"));
  REQUIRE(put(model, HALFSPACE_TILE_JOB, join(machine.widths, some_job())) == HALFSPACE_OK);
  CHECK(halfspace_watch(model.get(), HALFSPACE_QUAD_BEAT) == HALFSPACE_REFUSED);
  CHECK_THAT(error(model), Catch::Contains("before the first packet"));
}

TEST_CASE("c_api: surfaces that cannot be are refused") {
  const Model model = make_model(kMachines[0], {});
  const auto define = [&](std::uint32_t first, int format, int width, int height, std::uint32_t code) {
    return halfspace_define_surface(model.get(), first, format, width, height, code);
  };
  CHECK(define(0, 3, 8, 8, 0) == HALFSPACE_REFUSED);
  CHECK_THAT(error(model), Catch::Contains("format of a depth surface is 3"));
  CHECK(define(0, 1, 0, 8, 0) == HALFSPACE_REFUSED);
  CHECK(define(0, 1, 8, 16385, 0) == HALFSPACE_REFUSED);
  CHECK(define(0, 1, 8, 8, 0x10000) == HALFSPACE_REFUSED);
  CHECK_THAT(error(model), Catch::Contains("depth code is 0x10000; legal: at most 0xffff"));
  CHECK(define(0, 4, 8, 8, 0x3F800001) == HALFSPACE_REFUSED);
  CHECK(define(0xFFFFFFFFu, 1, 16, 8, 0) == HALFSPACE_REFUSED);
  CHECK(define(0xFFFFFFFFu, 1, 8, 8, 0) == HALFSPACE_OK);
  CHECK(define(10, 2, 16, 16, 0) == HALFSPACE_OK);
  CHECK(define(10, 2, 16, 16, 0) == HALFSPACE_REFUSED);
  CHECK(define(13, 2, 8, 8, 0) == HALFSPACE_REFUSED);
  CHECK_THAT(error(model), Catch::Contains("10 to 13 are another's"));
  CHECK(define(9, 2, 16, 8, 0) == HALFSPACE_REFUSED);
  CHECK(define(14, 2, 8, 8, 0) == HALFSPACE_OK);
  CHECK(halfspace_clear_surface(model.get(), 11, 0) == HALFSPACE_REFUSED);
  CHECK_THAT(error(model), Catch::Contains("legal: 10, 14, 4294967295"));
  CHECK(halfspace_clear_surface(model.get(), 10, 1u << 24) == HALFSPACE_REFUSED);
  std::uint32_t code = 0;
  CHECK(halfspace_read_depth(model.get(), 10, 16, 0, &code) == HALFSPACE_REFUSED);
  CHECK_THAT(error(model), Catch::Contains("pixel (16, 0); legal: (0, 0) to (15, 15)"));
  CHECK(halfspace_read_depth(model.get(), 10, 0, -1, &code) == HALFSPACE_REFUSED);
  CHECK(halfspace_read_depth(model.get(), 10, 0, 0, nullptr) == HALFSPACE_REFUSED);
  CHECK(halfspace_write_depth(model.get(), 10, 0, 16, 0) == HALFSPACE_REFUSED);
  CHECK(halfspace_write_depth(model.get(), 10, 0, 0, 1u << 24) == HALFSPACE_REFUSED);
}

TEST_CASE_METHOD(Refusals, "c_api: triangles outside the contract of setup are refused, and change nothing") {
  const ScreenTrianglePacket triangle{.x = {0, 20000, 300}, .y = {0, 800, 21000}, .z = {0, 5, 1u << 30}};
  const DrawStatePacket good = draw_state(machine, format);
  const auto refused_triangle = [&](auto change, const std::string& why) {
    ScreenTrianglePacket packet = triangle;
    DrawStatePacket draw = good;
    change(packet, draw);
    refused(HALFSPACE_TRIANGLE, join(widths, packet, draw), why);
  };
  for (const int format_number : {3, 5, 6, 7}) {
    refused_triangle([&](auto&, auto& d) { d.format = static_cast<std::uint8_t>(format_number); },
                     fmt::format("state.format is {}; legal: 0 (none), 1", format_number));
  }
  refused_triangle([](auto& t, auto&) { t.line_rule = 5, t.line_width = 1; },
                   "triangle.line_rule is 5; legal: 0 (a triangle) to 4");
  for (const int width : {0, 65}) {
    refused_triangle(
        [&](auto& t, auto&) { t.line_rule = 2, t.line_width = static_cast<std::uint8_t>(width); },
        fmt::format("triangle.line_width is {}; legal: 1 to 64", width));
  }
  refused_triangle([](auto&, auto& d) { d.format = 0; }, "state.test is 1; legal: 0");
  refused_triangle([](auto&, auto& d) { d.late = 1; }, "state.late is 1; legal: 0");
  refused_triangle(
      [](auto&, auto& d) { d.most_code = 1u << 24; },
      "state.least_code and most_code are 0x0 and 0x1000000; legal: 0 to 0xffffff, in this order");
  refused_triangle([](auto&, auto& d) { d.least_code = d.most_code--; },
                   "state.least_code and most_code are 0xffffff and 0xfffffe; legal: 0 to");
  refused_triangle([](auto&, auto& d) { d.format = 1, d.most_code = 0xFFFF; },
                   "state.format is 1; legal: 2, the format of the surface at tile 77");
  refused_triangle([](auto&, auto& d) { d.x_first = kWidth; },
                   "state.x_last is 199; legal: at least state.x_first (200)");
  refused_triangle([](auto&, auto& d) { d.y_first = kHeight; }, "state.y_last is 119");
  refused_triangle([](auto& p, auto&) { p.z[1] = (std::int64_t{1} << 46) + 1; },
                   "triangle.z[1] is 70368744177665; legal: -70368744177664 to 70368744177664");
  refused_triangle([](auto& p, auto&) { p.offset = -(std::int64_t{1} << 47); },
                   "triangle.offset is -140737488355328; legal: -70368744177664 to");
  refused_triangle([](auto&, auto& d) { d.first_tile = 3; },
                   "state.first_tile is 3, where no depth surface begins; legal: 77");
  refused_triangle([](auto&, auto& d) { d.tiles_x = 3; }, "state.tiles_x is 3; legal: 24");
  refused_triangle([](auto&, auto& d) { d.x_last = 200; }, "pixel (200, 119) is outside the depth surface");
  refused_triangle([](auto&, auto& d) { d.y_last = 16383; },
                   "pixel (199, 16383) is outside the depth surface");
}

TEST_CASE_METHOD(Refusals, "c_api: so are triangles that setup does not make") {
  const Words set_up = reference.packets.at(HALFSPACE_SETUP_TRIANGLE).at(0);
  const auto refused_set_up = [&](int lsb, const std::vector<FieldSlot>& fields, const char* name,
                                  std::uint64_t value, const std::string& why) {
    refused(HALFSPACE_SETUP_TRIANGLE, change(set_up, lsb, fields, name, value), why);
  };
  refused_set_up(triangle_lsb, triangle_fields, "x_first", 4000, "triangle.x_last is");
  refused_set_up(triangle_lsb, triangle_fields, "y_first", 4000, "triangle.y_last is");
  refused_set_up(triangle_lsb, triangle_fields, "x_last", 3000, "pixel (3000,");
  refused_set_up(triangle_lsb, triangle_fields, "e[1]", (std::uint64_t{1} << 50) - 1,
                 "triangle.e[1] is 1125899906842623");
  refused_set_up(triangle_lsb, triangle_fields, "e[0]", 12345, "equation.area2 is");
  refused_set_up(triangle_lsb, triangle_fields, "a[0]", 1, "triangle.a[0] is 1; legal:");
  refused_set_up(triangle_lsb, triangle_fields, "a[1]", 1, "equation.a[0] is");
  refused_set_up(triangle_lsb, triangle_fields, "b[2]", 1, "equation.b[1] is");
  refused_set_up(equation_lsb, equation_fields, "reciprocal", 7, "equation.reciprocal is 7; legal:");
  refused_set_up(equation_lsb, equation_fields, "shift", 31, "equation.shift is 31; legal:");
  refused_set_up(equation_lsb, equation_fields, "min_code", 7, "equation.min_code is 7; legal: 0");
  refused_set_up(equation_lsb, equation_fields, "max_code", 7, "equation.max_code is 7; legal:");
  refused_set_up(equation_lsb, equation_fields, "area2", 0, "equation.area2 is 0; legal: 1 or more");
  refused_set_up(equation_lsb, equation_fields, "beyond", 1, "equation.beyond is 1; legal: 0");
  refused_set_up(equation_lsb, equation_fields, "exponent", 1, "equation.exponent is 1; legal: 0");
  refused_set_up(equation_lsb, equation_fields, "offset", 1 << 20, "equation.min_code is");
  refused_set_up(equation_lsb, equation_fields, "offset", std::uint64_t{1} << 47,
                 "equation.offset, as a depth, is");
  refused_set_up(equation_lsb, equation_fields, "z[0]", (std::uint64_t{1} << 47) - 1,
                 "equation.z[0] is 140737488355327; legal: -");
}

TEST_CASE_METHOD(Refusals, "c_api: so are slots and block jobs that block_walker does not make") {
  const Words slot = reference.packets.at(HALFSPACE_SLOT).at(0);
  const std::vector<Words>& jobs = reference.packets.at(HALFSPACE_BLOCK_JOB);
  // The block at (32, 32), whose upper left is inside the triangle.
  const auto found = std::ranges::find_if(jobs, [&](const Words& words) {
    const auto job = unpack<BlockJob>(words, widths);
    return job.block_x == 1 && job.block_y == 1;
  });
  REQUIRE(found != jobs.end());
  const Words& job = *found;
  const std::vector<FieldSlot> job_fields = field_slots<BlockJob>(widths);
  const auto refused_job = [&](const char* name, std::uint64_t value, const std::string& why) {
    refused(HALFSPACE_BLOCK_JOB, change(job, 0, job_fields, name, value), why);
  };
  refused(HALFSPACE_BLOCK_JOB, job, "slot is 0; legal: one that was put on link 2 (slot) before");
  refused(HALFSPACE_SLOT, change(slot, equation_lsb, equation_fields, "shift", 31), "equation.shift is 31");
  REQUIRE(put(model, HALFSPACE_SLOT, slot) == HALFSPACE_OK);

  // What tile_walker demands. A block has 4 by 4 tiles.
  const auto refused_order = [&](const char* first, const char* last) {
    const Words moved = change(job, 0, job_fields, first, 7);
    refused(HALFSPACE_BLOCK_JOB, change(moved, 0, job_fields, last, 6),
            fmt::format("{} is 6; legal: at least {} (7)", last, first));
  };
  refused_order("x_first", "x_last");
  refused_order("y_first", "y_last");
  refused_job("tiles", 0, "tiles is 0; legal: a tile or more");
  const auto refused_tiles = [&](const char* bound, std::uint64_t pixel, std::uint64_t tiles,
                                 const std::string& why) {
    const Words tighter = change(job, 0, job_fields, bound, pixel);
    refused(HALFSPACE_BLOCK_JOB, change(tighter, 0, job_fields, "tiles", tiles), why);
  };
  refused_tiles(
      "x_first", 8, 0x21,
      "tiles is 0x21, with tile (0, 0) of the block; legal: (1, 0) to (3, 3), which the bounds touch");
  refused_tiles("x_last", 23, 0x8001,
                "tiles is 0x8001, with tile (3, 3) of the block; legal: (0, 0) to (2, 3), which");
  refused_tiles("y_first", 16, 0x120,
                "tiles is 0x120, with tile (1, 1) of the block; legal: (0, 2) to (3, 3), which");
  refused_tiles("y_last", 7, 0x11,
                "tiles is 0x11, with tile (0, 1) of the block; legal: (0, 0) to (3, 0), which");
  refused_job("e[1]", (std::uint64_t{1} << 50) - 1, "e[1] is 1125899906842623, so E is ");
  refused_job("e[2]", std::uint64_t{1} << 50, "e[2] is -1125899906842624, so E is ");

  // What early_z demands.
  refused_job("slot", 1, "slot is 1; legal: one that was put on link 2 (slot) before");
  refused_job("block_x", 6,
              "pixel (223, 63) is outside the depth surface at tile 77; legal: (0, 0) to (199, ");
  refused_job("block_x", 511, "pixel (16383, 63) is outside the depth surface");
  refused_job("block_y", 511, "pixel (63, 16383) is outside the depth surface");
  refused_job("a[0]", 1, "a[0] is 1; legal:");
  refused_job("a[1]", 1, "a[1] is 1; legal:");
  refused_job("a[2]", 1, "a[2] is 1; legal:");
  refused_job("b[0]", 1, "b[0] is 1; legal:");
  refused_job("b[1]", 1, "b[1] is 1; legal:");
  refused_job("b[2]", 1, "b[2] is 1; legal:");
  refused_job("e[0]", 12345, "the sum of e and bias of the slot is");
  bool untouched = true;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      std::uint32_t code = 0;
      untouched = untouched && halfspace_read_depth(model.get(), kFirstTile, x, y, &code) == HALFSPACE_OK &&
                  code == largest_code(format);
    }
  }
  CHECK(untouched);
  // After all that the right one is taken, and gives what it should.
  REQUIRE(put(model, HALFSPACE_BLOCK_JOB, job) == HALFSPACE_OK);
  CHECK_FALSE(take(model, HALFSPACE_TESTED_BEAT).empty());
}

TEST_CASE_METHOD(Refusals, "c_api: so are tile jobs that tile_walker does not make") {
  REQUIRE(put(model, HALFSPACE_SLOT, reference.packets.at(HALFSPACE_SLOT).at(0)) == HALFSPACE_OK);
  const Words job = reference.packets.at(HALFSPACE_TILE_JOB).at(0);
  const std::vector<FieldSlot> job_fields = field_slots<TileJob>(widths);
  refused(HALFSPACE_TILE_JOB, change(job, 0, job_fields, "slot", 7),
          "slot is 7; legal: one that was put on link 2 (slot) before");
  refused(HALFSPACE_TILE_JOB, change(job, 0, job_fields, "tile_x", 25),
          "pixel (200, 0) is outside the depth surface");
  refused(HALFSPACE_TILE_JOB, change(job, 0, job_fields, "e[1]", std::uint64_t{1} << 49),
          "mask covers sample (");
}

TEST_CASE_METHOD(Refusals, "c_api: so are beats that quad_generator does not make") {
  REQUIRE(put(model, HALFSPACE_SLOT, reference.packets.at(HALFSPACE_SLOT).at(0)) == HALFSPACE_OK);
  // A burst of two beats.
  TileJob whole;
  REQUIRE(edge_evaluator<8>(whole, 8).mask.word[0] != 0);
  const std::vector<Words>& beats = reference.packets.at(HALFSPACE_QUAD_BEAT);
  const auto beat = [&](std::size_t i) { return unpack<QuadBeat>(beats[i], widths); };
  std::size_t first = 0;
  while (beat(first).last != 0) {
    ++first;
  }
  QuadBeat head = beat(first);
  while (beat(first + 1).last == 0) {
    ++first;
    head = beat(first);
  }
  // Now `first` is the last but one of its burst; find its beginning.
  std::size_t begin = first;
  while (begin > 0 && beat(begin - 1).last == 0) {
    --begin;
  }
  for (std::size_t i = begin; i <= first; ++i) {
    REQUIRE(put(model, HALFSPACE_QUAD_BEAT, beats[i]) == HALFSPACE_OK);
  }
  const auto refused_beat = [&](auto edit, const std::string& why) {
    QuadBeat wrong = beat(first + 1);
    edit(wrong);
    refused(HALFSPACE_QUAD_BEAT, join(widths, wrong), why);
  };
  refused_beat([](QuadBeat& b) { b.slot = 1; }, "beat ");
  refused_beat([](QuadBeat& b) { b.tile_x = 9; }, "beat ");
  refused_beat([](QuadBeat& b) { b.parts[0] = 0; }, "beat ");
  refused_beat([](QuadBeat& b) { b.mask[0] = 0; }, "");
  refused_beat([](QuadBeat& b) { b.index[0] = 0; }, "");
  // After all that the right one is taken, and gives what it should.
  REQUIRE(put(model, HALFSPACE_QUAD_BEAT, beats[first + 1]) == HALFSPACE_OK);
  CHECK_FALSE(take(model, HALFSPACE_TESTED_BEAT).empty());
  // More beats than a tile has.
  QuadBeat endless = beat(begin);
  endless.last = 0;
  for (int i = 0; i < 3; ++i) {
    REQUIRE(put(model, HALFSPACE_QUAD_BEAT, join(widths, endless)) == HALFSPACE_OK);
  }
  refused(HALFSPACE_QUAD_BEAT, join(widths, endless), "last is 0 in beat 4 of a burst; legal: 1");
}

TEST_CASE("c_api: what early_z demands of a block job is no matter where early_z does not work") {
  const Machine& machine = kMachines[0];
  const Model model = make_model(machine, {HALFSPACE_TILE_JOB});
  BlockJob job{.slot = 9, .block_x = 511, .block_y = 511, .x_first = 8, .x_last = 8, .tiles = 2};
  job.e = {-1000, 5000, 1 << 20};
  job.a = {300, -40, 7};
  REQUIRE(put(model, HALFSPACE_BLOCK_JOB, join(machine.widths, job)) == HALFSPACE_OK);
  const std::vector<Words> jobs = take(model, HALFSPACE_TILE_JOB);
  REQUIRE(jobs.size() == 1);
  const auto got = unpack<TileJob>(jobs[0], machine.widths);
  CHECK(got.slot == 9);
  CHECK(got.tile_x == 2045);
  CHECK(got.tile_y == 2044);
  CHECK(got.e ==
        std::array<std::int64_t, 3>{-1000 + 8 * 256 * 300, 5000 - 8 * 256 * 40, (1 << 20) + 8 * 256 * 7});
  job.tiles = 1;
  CHECK(put(model, HALFSPACE_BLOCK_JOB, join(machine.widths, job)) == HALFSPACE_REFUSED);
  CHECK(halfspace_pending(model.get(), HALFSPACE_TILE_JOB) == 0);
}

TEST_CASE("c_api: no pattern of bits on any link does harm") {
  Random random(3);
  const int watched = GENERATE(static_cast<int>(HALFSPACE_COVERAGE), static_cast<int>(HALFSPACE_TESTED_BEAT));
  const Model model = make_model(kMachines[0], {watched});
  define_surface(model, DepthFormat::kUnorm24);
  int taken = 0;
  for (int i = 0; i < 200; ++i) {
    const int link = static_cast<int>(random.between(HALFSPACE_TRIANGLE, HALFSPACE_QUAD_BEAT));
    Words words(HALFSPACE_MAX_PACKET_WORDS);
    for (std::uint32_t& word : words) {
      word = static_cast<std::uint32_t>(random.between(0, 0xFFFFFFFF));
    }
    const int status = put(model, link, words);
    if (status != (error(model).empty() ? HALFSPACE_OK : HALFSPACE_REFUSED)) {
      FAIL(status << " " << error(model));
    }
    taken += status == HALFSPACE_OK ? 1 : 0;
    if (halfspace_pending(model.get(), watched) > 100000) {
      REQUIRE(halfspace_reset(model.get()) == HALFSPACE_OK);
    }
  }
  CHECK(taken > 0);
}

TEST_CASE("c_api: nor does a packet with some bits flipped, where all units work") {
  Random random(4);
  const Machine& machine = kMachines[0];
  const DepthFormat format = GENERATE(DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32);
  Reference<8> reference(machine, format, kWidth, kHeight, largest_code(format));
  TriangleSource source(7, kWidth, machine.widths.SubPixelBits);
  for (int i = 0; i < 10; ++i) {
    reference.triangle(source.next(largest_vertex_depth(format)), draw_state(machine, format));
  }
  const Model model = make_model(machine, {HALFSPACE_TESTED_BEAT});
  define_surface(model, format);
  for (const Words& slot : reference.packets.at(HALFSPACE_SLOT)) {
    REQUIRE(put(model, HALFSPACE_SLOT, slot) == HALFSPACE_OK);
  }
  int refused = 0;
  int taken = 0;
  for (int i = 0; i < 3000; ++i) {
    const int link = static_cast<int>(random.between(HALFSPACE_TRIANGLE, HALFSPACE_QUAD_BEAT));
    const std::vector<Words>& packets = reference.packets.at(link);
    Words words = packets[static_cast<std::size_t>(random.between(0, static_cast<int>(packets.size()) - 1))];
    for (std::int64_t flips = random.between(1, 3); flips > 0; --flips) {
      const auto bit = static_cast<std::size_t>(random.between(0, 32 * static_cast<int>(words.size()) - 1));
      words[bit / 32] ^= 1u << bit % 32;
    }
    const int status = put(model, link, words);
    if (status != (error(model).empty() ? HALFSPACE_OK : HALFSPACE_REFUSED)) {
      FAIL(status << " " << error(model));
    }
    ++(status == HALFSPACE_OK ? taken : refused);
    if (i % 100 == 0) {
      static_cast<void>(take(model, HALFSPACE_TESTED_BEAT));
    }
  }
  CHECK(refused > 100);
  CHECK(taken > 100);
}
