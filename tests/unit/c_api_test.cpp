/// The C API: are its packets those of the C++ units, from every link on? Is everything refused that must be?
#include "halfspace/c_api/halfspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "../triangles.hpp"
#include "halfspace/config/config.hpp"
#include "halfspace/units/edge_evaluator.hpp"
#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/packing.hpp"
#include "halfspace/units/quad_beats.hpp"
#include "halfspace/units/quad_generator.hpp"
#include "halfspace/units/tile_walker.hpp"
#include "halfspace/units/tiled_image.hpp"
#include "halfspace/units/z_test.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

using Words = std::vector<std::uint32_t>;

struct Destroy {
  void operator()(halfspace_model* model) const { halfspace_destroy(model); }
};
using Model = std::unique_ptr<halfspace_model, Destroy>;

/// A machine, as both sides are told it.
struct Machine {
  Widths widths;
  bool block_level = true;

  [[nodiscard]] WalkerConfig walker() const {
    return {.sub_pixel_bits = widths.SubPixelBits, .block_size = 32, .block_level = block_level};
  }
};

const std::array<Machine, 4> kMachines = {
    Machine{Widths{}, true},
    Machine{Widths{.SubPixelBits = 4, .TileSize = 4, .QuadWidth = 2, .TestWidth = 1, .ZParts = 2}, true},
    Machine{Widths{.SubPixelBits = 6, .TileSize = 16, .QuadWidth = 16, .TestWidth = 16, .ZParts = 4}, false},
    Machine{Widths{.SubPixelBits = 8, .TileSize = 16, .QuadWidth = 8, .TestWidth = 4}, true}};

Model make_model(const Machine& machine, std::initializer_list<int> links) {
  Model model(halfspace_create());
  const Widths& w = machine.widths;
  for (const std::string& setting :
       {fmt::format("raster.sub_pixel_bits={}", w.SubPixelBits),
        fmt::format("tile_walker.tile_size={}", w.TileSize),
        fmt::format("quad_generator.quads_per_cycle={}", w.QuadWidth),
        fmt::format("early_z.quads_per_cycle={}", w.TestWidth), fmt::format("z_cache.parts={}", w.ZParts),
        fmt::format("tile_walker.block_level={}", machine.block_level)}) {
    REQUIRE(halfspace_set(model.get(), setting.c_str()) == HALFSPACE_OK);
  }
  for (const int link : links) {
    REQUIRE(halfspace_watch(model.get(), link) == HALFSPACE_OK);
  }
  return model;
}

/// The structs side by side, the first on top.
template <class... Packets>
Words join(const Widths& widths, const Packets&... packets) {
  int lsb = (packed_bits<Packets>(widths) + ...);
  Words words(words_for(lsb));
  const auto add = [&](const auto& packet) {
    using Packet = std::remove_cvref_t<decltype(packet)>;
    const int bits = packed_bits<Packet>(widths);
    Words part(words_for(bits));
    pack(packet, widths, part);
    lsb -= bits;
    for (int i = 0; i < bits; i += 8) {
      const int size = std::min(8, bits - i);
      insert_bits(words, lsb + i, size, extract_bits(part, i, size));
    }
  };
  (add(packets), ...);
  return words;
}

struct SlotNumber {
  std::uint8_t slot = 0;
  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    visit("slot", &SlotNumber::slot, &Widths::SlotBits, Sign::kUnsigned);
  }
};

int put(const Model& model, int link, const Words& words) {
  return halfspace_put(model.get(), link, words.data(), halfspace_packet_bits(model.get(), link));
}

std::vector<Words> take(const Model& model, int link) {
  std::vector<Words> all;
  const int bits = halfspace_packet_bits(model.get(), link);
  Words words(words_for(bits));
  while (halfspace_get(model.get(), link, words.data(), bits) == HALFSPACE_OK) {
    all.push_back(words);
  }
  return all;
}

std::string error(const Model& model) { return halfspace_error(model.get()); }

/// What the C++ units put on every link.
template <int TileSize>
class Reference {
 public:
  Reference(const Machine& machine, DepthFormat format, int width, int height, std::uint32_t code)
      : machine_(machine), codes_(width, height, TileSize, code), format_(format) {}

