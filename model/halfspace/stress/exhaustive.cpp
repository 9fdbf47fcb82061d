#include "halfspace/stress/exhaustive.hpp"

#include <algorithm>
#include <bit>
#include <mutex>
#include <optional>
#include <utility>

#include "halfspace/machine/tile_size.hpp"
#include "halfspace/numerics/parallel.hpp"
#include "halfspace/reference/exact_triangle.hpp"
#include "halfspace/stress/draw_list.hpp"
#include "halfspace/units/block_walker.hpp"
#include "halfspace/units/edge_evaluator.hpp"
#include "halfspace/units/quad_generator.hpp"
#include "halfspace/units/setup.hpp"
#include "halfspace/units/tile_walker.hpp"

namespace halfspace::stress {
namespace {

GridPoint point(std::uint32_t number) { return {number % kGridSide, number / kGridSide}; }

std::int64_t twice_area(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return static_cast<std::int64_t>(reference::twice_area(point(a), point(b), point(c)));
}

/// The units one after the other, without time.
template <int TileSize>
class UnitChain {
 public:
  /// The square's top left pixel is (corner, corner).
  UnitChain(int corner, FillRule rule) : corner_(corner) { state_.fill_rule = rule; }

  /// The samples of the square that are covered, as in GridDefinition; counts what quads and tiles get wrong.
  std::uint8_t draw(const std::array<std::uint32_t, 3>& points, std::uint8_t expected,
                    ExhaustiveTally& tally) {
    ScreenTriangle in{};
    for (std::size_t i = 0; i < 3; ++i) {
      const GridPoint p = point(points[i]);
      in.v[i].x = static_cast<std::int32_t>(p.x) + (corner_ << kGridBits);
      in.v[i].y = static_cast<std::int32_t>(p.y) + (corner_ << kGridBits);
    }
    covered_ = 0;
    expected_ = expected;
    tally_ = &tally;
    if (setup(in, state_, triangle_) == SetupVerdict::kDrawn) {
      block_walker<TileSize>(triangle_, config_, 0, *this);
    }
    return covered_;
  }

  void block(const BlockJob& job, std::uint64_t touched) {
    const int row = config_.block_size / TileSize;
    for (std::uint64_t left = touched & ~job.tiles; left != 0; left &= left - 1) {
      const int tile = std::countr_zero(left);
      ++tally_->tiles;
      tally_->unsound +=
          (expected_ & samples_of(job.block_x * row + tile % row, job.block_y * row + tile / row)) != 0 ? 1
                                                                                                        : 0;
    }
    tile_walker<TileSize>(job, config_, *this);
  }
  static void pass(const GridPlace& /*cell*/, int /*side*/) {}

  void tile(const TileJob& job, bool whole) {
    ++tally_->tiles;
    // The square never fills a tile.
    tally_->unsound += whole ? 1 : 0;
    const QuadBurst burst = quad_generator<TileSize>(edge_evaluator<TileSize>(job, kGridBits));
    std::uint8_t covered = 0;
    for_each_quad<TileSize>(burst, [&](const Quad& quad) {
      tally_->wrong_quads += quad.mask == 0 ? 1 : 0;
      for (int i = 0; i < 4; ++i) {
        const int x = job.tile_x * TileSize + quad.x + i % 2 - corner_;
        const int y = job.tile_y * TileSize + quad.y + i / 2 - corner_;
        if ((quad.mask >> i & 1) != 0) {
          const bool in_square = x >= 0 && x < 2 && y >= 0 && y < 2;
          tally_->wrong += in_square ? 0 : 1;
          covered |= in_square ? static_cast<std::uint8_t>(1 << (y * 2 + x)) : std::uint8_t{0};
        }
      }
    });
    tally_->wrong_quads += (covered_ & covered) != 0 ? 1 : 0;  // a sample left twice
    covered_ |= covered;
  }

 private:
  /// Those of the square that lie in a tile.
  [[nodiscard]] std::uint8_t samples_of(int tile_x, int tile_y) const {
    std::uint8_t samples = 0;
    for (int i = 0; i < 4; ++i) {
      const bool inside = (corner_ + i % 2) / TileSize == tile_x && (corner_ + i / 2) / TileSize == tile_y;
      samples |= static_cast<std::uint8_t>(inside ? 1 << i : 0);
    }
    return samples;
  }

