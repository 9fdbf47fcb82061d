/// rtl/raster_pipeline.sv of one configuration, verilated, as its driver sees it: inputs and outputs of a
/// cycle. tb/raster_pipeline makes it, in a library that is loaded at run time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "halfspace/machine/shape.hpp"

namespace halfspace::rtl {

/// The bit of an event in PipelineOutputs::events.
constexpr std::uint32_t bit(Event event) { return 1u << static_cast<int>(event); }
/// Above them: lines that enter the write buffer in the cycle, 3 bits.
inline constexpr int kWritesShift = static_cast<int>(kEvents);

struct PipelineInputs {
  bool reset = false;
  bool triangle_valid = false;
  bool beat_ready = false;
  bool late_valid = false;
  bool fill_valid = false;
  bool clear_valid = false;
  bool flush = false;
  std::uint32_t clear_first = 0;
  std::uint32_t clear_last = 0;
  std::uint32_t clear_first_block = 0;
  std::uint32_t clear_last_block = 0;
  std::uint32_t counter_select = 0;
  std::vector<std::uint32_t> triangle;  ///< screen_triangle_t; all payloads in packed words
  std::vector<std::uint32_t> state;     ///< draw_state_t
  std::vector<std::uint32_t> fill;
  std::vector<std::uint32_t> late_keep;  ///< of the tile, 4 bits a quad

  friend bool operator==(const PipelineInputs&, const PipelineInputs&) = default;
};

/// Memory always takes requests and writes.
struct PipelineOutputs {
  bool triangle_ready = false;
  bool beat_valid = false;
  bool read_valid = false;
  bool read_half = false;
  int read_shift = 0;
  bool write_valid = false;
  bool write_half = false;
  int write_shift = 0;
  bool write_last = false;
  bool idle = false;
  std::uint32_t read_line = 0;
  std::uint32_t write_line = 0;
  std::uint32_t activity = 0;  ///< of all stages, 3 bits each, setup's lowest
  std::uint32_t events = 0;
  std::uint64_t counter = 0;

  friend bool operator==(const PipelineOutputs&, const PipelineOutputs&) = default;
};

class VerilatedPipeline {
 public:
  VerilatedPipeline() = default;
  VerilatedPipeline(const VerilatedPipeline&) = delete;
  VerilatedPipeline& operator=(const VerilatedPipeline&) = delete;
  virtual ~VerilatedPipeline() = default;

  /// Clock low, inputs applied; outputs as they are then.
  virtual void settle(const PipelineInputs& in, PipelineOutputs& out) = 0;
  virtual void clock_edge() = 0;
  /// Whether the counters of cycles count from the next settled cycle on; at first they do.
  virtual void count_cycles(bool on) = 0;
  /// Keeps what every register, wire and input holds in the settled cycle.
  virtual void keep_state() = 0;
  /// Whether all of them hold that in this one.
  [[nodiscard]] virtual bool holds_kept_state() const = 0;
  /// Outputs that are registers, as they are after the clock edge.
  [[nodiscard]] virtual bool clear_done() const = 0;
  [[nodiscard]] virtual bool flush_done() const = 0;

  // Payloads in the settled cycle, in packed words; each means something with its event only.
  [[nodiscard]] virtual std::span<const std::uint32_t> setup_triangle() const = 0;
  [[nodiscard]] virtual std::span<const std::uint32_t> depth_equation() const = 0;
  [[nodiscard]] virtual std::span<const std::uint32_t> draw_state() const = 0;
  /// Of a block job as block_walker has made it, where hi_z takes it; then where tile_walker takes it.
  [[nodiscard]] virtual std::span<const std::uint32_t> walked_job() const = 0;
  [[nodiscard]] virtual std::span<const std::uint32_t> block_job() const = 0;
  [[nodiscard]] virtual std::span<const std::uint32_t> tile_job() const = 0;
  [[nodiscard]] virtual std::span<const std::uint32_t> coverage() const = 0;
  [[nodiscard]] virtual std::span<const std::uint32_t> quad_beat() const = 0;
  [[nodiscard]] virtual std::span<const std::uint32_t> tested_beat() const = 0;
  virtual void write_data(std::vector<std::uint32_t>& words) const = 0;

  /// An assertion of the RTL has failed; its message is on standard output.
  [[nodiscard]] virtual bool assertion_failed() const = 0;
  /// Writes an FST waveform from now on. Throws InputError where the library was built without.
  virtual void trace_to(const std::filesystem::path& file) = 0;
};

}  // namespace halfspace::rtl
