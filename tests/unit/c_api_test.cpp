/// The C API: are its packets those of the C++ units, from every link on?
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "c_api_fixture.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

template <int TileSize>
void check_from(const Machine& machine, const Reference<TileSize>& reference, DepthFormat format, int from,
                int to) {
  CAPTURE(from, to, static_cast<int>(format), TileSize);
  const Model model = make_model(machine, {to});
  define_surface(model, format);
  std::size_t next_slot = 0;
  const auto slot_lsb = halfspace_packet_bits(model.get(), HALFSPACE_SLOT) - 8;
  const std::vector<Words>& slots = reference.packets.at(HALFSPACE_SLOT);
  const auto slot_of = [&](const Words& words, int lsb) { return extract_bits(words, lsb, 8); };
  std::uint64_t last_slot = 256;
  for (const Words& words : reference.packets.at(from)) {
    if (from > HALFSPACE_SLOT) {  // as the RTL: a triangle's slot is written before its first packet
      const std::uint64_t slot = slot_of(words, halfspace_packet_bits(model.get(), from) - 8);
      if (slot != last_slot) {
        do {
          REQUIRE(put(model, HALFSPACE_SLOT, slots.at(next_slot)) == HALFSPACE_OK);
        } while (slot_of(slots[next_slot++], slot_lsb) != slot);
        while (next_slot < slots.size() && slot_of(slots[next_slot], slot_lsb) == slot) {
          REQUIRE(put(model, HALFSPACE_SLOT, slots[next_slot++]) == HALFSPACE_OK);
        }
        last_slot = slot;
      }
    }
    if (put(model, from, words) != HALFSPACE_OK) {
      FAIL(error(model));
    }
  }
  const std::vector<Words> got = take(model, to);
  const std::vector<Words>& want = reference.packets.at(to);
  REQUIRE(got.size() == want.size());
  CHECK(got == want);
  if (to == HALFSPACE_TESTED_BEAT && format != DepthFormat::kNone) {
    bool same = true;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        std::uint32_t code = 0;
        same = same && halfspace_read_depth(model.get(), kFirstTile, x, y, &code) == HALFSPACE_OK &&
               code == reference.depth(x, y);
      }
    }
    CHECK(same);
  }
}

template <int TileSize>
void check_random(const Machine& machine, DepthFormat format) {
  Reference<TileSize> reference(machine, format, kWidth, kHeight, largest_code(format));
  TriangleSource source(5, kWidth, machine.widths.SubPixelBits);
  DrawStatePacket draw = draw_state(machine, format);
  for (int i = 0; i < 30; ++i) {
    if (i % 5 == 0) {
      draw.func = static_cast<std::uint8_t>(source.integer(0, 7));
      draw.write = static_cast<std::uint8_t>(source.integer(0, 1));
      draw.test = format == DepthFormat::kNone ? 0 : static_cast<std::uint8_t>(source.integer(0, 5) != 0);
      draw.fill_rule = static_cast<std::uint8_t>(source.integer(0, 3));
      draw.front_positive_area = static_cast<std::uint8_t>(source.integer(0, 1));
      draw.cull_front = static_cast<std::uint8_t>(source.integer(0, 3) == 0);
      draw.cull_back = static_cast<std::uint8_t>(source.integer(0, 3) == 0);
    }
    draw.empty = i % 10 == 7 ? 1 : 0;
    ScreenTriangle triangle = source.next(largest_vertex_depth(format));
    if (i % 2 == 0) {  // a flat side through samples: the rules for top, left and bottom decide
      triangle.v[0].y = triangle.v[1].y = (source.integer(0, kHeight) << machine.widths.SubPixelBits) +
                                          (1 << (machine.widths.SubPixelBits - 1));
    }
    reference.triangle(triangle, draw);
  }
  for (int to = HALFSPACE_SETUP_TRIANGLE; to < HALFSPACE_LINKS; ++to) {
    check_from(machine, reference, format, HALFSPACE_TRIANGLE, to);
  }
  check_from(machine, reference, format, HALFSPACE_SETUP_TRIANGLE, HALFSPACE_SLOT);
  check_from(machine, reference, format, HALFSPACE_SETUP_TRIANGLE, HALFSPACE_TESTED_BEAT);
}