  void triangle(const ScreenTriangle& in, const DrawStatePacket& draw) {
    const Widths& widths = machine_.widths;
    packets[HALFSPACE_TRIANGLE].push_back(join(widths, to_packet(in), draw));
    SetupState state{.sub_pixel_bits = widths.SubPixelBits,
                     .front_positive_area = draw.front_positive_area != 0,
                     .cull_front = draw.cull_front != 0,
                     .cull_back = draw.cull_back != 0,
                     .bottom_left_rule = draw.bottom_left_rule != 0,
                     .bounds = {},
                     .depth_format = static_cast<DepthFormat>(draw.format)};
    if (draw.empty == 0) {
      state.bounds = {draw.x_first, draw.y_first, draw.x_last, draw.y_last};
    }
    draw_ = draw;
    if (setup(in, state, triangle_) != SetupVerdict::kDrawn) {
      return;
    }
    const DepthEquationPacket equation = to_packet(triangle_, state.depth_format);
    packets[HALFSPACE_SETUP_TRIANGLE].push_back(
        join(widths, to_packet(triangle_, machine_.walker(), TileSize), equation, draw));
    packets[HALFSPACE_SLOT].push_back(join(widths, SlotNumber{slot_}, equation, draw));
    emitted_ = false;
    tile_walker<TileSize>(triangle_, machine_.walker(), slot_, *this);
    slot_ = static_cast<std::uint8_t>(slot_ + (emitted_ ? 1 : 0));
  }

  void decision(int, int, int, TileVerdict) {}
  void tile(const TileJob& job, TileWork) {
    emitted_ = true;
    packets[HALFSPACE_TILE_JOB].push_back(join(machine_.widths, job));
    const Coverage coverage = edge_evaluator<TileSize>(job, machine_.widths.SubPixelBits);
    packets[HALFSPACE_COVERAGE].push_back(join(machine_.widths, coverage));
    const QuadBurst burst = quad_generator<TileSize>(coverage);
    for (const QuadBeat& beat : quad_beats<TileSize>(burst, machine_.widths)) {
      packets[HALFSPACE_QUAD_BEAT].push_back(join(machine_.widths, beat));
    }
    if (any(coverage.mask)) {
      test(burst);
    }
  }

  std::map<int, std::vector<Words>> packets;
  [[nodiscard]] std::uint32_t depth(int x, int y) const { return codes_.at(x, y); }

 private:
  /// Sample by sample: what each bit and code of the tested beats must be.
  void test(const QuadBurst& burst) {
    const Coverage& coverage = burst.coverage;
    const EarlyZState state{.test = draw_.test != 0,
                            .write = draw_.write != 0,
                            .func = static_cast<DepthFunc>(draw_.func),
                            .format = static_cast<DepthFormat>(draw_.format),
                            .sub_pixel_bits = machine_.widths.SubPixelBits};
    TileCodes<TileSize> codes{};
    if (draw_.format != 0) {
      interpolate_tile<TileSize>(triangle_, burst, state, codes);
    }
    const TileMask passed =
        z_test<TileSize>(triangle_, burst, state, codes_.tile(coverage.tile_x, coverage.tile_y), codes);
    std::vector<Quad> quads;
    for_each_quad<TileSize>(burst, [&](const Quad& quad) { quads.push_back(quad); });
    const auto width = static_cast<std::size_t>(machine_.widths.TestWidth);
    for (std::size_t first = 0; first < quads.size(); first += width) {
      TestedBeat beat{.slot = coverage.slot,
                      .tile_x = coverage.tile_x,
                      .tile_y = coverage.tile_y,
                      .last = first + width >= quads.size()};
      for (std::size_t i = 0; i < width && first + i < quads.size(); ++i) {
        const Quad& quad = quads[first + i];
        beat.index[i] = static_cast<std::uint8_t>((quad.y * TileSize / 4) + quad.x / 2);
        for (int s = 0; s < 4; ++s) {
          const int x = quad.x + (s & 1);
          const int y = quad.y + (s >> 1);
          const bool covered = halfspace::test<TileSize>(coverage.mask, x, y);
          beat.mask[i] = static_cast<std::uint8_t>(beat.mask[i] | (covered ? 1 : 0) << s);
          beat.passed[i] = static_cast<std::uint8_t>(beat.passed[i] |
                                                     (halfspace::test<TileSize>(passed, x, y) ? 1 : 0) << s);
          beat.depth[4 * i + static_cast<std::size_t>(s)] =
              covered && format_ != DepthFormat::kNone ? codes[static_cast<std::size_t>(y * TileSize + x)]
                                                       : 0;
        }
      }
      packets[HALFSPACE_TESTED_BEAT].push_back(join(machine_.widths, beat));
    }
  }

