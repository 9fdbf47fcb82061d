/// Threads that draw the same triangles, each in columns of blocks of its own: of different columns, surfaces
/// and the sets of the z cache have nothing in common, and counters add up.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <span>
#include <thread>
#include <vector>

#include "halfspace/fast/raster.hpp"
#include "halfspace/fast/set_up.hpp"

namespace halfspace::fast {

/// Draws triangles in the task's columns, and keeps the number of their planes small.
void draw_columns(int tile_size, const RasterTask& task, const SetUpTriangles& triangles);

/// The caller fills triangles() and calls draw(), again and again; it draws the first columns itself. The
/// others may be some calls behind.
class Crew {
 public:
  static constexpr std::uint32_t kMostThreads = 8;

  /// `threads`: a power of two, 2 to kMostThreads.
  Crew(int tile_size, std::uint32_t threads);
  /// When none draws any more; what is left is not drawn.
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  /// Empty, to be filled for the next draw().
  [[nodiscard]] SetUpTriangles& triangles() { return slot(drawn_).triangles; }
  /// Draws them. `counters`: of each thread; what is counted is there after wait().
  void draw(const RasterTask& task, std::span<Counters* const> counters);
  /// Until all is drawn. Throws what a thread threw.
  void wait();

 private:
  struct Slot {
    RasterTask task;
    std::array<Counters*, kMostThreads> counters{};
    SetUpTriangles triangles;
  };
  /// How far a thread is: slots that it has drawn.
  struct alignas(64) Progress {
    std::atomic<std::uint32_t> drawn = 0;
    std::exception_ptr error;
    std::unique_ptr<SetUpTriangles> share = std::make_unique<SetUpTriangles>();
  };

  static constexpr std::uint32_t kSlots = 8;

  [[nodiscard]] Slot& slot(std::uint32_t number) { return slots_[number % kSlots]; }
  void draw_share(std::uint32_t thread, Slot& slot);
  void run(std::uint32_t thread);
  /// Until all but the caller have drawn so many slots.
  void wait_for(std::uint32_t drawn);

  int tile_size_;
  std::uint32_t threads_;
  std::vector<Slot> slots_;
  std::vector<Progress> progress_;
  std::uint32_t drawn_ = 0;  ///< by the caller
  alignas(64) std::atomic<std::uint32_t> given_ = 0;  ///< slots that are filled
  std::atomic<bool> stop_ = false;
  std::vector<std::jthread> workers_;
};

}  // namespace halfspace::fast
