/// A tested burst's passage through what follows early_z, as pixel shading would take it: counts of each
/// pixel and quad, the visible image, and the quads for who watches.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "halfspace/machine/attribute_source.hpp"
#include "halfspace/machine/draw_context.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/machine/passage/packet_sums.hpp"
#include "halfspace/machine/passage/z_test.hpp"
#include "halfspace/units/quad_generator.hpp"
#include "halfspace/units/tile_mask.hpp"
#include "halfspace/units/z_test.hpp"

namespace halfspace::passage {

/// Adds 1 where the mask is set, up to the largest value.
template <int TileSize>
void count_samples(const TileMask& mask, std::uint16_t* counts) {
  constexpr std::size_t kBits = std::min(TileSize * TileSize, 64);
  constexpr std::uint64_t kAll = ~std::uint64_t{0} >> (64 - kBits);
  const auto add = [&](std::size_t i) {
    counts[i] = static_cast<std::uint16_t>(counts[i] + (counts[i] != 0xFFFF ? 1 : 0));
  };
  for (std::size_t i = 0; i < kMaskWords<TileSize>; ++i) {
    if (mask.word[i] == kAll) {  // most words: a loop without branches
      for (std::size_t k = 0; k < kBits; ++k) {
        add(i * 64 + k);
      }
      continue;
    }
    for (std::uint64_t left = mask.word[i]; left != 0; left &= left - 1) {
      add(i * 64 + static_cast<std::size_t>(std::countr_zero(left)));
    }
  }
}

/// `surface` is what is drawn on; `covered` and what is in `tested` are of one tile of it, and `triangle` is
/// the triangle's number in the draw. Of a clear nothing is counted: it only makes its samples invisible.
template <int TileSize>
void sink(const TileMask& covered, const Tested& tested, int tile_x, int tile_y, std::uint32_t triangle,
          const DrawContext& draw, Surface& surface) {
  if (!draw.is_clear() && !surface.fragments.empty()) {
    count_samples<TileSize>(covered, surface.fragments.tile(tile_x, tile_y));
    count_samples<TileSize>(tested.passed, surface.survivors.tile(tile_x, tile_y));
  }
  if (draw.sums != nullptr) {
    count_quads<TileSize>(*draw.sums, tile_x / draw.early_z.samples.count, tile_y, covered);
  }
  if (draw.keeps_visible) {
    const std::uint32_t shown = draw.is_clear() ? kNothingVisible : draw.first_triangle + triangle;
    std::uint32_t* const visible = surface.visible.tile(tile_x, tile_y);
    for (std::size_t i = 0; i < kMaskWords<TileSize>; ++i) {
      for (std::uint64_t left = tested.kept.word[i]; left != 0; left &= left - 1) {
        visible[i * 64 + static_cast<std::size_t>(std::countr_zero(left))] = shown;
      }
    }
  }
}

/// Calls show(QuadEvent, n) for each quad of a burst, n counting them from 0 in the order in which they
/// leave. `codes`: TileSize^2 depth codes, all that is shown of a sample that is covered.
template <int TileSize, class Show>
void show_quads(const QuadBurst& burst, const Tested& tested, const std::uint32_t* codes,
                const SetupTriangle& triangle, const DrawContext& draw, Show&& show) {
  const int samples = draw.early_z.samples.count;
  std::size_t number = 0;
  for_each_quad<TileSize>(burst, [&](const Quad& quad) {
    QuadEvent event{.draw = draw.draw,
                    .triangle = triangle.triangle,
                    .piece = triangle.piece,
                    .surface = draw.surface,
                    .sample = static_cast<std::uint8_t>(burst.coverage.tile_x % samples),
                    .x = static_cast<std::uint32_t>(burst.coverage.tile_x / samples * TileSize + quad.x),
                    .y = static_cast<std::uint32_t>(burst.coverage.tile_y * TileSize + quad.y),
                    .front = triangle.front,
                    .mask = quad.mask,
                    .passed = quad_bits<TileSize>(tested.passed, quad.x, quad.y),
                    .kept = quad_bits<TileSize>(tested.kept, quad.x, quad.y),
                    .inner = quad_bits<TileSize>(tested.inner, quad.x, quad.y)};
    for (int i = 0; i < 4; ++i) {
      const int sample = (quad.y + i / 2) * TileSize + quad.x + i % 2;
      event.depth[static_cast<std::size_t>(i)] = (quad.mask >> i & 1) != 0 ? codes[sample] : 0;
    }
    if (draw.source != nullptr && event.passed != 0) {
      event.attributes = draw.source->quad(triangle.triangle, triangle.piece, static_cast<int>(event.x),
                                           static_cast<int>(event.y), event.sample, event.passed);
    }
    show(event, number++);
  });
}

}  // namespace halfspace::passage
