/// What z_lookup, z_test and z_control of early_z share: the z cache, its buffers, and the port to memory.
#pragma once

#include <cstdint>
#include <span>
#include <systemc>
#include <vector>

#include "halfspace/timing/systemc/credit_link.hpp"
#include "halfspace/timing/systemc/depth_memory.hpp"
#include "halfspace/timing/systemc/tokens.hpp"
#include "halfspace/units/z_cache.hpp"
#include "halfspace/units/z_codec.hpp"

namespace halfspace::systemc {

struct ZCacheState {
  /// A line of memory on its way out of the cache.
  struct Exit {
    bool looked_up = false;   ///< its slot is given away by z_lookup, and z_test has not come to it
    std::uint64_t write = 0;  ///< number of its write-back, 0 where it was clean
    Cycle left = 0;           ///< first cycle in which it may be asked for
  };

  ZCacheState(RunState& run, std::uint64_t base);

  /// Fills the surfaces in memory with what they hold before the first command, in no time.
  void begin_frame();
  /// Part `part` of the burst's tile in memory.
  [[nodiscard]] std::uint32_t line_of(const PendingToken& token, int part) const;
  /// Counts the cycles in which a channel of memory moves a line of `bytes` for `draw`.
  void count_transfer(std::uint64_t CycleStats::*channel, std::uint32_t bytes, int bytes_per_cycle,
                      const DrawContext* draw);
  /// Puts the line in a slot into the write buffer, in this cycle, which is `at`; it has `bytes` in memory.
  void send(DrawContext* draw, std::uint32_t line, std::uint32_t bytes, std::uint32_t slot, Cycle at);

  // Lines in memory.
  [[nodiscard]] std::uint32_t stored_bytes(std::uint32_t line) const;
  void pack(std::uint32_t line, std::span<const std::uint32_t> codes, std::vector<std::uint8_t>& bytes) const;
  void unpack(std::uint32_t line, std::span<const std::uint8_t> bytes,
              std::vector<std::uint32_t>& codes) const;
  /// By how much a line would be coded.
  [[nodiscard]] int shift(std::uint32_t line, std::span<const std::uint32_t> codes) const;
  [[nodiscard]] ZCodecShape shape(std::uint32_t line) const;

  RunState& run;
  std::uint64_t base;  ///< address of the first surface
  DepthMemory memory;
  CreditLink<PendingToken> pending;
  CreditLink<FillToken> fill_buffers;
  CreditLink<WriteToken> write_buffers;

  // What z_lookup knows.
  ZTags tags;
  std::vector<std::uint32_t> line_of_slot;

  // What z_test knows.
  ZLines lines;
  std::vector<std::vector<std::uint32_t>> codes;  ///< by slot: the data of the cache
  std::vector<std::uint32_t> clear_code;          ///< by surface

  // What they tell each other.
  std::vector<Exit> exits;  ///< by line of memory
  sc_core::sc_event exit_changed{"exit_changed"};

  // Write-back.
  std::uint64_t writes_sent = 0;
  std::uint64_t writes_done = 0;
  Cycle next_write = 0;  ///< first cycle after the last write
};

}  // namespace halfspace::systemc
