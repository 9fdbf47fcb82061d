/// early_z as the bench sees it, whatever configuration was verilated.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "halfspace/numerics/conservative.hpp"
#include "halfspace/numerics/widths.hpp"
#include "halfspace/units/depth_interpolator.hpp"
#include "halfspace/units/z_codec.hpp"
#include "halfspace/units/z_line.hpp"

namespace halfspace::tb {

/// A verilated configuration: the package's parameters and the unit's.
struct EarlyZShape {
  Widths widths;
  int pending = 32;
  int fifo = 16;
  int lines = 128;
  int ways = 4;
  int misses = 16;
  int write_buffers = 4;
  int read_bytes = 64;
  int write_bytes = 64;
  int clear_tiles = 64;
  int memory_tiles = 1024;
  int interpolator_number = 1;
  bool hi_z = false;
  bool compression = false;
  int late_queue = 0;
  int conservative_number = 0;
  int uncertainty = 0;

  [[nodiscard]] DepthInterpolator interpolator() const {
    return static_cast<DepthInterpolator>(interpolator_number);
  }

  [[nodiscard]] Conservative conservative() const { return static_cast<Conservative>(conservative_number); }

  /// Bytes of a line of 4-byte samples.
  [[nodiscard]] int line_bytes() const { return 4 * widths.MaskBits / widths.ZParts; }
  /// Cycles in which a line is decoded and encoded: a register each, and those of z_decoder and z_encoder.
  [[nodiscard]] int decode() const { return compression ? 5 : 0; }
  [[nodiscard]] int encode() const { return compression ? 7 : 0; }
  /// Of a line of the surface.
  [[nodiscard]] ZCodecShape codec(DepthFormat format) const {
    return {.width = widths.TileSize,
            .height = widths.TileSize / widths.ZParts,
            .sample_bytes = sample_bytes(format)};
  }
  [[nodiscard]] int sets() const { return lines / (ways * widths.ZParts); }
};

struct EarlyZInputs {
  bool reset = false;
  bool slot_write = false;
  std::uint8_t slot = 0;
  std::vector<std::uint32_t> equation;
  std::vector<std::uint32_t> state;
  bool beat_valid = false;
  std::vector<std::uint32_t> beat;
  bool beat_ready = false;
  bool late_valid = false;
  std::vector<std::uint32_t> late_keep;
  bool read_ready = true;
  bool fill_valid = false;
  std::vector<std::uint32_t> fill;
  bool write_ready = true;
  bool clear_valid = false;
  std::uint32_t clear_first = 0;
  std::uint32_t clear_last = 0;
  bool flush = false;
};

struct EarlyZOutputs {
  bool beat_ready = false;
  bool beat_valid = false;
  std::vector<std::uint32_t> beat;
  bool read_valid = false;
  std::uint32_t read_line = 0;
  bool read_half = false;
  std::uint32_t read_shift = 0;
  bool write_valid = false;
  std::uint32_t write_line = 0;
  bool write_half = false;
  std::uint32_t write_shift = 0;
  bool write_last = false;
  std::vector<std::uint32_t> write;
  bool idle = false;
  bool clear_done = false;
  bool flush_done = false;
  bool update_valid = false;
  std::vector<std::uint32_t> update;
};

class EarlyZDut {
 public:
  EarlyZDut() = default;
  EarlyZDut(const EarlyZDut&) = delete;
  EarlyZDut& operator=(const EarlyZDut&) = delete;
  virtual ~EarlyZDut() = default;

  /// Clock low, inputs applied, outputs as they are then.
  virtual void settle(const EarlyZInputs& in, EarlyZOutputs& out) = 0;
  virtual void clock_edge() = 0;
  [[nodiscard]] virtual bool assertion_failed() const = 0;
  virtual void trace_to(const std::string& file) = 0;
  virtual void write_coverage(const std::string& file) = 0;
};

struct EarlyZModel {
  std::string name;
  EarlyZShape shape;
  std::unique_ptr<EarlyZDut> (*make)(std::uint64_t seed) = nullptr;  ///< seed of the registers before reset
};

[[nodiscard]] std::vector<EarlyZModel> early_z_models();

}  // namespace halfspace::tb
