#include "halfspace/machine/pixel_rate.hpp"

#include <bit>
#include <utility>

namespace halfspace {

PixelRate::PixelRate(std::size_t draws, int tile_size, const SamplePattern& samples, Shade shade)
    : tile_size_(static_cast<std::uint32_t>(tile_size)),
      samples_(samples),
      shade_(std::move(shade)),
      collector_(tile_size) {
  result_.draws.resize(draws);
}

void PixelRate::quad(const QuadEvent& quad) {
  const Held now{.draw = quad.draw,
                 .triangle = quad.triangle,
                 .piece = quad.piece,
                 .surface = quad.surface,
                 .tile_x = quad.x / tile_size_,
                 .tile_y = quad.y / tile_size_};
  if (held_ != now) {
    leave();
    held_ = now;
  }
  result_.draws[quad.draw].sample_quads += quad.passed != 0 ? 1 : 0;
  collector_.add(static_cast<int>(quad.x % tile_size_), static_cast<int>(quad.y % tile_size_), quad.sample,
                 quad.mask, quad.passed);
}

void PixelRate::leave() {
  collector_.leave([this](const PixelQuad& quad) {
    PixelRateCounters& counters = result_.draws[held_->draw];
    ++counters.quads;
    PixelQuadEvent event{.draw = held_->draw,
                         .triangle = held_->triangle,
                         .surface = held_->surface,
                         .x = held_->tile_x * tile_size_ + static_cast<std::uint32_t>(quad.x),
                         .y = held_->tile_y * tile_size_ + static_cast<std::uint32_t>(quad.y),
                         .covered = quad.covered,
                         .passed = quad.passed};
    for (std::size_t pixel = 0; pixel < 4; ++pixel) {
      const bool lives = quad.passed[pixel] != 0;
      const bool whole = std::popcount(quad.covered[pixel]) == samples_.count;
      counters.pixels += lives ? 1 : 0;
      counters.helpers += lives ? 0 : 1;
      counters.samples += static_cast<std::uint64_t>(std::popcount(quad.passed[pixel]));
      counters.at_centre += lives && whole ? 1 : 0;
      counters.at_sample += lives && !whole ? 1 : 0;
      event.centroid[pixel] = centroid(quad.covered[pixel], samples_);
    }
    if (shade_) {
      shade_(event);
    }
  });
}

PixelRateResult PixelRate::finish() {
  leave();
  for (const PixelRateCounters& draw : result_.draws) {
    result_.frame += draw;
  }
  return std::move(result_);
}

}  // namespace halfspace
