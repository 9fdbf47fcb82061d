#include "halfspace/c_api/unit_chain.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "halfspace/c_api/input_checks.hpp"
#include "halfspace/machine/passage/block_walker.hpp"
#include "halfspace/machine/passage/edge_evaluator.hpp"
#include "halfspace/machine/passage/quad_generator.hpp"
#include "halfspace/machine/passage/setup.hpp"
#include "halfspace/machine/passage/tile_walker.hpp"
#include "halfspace/machine/passage/z_test.hpp"
#include "halfspace/machine/tile_size.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/units/quad_beats.hpp"

namespace halfspace::c_api {
namespace {

/// What early_z keeps of a triangle: all that the interpolator uses.
struct Slot {
  SetupTriangle triangle;
  DrawStatePacket draw;
};

SetupTriangle depth_part(const DepthEquationPacket& equation) {
  SetupTriangle triangle;
  triangle.edge[1] = {.a = equation.a[0], .b = equation.b[0]};
  triangle.edge[2] = {.a = equation.a[1], .b = equation.b[1]};
  triangle.depth.z = equation.z;
  triangle.depth.bias = equation.bias;
  triangle.depth.area2 = equation.area2;
  triangle.depth.reciprocal = equation.reciprocal;
  triangle.depth.shift = equation.shift;
  const auto gradient = [](const std::array<std::uint64_t, 2>& halves) {
    return Modular{halves[1]} << Widths{}.HalfGradientBits | halves[0];
  };
  triangle.depth.plane = {.dx = gradient(equation.dx),
                          .dy = gradient(equation.dy),
                          .z = equation.word,
                          .x = equation.x,
                          .y = equation.y};
  triangle.depth.beyond = equation.beyond != 0;
  triangle.depth.exponent = equation.exponent;
  triangle.depth.offset = equation.offset;
  triangle.depth.min_code = equation.min_code;
  triangle.depth.max_code = equation.max_code;
  return triangle;
}

/// The units' view of a draw. Whatever leaves early_z has its depth, as where quads are recorded.
DrawContext draw_context(const DrawStatePacket& packet, const ChainContext& context) {
  DrawContext draw;
  draw.setup = setup_state(packet, context.widths.SubPixelBits, context.interpolator);
  draw.early_z = early_z_state(packet, context.widths.SubPixelBits, context.interpolator);
  draw.record_quads = true;
  return draw;
}

template <int TileSize>
class Chain final : public UnitChain {
 public:
  explicit Chain(ChainContext& context)
      : context_(context), widths_(context.widths), walker_(context.walker), slots_(256) {
    any_draw_.setup.sub_pixel_bits = widths_.SubPixelBits;
  }

  void put(LinkId link, std::span<const std::uint32_t> words) override {
    switch (link) {
      case LinkId::kTriangle:
        std::apply([&](const auto&... packets) { triangle(packets...); },
                   TriangleLink::unpack(widths_, words));
        return;
      case LinkId::kSetupTriangle:
        std::apply([&](const auto&... packets) { setup_triangle(packets...); },
                   SetupTriangleLink::unpack(widths_, words));
        return;
      case LinkId::kSlot:
        std::apply([&](const auto&... packets) { slot(packets...); }, SlotLink::unpack(widths_, words));
        return;
      case LinkId::kBlockJob:
        block_job(unpack<BlockJob>(words, widths_));
        return;
      case LinkId::kTileJob:
        // Whether the tile is whole matters to counters alone.
        evaluate(unpack<TileJob>(words, widths_), false);
        return;
      case LinkId::kCoverage:
        covered(unpack<Coverage>(words, widths_));
        return;
      case LinkId::kQuadBeat:
        beat(unpack<QuadBeat>(words, widths_));
        return;
      case LinkId::kTestedBeat:
        return;
    }
  }

  void reset() override {
    walker_.reset();
    slots_.assign(slots_.size(), std::nullopt);
    burst_.clear();
  }

 private:
  template <class Layout, class... Packets>
  void emit(LinkId link, const Packets&... packets) {
    if (!context_.watched[static_cast<std::size_t>(link)]) {
      return;
    }
    std::array<std::uint32_t, HALFSPACE_MAX_PACKET_WORDS> storage;
    ExpectedPackets& expected = context_.expected[static_cast<std::size_t>(link)];
    const std::span<std::uint32_t> words = std::span(storage).first(expected.packet_words());
    Layout::pack(widths_, words, packets...);
    expected.push(words);
  }

  void triangle(const ScreenTrianglePacket& packet, const DrawStatePacket& draw) {
    check_draw(draw);
    check_vertex_depths(packet.z, draw.format, "triangle.z");
    check_vertex_depth(packet.offset, draw.format, "triangle.offset");
    if (draw.empty == 0) {
      check_target(draw, draw.x_last, draw.y_last);
    }
    check_line(packet, draw, barycentric());
    DrawContext context = draw_context(draw, context_);
    const ScreenTriangle in = screen_triangle(packet, context.setup);
    SetupTriangle out;
    if (!passage::setup(in, context, out)) {
      return;
    }
    const DepthEquationPacket equation = to_packet(out, context.setup.depth_format, context_.interpolator);
    emit<SetupTriangleLink>(LinkId::kSetupTriangle, to_packet(out, context_.walker), equation, draw);
    walk(out, equation, draw);
  }

