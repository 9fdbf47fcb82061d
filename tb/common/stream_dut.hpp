/// A device under test with one link in and one link out, whatever made it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace halfspace::tb {

/// Pins are sampled between settle() and clock_edge(); words are packed as model/halfspace/units/packing.hpp
/// does.
class StreamDut {
 public:
  StreamDut() = default;
  StreamDut(const StreamDut&) = delete;
  StreamDut& operator=(const StreamDut&) = delete;
  virtual ~StreamDut() = default;

  virtual void set_reset(bool active) = 0;
  virtual void set_input(bool valid, std::span<const std::uint32_t> payload) = 0;
  virtual void set_output_ready(bool ready) = 0;
  /// Lets the combinational logic follow the inputs, clock low.
  virtual void settle() = 0;
  virtual void clock_edge() = 0;

  [[nodiscard]] virtual bool input_ready() const = 0;
  [[nodiscard]] virtual bool output_valid() const = 0;
  [[nodiscard]] virtual std::span<const std::uint32_t> output_payload() const = 0;
  /// Outputs that belong to no link with a handshake, in an order of the unit's own: for its UnitTiming.
  [[nodiscard]] virtual std::span<const std::uint32_t> side_outputs() { return {}; }

  /// True once an assertion of the RTL has failed; its message is on standard output.
  [[nodiscard]] virtual bool assertion_failed() const = 0;
  /// Writes a waveform from the next edge on.
  virtual void trace_to(const std::string& file) = 0;
  /// Writes what a model built with coverage has counted; of other models an empty file.
  virtual void write_coverage(const std::string& file) = 0;
};

/// A model of one unit in one configuration.
struct DutModel {
  std::string name;
  int tile_size = 0;
  int sub_pixel_bits = 0;
  int pipe_stages = 0;
  std::unique_ptr<StreamDut> (*make)(std::uint64_t seed) = nullptr;  ///< seed of the registers before reset
};

}  // namespace halfspace::tb
