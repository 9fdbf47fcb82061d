/// hi_z as the bench sees it, whatever configuration was verilated.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "halfspace/numerics/widths.hpp"
#include "halfspace/units/hi_z.hpp"

namespace halfspace::tb {

/// A verilated configuration: the package's parameters and the unit's.
struct HiZShape {
  Widths widths;
  int fifo = 8;
  bool accept = true;
  int bits = 8;
  int lag = 128;
  int memory_blocks = 1024;
  int clear_blocks = 64;

  [[nodiscard]] HiZConfig config() const {
    return {.enabled = true,
            .accept = accept,
            .bits = bits,
            .lag = lag,
            .block_size = widths.BlockSize,
            .tile_size = widths.TileSize,
            .parts = widths.ZParts};
  }
  [[nodiscard]] std::size_t entries() const {
    return static_cast<std::size_t>(widths.BlockTiles) * static_cast<std::size_t>(widths.ZParts);
  }
};

struct HiZInputs {
  bool reset = false;
  bool slot_write = false;
  std::uint8_t slot = 0;
  std::vector<std::uint32_t> equation;
  std::vector<std::uint32_t> state;
  bool block_valid = false;
  std::vector<std::uint32_t> block;
  bool left_ready = false;
  bool job_valid = false;
  bool job_burst = false;
  bool update_valid = false;
  std::vector<std::uint32_t> update;
  bool drain = false;
  bool clear = false;
  std::uint32_t clear_first = 0;
  std::uint32_t clear_last = 0;
  bool forget = false;
};

struct HiZOutputs {
  bool block_ready = false;
  bool left_valid = false;
  std::vector<std::uint32_t> left;
  bool clear_done = false;
  bool slot_write = false;
  std::uint8_t slot = 0;
  std::vector<std::uint32_t> equation;
  std::vector<std::uint32_t> state;
  std::uint8_t activity = 0;
  bool idle = false;
};

class HiZDut {
 public:
  HiZDut() = default;
  HiZDut(const HiZDut&) = delete;
  HiZDut& operator=(const HiZDut&) = delete;
  virtual ~HiZDut() = default;

  /// Clock low, inputs applied, outputs as they are then.
  virtual void settle(const HiZInputs& in, HiZOutputs& out) = 0;
  virtual void clock_edge() = 0;
  [[nodiscard]] virtual bool assertion_failed() const = 0;
  virtual void trace_to(const std::string& file) = 0;
  virtual void write_coverage(const std::string& file) = 0;
};

struct HiZModel {
  std::string name;
  HiZShape shape;
  std::unique_ptr<HiZDut> (*make)(std::uint64_t seed) = nullptr;  ///< seed of the registers before reset
};

[[nodiscard]] std::vector<HiZModel> hi_z_models();

}  // namespace halfspace::tb