  int corner_;
  WalkerConfig config_{.sub_pixel_bits = kGridBits, .block_size = 4 * TileSize};
  SetupState state_{.sub_pixel_bits = kGridBits, .bounds = {.x_last = 255, .y_last = 255}};
  SetupTriangle triangle_;
  std::uint8_t covered_ = 0;
  std::uint8_t expected_ = 0;
  ExhaustiveTally* tally_ = nullptr;
};

template <int TileSize>
void check_point(std::uint32_t first, int corner, FillRule rule, const GridDefinition& definition,
                 ExhaustiveTally& tally) {
  UnitChain<TileSize> units(corner, rule);
  const auto draw = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint8_t expected) {
    const std::uint8_t got = units.draw({a, b, c}, expected, tally);
    ++tally.triangles;
    tally.samples += 4;
    tally.wrong += static_cast<std::uint64_t>(std::popcount(static_cast<unsigned>(got ^ expected)));
  };
  for (std::uint32_t second = first + 1; second < kGridPoints; ++second) {
    for (std::uint32_t third = second + 1; third < kGridPoints; ++third) {
      const std::int64_t area = twice_area(first, second, third);
      tally.without_area += area == 0 ? 2 : 0;
      const std::uint8_t expected = area == 0  ? std::uint8_t{0}
                                    : area > 0 ? definition.covered(first, second, third)
                                               : definition.covered(first, third, second);
      draw(first, second, third, expected);
      draw(first, third, second, expected);
    }
  }
}

/// The samples that setup puts inside the edge from one point to another, from a triangle that it belongs to;
/// none where no point of the grid makes one.
std::optional<std::uint8_t> inside_edge(std::uint32_t from, std::uint32_t to, FillRule rule) {
  std::uint32_t third = 0;
  while (third < kGridPoints && twice_area(from, to, third) <= 0) {
    ++third;
  }
  if (third == kGridPoints) {
    return std::nullopt;
  }
  ScreenTriangle in{};
  const std::array points{from, to, third};
  for (std::size_t i = 0; i < 3; ++i) {
    // Where every triangle has a sample in its box.
    in.v[i].x = static_cast<std::int32_t>(point(points[i]).x);
    in.v[i].y = static_cast<std::int32_t>(point(points[i]).y);
  }
  SetupTriangle out;
  if (setup(in, {.sub_pixel_bits = kGridBits, .fill_rule = rule, .bounds = {.x_last = 255, .y_last = 255}},
            out) != SetupVerdict::kDrawn) {
    return std::nullopt;
  }
  const auto a = static_cast<std::int32_t>(point(from).y - point(to).y);
  const auto b = static_cast<std::int32_t>(point(to).x - point(from).x);
  const auto edge =
      std::find_if(out.edge.begin(), out.edge.end(), [&](const Edge& e) { return e.a == a && e.b == b; });
  std::uint8_t inside = 0;
  for (int i = 0; i < 4; ++i) {
    const std::int64_t e =
        edge->c + ((std::int64_t{a} * (i % 2) + std::int64_t{b} * (i / 2)) * (1 << kGridBits));
    inside |= static_cast<std::uint8_t>(e >= 0 ? 1 << i : 0);
  }
  return inside;
}

/// Of the edges between a point and all later ones: every sample lies on one side of the edge, never on both.
void check_edges(std::uint32_t first, FillRule rule, const GridDefinition& definition,
                 ExhaustiveTally& tally) {
  for (std::uint32_t second = first + 1; second < kGridPoints; ++second) {
    const auto there = inside_edge(first, second, rule);
    const auto back = inside_edge(second, first, rule);
    if (there && back) {
      ++tally.edges;
      tally.on_edges += static_cast<std::uint64_t>(std::popcount(definition.on(first, second)));
      tally.ownerless +=
          static_cast<std::uint64_t>(std::popcount(static_cast<unsigned>(*there ^ *back ^ 0xF)));
    }
  }
}

}  // namespace

GridDefinition::GridDefinition(reference::TieRule rule)
    : inside_(std::size_t{kGridPoints} * kGridPoints), on_(std::size_t{kGridPoints} * kGridPoints) {
  for (std::uint32_t from = 0; from < kGridPoints; ++from) {
    for (std::uint32_t to = 0; to < kGridPoints; ++to) {
      for (int i = 0; i < 4; ++i) {
        const reference::Int128 side =
            reference::twice_area(point(from), point(to), reference::pixel_centre(i % 2, i / 2, kGridBits));
        const reference::Int128 a = point(from).y - point(to).y;
        const reference::Int128 b = point(to).x - point(from).x;
        const bool inside = side > 0 || (side == 0 && reference::owns_samples(a, b, rule));
        const std::size_t at = from * kGridPoints + to;
        inside_[at] |= static_cast<std::uint8_t>(inside ? 1 << i : 0);
        on_[at] |= static_cast<std::uint8_t>(side == 0 ? 1 << i : 0);
      }
    }
  }
}