template <int TileSize>
void check_late_start(const Machine& machine, DepthFormat format) {
  Reference<TileSize> reference(machine, format, kWidth, kHeight, largest_code(format));
  TriangleSource source(6, kWidth, machine.widths.SubPixelBits);
  const DrawStatePacket draw = draw_state(machine, format);
  for (int i = 0; i < 20; ++i) {
    ScreenTriangle triangle;
    const int extent = 100 << machine.widths.SubPixelBits;
    for (ScreenVertex& v : triangle.v) {  // each with samples: see how check_from follows the slots
      v = {source.integer(0, extent), source.integer(0, extent),
           static_cast<std::uint32_t>(source.integer(0, static_cast<int>(largest_vertex_depth(format))))};
    }
    reference.triangle(triangle, draw);
  }
  for (int to = HALFSPACE_TILE_JOB; to < HALFSPACE_LINKS; ++to) {
    check_from(machine, reference, format, HALFSPACE_BLOCK_JOB, to);
  }
  check_from(machine, reference, format, HALFSPACE_TILE_JOB, HALFSPACE_COVERAGE);
  check_from(machine, reference, format, HALFSPACE_TILE_JOB, HALFSPACE_TESTED_BEAT);
  check_from(machine, reference, format, HALFSPACE_COVERAGE, HALFSPACE_QUAD_BEAT);
  check_from(machine, reference, format, HALFSPACE_COVERAGE, HALFSPACE_TESTED_BEAT);
  check_from(machine, reference, format, HALFSPACE_QUAD_BEAT, HALFSPACE_TESTED_BEAT);
}

template <class Check>
void for_each_machine(Check&& check) {
  for (const Machine& machine : kMachines) {
    for (const DepthFormat format :
         {DepthFormat::kNone, DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32}) {
      check(machine, format);
    }
  }
}

}  // namespace

TEST_CASE("c_api: packets have the sizes of the packed structs, and fit the words that are promised") {
  const int tile_size = GENERATE(4, 8, 16);
  const int row_tiles = GENERATE(2, 4, 8);
  const int width = GENERATE(1, 2, 4, 8, 16);
  const int bits = GENERATE(4, 8);
  if (width > tile_size * tile_size / 4 || tile_size * row_tiles > 64) {
    return;
  }
  const Widths w{.SubPixelBits = bits,
                 .BlockSize = tile_size * row_tiles,
                 .TileSize = tile_size,
                 .QuadWidth = width,
                 .TestWidth = width,
                 .ZParts = 2};
  const Model model = make_model({w, true}, {});
  const std::array<int, HALFSPACE_LINKS> want = {
      packed_bits<ScreenTrianglePacket>(w) + packed_bits<DrawStatePacket>(w),
      packed_bits<SetupTrianglePacket>(w) + packed_bits<DepthEquationPacket>(w) +
          packed_bits<DrawStatePacket>(w),
      8 + packed_bits<DepthEquationPacket>(w) + packed_bits<DrawStatePacket>(w),
      packed_bits<BlockJob>(w),
      packed_bits<TileJob>(w),
      packed_bits<Coverage>(w),
      packed_bits<QuadBeat>(w),
      packed_bits<TestedBeat>(w)};
  for (int link = 0; link < HALFSPACE_LINKS; ++link) {
    CHECK(halfspace_packet_bits(model.get(), link) == want[static_cast<std::size_t>(link)]);
    CHECK(want[static_cast<std::size_t>(link)] <= 32 * HALFSPACE_MAX_PACKET_WORDS);
  }
}

TEST_CASE("c_api: triangles give the packets of the C++ units on every link") {
  for_each_machine([](const Machine& machine, DepthFormat format) {
    switch (machine.widths.TileSize) {
      case 4:
        return check_random<4>(machine, format);
      case 8:
        return check_random<8>(machine, format);
      default:
        return check_random<16>(machine, format);
    }
  });
}