  Machine machine_;
  TiledImage<std::uint32_t> codes_;
  DepthFormat format_;
  DrawStatePacket draw_;
  SetupTriangle triangle_;
  std::uint8_t slot_ = 0;
  bool emitted_ = false;
};

constexpr int kWidth = 200;
constexpr int kHeight = 120;
constexpr std::uint32_t kFirstTile = 77;

DrawStatePacket draw_state(const Machine& machine, DepthFormat format) {
  DrawStatePacket draw;
  draw.x_last = kWidth - 1;
  draw.y_last = kHeight - 1;
  draw.format = static_cast<std::uint8_t>(format);
  draw.test = format == DepthFormat::kNone ? 0 : 1;
  draw.write = 1;
  draw.func = static_cast<std::uint8_t>(DepthFunc::kLequal);
  draw.first_tile = kFirstTile;
  draw.tiles_x = static_cast<std::uint16_t>((kWidth - 1) / machine.widths.TileSize);
  return draw;
}

std::uint32_t one(DepthFormat format) {
  return format == DepthFormat::kFloat32 ? 0x3F800000u : max_unorm_code(format);
}

std::uint32_t largest_vertex_depth(DepthFormat format) {
  return format == DepthFormat::kFloat32 ? 0x3F800000u
         : format == DepthFormat::kNone  ? 0x7FFFFFFFu
                                         : max_unorm_code(format) << vertex_depth_fraction(format);
}

void define_surface(const Model& model, DepthFormat format) {
  if (format != DepthFormat::kNone) {
    REQUIRE(halfspace_define_surface(model.get(), kFirstTile, static_cast<int>(format), kWidth, kHeight,
                                     one(format)) == HALFSPACE_OK);
  }
}

