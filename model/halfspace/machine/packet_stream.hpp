/// The packets of a frame as a stream: all that time depends on, and nothing that only function needs.
///
/// Whoever runs the units writes it (machine/in_order.hpp), in chunks; whoever has time reads it: the
/// recurrence, its lanes, the record. A tile job is one byte whatever it holds, and a burst that has to do
/// with stored depth a word more. Chunks may end anywhere, also inside a triangle, but not inside a block;
/// put together in order they are the stream of the frame.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/scene/frame.hpp"
#include "halfspace/units/z_cache.hpp"

namespace halfspace {

/// A block job: the blocks without a tile that the walker visited since the job before, and its tile jobs, as
/// many as it has tiles with several samples a pixel times those: at most 1023.
class StreamBlock {
 public:
  StreamBlock() = default;
  StreamBlock(std::uint32_t empty_before, int jobs)
      : word_(empty_before | jobs_field(static_cast<std::uint32_t>(jobs))) {}
  explicit StreamBlock(std::uint32_t word) : word_(word) {}
  /// A screen has no more than 2^22 blocks, one of which is this one.
  [[nodiscard]] std::uint32_t empty_before() const { return word_ & kEmptyMask; }
  [[nodiscard]] int jobs() const { return static_cast<int>(word_ >> 24 | (word_ >> 22 & 3) << 8); }
  void add_job() { *this = StreamBlock(empty_before(), jobs() + 1); }
  [[nodiscard]] std::uint32_t word() const { return word_; }

 private:
  static constexpr std::uint32_t kEmptyMask = (1u << 22) - 1;
  /// The low eight bits on top, as records without samples have them, the others below them.
  static constexpr std::uint32_t jobs_field(std::uint32_t jobs) { return jobs << 24 | (jobs >> 8 & 3) << 22; }

  std::uint32_t word_ = 0;
};

/// A tile job: its quads, 0 to 64. 0: no sample is covered, and nothing leaves the quad generator.
using StreamJob = std::uint8_t;

/// A burst that has to do with stored depth: its tile, and the bands of rows, a quarter of a tile each (a
/// half in tiles of 4 x 4), that it touches, writes and overwrites whole; by how much the parts that it
/// writes are coded then, on the machine that the stream is of; and whether its draw writes late, and it
/// does.
class StreamAccess {
 public:
  StreamAccess() = default;
  StreamAccess(std::uint32_t tile_x, std::uint32_t tile_y, std::uint8_t touched, std::uint8_t written,
               std::uint8_t sure = 0, ZShifts shifts = {}, bool late = false, bool late_write = false)
      : words_{(tile_x & 0xFFF) | tile_y << 12 | std::uint32_t{touched} << 24 | std::uint32_t{written} << 28,
               sure | std::uint32_t{shifts.bits()} << 4 | (late ? 1u << 12 : 0) |
                   (late_write ? 1u << 13 : 0) | tile_x >> 12 << 14} {}
  explicit StreamAccess(const std::array<std::uint32_t, 2>& words) : words_(words) {}
  /// With several samples a pixel, of a column of one of them (see TileJob): 16 bits.
  [[nodiscard]] std::uint32_t tile_x() const { return (words_[0] & 0xFFF) | (words_[1] >> 14 & 0xF) << 12; }
  [[nodiscard]] std::uint32_t tile_y() const { return words_[0] >> 12 & 0xFFF; }
  [[nodiscard]] std::uint8_t touched() const { return words_[0] >> 24 & 0xF; }
  [[nodiscard]] std::uint8_t written() const { return static_cast<std::uint8_t>(words_[0] >> 28); }
  [[nodiscard]] std::uint8_t sure() const { return words_[1] & 0xF; }
  [[nodiscard]] ZShifts shifts() const { return ZShifts(static_cast<std::uint8_t>(words_[1] >> 4)); }
  [[nodiscard]] bool late() const { return (words_[1] >> 12 & 1) != 0; }
  [[nodiscard]] bool late_write() const { return (words_[1] >> 13 & 1) != 0; }
  [[nodiscard]] const std::array<std::uint32_t, 2>& words() const { return words_; }

