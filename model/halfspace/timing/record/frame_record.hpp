/// The packet stream of a frame, without what only function needs: enough to time it on other machines.
///
/// A tile job is one word whatever it holds, and a burst that has to do with stored depth one more. A record
/// serves every configuration that differs from its own in keys of time only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/units/z_cache.hpp"

namespace halfspace {

class PacketObserver;

/// Steps that a RecordedJob can hold.
inline constexpr std::uint32_t kMostSteps = 1u << 24;

/// A tile job: steps of the walker since the job before, its own included, 1 to kMostSteps; and its quads, 0
/// to 64.
class RecordedJob {
 public:
  RecordedJob() = default;
  RecordedJob(std::uint32_t steps, int quads)
      : word_((steps - 1) | static_cast<std::uint32_t>(quads) << 24) {}
  explicit RecordedJob(std::uint32_t word) : word_(word) {}
  [[nodiscard]] std::uint32_t steps() const { return (word_ & 0xFFFFFFu) + 1; }
  [[nodiscard]] int quads() const { return static_cast<int>(word_ >> 24); }
  [[nodiscard]] std::uint32_t word() const { return word_; }

 private:
  std::uint32_t word_ = 0;
};

/// A burst that has to do with stored depth: its tile, and the bands of rows, a quarter of a tile each (a
/// half in tiles of 4 x 4), that it touches and writes.
class RecordedAccess {
 public:
  RecordedAccess() = default;
  RecordedAccess(std::uint32_t tile_x, std::uint32_t tile_y, std::uint8_t touched, std::uint8_t written)
      : word_(tile_x | tile_y << 12 | std::uint32_t{touched} << 24 | std::uint32_t{written} << 28) {}
  explicit RecordedAccess(std::uint32_t word) : word_(word) {}
  [[nodiscard]] std::uint32_t tile_x() const { return word_ & 0xFFF; }
  [[nodiscard]] std::uint32_t tile_y() const { return word_ >> 12 & 0xFFF; }
  [[nodiscard]] std::uint8_t touched() const { return word_ >> 24 & 0xF; }
  [[nodiscard]] std::uint8_t written() const { return static_cast<std::uint8_t>(word_ >> 28); }
  [[nodiscard]] std::uint32_t word() const { return word_; }

 private:
  std::uint32_t word_ = 0;
};

/// A triangle that setup gave to the walker, with the dropped ones before it.
struct RecordedTriangle {
  std::uint32_t dropped_before = 0;
  std::uint32_t jobs = 0;
  std::uint32_t steps_after = 0;  ///< of the walker, after the last job
};

/// What the machine does in one go.
struct RecordedSegment {
  enum class Kind : std::uint32_t { kDraw, kDrawnClear, kFastClear };
  Kind kind = Kind::kDraw;
  std::uint32_t surface = kNoSurface;  ///< depth surface
  std::uint32_t touches_depth = 0;     ///< 1: each of its bursts has a RecordedAccess
  std::uint32_t triangles = 0;         ///< given to the walker
  std::uint32_t dropped_after = 0;     ///< after the last of them
};

struct RecordedSurface {
  std::uint32_t tiles_x = 0;
  std::uint32_t tiles = 0;
  std::uint32_t sample_bytes = 4;  ///< 2 or 4
};

struct FrameRecord {
  std::string name;
  Config config;  ///< the machine it was recorded on
  std::vector<RecordedSurface> surfaces;
  std::vector<RecordedSegment> segments;  ///< in order
  std::vector<RecordedTriangle> triangles;
  std::vector<RecordedJob> jobs;
  std::vector<RecordedAccess> accesses;
};

/// Most tiles of all surfaces together: 4 screens of 16384 x 16384 in the smallest tiles.
inline constexpr std::uint64_t kMostRecordedTiles = std::uint64_t{1} << 26;

/// Bands of a tile that a record tells apart.
constexpr int recorded_bands(int tile_size) { return tile_size == 4 ? 2 : 4; }

/// Records `frame` on the machine of `config`, both valid. `observer` may be null. Throws InputError where a
/// triangle makes the walker take more than kMostSteps steps without a tile job.

FrameRecord record_frame(const Frame& frame, const Config& config, PacketObserver* observer);

}  // namespace halfspace