/// Puts what the C++ units have on `from`, and on slot where early_z needs it, and wants what they have on
/// `to`.
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
  Reference<TileSize> reference(machine, format, kWidth, kHeight, one(format));
  TriangleSource source(5, kWidth, machine.widths.SubPixelBits);
  DrawStatePacket draw = draw_state(machine, format);
  for (int i = 0; i < 30; ++i) {
    if (i % 5 == 0) {
      draw.func = static_cast<std::uint8_t>(source.integer(0, 7));
      draw.write = static_cast<std::uint8_t>(source.integer(0, 1));
      draw.test = format == DepthFormat::kNone ? 0 : static_cast<std::uint8_t>(source.integer(0, 5) != 0);
      draw.bottom_left_rule = static_cast<std::uint8_t>(source.integer(0, 1));
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
  Reference<TileSize> reference(machine, format, kWidth, kHeight, one(format));
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

TileJob some_job() {
  TileJob job{.slot = 3, .tile_x = 5, .tile_y = 6, .x_last = 7, .y_last = 7};
  job.e = {-1000, 5000, 1 << 20};
  job.a = {300, -40, 7};
  job.b = {25, 100, -3};
  return job;
}

}  // namespace

TEST_CASE("c_api: packets have the sizes of the packed structs, and fit the words that are promised") {
  for (const int tile_size : {4, 8, 16}) {
    for (const int width : {1, 2, 4, 8, 16}) {
      for (const int bits : {4, 8}) {
        if (width > tile_size * tile_size / 4) {
          continue;
        }
        const Widths w{
            .SubPixelBits = bits, .TileSize = tile_size, .QuadWidth = width, .TestWidth = width, .ZParts = 2};
        const Model model = make_model({w, true}, {});
        const std::array<int, HALFSPACE_LINKS> want = {
            packed_bits<ScreenTrianglePacket>(w) + packed_bits<DrawStatePacket>(w),
            packed_bits<SetupTrianglePacket>(w) + packed_bits<DepthEquationPacket>(w) +
                packed_bits<DrawStatePacket>(w),
            8 + packed_bits<DepthEquationPacket>(w) + packed_bits<DrawStatePacket>(w),
            packed_bits<TileJob>(w),
            packed_bits<Coverage>(w),
            packed_bits<QuadBeat>(w),
            packed_bits<TestedBeat>(w)};
        for (int link = 0; link < HALFSPACE_LINKS; ++link) {
          CHECK(halfspace_packet_bits(model.get(), link) == want[static_cast<std::size_t>(link)]);
          CHECK(want[static_cast<std::size_t>(link)] <= 32 * HALFSPACE_MAX_PACKET_WORDS);
        }
      }
    }
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

TEST_CASE("c_api: reset forgets packets, bursts and slots, and keeps surfaces") {
  const Machine& machine = kMachines[0];
  const DepthFormat format = DepthFormat::kUnorm16;
  const Model model = make_model(machine, {HALFSPACE_TILE_JOB, HALFSPACE_TESTED_BEAT});
  define_surface(model, format);
  const ScreenTriangle triangle = {
      {ScreenVertex{0, 0, 1 << 20}, ScreenVertex{0, 9000, 1 << 20}, ScreenVertex{9000, 0, 1 << 20}}, 0};
  const Words words = join(machine.widths, to_packet(triangle), draw_state(machine, format));
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
  REQUIRE(halfspace_set(model.get(), "tile_walker.block_size=8") == HALFSPACE_OK);
  CHECK(halfspace_packet_bits(model.get(), HALFSPACE_COVERAGE) == HALFSPACE_REFUSED);
  CHECK_THAT(error(model), Catch::Contains("'tile_walker.block_size' is 8"));
  REQUIRE(halfspace_set(model.get(), "tile_walker.block_size=16") == HALFSPACE_OK);
  REQUIRE(halfspace_set(model.get(), "depth.interpolator=plane") == HALFSPACE_OK);
  CHECK(halfspace_watch(model.get(), HALFSPACE_COVERAGE) == HALFSPACE_REFUSED);
  CHECK_THAT(error(model), Catch::Contains("'depth.interpolator' is 'plane'; legal here: barycentric"));
  REQUIRE(halfspace_set(model.get(), "depth.interpolator=barycentric") == HALFSPACE_OK);
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
                                 "a packet of {} bits on link 3 (tile_job); legal: {}", size, bits)));
  }
  CHECK(halfspace_get(model.get(), HALFSPACE_COVERAGE, words, bits) == HALFSPACE_REFUSED);
  CHECK(halfspace_check(model.get(), HALFSPACE_COVERAGE, words, bits) == HALFSPACE_REFUSED);
  for (const int link :
       {-1, static_cast<int>(HALFSPACE_TESTED_BEAT), static_cast<int>(HALFSPACE_LINKS), 1 << 20}) {
    CHECK(halfspace_put(model.get(), link, words, bits) == HALFSPACE_REFUSED);
    CHECK_THAT(error(model), Catch::Contains("legal: 0 (triangle) to 5 (quad_beat)"));
  }
  for (const int link : {-1, static_cast<int>(HALFSPACE_TRIANGLE), static_cast<int>(HALFSPACE_LINKS)}) {
    CHECK(halfspace_watch(model.get(), link) == HALFSPACE_REFUSED);
    CHECK(halfspace_get(model.get(), link, words, bits) == HALFSPACE_REFUSED);
    CHECK(halfspace_pending(model.get(), link) == HALFSPACE_REFUSED);
  }
  CHECK(halfspace_packet_bits(model.get(), HALFSPACE_LINKS) == HALFSPACE_REFUSED);
  CHECK(halfspace_pending(model.get(), HALFSPACE_QUAD_BEAT) == HALFSPACE_REFUSED);
  CHECK_THAT(error(model), Catch::Contains("link 5 (quad_beat) is not watched"));
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

