/// The C API beside the C++ units: models of the same machine, packets as words, and what the units put on
/// every link.
#pragma once

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
#include "halfspace/units/block_walker.hpp"
#include "halfspace/units/edge_evaluator.hpp"
#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/packing.hpp"
#include "halfspace/units/quad_beats.hpp"
#include "halfspace/units/quad_generator.hpp"
#include "halfspace/units/tile_walker.hpp"
#include "halfspace/units/tiled_image.hpp"
#include "halfspace/units/z_test.hpp"

namespace halfspace::testing {

using Words = std::vector<std::uint32_t>;

struct Destroy {
  void operator()(halfspace_model* model) const { halfspace_destroy(model); }
};
using Model = std::unique_ptr<halfspace_model, Destroy>;

/// A machine, as both sides are told it.
struct Machine {
  Widths widths;
  bool trivial_reject = true;
  DepthInterpolator interpolator = DepthInterpolator::kBarycentric;

  [[nodiscard]] WalkerConfig walker() const {
    return {.sub_pixel_bits = widths.SubPixelBits,
            .block_size = widths.BlockSize,
            .trivial_reject = trivial_reject};
  }
};

const std::array<Machine, 4> kMachines = {
    Machine{Widths{}, true},
    Machine{Widths{.SubPixelBits = 4, .TileSize = 4, .QuadWidth = 2, .TestWidth = 1, .ZParts = 2}, true,
            DepthInterpolator::kPlane},
    Machine{Widths{.SubPixelBits = 6,
                   .BlockSize = 64,
                   .TileSize = 16,
                   .QuadWidth = 16,
                   .TestWidth = 16,
                   .ZParts = 4},
            false, DepthInterpolator::kPlane},
    Machine{Widths{.SubPixelBits = 8, .TileSize = 16, .QuadWidth = 8, .TestWidth = 4}, true}};

inline Model make_model(const Machine& machine, std::initializer_list<int> links) {
  Model model(halfspace_create());
  const Widths& w = machine.widths;
  for (const std::string& setting :
       {fmt::format("raster.sub_pixel_bits={}", w.SubPixelBits),
        fmt::format("block_walker.block_size={}", w.BlockSize),
        fmt::format("tile_walker.tile_size={}", w.TileSize),
        fmt::format("quad_generator.quads_per_cycle={}", w.QuadWidth),
        fmt::format("early_z.quads_per_cycle={}", w.TestWidth), fmt::format("z_cache.parts={}", w.ZParts),
        fmt::format("block_walker.trivial_reject={}", machine.trivial_reject),
        fmt::format("depth.interpolator={}",
                    machine.interpolator == DepthInterpolator::kPlane ? "plane" : "barycentric")}) {
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

inline int put(const Model& model, int link, const Words& words) {
  return halfspace_put(model.get(), link, words.data(), halfspace_packet_bits(model.get(), link));
}

inline std::vector<Words> take(const Model& model, int link) {
  std::vector<Words> all;
  const int bits = halfspace_packet_bits(model.get(), link);
  Words words(words_for(bits));
  while (halfspace_get(model.get(), link, words.data(), bits) == HALFSPACE_OK) {
    all.push_back(words);
  }
  return all;
}

inline std::string error(const Model& model) { return halfspace_error(model.get()); }

/// What the C++ units put on every link.
template <int TileSize>
class Reference {
 public:
  Reference(const Machine& machine, DepthFormat format, int width, int height, std::uint32_t code)
      : machine_(machine), codes_(width, height, TileSize, code), format_(format) {}

  void triangle(const ScreenTriangle& in, const DrawStatePacket& draw) {
    const Widths& widths = machine_.widths;
    packets[HALFSPACE_TRIANGLE].push_back(join(widths, to_packet(in, Conservative::kOff), draw));
    SetupState state{.sub_pixel_bits = widths.SubPixelBits,
                     .front_positive_area = draw.front_positive_area != 0,
                     .cull_front = draw.cull_front != 0,
                     .cull_back = draw.cull_back != 0,
                     .fill_rule = static_cast<FillRule>(draw.fill_rule),
                     .bounds = {},
                     .depth_format = static_cast<DepthFormat>(draw.format),
                     .limits = {.least = draw.least_code, .most = draw.most_code},
                     .interpolator = machine_.interpolator};
    if (draw.empty == 0) {
      state.bounds = {draw.x_first, draw.y_first, draw.x_last, draw.y_last};
    }
    draw_ = draw;
    if (setup(in, state, triangle_) != SetupVerdict::kDrawn) {
      return;
    }
    const DepthEquationPacket equation = to_packet(triangle_, state.depth_format, state.interpolator);
    packets[HALFSPACE_SETUP_TRIANGLE].push_back(
        join(widths, to_packet(triangle_, machine_.walker()), equation, draw));
    packets[HALFSPACE_SLOT].push_back(join(widths, SlotNumber{slot_}, equation, draw));
    emitted_ = false;
    block_walker<TileSize>(triangle_, machine_.walker(), slot_, *this);
    slot_ = static_cast<std::uint8_t>(slot_ + (emitted_ ? 1 : 0));
  }

  void block(const BlockJob& job, std::uint64_t /*touched*/) {
    if (job.tiles == 0) {
      return;
    }
    emitted_ = true;
    packets[HALFSPACE_BLOCK_JOB].push_back(join(machine_.widths, job));
    tile_walker<TileSize>(job, machine_.walker(), *this);
  }
  static void pass() {}
  void tile(const TileJob& job, bool /*whole*/) {
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
                            .interpolator = machine_.interpolator,
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

inline DrawStatePacket draw_state(const Machine& machine, DepthFormat format) {
  DrawStatePacket draw;
  draw.x_last = kWidth - 1;
  draw.y_last = kHeight - 1;
  draw.format = static_cast<std::uint8_t>(format);
  draw.most_code = largest_code(format);
  draw.test = format == DepthFormat::kNone ? 0 : 1;
  draw.write = 1;
  draw.func = static_cast<std::uint8_t>(DepthFunc::kLequal);
  draw.first_tile = kFirstTile;
  draw.tiles_x = static_cast<std::uint16_t>((kWidth - 1) / machine.widths.TileSize);
  return draw;
}

inline std::uint32_t largest_vertex_depth(DepthFormat format) {
  return format == DepthFormat::kNone
             ? 0x7FFFFFFFu
             : static_cast<std::uint32_t>(vertex_depth_of_code(format, largest_code(format)));
}

inline void define_surface(const Model& model, DepthFormat format) {
  if (format != DepthFormat::kNone) {
    REQUIRE(halfspace_define_surface(model.get(), kFirstTile, static_cast<int>(format), kWidth, kHeight,
                                     largest_code(format)) == HALFSPACE_OK);
  }
}

/// Puts what the C++ units have on `from`, and on slot where early_z needs it, and wants what they have on
/// `to`.

inline TileJob some_job() {
  TileJob job{.slot = 3, .tile_x = 5, .tile_y = 6, .x_last = 7, .y_last = 7};
  job.e = {-1000, 5000, 1 << 20};
  job.a = {300, -40, 7};
  job.b = {25, 100, -3};
  return job;
}

}  // namespace halfspace::testing
