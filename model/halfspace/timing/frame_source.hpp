/// What a frame gives to setup and to the z cache, in order: for engines in which the units work on different
/// draws at the same time.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "halfspace/scene/front_end.hpp"
#include "halfspace/timing/cycle_stats.hpp"
#include "halfspace/timing/draw_state.hpp"
#include "halfspace/timing/frame_result.hpp"
#include "halfspace/timing/pipeline.hpp"

namespace halfspace {

/// A draw, or a clear that is drawn. Packets under way point to theirs.
struct DrawContext {
  std::uint32_t draw = kNoDraw;  ///< counts the draws of the frame
  std::uint32_t command = 0;     ///< index in Frame::commands
  std::uint32_t surface = kNoSurface;
  std::uint32_t first_triangle = 0;  ///< triangles of the draws before
  SetupState setup;
  EarlyZState early_z;
  bool keeps_visible = false;  ///< its survivors go into Surface::visible
  bool record_quads = false;
  bool record_decisions = false;
  bool record_jobs = false;
  bool has_burst = false;
  Counters counters;
  DrawCycles cycles;

  [[nodiscard]] bool is_clear() const { return draw == kNoDraw; }
  /// Cycles of a clear belong to the frame only.
  [[nodiscard]] CycleStats* stats() { return is_clear() ? nullptr : &cycles.stats; }
};

/// A triangle of a draw, or without a draw a clear by the z cache.
struct SourceItem {
  DrawContext* draw = nullptr;
  ScreenTriangle triangle{};
  std::uint32_t surface = kNoSurface;  ///< that is cleared
  std::uint32_t code = 0;              ///< to this code
};

/// Executes the commands of a frame. All references must outlive it; `result` has its surfaces, `observer`
/// may be null. Draws are added to `draws` as they begin.
class FrameSource {
 public:
  FrameSource(const Frame& frame, const Config& config, PacketObserver* observer, FrameResult& result,
              std::deque<DrawContext>& draws);

  /// Begins a command, by its index; the one before must be done.
  void begin(std::uint32_t command);
  /// The next that the command has to give, or none: then it is done.
  std::optional<SourceItem> next();

 private:
  void begin_draw(const Command& command, std::uint32_t index);
  void begin_clear(const Command& command);
  void fill_batch();

  const Frame& frame_;
  const Config& config_;
  PacketObserver* observer_;
  FrameResult& result_;
  std::deque<DrawContext>& draws_;
  std::vector<bool> depth_written_;  ///< by surface: some draw of the frame writes its depth
  std::size_t draws_in_frame_ = 0;

  std::uint32_t draws_begun_ = 0;
  std::uint32_t first_triangle_ = 0;  ///< triangles of the draws so far

  // Of the command at work.
  DrawContext* draw_ = nullptr;
  std::optional<FrontEnd> front_end_;  ///< of a draw
  std::uint32_t triangle_count_ = 0;
  std::uint32_t next_triangle_ = 0;
  std::vector<ScreenTriangle> batch_;  ///< made, in order
  std::size_t next_in_batch_ = 0;
  std::optional<SourceItem> fast_clear_;
  bool tell_done_ = false;  ///< the observer has yet to hear of the draw's end
};

/// Adds up what the draws have counted, when all have left the pipe; their cycles go to `cycles`.
void collect_draws(std::deque<DrawContext>& draws, FrameResult& result, FrameCycles& cycles);

}  // namespace halfspace
