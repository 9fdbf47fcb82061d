#include "halfspace/fast/crew.hpp"

#include <hwy/cache_control.h>

#include <algorithm>
#include <exception>
#include <utility>

namespace halfspace::fast {
namespace {

/// Planes of a list; with more, its tiles are resolved.
constexpr std::size_t kMostPlanes = 1 << 16;

/// Looks at a number for a while before it sleeps: the next batch of triangles is a few microseconds away.
/// Returns it when it is not `old` any more.
std::uint32_t wait_while(const std::atomic<std::uint32_t>& number, std::uint32_t old) {
  constexpr int kLooks = 2000;
  for (int i = 0; i < kLooks; ++i) {
    const std::uint32_t now = number.load(std::memory_order_acquire);
    if (now != old) {
      return now;
    }
    hwy::Pause();
  }
  number.wait(old, std::memory_order_acquire);
  return number.load(std::memory_order_acquire);
}

}  // namespace

void draw_columns(int tile_size, const RasterTask& task, const SetUpTriangles& triangles) {
  raster(tile_size, task, triangles);
  const std::uint32_t list = task.columns.own;
  if (task.tiles != nullptr && task.tiles->lists[list].planes.size() > kMostPlanes) {
    resolve(tile_size, task.walker.sub_pixel_bits, task.columns, *task.surface, *task.tiles);
    task.tiles->forget_planes(list);
  }
}

Crew::Crew(int tile_size, std::uint32_t threads)
    : tile_size_(tile_size), threads_(threads), slots_(kSlots), progress_(threads) {
  for (std::uint32_t thread = 1; thread < threads; ++thread) {
    workers_.emplace_back([this, thread] { run(thread); });
  }
}

Crew::~Crew() {
  stop_.store(true, std::memory_order_relaxed);
  given_.fetch_add(1, std::memory_order_release);
  given_.notify_all();
}

void Crew::draw(const RasterTask& task, std::span<Counters* const> counters) {
  Slot& now = slot(drawn_);
  now.task = task;
  std::ranges::copy(counters, now.counters.begin());
  given_.fetch_add(1, std::memory_order_release);
  given_.notify_all();
  draw_share(0, now);
  ++drawn_;
  if (drawn_ >= kSlots) {
    wait_for(drawn_ - kSlots + 1);
  }
  triangles().clear();
}

void Crew::wait() {
  wait_for(drawn_);
  for (Progress& each : progress_) {
    if (each.error) {
      std::rethrow_exception(std::exchange(each.error, nullptr));
    }
  }
}

void Crew::wait_for(std::uint32_t drawn) {
  for (std::uint32_t thread = 1; thread < threads_; ++thread) {
    const std::atomic<std::uint32_t>& there = progress_[thread].drawn;
    for (std::uint32_t now = there.load(std::memory_order_acquire);
         static_cast<std::int32_t>(now - drawn) < 0;) {
      now = wait_while(there, now);
    }
  }
}

void Crew::draw_share(std::uint32_t thread, Slot& slot) {
  RasterTask task = slot.task;
  task.counters = slot.counters[thread];
  task.columns = {.mask = threads_ - 1, .own = thread};
  SetUpTriangles& share = *progress_[thread].share;
  take_share(slot.triangles, task.columns, task.walker.block_size, share);
  draw_columns(tile_size_, task, share);
}

void Crew::run(std::uint32_t thread) {
  Progress& progress = progress_[thread];
  for (std::uint32_t drawn = 0;; ++drawn) {
    if (given_.load(std::memory_order_acquire) == drawn) {
      wait_while(given_, drawn);
    }
    if (stop_.load(std::memory_order_relaxed)) {
      return;
    }
    try {
      draw_share(thread, slot(drawn));
    } catch (...) {
      progress.error = std::current_exception();
    }
    progress.drawn.store(drawn + 1, std::memory_order_release);
    progress.drawn.notify_all();
  }
}

}  // namespace halfspace::fast
