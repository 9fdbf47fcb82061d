/// z_encoder and z_decoder as the bench sees them, whatever configuration was verilated.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "halfspace/numerics/widths.hpp"
#include "halfspace/units/z_codec.hpp"

namespace halfspace::tb {

/// A verilated configuration: the package's parameters.
struct CodecShape {
  Widths widths;

  [[nodiscard]] ZCodecShape line(bool half) const {
    return {
        .width = widths.TileSize, .height = widths.TileSize / widths.ZParts, .sample_bytes = half ? 2 : 4};
  }
  /// Whether a line can be coded with that shift.
  [[nodiscard]] bool has(bool half, int shift) const {
    return shift > 0 && shift <= kMostCodedShift && line(half).bytes() >> shift >= kLeastCodedBytes;
  }
  /// Words of a line's ports.
  [[nodiscard]] std::size_t words() const { return static_cast<std::size_t>(line(false).samples()); }
};

struct CodecInputs {
  bool reset = false;
  bool line_valid = false;
  bool line_half = false;
  std::vector<std::uint32_t> line_codes;  ///< by quad
  bool coded_valid = false;
  bool coded_half = false;
  std::uint8_t coded_shift = 0;
  std::vector<std::uint32_t> coded_data;
};

struct CodecOutputs {
  bool coded_valid = false;
  std::uint8_t coded_shift = 0;
  std::vector<std::uint32_t> coded_data;
  bool line_valid = false;
  std::vector<std::uint32_t> line_codes;

  bool operator==(const CodecOutputs&) const = default;
};

class CodecDut {
 public:
  CodecDut() = default;
  CodecDut(const CodecDut&) = delete;
  CodecDut& operator=(const CodecDut&) = delete;
  virtual ~CodecDut() = default;

  /// Clock low, inputs applied, outputs as they are then.
  virtual void settle(const CodecInputs& in, CodecOutputs& out) = 0;
  virtual void clock_edge() = 0;
  [[nodiscard]] virtual bool assertion_failed() const = 0;
  virtual void trace_to(const std::string& file) = 0;
  virtual void write_coverage(const std::string& file) = 0;
};

struct CodecModel {
  std::string name;
  CodecShape shape;
  std::unique_ptr<CodecDut> (*make)(std::uint64_t seed) = nullptr;  ///< seed of the registers before reset
};

[[nodiscard]] std::vector<CodecModel> z_codec_models();

}  // namespace halfspace::tb
