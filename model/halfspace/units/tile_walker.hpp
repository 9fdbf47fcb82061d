/// tile_walker: finds the tiles that a triangle may touch, by a two-level walk of its bounds.
///
/// Blocks first, then the tiles of every block that is not decided: each is rejected when all its samples are
/// outside one edge, accepted when all are inside all edges, else partial (N. Greene, "Hierarchical Polygon
/// Tiling with Coverage Masks", SIGGRAPH 1996). An edge function is linear, so its extremes over the samples
/// of a square lie at corner samples, and two corners of each edge decide. A triangle whose bounds fit one
/// tile skips the block level.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "halfspace/units/packets.hpp"

namespace halfspace {

/// How the walk is done. Every choice gives the same coverage.
struct WalkerConfig {
  int sub_pixel_bits = 8;
  int block_size = 32;  ///< pixels; a multiple of the tile size
  bool block_level = true;
  bool trivial_reject = true;
  bool trivial_accept = true;
};

enum class TileVerdict : std::uint8_t { kReject = 0, kAccept = 1, kPartial = 2 };

/// What is known of a tile that leaves the walker.
enum class TileWork : std::uint8_t {
  kEvaluate,      ///< some sample may be outside
  kWhole,         ///< all its samples are covered
  kWholeByBlock,  ///< the same, and its block said so
};

/// An edge in pixel steps, positioned at a sample.
struct EdgeAtSample {
  std::int64_t e = 0;
  std::int64_t dx = 0;  ///< change of e for one pixel
  std::int64_t dy = 0;
};

/// What the corners of a square say about the three edges.
struct CornerTest {
  bool reject = false;
  std::uint8_t accept = 0;  ///< bit i: all samples inside edge i
};

/// Tests the square of `size` pixels whose top left sample the edges are at. Edges in `known` are inside
/// already.
inline CornerTest test_corners(const std::array<EdgeAtSample, 3>& edge, int size, std::uint8_t known,
                               const WalkerConfig& config) {
  CornerTest result{.reject = false, .accept = known};
  for (std::size_t i = 0; i < 3; ++i) {
    if ((known >> i & 1) != 0) {
      continue;
    }
    const std::int64_t far_x = edge[i].dx * (size - 1);
    const std::int64_t far_y = edge[i].dy * (size - 1);
    const std::int64_t most_inside =
        edge[i].e + std::max<std::int64_t>(far_x, 0) + std::max<std::int64_t>(far_y, 0);
    const std::int64_t most_outside =
        edge[i].e + std::min<std::int64_t>(far_x, 0) + std::min<std::int64_t>(far_y, 0);
    result.reject |= config.trivial_reject && most_inside < 0;
    result.accept |= static_cast<std::uint8_t>((config.trivial_accept && most_outside >= 0 ? 1u : 0u) << i);
  }
  return result;
}

/// Walks one triangle. `sink` gets
///   sink.decision(x, y, size, verdict)  for every block and tile that is decided, x and y in pixels;
///   sink.tile(job, work)                for every tile that is not rejected.
///   covered.
/// Blocks and, inside a block, tiles come in row order.
template <int TileSize, class Sink>
class TileWalker {
 public:
  TileWalker(const SetupTriangle& triangle, const WalkerConfig& config, std::uint8_t slot, Sink& sink)
      : bounds_(triangle.bounds), config_(config), sink_(sink) {
    job_.slot = slot;
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge& edge = triangle.edge[i];
      edge_[i] = {.e = edge.c,
                  .dx = std::int64_t{edge.a} << config.sub_pixel_bits,
                  .dy = std::int64_t{edge.b} << config.sub_pixel_bits};
      job_.a[i] = edge.a;
      job_.b[i] = edge.b;
    }
  }

  void walk() {
    const bool one_tile = bounds_.x_first / TileSize == bounds_.x_last / TileSize &&
                          bounds_.y_first / TileSize == bounds_.y_last / TileSize;
    if (!config_.block_level || one_tile) {
      walk_tiles(bounds_, 0);
      return;
    }
    const int size = config_.block_size;
    for (int y = bounds_.y_first / size * size; y <= bounds_.y_last; y += size) {
      for (int x = bounds_.x_first / size * size; x <= bounds_.x_last; x += size) {
        walk_block(x, y);
      }
    }
  }