TEST_CASE("c_api: so do packets of later links") {
  for_each_machine([](const Machine& machine, DepthFormat format) {
    switch (machine.widths.TileSize) {
      case 4:
        return check_late_start<4>(machine, format);
      case 8:
        return check_late_start<8>(machine, format);
      default:
        return check_late_start<16>(machine, format);
    }
  });
}

TEST_CASE("c_api: check compares packet by packet and names link, packet and fields") {
  const Machine& machine = kMachines[0];
  const Model model = make_model(machine, {HALFSPACE_COVERAGE});
  const int bits = halfspace_packet_bits(model.get(), HALFSPACE_COVERAGE);
  std::vector<Words> want;
  for (std::uint8_t slot = 0; slot < 4; ++slot) {
    TileJob job = some_job();
    job.slot = slot;
    REQUIRE(put(model, HALFSPACE_TILE_JOB, join(machine.widths, job)) == HALFSPACE_OK);
    want.push_back(join(machine.widths, edge_evaluator<8>(job, 8)));
  }
  CHECK(halfspace_pending(model.get(), HALFSPACE_COVERAGE) == 4);
  const auto check = [&](const Words& words) {
    return halfspace_check(model.get(), HALFSPACE_COVERAGE, words.data(), bits);
  };
  Words dirty = want[0];
  dirty.back() |= 0xF0000000u;  // above the packet's 196 bits
  CHECK(check(dirty) == HALFSPACE_OK);
  CHECK(error(model).empty());
  Words wrong = want[1];
  wrong[0] ^= 1u;
  CHECK(check(wrong) == HALFSPACE_DIFFERENT);
  CHECK_THAT(error(model),
             Catch::Contains("coverage packet 1: mask: expected 0x") && Catch::Contains(", got 0x"));
  CHECK(check(want[1]) == HALFSPACE_DIFFERENT);  // comes late: nothing is taken for it
  CHECK(error(model) ==
        "coverage packet 1 came a second time, in the place of packet 2: slot: expected 0x2, got 0x1");
  CHECK(halfspace_pending(model.get(), HALFSPACE_COVERAGE) == 2);
  CHECK(check(want[3]) == HALFSPACE_DIFFERENT);
  CHECK(error(model) ==
        "coverage packet 2 is missing, packet 3 came in its place: slot: expected 0x2, got 0x3");
  CHECK(halfspace_pending(model.get(), HALFSPACE_COVERAGE) == 0);
  CHECK(check(want[3]) == HALFSPACE_DIFFERENT);
  CHECK(error(model) == "coverage packet 3 came a second time, but none is expected");
  CHECK(check(want[2]) == HALFSPACE_DIFFERENT);
  CHECK(error(model) == "coverage packet 4 came, but none is expected");
  REQUIRE(put(model, HALFSPACE_TILE_JOB, join(machine.widths, some_job())) == HALFSPACE_OK);
  CHECK(check(want[3]) == HALFSPACE_OK);
  CHECK(halfspace_get(model.get(), HALFSPACE_COVERAGE, wrong.data(), bits) == HALFSPACE_NONE);
}

TEST_CASE("c_api: a thin line leaves setup as line_setup makes it") {
  const Machine& machine = kMachines[0];
  const DepthFormat format = DepthFormat::kNone;
  const Model model = make_model(machine, {HALFSPACE_SETUP_TRIANGLE});
  const DrawStatePacket draw = draw_state(machine, format);
  SetupState state = setup_state(draw, machine.widths.SubPixelBits, machine.interpolator);
  for (const LineRule rule :
       {LineRule::kBresenham, LineRule::kDiamondExit, LineRule::kMidpoint, LineRule::kDda}) {
    state.line_rule = rule;
    state.line_width = 3;
    const ScreenTriangle line{.v = {ScreenVertex{.x = 100, .y = 900}, ScreenVertex{.x = 3000, .y = 2100},
                                    ScreenVertex{.x = 100, .y = 900}},
                              .shape = ScreenShape::kThinLine};
    SetupTriangle expected;
    REQUIRE(setup(line, state, expected) == SetupVerdict::kDrawn);
    REQUIRE(put(model, HALFSPACE_TRIANGLE, join(machine.widths, to_packet(line, state), draw)) ==
            HALFSPACE_OK);
    CHECK(take(model, HALFSPACE_SETUP_TRIANGLE) ==
          std::vector<Words>{join(machine.widths, to_packet(expected, machine.walker()),
                                  to_packet(expected, format, machine.interpolator), draw)});
  }
}