TEST_CASE("c_api: packets outside the contract of a unit are refused, and change nothing") {
  const Machine& machine = kMachines[0];
  const Widths& widths = machine.widths;
  const DepthFormat format = DepthFormat::kUnorm24;
  const Model model = make_model(machine, {HALFSPACE_SETUP_TRIANGLE, HALFSPACE_SLOT, HALFSPACE_TILE_JOB,
                                           HALFSPACE_COVERAGE, HALFSPACE_QUAD_BEAT, HALFSPACE_TESTED_BEAT});
  define_surface(model, format);
  const auto refused = [&](int link, const Words& words, const std::string& why) {
    CAPTURE(link);
    CHECK(put(model, link, words) == HALFSPACE_REFUSED);
    CHECK_THAT(error(model), Catch::Contains(fmt::format("({}): ", halfspace_link_name(link)) + why));
    for (int watched = HALFSPACE_SETUP_TRIANGLE; watched < HALFSPACE_LINKS; ++watched) {
      CHECK(halfspace_pending(model.get(), watched) == 0);
    }
  };

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
  refused_triangle([](auto&, auto& d) { d.format = 0; }, "state.test is 1; legal: 0");
  refused_triangle([](auto&, auto& d) { d.format = 1; },
                   "state.format is 1; legal: 2, the format of the surface at tile 77");
  refused_triangle([](auto&, auto& d) { d.x_first = kWidth; },
                   "state.x_last is 199; legal: at least state.x_first (200)");
  refused_triangle([](auto&, auto& d) { d.y_first = kHeight; }, "state.y_last is 119");
  refused_triangle([](auto& p, auto&) { p.z[1] = 0x7FFFFFFF; },
                   "triangle.z[1] is 0x7fffffff; legal: at most 0x7fffff80");
  refused_triangle([](auto&, auto& d) { d.first_tile = 3; },
                   "state.first_tile is 3, where no depth surface begins; legal: 77");
  refused_triangle([](auto&, auto& d) { d.tiles_x = 3; }, "state.tiles_x is 3; legal: 24");
  refused_triangle([](auto&, auto& d) { d.x_last = 200; }, "pixel (200, 119) is outside the depth surface");
  refused_triangle([](auto&, auto& d) { d.y_last = 16383; },
                   "pixel (199, 16383) is outside the depth surface");

  // A triangle as setup makes it, and how it can be wrong.
  Reference<8> reference(machine, format, kWidth, kHeight, one(format));
  reference.triangle(
      {{ScreenVertex{0, 0, 0}, ScreenVertex{20000, 800, 5}, ScreenVertex{300, 21000, 1 << 30}}, 0}, good);
  const Words set_up = reference.packets.at(HALFSPACE_SETUP_TRIANGLE).at(0);
  const int equation_lsb = packed_bits<DrawStatePacket>(widths);
  const int triangle_lsb = equation_lsb + packed_bits<DepthEquationPacket>(widths);
  const auto change = [&](const Words& words, int lsb, const std::vector<FieldSlot>& fields,
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
  };
  const std::vector<FieldSlot> triangle_fields = field_slots<SetupTrianglePacket>(widths);
  const std::vector<FieldSlot> equation_fields = field_slots<DepthEquationPacket>(widths);
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
  refused_set_up(equation_lsb, equation_fields, "z[0]", 0x7FFFFFFF, "equation.z[0] is 0x7fffffff");

  const Words slot = reference.packets.at(HALFSPACE_SLOT).at(0);
  const Words job = reference.packets.at(HALFSPACE_TILE_JOB).at(0);
  refused(HALFSPACE_TILE_JOB, job, "slot is 0; legal: one that was put on link 2 (slot) before");
  refused(HALFSPACE_SLOT, change(slot, equation_lsb, equation_fields, "shift", 31), "equation.shift is 31");
  REQUIRE(put(model, HALFSPACE_SLOT, slot) == HALFSPACE_OK);

  const std::vector<FieldSlot> job_fields = field_slots<TileJob>(widths);
  refused(HALFSPACE_TILE_JOB, change(job, 0, job_fields, "tile_x", 25),
          "pixel (200, 0) is outside the depth surface");
  refused(HALFSPACE_TILE_JOB, change(job, 0, job_fields, "e[1]", std::uint64_t{1} << 49),
          "mask covers sample (");

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
  Reference<8> reference(machine, format, kWidth, kHeight, one(format));
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
