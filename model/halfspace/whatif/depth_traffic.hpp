/// What moves between the z cache and memory where lines are coded, by the class of the line.
///
/// Counters and streams of packets know the shift of a line, which says its bytes. The class says why it is
/// so small, too, and only the encoder knows it. So the frame is drawn once more, with a note for each line
/// of memory. In stats.json, bytes_read and bytes_written of early_z with those of drawn clears, and
/// flushed_bytes, are the sums of what is stored here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "halfspace/config/config.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/units/z_codec.hpp"

namespace halfspace::whatif {

enum class LineClass : std::uint8_t {
  kCleared,  ///< memory has nothing of it
  kPlaneEighth,
  kPlaneQuarter,
  kPlaneHalf,
  kEndsEighth,
  kEndsQuarter,
  kEndsHalf,
  kRaw
};
inline constexpr std::size_t kLineClasses = 8;
inline constexpr std::array<const char*, kLineClasses> kLineClassNames{
    "cleared",      "plane, eighth", "plane, quarter", "plane, half",
    "ends, eighth", "ends, quarter", "ends, half",     "raw"};

LineClass line_class(const ZCodedClass& coded);

struct LineTraffic {
  std::uint64_t lines = 0;
  std::uint64_t raw_bytes = 0;     ///< of the lines where they are not coded
  std::uint64_t stored_bytes = 0;  ///< that move

  LineTraffic& operator+=(const LineTraffic& other) {
    lines += other.lines;
    raw_bytes += other.raw_bytes;
    stored_bytes += other.stored_bytes;
    return *this;
  }
  friend bool operator==(const LineTraffic&, const LineTraffic&) = default;
};

/// By class of the line.
using ClassTraffic = std::array<LineTraffic, kLineClasses>;

/// Of all lines that move: those of each class but kCleared.
LineTraffic moved(const ClassTraffic& traffic);

struct DepthTraffic {
  ClassTraffic read;                    ///< lines that the z cache did not have
  ClassTraffic written;                 ///< dirty lines that left, the flush at the end of the frame included
  std::uint64_t lines_overwritten = 0;  ///< not in the z cache, and not read, because hi_z knew them dead
};

/// `config` is the machine; its z_cache.compression counts as on.
DepthTraffic count_depth_traffic(const Frame& frame, const Config& config);

}  // namespace halfspace::whatif
