/// What a run of a frame gives, in every fidelity, and who may watch it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/units/counters.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/tile_walker.hpp"
#include "halfspace/units/tiled_image.hpp"

namespace halfspace {

inline constexpr std::uint32_t kNothingVisible = 0xFFFFFFFFu;

/// A depth surface and what happened to its pixels. Without a clear it starts at depth 1.
struct Surface {
  DepthFormat format = DepthFormat::kNone;
  TiledImage<std::uint32_t> codes;      ///< stored depth codes
  TiledImage<std::uint16_t> fragments;  ///< fragments that covered each pixel, at most 65535
  TiledImage<std::uint16_t> survivors;  ///< fragments that passed early-Z, at most 65535
  /// The triangle that wrote the depth last, counted through all draws, or kNothingVisible. On a surface
  /// where no draw writes depth, the one that passed last. Kept on request.
  TiledImage<std::uint32_t> visible;
  Counters counters;  ///< of all draws on the surface
};

/// One draw of the frame.
struct DrawStats {
  std::uint32_t command = 0;  ///< index in Frame::commands
  std::uint32_t surface = kNoSurface;
  Counters counters;
};

struct FrameResult {
  std::vector<Surface> surfaces;  ///< by depth surface number
  std::vector<DrawStats> draws;
  Counters counters;                ///< of the whole frame, targets without depth included
  Counters drawn_clears;            ///< of the clears that went through the pipe as rectangles
  std::uint64_t clears = 0;         ///< clears of depth
  std::uint64_t flushed_lines = 0;  ///< of the z cache, written back at the end
  std::uint64_t flushed_bytes = 0;
  std::uint64_t draws_not_filled = 0;  ///< skipped: their polygons are drawn as lines or points
};

/// A quad as it leaves early_z.
struct QuadEvent {
  std::uint32_t draw = 0;      ///< counts the draws of the frame, not its clears
  std::uint32_t triangle = 0;  ///< in the draw
  std::uint32_t surface = kNoSurface;
  std::uint32_t x = 0;  ///< top left pixel
  std::uint32_t y = 0;
  std::uint8_t mask = 0;    ///< covered: bit 0 (x, y), 1 (x + 1, y), 2 (x, y + 1), 3 (x + 1, y + 1)
  std::uint8_t passed = 0;  ///< the same bits after early-Z
  std::array<std::uint32_t, 4> depth{};  ///< codes; 0 for helpers and where there is no depth surface
  std::uint64_t cycle = 0;               ///< leaves early_z; 0 when untimed
};

/// A decision of the walker.
struct DecisionEvent {
  std::uint32_t draw = 0;
  std::uint32_t triangle = 0;
  std::uint32_t surface = kNoSurface;
  std::uint32_t x = 0;  ///< top left pixel
  std::uint32_t y = 0;
  std::uint32_t size = 0;
  TileVerdict verdict = TileVerdict::kReject;
};

/// Sees packets as they pass, in order. Override what is of interest and say so.
class PacketObserver {
 public:
  virtual ~PacketObserver() = default;
  [[nodiscard]] virtual bool wants_quads() const { return false; }
  [[nodiscard]] virtual bool wants_decisions() const { return false; }
  [[nodiscard]] virtual bool wants_tile_jobs() const { return false; }
  virtual void quad(const QuadEvent&) {}
  virtual void decision(const DecisionEvent&) {}
  virtual void tile_job(const TileJob&) {}
  virtual void draw_done(std::size_t /*done*/, std::size_t /*of*/) {}
};

}  // namespace halfspace
