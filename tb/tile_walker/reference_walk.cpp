#include "reference_walk.hpp"

#include <array>

#include "halfspace/machine/tile_size.hpp"
#include "halfspace/units/packing.hpp"

namespace halfspace::tb {
namespace {

struct Pixel {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

bool fits_one_tile(const PixelRect& bounds, int tile_size) {
  return bounds.x_first / tile_size == bounds.x_last / tile_size &&
         bounds.y_first / tile_size == bounds.y_last / tile_size;
}

/// The first pixel of the first square of the walk.
Pixel start_of(const PixelRect& bounds, const WalkerParameters& parameters) {
  const bool tiles_only = !parameters.block_level || fits_one_tile(bounds, parameters.tile_size);
  const int size = tiles_only ? parameters.tile_size : parameters.block_size;
  return {bounds.x_first / size * size, bounds.y_first / size * size};
}

/// E at a pixel, less E at the centre of pixel (0, 0).
std::int64_t moved(const Edge& edge, const Pixel& pixel, int sub_pixel_bits) {
  return (edge.a * pixel.x + edge.b * pixel.y) << sub_pixel_bits;
}

SetupTriangle to_model(const SetupTrianglePacket& packet, const WalkerParameters& parameters) {
  SetupTriangle triangle;
  triangle.bounds = {packet.x_first, packet.y_first, packet.x_last, packet.y_last};
  const Pixel start = start_of(triangle.bounds, parameters);
  for (std::size_t i = 0; i < 3; ++i) {
    Edge& edge = triangle.edge[i];
    edge.a = packet.a[i];
    edge.b = packet.b[i];
    edge.c = packet.e[i] - moved(edge, start, parameters.sub_pixel_bits);
  }
  return triangle;
}

/// What TileWalker tells, as steps.
class StepSink {
 public:
  StepSink(const SetupTriangle& triangle, const WalkerParameters& parameters, Walk& walk)
      : triangle_(triangle), parameters_(parameters), walk_(walk) {}

  void decision(int x, int y, int size, TileVerdict verdict) {
    const bool block = size != parameters_.tile_size;
    const auto kind = [&](StepKind of_block, StepKind of_tile) { return block ? of_block : of_tile; };
    switch (verdict) {
      case TileVerdict::kReject:
        walk_.steps.push_back(
            {kind(StepKind::kBlockReject, StepKind::kTileReject), tested(x, y, size).rejecting});
        break;
      case TileVerdict::kAccept:
        walk_.steps.push_back({kind(StepKind::kBlockAccept, StepKind::kTileAccept), 7});
        break;
      case TileVerdict::kPartial:
        walk_.steps.push_back(
            {kind(StepKind::kBlockPartial, StepKind::kTilePartial), tested(x, y, size).undecided});
        break;
    }
  }
  void tile(const TileJob& job, TileWork work) {
    if (work == TileWork::kWholeByBlock) {
      walk_.steps.push_back({StepKind::kTileByBlock, 7});
    }
    walk_.jobs.push_back(job);
  }

 private:
  struct Tested {
    std::uint8_t rejecting = 0;
    std::uint8_t undecided = 0;
  };

  /// Each edge for itself.
  [[nodiscard]] Tested tested(int x, int y, int size) const {
    std::array<EdgeAtSample, 3> at;
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge& edge = triangle_.edge[i];
      at[i] = {.e = edge.c + moved(edge, {x, y}, parameters_.sub_pixel_bits),
               .dx = std::int64_t{edge.a} << parameters_.sub_pixel_bits,
               .dy = std::int64_t{edge.b} << parameters_.sub_pixel_bits};
    }
    Tested tested;
    for (unsigned i = 0; i < 3; ++i) {
      const unsigned bit = 1u << i;
      const CornerTest test =
          test_corners(at, size, static_cast<std::uint8_t>(7u & ~bit), parameters_.walker());
      tested.rejecting = static_cast<std::uint8_t>(tested.rejecting | (test.reject ? bit : 0u));
      tested.undecided =
          static_cast<std::uint8_t>(tested.undecided | (!test.reject && test.accept != 7 ? bit : 0u));
    }
    return tested;
  }

  const SetupTriangle& triangle_;
  const WalkerParameters& parameters_;
  Walk& walk_;
};

}  // namespace

InputWords::InputWords(const Widths& widths)
    : triangle(words_for(packed_bits<SetupTrianglePacket>(widths))),
      equation(words_for(packed_bits<DepthEquationPacket>(widths))),
      state(words_for(packed_bits<DrawStatePacket>(widths))) {}

Walk reference_walk(std::span<const std::uint32_t> triangle, std::uint8_t slot,
                    const WalkerParameters& parameters) {
  const SetupTriangle model =
      to_model(unpack<SetupTrianglePacket>(triangle, parameters.widths()), parameters);
  Walk walk;
  walk.one_tile = fits_one_tile(model.bounds, parameters.tile_size);
  StepSink sink(model, parameters, walk);
  with_tile_size(parameters.tile_size,
                 [&](auto size) { tile_walker<size()>(model, parameters.walker(), slot, sink); });
  return walk;
}

}  // namespace halfspace::tb