TEST_CASE("c_api: reset forgets packets, bursts and slots, and keeps surfaces") {
  const Machine& machine = kMachines[0];
  const DepthFormat format = DepthFormat::kUnorm16;
  const Model model = make_model(machine, {HALFSPACE_TILE_JOB, HALFSPACE_TESTED_BEAT});
  define_surface(model, format);
  const ScreenTriangle triangle = {
      {ScreenVertex{0, 0, 1 << 20}, ScreenVertex{0, 9000, 1 << 20}, ScreenVertex{9000, 0, 1 << 20}}, 0};
  const Words words = join(machine.widths, to_packet(triangle, {}), draw_state(machine, format));
  REQUIRE(put(model, HALFSPACE_TRIANGLE, words) == HALFSPACE_OK);
  const std::vector<Words> first = take(model, HALFSPACE_TILE_JOB);
  REQUIRE_FALSE(first.empty());
  REQUIRE(put(model, HALFSPACE_TRIANGLE, words) == HALFSPACE_OK);
  CHECK(take(model, HALFSPACE_TILE_JOB) != first);  // another slot
  REQUIRE(halfspace_reset(model.get()) == HALFSPACE_OK);
  CHECK(halfspace_pending(model.get(), HALFSPACE_TESTED_BEAT) == 0);
  std::uint32_t code = 0;
  REQUIRE(halfspace_read_depth(model.get(), kFirstTile, 2, 2, &code) == HALFSPACE_OK);
  CHECK(code == (1u << 20) >> vertex_depth_fraction(format));
  REQUIRE(halfspace_clear_surface(model.get(), kFirstTile, 9) == HALFSPACE_OK);
  REQUIRE(halfspace_write_depth(model.get(), kFirstTile, kWidth - 1, kHeight - 1, 10) == HALFSPACE_OK);
  REQUIRE(halfspace_read_depth(model.get(), kFirstTile, 2, 2, &code) == HALFSPACE_OK);
  CHECK(code == 9);
  REQUIRE(halfspace_read_depth(model.get(), kFirstTile, kWidth - 1, kHeight - 1, &code) == HALFSPACE_OK);
  CHECK(code == 10);
  REQUIRE(put(model, HALFSPACE_TRIANGLE, words) == HALFSPACE_OK);
  CHECK(take(model, HALFSPACE_TILE_JOB) == first);
}

TEST_CASE("c_api: configuration by text, file and assignment; fixed by the first other call") {
  const Model model(halfspace_create());
  REQUIRE(halfspace_configure(model.get(), "[tile_walker]\ntile_size = 4\n") == HALFSPACE_OK);
  REQUIRE(halfspace_set(model.get(), "raster.sub_pixel_bits=5") == HALFSPACE_OK);
  CHECK(halfspace_packet_bits(model.get(), HALFSPACE_COVERAGE) ==
        packed_bits<Coverage>(Widths{.SubPixelBits = 5, .TileSize = 4}));
  CHECK(halfspace_set(model.get(), "tile_walker.tile_size=8") == HALFSPACE_REFUSED);
  CHECK_THAT(error(model), Catch::Contains("the configuration is fixed"));
  CHECK(halfspace_configure(model.get(), "") == HALFSPACE_REFUSED);
  CHECK(halfspace_configure_file(model.get(), "machine.toml") == HALFSPACE_REFUSED);
  CHECK(halfspace_abi_version() == HALFSPACE_ABI_VERSION);
  CHECK_THAT(halfspace_version(), Catch::Matches("[0-9]+\\.[0-9]+\\.[0-9]+"));
  CHECK(std::string(halfspace_link_name(HALFSPACE_TESTED_BEAT)) == "tested_beat");
  CHECK(std::string(halfspace_link_name(-1)) == "?");
  CHECK(std::string(halfspace_link_name(HALFSPACE_LINKS)) == "?");
}