 private:
  std::array<EdgeAtSample, 3> edges_at(int x, int y) const {
    std::array<EdgeAtSample, 3> at = edge_;
    for (EdgeAtSample& edge : at) {
      edge.e += edge.dx * x + edge.dy * y;
    }
    return at;
  }

  /// The part of the square at (x, y) that lies inside the bounds.
  PixelRect clip(int x, int y, int size) const {
    return {.x_first = std::max(bounds_.x_first, x),
            .y_first = std::max(bounds_.y_first, y),
            .x_last = std::min(bounds_.x_last, x + size - 1),
            .y_last = std::min(bounds_.y_last, y + size - 1)};
  }

  static bool fills(const PixelRect& rect, int size) {
    return rect.x_last - rect.x_first == size - 1 && rect.y_last - rect.y_first == size - 1;
  }

  static TileVerdict verdict_of(const CornerTest& test, bool filled) {
    return test.reject                  ? TileVerdict::kReject
           : test.accept == 7 && filled ? TileVerdict::kAccept
                                        : TileVerdict::kPartial;
  }

  void walk_block(int x, int y) {
    const int size = config_.block_size;
    const PixelRect inside = clip(x, y, size);
    const CornerTest test = test_corners(edges_at(x, y), size, 0, config_);
    const TileVerdict verdict = verdict_of(test, fills(inside, size));
    sink_.decision(x, y, size, verdict);
    if (verdict == TileVerdict::kAccept) {
      emit_tiles(inside);
    } else if (verdict == TileVerdict::kPartial) {
      walk_tiles(inside, test.accept);
    }
  }

  /// Decides every tile that `rect` touches; the edges in `known` are inside all over it.
  void walk_tiles(const PixelRect& rect, std::uint8_t known) {
    for (int y = rect.y_first / TileSize * TileSize; y <= rect.y_last; y += TileSize) {
      for (int x = rect.x_first / TileSize * TileSize; x <= rect.x_last; x += TileSize) {
        const std::array<EdgeAtSample, 3> edge = edges_at(x, y);
        const CornerTest test = test_corners(edge, TileSize, known, config_);
        const PixelRect inside = clip(x, y, TileSize);
        const TileVerdict verdict = verdict_of(test, fills(inside, TileSize));
        sink_.decision(x, y, TileSize, verdict);
        if (verdict != TileVerdict::kReject) {
          emit(x, y, edge, test.accept, inside,
               verdict == TileVerdict::kAccept ? TileWork::kWhole : TileWork::kEvaluate);
        }
      }
    }
  }

  /// The tiles of an accepted block: nothing is left to decide.
  void emit_tiles(const PixelRect& rect) {
    for (int y = rect.y_first; y <= rect.y_last; y += TileSize) {
      for (int x = rect.x_first; x <= rect.x_last; x += TileSize) {
        emit(x, y, edges_at(x, y), 7, clip(x, y, TileSize), TileWork::kWholeByBlock);
      }
    }
  }

  void emit(int x, int y, const std::array<EdgeAtSample, 3>& edge, std::uint8_t accept,
            const PixelRect& inside, TileWork work) {
    job_.tile_x = static_cast<std::uint16_t>(x / TileSize);
    job_.tile_y = static_cast<std::uint16_t>(y / TileSize);
    job_.e = {edge[0].e, edge[1].e, edge[2].e};
    job_.accept = accept;
    job_.x_first = static_cast<std::uint8_t>(inside.x_first - x);
    job_.x_last = static_cast<std::uint8_t>(inside.x_last - x);
    job_.y_first = static_cast<std::uint8_t>(inside.y_first - y);
    job_.y_last = static_cast<std::uint8_t>(inside.y_last - y);
    sink_.tile(job_, work);
  }

  PixelRect bounds_;
  WalkerConfig config_;
  Sink& sink_;
  std::array<EdgeAtSample, 3> edge_;  ///< at pixel (0, 0)
  TileJob job_;
};

/// Walks one triangle; see TileWalker for what `sink` must offer.
template <int TileSize, class Sink>
void tile_walker(const SetupTriangle& triangle, const WalkerConfig& config, std::uint8_t slot, Sink& sink) {
  TileWalker<TileSize, Sink>(triangle, config, slot, sink).walk();
}

}  // namespace halfspace