  void setup_triangle(const SetupTrianglePacket& packet, const DepthEquationPacket& equation,
                      const DrawStatePacket& draw) {
    if (!context_.reaches(LinkId::kSlot)) {
      return;
    }
    SetupTriangle in;
    in.bounds = {.x_first = packet.x_first,
                 .y_first = packet.y_first,
                 .x_last = packet.x_last,
                 .y_last = packet.y_last};
    for (std::size_t i = 0; i < 3; ++i) {
      in.edge[i] = {.a = packet.a[i], .b = packet.b[i]};
    }
    // The packet has E where the walk starts, the model at pixel (0, 0): the same way back.
    const SetupTrianglePacket from_zero = to_packet(in, context_.walker);
    for (std::size_t i = 0; i < 3; ++i) {
      in.edge[i].c = packet.e[i] - from_zero.e[i];
    }
    check_walk(packet, in, widths_);
    if (context_.reaches(LinkId::kTestedBeat)) {
      check_kept(equation, draw);
      if (draw.format != 0 && barycentric()) {
        check_equation_of(equation, in);
      }
      check_target(draw, packet.x_last, packet.y_last);
    }
    walk(in, equation, draw);
  }

  void walk(const SetupTriangle& triangle, const DepthEquationPacket& equation, const DrawStatePacket& draw) {
    if (!context_.reaches(LinkId::kSlot)) {
      return;
    }
    const std::uint8_t slot = walker_.slot();
    emit<SlotLink>(LinkId::kSlot, SlotNumber{slot}, equation, draw);
    slots_[slot] = Slot{depth_part(equation), draw};
    walker_.walk<TileSize>(triangle, any_draw_, [this](const BlockJob& block, std::uint32_t) {
      emit<BlockJobLink>(LinkId::kBlockJob, block);
      tiles(block);
    });
  }

  void slot(const SlotNumber& number, const DepthEquationPacket& equation, const DrawStatePacket& draw) {
    if (!context_.reaches(LinkId::kTestedBeat)) {
      return;
    }
    check_kept(equation, draw);
    slots_[number.slot] = Slot{depth_part(equation), draw};
  }

  void block_job(const BlockJob& block) {
    if (!context_.reaches(LinkId::kTileJob)) {
      return;
    }
    check_block(block, widths_);
    if (context_.reaches(LinkId::kTestedBeat)) {
      // All of it before the first tile: a tile that is tested may write depth.
      const Slot& slot = kept(block.slot);
      check_target(slot.draw, block.block_x * widths_.BlockSize + block.x_last,
                   block.block_y * widths_.BlockSize + block.y_last);
      if (slot.draw.format != 0 && barycentric()) {
        check_block_of(block, slot.triangle);
      }
    }
    tiles(block);
  }

  void tiles(const BlockJob& block) {
    if (!context_.reaches(LinkId::kTileJob)) {
      return;
    }
    passage::tile_walker<TileSize>(block, context_.walker, any_draw_, [this](const TileJob& job, bool whole) {
      emit<TileJobLink>(LinkId::kTileJob, job);
      evaluate(job, whole);
    });
  }

  void evaluate(const TileJob& job, bool whole) {
    if (context_.reaches(LinkId::kCoverage)) {
      const Coverage coverage = passage::edge_evaluator<TileSize>(job, whole, any_draw_);
      emit<CoverageLink>(LinkId::kCoverage, coverage);
      covered(coverage);
    }
  }

  void covered(const Coverage& coverage) {
    if (!context_.reaches(LinkId::kQuadBeat)) {
      return;
    }
    if (!any(coverage.mask)) {
      return;
    }
    const Burst burst = passage::quad_generator<TileSize>(coverage, any_draw_);
    for (const QuadBeat& beat : quad_beats<TileSize>(burst.packet, widths_)) {
      emit<QuadBeatLink>(LinkId::kQuadBeat, beat);
    }
    test(burst);
  }

  void test(const Burst& burst) {
    if (!context_.reaches(LinkId::kTestedBeat)) {
      return;
    }
    const Coverage& coverage = burst.packet.coverage;
    const Slot& slot = kept(coverage.slot);
    const DrawStatePacket& draw = slot.draw;
    DrawContext context = draw_context(draw, context_);
    std::uint32_t* stored = nullptr;
    if (context.early_z.test) {
      check_target(draw, coverage.tile_x * TileSize, coverage.tile_y * TileSize);
      stored = context_.surfaces.of_draw(draw).codes.tile(coverage.tile_x, coverage.tile_y);
    }
    TileCodes<TileSize> codes{};
    if (context.early_z.format != DepthFormat::kNone && barycentric()) {
      check_samples(coverage, slot.triangle, widths_);
    }
    const passage::Tested tested = passage::z_test<TileSize>(slot.triangle, burst, context, stored, codes);
    for (const TestedBeat& beat :
         tested_beats<TileSize>(burst.packet, tested.passed, tested.inner, codes, widths_)) {
      emit<TestedBeatLink>(LinkId::kTestedBeat, beat);
    }
  }

