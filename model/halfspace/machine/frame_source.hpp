/// What a frame gives to setup and to the z cache, in order: the one loop over commands and triangles.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/draw_context.hpp"
#include "halfspace/machine/draw_state.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/scene/front_end.hpp"

namespace halfspace {

/// Some triangles of a draw, or without a draw a clear by the z cache.
struct SourceItem {
  DrawContext* draw = nullptr;
  std::span<const ScreenTriangle> triangles{};  ///< valid until the next call of the source
  std::uint32_t surface = kNoSurface;           ///< that is cleared
  std::uint32_t code = 0;                       ///< to this code
};

/// The triangles of a draw before the front end.
struct RawTriangles {
  const FrontEnd* front_end = nullptr;
  std::uint32_t count = 0;
};

/// Executes the commands of a frame. All references must outlive it; `surfaces` are those of the frame,
/// `observer` may be null. Draws are added to `draws` as they begin, clears counted in `result`.
class FrameSource {
 public:
  FrameSource(const Frame& frame, const Config& config, PacketObserver* observer,
              std::vector<Surface>& surfaces, FrameResult& result, std::deque<DrawContext>& draws);

  /// Begins a command, by its index; the one before must be done. Gives the draw, or the clear that is drawn;
  /// null where the command is neither.
  DrawContext* begin(std::uint32_t command);
  /// The next that the command has to give, never empty, or none: then it is done.
  std::optional<SourceItem> next();
  /// For who has a front end of his own: the triangles of the draw that has begun, before next(), which then
  /// gives none of them. None where it is no draw, or one that draws nothing.
  std::optional<RawTriangles> take_raw();

 private:
  void begin_draw(const Command& command, std::uint32_t index);
  void begin_clear(const Command& command);
  void fill_batch();

  const Frame& frame_;
  const Config& config_;
  PacketObserver* observer_;
  std::vector<Surface>& surfaces_;
  FrameResult& result_;
  std::deque<DrawContext>& draws_;
  std::vector<std::uint32_t> surfaces_of_targets_;
  std::vector<bool> unrestricted_;   ///< by surface: EarlyZState::unrestricted of its draws
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
  bool batch_given_ = true;
  std::optional<SourceItem> fast_clear_;
  bool tell_done_ = false;  ///< the observer has yet to hear of the draw's end
};

/// Marks a surface cleared by the z cache in what a run keeps of it: `code` in every sample, nothing visible.
void clear_surface(Surface& surface, std::uint32_t code);

/// Adds up what the draws have counted, when all have left the pipe.
void collect_draws(const std::deque<DrawContext>& draws, FrameResult& result);

}  // namespace halfspace