ExhaustiveTally& ExhaustiveTally::operator+=(const ExhaustiveTally& other) {
  triangles += other.triangles;
  without_area += other.without_area;
  samples += other.samples;
  wrong += other.wrong;
  wrong_quads += other.wrong_quads;
  tiles += other.tiles;
  unsound += other.unsound;
  edges += other.edges;
  on_edges += other.on_edges;
  ownerless += other.ownerless;
  return *this;
}

ExhaustiveTally check_units(FillRule units, reference::TieRule rule, std::uint32_t every, int threads,
                            const std::function<void(std::size_t)>& progress) {
  const GridDefinition definition(rule);
  ExhaustiveTally sum;
  std::mutex mutex;
  std::size_t done = 0;
  parallel_for((kGridPoints + every - 1) / every, threads, [&](std::size_t i) {
    ExhaustiveTally tally;
    const auto first = static_cast<std::uint32_t>(i) * every;
    // Pixel 6 or 15 is the last but one, or the last, of a tile of any size.
    check_point<8>(first, 6, units, definition, tally);
    check_point<4>(first, 15, units, definition, tally);
    check_point<8>(first, 15, units, definition, tally);
    check_point<16>(first, 15, units, definition, tally);
    check_edges(first, units, definition, tally);
    const std::lock_guard lock(mutex);
    sum += tally;
    progress(++done);
  });
  return sum;
}

ExhaustiveTally check_subject(Subject& subject, reference::TieRule rule, std::uint32_t every,
                              const std::function<void(std::size_t)>& progress) {
  // A pixel counts up to 65535 fragments.
  constexpr std::size_t kMostTriangles = 65535;
  const GridDefinition definition(rule);
  DrawList list({.sub_pixel_bits = kGridBits}, 16, 0);
  Command& draw = list.draw();
  draw.flags &= ~bits({Flag::kDepthWrite});
  draw.vertex_count = kGridPoints;
  Frame frame = list.take_frame();
  frame.name = "exhaustive";
  for (std::uint32_t number = 0; number < kGridPoints; ++number) {
    const GridPoint p = point(number);
    const auto clip = [](std::int64_t at) { return static_cast<float>(at) / (8 << kGridBits) - 1; };
    frame.vertices.emplace_back(clip(p.x), clip(p.y), 0.5F, 1);
  }
  ExhaustiveTally tally;
  std::array<std::uint32_t, 4> expected{};
  const auto flush = [&] {
    if (frame.indices.empty()) {
      return;
    }
    frame.commands.back().index_count = static_cast<std::uint32_t>(frame.indices.size());
    const Picture picture = subject.draw(frame);
    for (std::uint32_t at = 0; at < picture.fragments.size(); ++at) {
      const std::uint32_t x = at % picture.width;
      const std::uint32_t y = at / picture.width;
      const std::int64_t wanted = x < 2 && y < 2 ? expected[y * 2 + x] : 0;
      tally.wrong += static_cast<std::uint64_t>(std::abs(wanted - std::int64_t{picture.fragments[at]}));
    }
    frame.indices.clear();
    expected = {};
  };
  for (std::uint32_t first = 0; first < kGridPoints; first += every) {
    for (std::uint32_t second = first + 1; second < kGridPoints; ++second) {
      for (std::uint32_t third = second + 1; third < kGridPoints; ++third) {
        const std::int64_t area = twice_area(first, second, third);
        const std::uint8_t covered = area == 0  ? std::uint8_t{0}
                                     : area > 0 ? definition.covered(first, second, third)
                                                : definition.covered(first, third, second);
        for (std::size_t i = 0; i < 4; ++i) {
          expected[i] += covered >> i & 1U;
        }
        frame.indices.insert(frame.indices.end(), {first, second, third});
        ++tally.triangles;
        tally.without_area += area == 0 ? 1 : 0;
        tally.samples += 4;
        if (frame.indices.size() == 3 * kMostTriangles) {
          flush();
        }
      }
    }
    progress(first / every + 1);
  }
  flush();
  return tally;
}

}  // namespace halfspace::stress
