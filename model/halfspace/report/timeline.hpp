/// timeline.json: what each stage did when, for Perfetto or chrome://tracing.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>

#include "halfspace/config/config.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/timing/cycle_observer.hpp"

namespace halfspace {

inline constexpr const char* kTimelineFile = "timeline.json";

/// More than a viewer opens with ease; a longer timeline is refused.
inline constexpr std::uint64_t kMostTimelineEvents = 2'000'000;

/// From the first to the last, both included.
struct TimelineRange {
  std::uint64_t first = 0;
  std::uint64_t last = std::numeric_limits<std::uint64_t>::max();

  [[nodiscard]] bool holds(std::uint64_t number) const { return first <= number && number <= last; }
};

/// What to show of a frame; both where both are given.
struct TimelineChoice {
  std::optional<TimelineRange> draws;
  std::optional<TimelineRange> cycles;
};

/// Writes the events as they come, in Chrome's trace format: a track a stage with its packets (category
/// "busy") and its stall reasons ("stall"), a counter a link, a track for each channel of memory. Throws
/// InputError where there are too many, or where the disk does not take them.
class Timeline final : public CycleObserver {
 public:
  Timeline(std::filesystem::path path, const Frame& frame, const Config& config,
           const TimelineChoice& choice);

  void draw(std::uint32_t index) override;
  void tile(std::uint32_t x, std::uint32_t y) override { next_tile_ = {x, y}; }
  void drained() override;
  void link(Link link, std::uint64_t from, std::uint64_t to) override;
  void slice(Stage stage, std::optional<std::size_t> stall, std::uint64_t from, std::uint64_t to) override;
  void transfer(Channel channel, std::uint64_t from, std::uint64_t to) override;

  /// Completes the file of a frame of so many cycles. Throws InputError where the choice holds none of them.
  void finish(std::uint64_t cycles);

 private:
  enum class Process : std::uint8_t { kStages = 1, kLinks, kMemory };  ///< groups of tracks

  struct Tile {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
  };

  /// The occupancy of a link: credits in use, and when those come back.
  struct Counter {
    std::deque<std::uint64_t> back;
    TimelineRange shown;       ///< cycles of the chosen packets
    std::uint64_t cycle = 0;   ///< of the last change
    std::uint64_t before = 0;  ///< in use until then
    std::uint64_t in_use = 0;  ///< from then on
    std::optional<std::uint64_t> written;
  };

  void write_head(const Frame& frame, const Config& config);
  void name_track(Process process, std::size_t track, std::string_view name);
  void return_credits(std::size_t link, std::uint64_t cycle);
  void change(std::size_t link, std::uint64_t cycle, bool taken);
  void write_change(std::size_t link);
  void count(std::size_t link, std::uint64_t cycle, std::uint64_t in_use);
  void span(Process process, std::size_t track, std::string_view category, std::string_view name,
            std::uint64_t from, std::uint64_t to, PacketKind work);
  [[nodiscard]] std::string packet(PacketKind work) const;
  [[nodiscard]] std::string arguments(PacketKind work) const;
  fmt::memory_buffer& begin_event();
  void empty_buffer();

  std::filesystem::path path_;
  std::ofstream file_;
  fmt::memory_buffer buffer_;
  std::uint64_t events_ = 0;
  TimelineChoice choice_;
  TimelineRange window_;  ///< cycles that may be shown
  std::array<Counter, kLinks> counters_;

  // What is told at the moment.
  bool chosen_ = true;
  bool drained_ = false;
  std::uint64_t last_draw_ = 0;
  std::optional<std::uint32_t> draw_;
  std::uint64_t triangles_ = 0;  ///< of the draw so far
  std::uint64_t jobs_ = 0;
  std::uint64_t bursts_ = 0;
  std::optional<Tile> next_tile_;
  std::optional<Tile> tile_;
};

}  // namespace halfspace
