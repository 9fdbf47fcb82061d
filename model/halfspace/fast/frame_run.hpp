/// A frame's way through the fast core, as one thread goes it: through all triangles, and in its columns of
/// blocks through what is drawn.
#pragma once

#include <barrier>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "halfspace/fast/frame_memory.hpp"
#include "halfspace/fast/front_end_task.hpp"
#include "halfspace/fast/raster.hpp"
#include "halfspace/machine/frame_source.hpp"
#include "halfspace/machine/stream_writer.hpp"

namespace halfspace::fast {

class FrameRun {
 public:
  using Barrier = std::barrier<>;

  /// `reader` may be null; it is where there is more than one thread. All references must outlive it.
  FrameRun(FrameMemory& memory, std::uint32_t thread, StreamReader* reader);

  /// Runs a frame, for which `memory` has begun. `all`: the threads that run it. Draws and clears are counted
  /// in `result`.
  void run(const Frame& frame, Barrier& all, FrameResult& result);
  /// Of the last frame, by draw.
  [[nodiscard]] std::deque<DrawContext>& draws() { return draws_; }

 private:
  void begin(DrawContext& draw);
  void clear(const SourceItem& item, Barrier& all);
  void draw_raw(const RawTriangles& raw, const Command& command);
  [[nodiscard]] FrontEndTask front_end_task(const FrontEnd& front_end, const Command& command) const;
  void set_up(std::span<const ScreenTriangle> triangles);
  /// Draws what is set up.
  void flush();
  /// The units themselves, on the fast core's surfaces.
  template <int TileSize>
  void draw_by_units(const SetupTriangle& triangle);
  template <int TileSize>
  void draw_job(const SetupTriangle& triangle, const TileJob& job, bool whole);
  void tell_job(int quads);
  /// Lines of a tile, a bit a part.
  void look_up(std::uint32_t tile_x, std::uint32_t tile_y, std::uint8_t touched, std::uint8_t written);

  FrameMemory& memory_;
  const int tile_size_;
  const WalkerConfig walker_;
  const Columns columns_;
  StreamReader* const reader_;
  std::optional<StreamWriter> stream_;  ///< where there is a reader
  const Frame* frame_ = nullptr;
  std::deque<DrawContext> draws_;
  DrawContext* draw_ = nullptr;  ///< at work
  RasterTask task_;
  std::vector<ScreenTriangle> batch_;
  std::unique_ptr<VertexChunk> chunk_ = std::make_unique<VertexChunk>();
  std::unique_ptr<SetUpTriangles> set_up_ = std::make_unique<SetUpTriangles>();
  std::unique_ptr<SetUpTriangles> share_;  ///< of them, where there are other threads
};

}  // namespace halfspace::fast
