#include "halfspace/timing/systemc/sink.hpp"

#include <algorithm>

#include "halfspace/timing/contract.hpp"
#include "halfspace/timing/tally.hpp"
#include "halfspace/units/quad_generator.hpp"

namespace halfspace::systemc {

Sink::Sink(const sc_core::sc_module_name& name, RunState& run) : sc_module(name), in("in"), run_(run) {
  SC_THREAD(take);
  set_stack_size(kStackBytes);
}

void Sink::begin_frame() { next_ = 0; }

void Sink::take() {
  run_.guard([&] {
    for (;;) {
      const Cycle at = std::max(in->visible(), next_);
      run_.clock.wait_until(at);
      const auto burst_beats =
          static_cast<Cycle>(beats(in->front().quads, run_.config.early_z.quads_per_cycle));
      const Cycle last = at + burst_beats - 1;
      const TestedToken token = in->take(last);
      next_ = last + 1;
      run_.record(&PacketTimes::y, at);
      token.work->cycles.end = last;
      token.work->has_burst = true;
      with_tile_size(run_.config.tile_walker.tile_size, [&](auto size) {
        count_pixels<size()>(token);
        if (token.work->record_quads) {
          show_quads<size()>(token, at);
        }
      });
      run_.in_pipe.remove();
    }
  });
}

template <int TileSize>
void Sink::count_pixels(const TestedToken& token) {
  const DrawWork& work = *token.work;
  if (work.surface == kNoSurface) {
    return;
  }
  Surface& surface = run_.result.surfaces[work.surface];
  const int tile_x = token.burst.coverage.tile_x;
  const int tile_y = token.burst.coverage.tile_y;
  if (!work.is_clear()) {
    count_samples<TileSize>(token.burst.coverage.mask, surface.fragments.tile(tile_x, tile_y));
    count_samples<TileSize>(token.passed, surface.survivors.tile(tile_x, tile_y));
  }
  if (work.keeps_visible) {
    const std::uint32_t shown =
        work.is_clear() ? kNothingVisible : work.first_triangle + token.triangle->triangle;
    std::uint32_t* const visible = surface.visible.tile(tile_x, tile_y);
    for (std::size_t i = 0; i < kMaskWords<TileSize>; ++i) {
      for (std::uint64_t left = token.passed.word[i]; left != 0; left &= left - 1) {
        visible[i * 64 + static_cast<std::size_t>(std::countr_zero(left))] = shown;
      }
    }
  }
}

template <int TileSize>
void Sink::show_quads(const TestedToken& token, Cycle first_beat) {
  const DrawWork& work = *token.work;
  std::uint64_t number = 0;
  for_each_quad<TileSize>(token.burst, [&](const Quad& quad) {
    QuadEvent event{
        .draw = work.draw,
        .triangle = token.triangle->triangle,
        .surface = work.surface,
        .x = static_cast<std::uint32_t>(token.burst.coverage.tile_x * TileSize + quad.x),
        .y = static_cast<std::uint32_t>(token.burst.coverage.tile_y * TileSize + quad.y),
        .mask = quad.mask,
        .passed = quad_bits<TileSize>(token.passed, quad.x, quad.y),
        .depth = {},
        .cycle = first_beat + number++ / static_cast<std::uint64_t>(run_.config.early_z.quads_per_cycle)};
    for (int i = 0; !token.codes.empty() && i < 4; ++i) {
      const int sample = (quad.y + i / 2) * TileSize + quad.x + i % 2;
      const bool covered = (quad.mask >> i & 1) != 0;
      event.depth[static_cast<std::size_t>(i)] = covered ? token.codes[static_cast<std::size_t>(sample)] : 0;
    }
    run_.observer->quad(event);
  });
}

}  // namespace halfspace::systemc
