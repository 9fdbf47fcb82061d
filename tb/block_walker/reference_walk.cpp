#include "reference_walk.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "halfspace/machine/tile_size.hpp"
#include "halfspace/units/block_walker.hpp"
#include "halfspace/units/packing.hpp"

namespace halfspace::tb {
namespace {

/// The packet has E and the plane at the first pixel of the first block of the bounds.
SetupTriangle to_model(const SetupTrianglePacket& packet, const BlockWalkerParameters& parameters) {
  const WalkSizes& sizes = parameters.sizes;
  SetupTriangle triangle;
  triangle.bounds = {packet.x_first, packet.y_first, packet.x_last, packet.y_last};
  const std::int64_t x = packet.x_first / sizes.block_size * sizes.block_size;
  const std::int64_t y = packet.y_first / sizes.block_size * sizes.block_size;
  for (std::size_t i = 0; i < 3; ++i) {
    Edge& edge = triangle.edge[i];
    edge.a = packet.a[i];
    edge.b = packet.b[i];
    edge.c = packet.e[i] - ((edge.a * x + edge.b * y) << sizes.sub_pixel_bits);
  }
  if (parameters.hi_z) {
    triangle.plane = {.z = packet.z - packet.z_dx * x - packet.z_dy * y,
                      .dx = packet.z_dx,
                      .dy = packet.z_dy,
                      .known = packet.z_known != 0};
  }
  return triangle;
}

/// What the unit tells, as steps.
class StepSink {
 public:
  StepSink(const BlockWalkerParameters& parameters, const SetupTriangle& triangle,
           std::vector<BlockStep>& steps)
      : parameters_(parameters), triangle_(triangle), steps_(steps) {
    const PixelRect& bounds = triangle.bounds;
    const int block = parameters.sizes.block_size;
    const int most = parameters.sizes.row_tiles();
    const auto is_short = [&](int first, int last) {
      return first / block == last / block && last - first < most;
    };
    wide_ = bounds.x_first / block != bounds.x_last / block;
    tall_ = bounds.y_first / block != bounds.y_last / block;
    few_samples_ = parameters.sample_reject && is_short(bounds.x_first, bounds.x_last) &&
                   is_short(bounds.y_first, bounds.y_last);
  }

  void block(const BlockJob& job, std::uint64_t touched) {
    BlockStep step{.job = job, .touched = touched, .few_samples = few_samples_, .wide = wide_, .tall = tall_};
    std::uint64_t left = touched;
    for (std::size_t i = 0; i < 3; ++i) {
      test(i, step);
      left &= ~(parameters_.trivial_reject ? step.outside[i] : 0);
    }
    if ((few_samples_ ? covered(step) : left) != job.tiles) {
      throw std::logic_error("block_walker.hpp and the samples of a tile say different things");
    }
    steps_.push_back(step);
  }
  void pass(const GridPlace& /*cell*/, int /*side*/) {
    BlockStep step{.job = {}, .wide = wide_, .tall = tall_, .pass = true};
    for (std::size_t i = 0; i < 3; ++i) {
      step.job.a[i] = triangle_.edge[i].a;
      step.job.b[i] = triangle_.edge[i].b;
    }
    steps_.push_back(step);
  }

 private:
  /// The tiles that hold a covered sample of the bounds.
  [[nodiscard]] std::uint64_t covered(const BlockStep& step) const {
    const WalkSizes& sizes = parameters_.sizes;
    const BlockJob& job = step.job;
    std::uint64_t tiles = 0;
    for (std::int64_t y = job.y_first; y <= job.y_last; ++y) {
      for (std::int64_t x = job.x_first; x <= job.x_last; ++x) {
        bool inside = true;
        for (std::size_t i = 0; i < 3; ++i) {
          inside = inside && job.e[i] + ((job.a[i] * x + job.b[i] * y) << sizes.sub_pixel_bits) >= 0;
        }
        const std::int64_t tile = y / sizes.tile_size * sizes.row_tiles() + x / sizes.tile_size;
        tiles |= std::uint64_t{inside} << tile;
      }
    }
    return tiles;
  }

  /// Edge i, at the four corner samples of every tile; where a pixel has several, at the corners of their
  /// box.
  void test(std::size_t i, BlockStep& step) const {
    const WalkSizes& sizes = parameters_.sizes;
    const int row_tiles = sizes.row_tiles();
    const SamplePattern samples = sizes.pattern();
    const auto [x_least, x_most] = std::ranges::minmax(samples.positions(), {}, &SamplePosition::x);
    const auto [y_least, y_most] = std::ranges::minmax(samples.positions(), {}, &SamplePosition::y);
    const std::int64_t one = std::int64_t{1} << sizes.sub_pixel_bits;
    // At a place of a pixel, in sixteenths; E of the job is at its centre.
    const auto at_place = [&](std::int64_t x, std::int64_t y, int in_x, int in_y) {
      return step.job.e[i] + step.job.a[i] * (x * one + (in_x - 8) * one / 16) +
             step.job.b[i] * (y * one + (in_y - 8) * one / 16);
    };
    const auto at = [&, left = x_least.x, right = x_most.x, top = y_least.y, bottom = y_most.y](
                        std::int64_t x, std::int64_t y) {
      return std::minmax({at_place(x, y, left, top), at_place(x, y, right, top), at_place(x, y, left, bottom),
                          at_place(x, y, right, bottom)});
    };
    const std::int64_t across = sizes.tile_size - 1;
    for (std::uint64_t left = step.touched; left != 0; left &= left - 1) {
      const int tile = std::countr_zero(left);
      const std::int64_t x = tile % row_tiles * sizes.tile_size;
      const std::int64_t y = tile / row_tiles * sizes.tile_size;
      const std::array corners{at(x, y), at(x + across, y), at(x, y + across), at(x + across, y + across)};
      const auto is_outside = [](const auto& corner) { return corner.second < 0; };
      const auto is_inside = [](const auto& corner) { return corner.first >= 0; };
      step.outside[i] |= std::uint64_t{std::ranges::all_of(corners, is_outside)} << tile;
      step.inside[i] |= std::uint64_t{std::ranges::all_of(corners, is_inside)} << tile;
    }
  }

  const BlockWalkerParameters& parameters_;
  const SetupTriangle& triangle_;
  std::vector<BlockStep>& steps_;
  bool few_samples_ = false;
  bool wide_ = false;
  bool tall_ = false;
};

}  // namespace

InputWords::InputWords(const Widths& widths)
    : triangle(words_for(packed_bits<SetupTrianglePacket>(widths))),
      equation(words_for(packed_bits<DepthEquationPacket>(widths))),
      state(words_for(packed_bits<DrawStatePacket>(widths))) {}

std::vector<BlockStep> reference_walk(std::span<const std::uint32_t> triangle, std::uint8_t slot,
                                      const BlockWalkerParameters& parameters) {
  const SetupTriangle model =
      to_model(unpack<SetupTrianglePacket>(triangle, parameters.sizes.widths()), parameters);
  std::vector<BlockStep> steps;
  StepSink sink(parameters, model, steps);
  with_tile_size(parameters.sizes.tile_size,
                 [&](auto size) { block_walker<size()>(model, parameters.walker(), slot, sink); });
  return steps;
}

}  // namespace halfspace::tb
