/// Observers of the packets of a run.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/machine/core.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/setup.hpp"
#include "halfspace/units/tile_walker.hpp"
#include "halfspace/units/walk_order.hpp"

namespace halfspace {

/// An attribute at the four pixels of a quad, as in ShadedQuad.
using QuadAttribute = std::array<std::int32_t, 16>;

/// A quad as it leaves early_z.
struct QuadEvent {
  std::uint32_t draw = 0;      ///< counts the draws of the frame, not its clears
  std::uint32_t triangle = 0;  ///< in the draw
  std::uint8_t piece = 0;      ///< as in ScreenTriangle
  std::uint32_t surface = kNoSurface;
  std::uint8_t sample = 0;  ///< of each of its pixels
  std::uint32_t x = 0;      ///< top left pixel
  std::uint32_t y = 0;
  bool front = false;       ///< the triangle faces front
  std::uint8_t mask = 0;    ///< covered: bit 0 (x, y), 1 (x + 1, y), 2 (x, y + 1), 3 (x + 1, y + 1)
  std::uint8_t passed = 0;  ///< the same bits after early-Z
  std::uint8_t kept = 0;    ///< and after the shader, where the draw writes late
  std::uint8_t inner = 0;   ///< with inner coverage: the triangle fills the pixel
  std::array<std::uint32_t, 4> depth{};  ///< codes; 0 for helpers and where there is no depth surface
  /// Leaves early_z; with the interpolator: its burst does. 0 when untimed.
  std::uint64_t cycle = 0;
  /// With the interpolator, of a quad that has a sample that passed: its attributes, in order.
  std::vector<QuadAttribute> attributes{};
};

/// A decision about a tile.
struct DecisionEvent {
  std::uint32_t draw = 0;
  std::uint32_t triangle = 0;
  std::uint32_t surface = kNoSurface;
  std::uint32_t tile_x = 0;
  std::uint32_t tile_y = 0;
  TileVerdict verdict = TileVerdict::kReject;
};

/// A triangle of the front end, as setup leaves it.
struct SetupEvent {
  std::uint32_t draw = 0;
  std::uint32_t triangle = 0;
  std::uint32_t surface = kNoSurface;
  SetupVerdict verdict = SetupVerdict::kDrawn;
  const ScreenTriangle* screen = nullptr;  ///< as it came; only during the call
  const SetupTriangle* drawn = nullptr;    ///< where it is drawn; only during the call
};

/// Sees the packets of a stage in order; quads may come later than the decisions and jobs that led to them.
/// Override what is of interest and say so.
class PacketObserver {
 public:
  virtual ~PacketObserver() = default;
  [[nodiscard]] virtual bool wants_quads() const { return false; }
  [[nodiscard]] virtual bool wants_decisions() const { return false; }
  [[nodiscard]] virtual bool wants_tile_jobs() const { return false; }
  [[nodiscard]] virtual bool wants_walk() const { return false; }
  virtual void quad(const QuadEvent&) {}
  virtual void decision(const DecisionEvent&) {}
  virtual void tile_job(const TileJob&) {}
  /// The walk: every triangle at setup; of those that are drawn every block of the bounds, with the tiles
  /// that they touch, of which job.tiles are left; and what hi_z then rejects of these.
  virtual void set_up(const SetupEvent&) {}
  virtual void block_walked(const BlockJob& /*job*/, std::uint64_t /*touched*/) {}
  /// A step that only leads the walk, by a square of `side` pixels with this top left pixel.
  virtual void walk_led(const GridPlace& /*pixel*/, int /*side*/) {}
  virtual void hi_z_decided(const BlockJob& /*block*/, std::uint64_t /*rejected*/) {}
  virtual void draw_done(std::size_t /*done*/, std::size_t /*of*/) {}
};

/// More than a processor is likely to have is a typing error.
inline constexpr int kMostThreads = 64;

/// What a run keeps beside its counts, and how it runs.
struct Watch {
  bool keep_visible = false;           ///< fill Surface::visible: 4 bytes a pixel more
  bool count_pixels = true;            ///< fill Surface::fragments and survivors
  bool keep_sums = false;              ///< fill Surface::sums
  PacketObserver* observer = nullptr;  ///< must outlive the run
  Core core = Core::kAuto;             ///< of the functional engines
  int threads = 1;                     ///< that the run may use, 1 to kMostThreads; the result is the same
};

}  // namespace halfspace