 private:
  std::array<std::uint32_t, 2> words_{};
};

/// Bands of a tile that a StreamAccess tells apart.
constexpr int stream_bands(int tile_size) { return tile_size == 4 ? 2 : 4; }

/// A triangle that setup gave to the walker, with the dropped ones before it.
struct StreamTriangle {
  std::uint32_t dropped_before = 0;
  std::uint32_t blocks = 0;       ///< jobs of them
  std::uint32_t empty_after = 0;  ///< blocks without a tile, after the last job
};

/// What the machine does in one go.
struct StreamSegment {
  enum class Kind : std::uint32_t { kDraw, kDrawnClear, kFastClear };
  Kind kind = Kind::kDraw;
  std::uint32_t surface = kNoSurface;  ///< depth surface
  std::uint32_t touches_depth = 0;     ///< 1: each of its bursts has to do with stored depth
  std::uint32_t triangles = 0;         ///< given to the walker
  std::uint32_t dropped_after = 0;     ///< after the last of them
};

struct StreamSurface {
  std::uint32_t tiles_x = 0;
  std::uint32_t tiles = 0;
  std::uint32_t sample_bytes = 4;  ///< 2 or 4
};

/// Each list is in order and belongs to the one before.
struct PacketStream {
  std::vector<StreamSegment> segments;
  std::vector<StreamTriangle> triangles;
  std::vector<StreamBlock> blocks;
  std::vector<StreamJob> jobs;
  std::vector<StreamAccess> accesses;  ///< of the bursts of segments that touch depth
};

/// A burst that waits for late writes, or that leaves one.
struct StreamLate {
  std::uint32_t access = 0;
  std::uint32_t done = 0;  ///< so many late writes of the frame are done before it is tested
  bool leaves = false;
};

/// What the z cache of one machine says to the bursts of a stream. It does not depend on time.
struct ZMissStream {
  std::vector<ZMiss> misses;         ///< of all bursts, in order
  std::vector<std::uint32_t> burst;  ///< the access each miss belongs to; then one that no access has
  std::vector<StreamLate> late;      ///< in order; then one of kNoBurst
};

/// Ends ZMissStream::burst and late.
inline constexpr std::uint32_t kNoBurst = 0xFFFFFFFFu;

/// A dirty line of the z cache at the end of the frame.
struct ZFlush {
  std::uint32_t slot = 0;
  std::uint32_t bytes = 0;
};

/// The top left pixel of a tile job.
struct StreamTile {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
};

/// A part of a stream, or all of it, for who reads it.
struct StreamView {
  std::span<const StreamSegment> segments;
  std::span<const StreamTriangle> triangles;
  std::span<const StreamBlock> blocks;
  std::span<const StreamJob> jobs;
  std::span<const StreamAccess> accesses;  ///< empty where the reader did not ask for them
  std::span<const ZMiss> misses;           ///< see ZMissStream
  std::span<const std::uint32_t> miss_burst;
  std::span<const StreamLate> late;
  std::span<const StreamTile> tiles;  ///< one a job; empty where the reader did not ask for them
  /// One a burst: bit i: its quad i, in the order in which they leave, asks the interpolator for attributes.
  /// Empty where the reader did not ask for them.
  std::span<const std::uint64_t> live;
  bool continues_segment = false;   ///< the first segment began in the part before
  bool continues_triangle = false;  ///< so did the first triangle
  bool open_segment = false;        ///< the last segment goes on in the next part
  bool open_triangle = false;       ///< so does the last triangle
};

/// Reads the stream of a frame while the units run.
class StreamReader {
 public:
  virtual ~StreamReader() = default;
  [[nodiscard]] virtual bool wants_accesses() const { return false; }
  [[nodiscard]] virtual bool wants_tiles() const { return false; }
  [[nodiscard]] virtual bool wants_live() const { return false; }
  /// It knows in which cycle a burst leaves early_z.
  [[nodiscard]] virtual bool has_time() const { return false; }

  /// Before the first part. `memory_lines`: lines of memory that all surfaces take. Whoever writes the stream
  /// numbers them, below that.
  virtual void begin(std::span<const StreamSurface> surfaces, std::uint32_t memory_lines) = 0;
  /// The next part. Where `burst_cycles` is not null, which it is only where the reader has time, appends for
  /// each of its bursts the cycle in which the first beat leaves early_z.
  virtual void read(const StreamView& part, std::vector<std::uint64_t>* burst_cycles) = 0;
  /// The end of the frame: the lines that the z cache writes back.
  virtual void end(std::span<const ZFlush> dirty) = 0;
};

}  // namespace halfspace
