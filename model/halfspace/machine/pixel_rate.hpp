/// What a shader that runs once a pixel would be given where a pixel has several samples: sample_collector
/// behind early_z, as an observer of a run. It changes nothing of it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/numerics/sample_pattern.hpp"
#include "halfspace/units/counter_struct.hpp"
#include "halfspace/units/sample_collector.hpp"

namespace halfspace {

// clang-format off
#define HALFSPACE_PIXEL_RATE_COUNTERS(C)                                                          \
  C(sample_quads, "quads of one sample with a pixel that passed: shaded once a sample")           \
  C(quads,        "quads of pixels with a sample that passed: shaded once a pixel")               \
  C(pixels,       "their pixels with a sample that passed")                                       \
  C(helpers,      "their other pixels")                                                           \
  C(samples,      "samples that passed")                                                          \
  C(at_centre,    "pixels with a sample that passed whose centroid is the centre: all are covered") \
  C(at_sample,    "pixels with a sample that passed whose centroid is a covered sample")
// clang-format on

HALFSPACE_COUNTER_STRUCT(PixelRateCounters, HALFSPACE_PIXEL_RATE_COUNTERS)

struct PixelRateResult {
  std::vector<PixelRateCounters> draws;  ///< of the frame, in order
  PixelRateCounters frame;               ///< their sum
};

/// A quad of pixels as it leaves sample_collector.
struct PixelQuadEvent {
  std::uint32_t draw = 0;
  std::uint32_t triangle = 0;
  std::uint32_t surface = kNoSurface;
  std::uint32_t x = 0;  ///< top left pixel
  std::uint32_t y = 0;
  std::array<std::uint16_t, 4> covered{};    ///< samples of each pixel
  std::array<std::uint16_t, 4> passed{};     ///< the same bits after early-Z
  std::array<SamplePosition, 4> centroid{};  ///< of each pixel
};

class PixelRate final : public PacketObserver {
 public:
  using Shade = std::function<void(const PixelQuadEvent&)>;

  /// `draws`: of the frame. `shade` gets every quad as it leaves.
  PixelRate(std::size_t draws, int tile_size, const SamplePattern& samples, Shade shade = {});

  [[nodiscard]] bool wants_quads() const override { return true; }
  void quad(const QuadEvent& quad) override;

  /// After the last quad.
  PixelRateResult finish();

 private:
  /// What the collector holds a tile of.
  struct Held {
    std::uint32_t draw = 0;
    std::uint32_t triangle = 0;
    std::uint8_t piece = 0;
    std::uint32_t surface = kNoSurface;
    std::uint32_t tile_x = 0;
    std::uint32_t tile_y = 0;
    friend bool operator==(const Held&, const Held&) = default;
  };

  void leave();

  std::uint32_t tile_size_;
  SamplePattern samples_;
  Shade shade_;
  SampleCollector collector_;
  std::optional<Held> held_;
  PixelRateResult result_;
};

}  // namespace halfspace
