/// What the bench sends to early_z, and what must come of it: commands in order, with the C++ units' answers.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/failure.hpp"
#include "early_z/models.hpp"
#include "early_z/triangles.hpp"
#include "halfspace/units/z_cache.hpp"

namespace halfspace::tb {

enum class CommandKind : std::uint8_t { kBurst, kClear, kFlush };

/// What a burst of a late draw leaves where a sample passed.
struct LateWrite {
  bool out = false;
  std::vector<std::uint32_t>
      keep;                     ///< the shader's answer, by quad; of samples that had not passed, anything
  std::size_t passed_word = 0;  ///< where one is that had passed
  std::uint32_t passed_bit = 0;
  int passed = 0;  ///< samples
  int kept = 0;    ///< of them
  std::uint8_t passed_parts = 0;
  std::uint8_t kept_parts = 0;
};

struct FlushedLine {
  std::uint32_t slot = 0;
  std::uint32_t line = 0;
  std::uint32_t bytes = 0;
};

struct Command {
  CommandKind kind = CommandKind::kBurst;
  // A burst.
  std::size_t triangle = 0;  ///< in Workload::triangles
  int quads = 0;
  EarlyZState state;
  ZMisses misses;
  std::uint8_t touched = 0;
  std::vector<std::uint32_t> lines;  ///< that it touches
  std::vector<int> fetched;          ///< the shifts by which the lines are coded that are fetched
  std::vector<int> written;          ///< and written back
  std::vector<std::vector<std::uint32_t>> beats;   ///< as they come
  std::vector<std::vector<std::uint32_t>> tested;  ///< as they must leave
  std::vector<std::uint32_t> update;               ///< what hi_z must be told
  LateWrite late;
  // A clear or a flush is offered so many cycles later than it could be.
  std::uint64_t wait = 0;
  // A clear, in tiles.
  std::uint32_t first = 0;
  std::uint32_t last = 0;
  // A flush.
  std::vector<FlushedLine> flushed;
};

struct TriangleWords {
  std::vector<std::uint32_t> equation;
  std::vector<std::uint32_t> state;
};

/// A line of memory at the end: its bytes, where memory has to hold them.
struct FinalLine {
  bool known = false;  ///< not only marked cleared
  std::vector<std::uint8_t> bytes;
};

struct Workload {
  std::vector<TriangleWords> triangles;
  std::vector<Command> commands;                         ///< the last is a flush
  std::vector<std::vector<std::uint8_t>> memory_before;  ///< by line
  std::vector<FinalLine> memory_after;
};

/// Some draws to three surfaces of different formats, and to none, with `bursts` in all; clears and flushes
/// between them. `local`: draws stay within a few tiles, so that bursts of the same line follow each other.
[[nodiscard]] Workload make_workload(const EarlyZShape& shape, std::uint64_t seed, std::size_t bursts,
                                     bool local);

/// The lines that the model's cache asks memory for, and those that it writes, in this order.
struct MemoryOrder {
  std::vector<std::uint32_t> read;
  std::vector<std::uint32_t> written;
};
[[nodiscard]] MemoryOrder memory_order(const Workload& workload);

/// Compares memory at the end of a run, in cycle `cycle`, with what it must hold; counts the lines that were.
[[nodiscard]] std::optional<Failure> compare_memory(const Workload& workload,
                                                    const std::vector<std::vector<std::uint8_t>>& memory,
                                                    std::uint64_t cycle, std::uint64_t& lines);

}  // namespace halfspace::tb