  /// A burst is complete with its last beat; it must be the one that quad_generator makes of what it covers.
  void beat(const QuadBeat& next) {
    if (!context_.reaches(LinkId::kTestedBeat)) {
      return;
    }
    const int most = (widths_.TileQuads + widths_.QuadWidth - 1) / widths_.QuadWidth;
    burst_.push_back(next);
    try {
      if (next.last != 0) {
        test(burst_of_beats());
        burst_.clear();
      } else if (std::cmp_equal(burst_.size(), most)) {
        throw InputError(fmt::format("last is 0 in beat {} of a burst; legal: 1, since a tile has {} quads",
                                     most, widths_.TileQuads));
      }
    } catch (const InputError&) {
      burst_.pop_back();
      throw;
    }
  }

  Burst burst_of_beats() {
    Coverage coverage{.slot = burst_[0].slot,
                      .tile_x = burst_[0].tile_x,
                      .tile_y = burst_[0].tile_y,
                      .sure = static_cast<std::uint8_t>(std::ranges::count(burst_[0].sure, 1) != 0 ? 1 : 0),
                      .e = burst_[0].e,
                      .mask = {}};
    for (const QuadBeat& beat : burst_) {
      for (std::size_t i = 0; std::cmp_less(i, widths_.QuadWidth); ++i) {
        const int x = beat.index[i] % (TileSize / 2) * 2;
        const int y = beat.index[i] / (TileSize / 2) * 2;
        const std::uint32_t mask = beat.mask[i];
        set_row<TileSize>(coverage.mask, y, (mask & 3) << x);
        set_row<TileSize>(coverage.mask, y + 1, (mask >> 2) << x);
      }
    }
    Burst burst = passage::quad_generator<TileSize>(coverage, any_draw_);
    const std::vector<QuadBeat> legal = quad_beats<TileSize>(burst.packet, widths_);
    if (legal.size() != burst_.size()) {
      throw InputError(fmt::format("a burst of {} beats; legal: {}, since it has {} quads", burst_.size(),
                                   legal.size(), burst.quads));
    }
    const std::vector<FieldSlot> fields = link_fields(LinkId::kQuadBeat, widths_);
    std::vector<std::uint32_t> want(words_for(link_bits(LinkId::kQuadBeat, widths_)));
    std::vector<std::uint32_t> got(want.size());
    for (std::size_t i = 0; i < legal.size(); ++i) {
      pack(legal[i], widths_, want);
      pack(burst_[i], widths_, got);
      if (want != got) {
        throw InputError(fmt::format("beat {} is not one of a burst as quad_generator makes it: {}", i,
                                     differences(fields, want, got)));
      }
    }
    burst.packet.coverage.sure = 0;  // whether all of it passes is tested
    return burst;
  }

  [[nodiscard]] const Slot& kept(std::uint8_t number) const {
    const std::optional<Slot>& slot = slots_[number];
    if (!slot) {
      throw InputError(fmt::format("slot is {}; legal: one that was put on link {} ({}) before", number,
                                   HALFSPACE_SLOT, link_name(LinkId::kSlot)));
    }
    return *slot;
  }

  [[nodiscard]] bool barycentric() const { return context_.interpolator == DepthInterpolator::kBarycentric; }

  void check_kept(const DepthEquationPacket& equation, const DrawStatePacket& draw) const {
    check_draw(draw);
    if (barycentric()) {
      check_equation(equation, draw);
    } else {
      check_plane(equation, draw);
    }
    if (draw.test != 0) {
      static_cast<void>(context_.surfaces.of_draw(draw));
    }
  }

  /// The pixel lies in a tile of the draw's surface, if early_z is to test there.
  void check_target(const DrawStatePacket& draw, int x, int y) const {
    if (draw.test == 0 || !context_.reaches(LinkId::kTestedBeat)) {
      return;
    }
    const auto& codes = context_.surfaces.of_draw(draw).codes;
    const int columns = codes.tiles_x() * TileSize;
    const int rows = codes.tiles_y() * TileSize;
    if (x >= columns || y >= rows) {
      throw InputError(
          fmt::format("pixel ({}, {}) is outside the depth surface at tile {}; legal: (0, 0) to ({}, {})", x,
                      y, draw.first_tile, columns - 1, rows - 1));
    }
  }

  ChainContext& context_;
  const Widths& widths_;
  passage::BlockWalker walker_;
  DrawContext any_draw_;  ///< for units that do not look at the draw's state
  std::vector<std::optional<Slot>> slots_;
  std::vector<QuadBeat> burst_;  ///< beats that were put, of a burst that is not complete
};

}  // namespace

std::unique_ptr<UnitChain> make_unit_chain(ChainContext& context) {
  return with_tile_size(context.widths.TileSize, [&](auto size) -> std::unique_ptr<UnitChain> {
    return std::make_unique<Chain<size()>>(context);
  });
}

}  // namespace halfspace::c_api
