/// CodecDut from a verilated class.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "common/ports.hpp"
#include "common/verilated_model.hpp"
#include "z_codec/models.hpp"

namespace halfspace::tb {

template <class Model>
class VerilatedCodec final : public CodecDut {
 public:
  explicit VerilatedCodec(std::uint64_t seed) : model_(seed) {}

  void settle(const CodecInputs& in, CodecOutputs& out) override {
    Model& m = *model_;
    m.rst_ni = in.reset ? 0 : 1;
    m.line_valid_i = in.line_valid;
    m.line_half_i = in.line_half;
    set_port(m.line_codes_i, in.line_codes);
    m.coded_valid_i = in.coded_valid;
    m.coded_half_i = in.coded_half;
    m.coded_shift_i = in.coded_shift;
    set_port(m.coded_data_i, in.coded_data);
    model_.settle();
    out.coded_valid = m.coded_valid_o != 0;
    out.coded_shift = m.coded_shift_o;
    get_port(m.coded_data_o, out.coded_data);
    out.line_valid = m.line_valid_o != 0;
    get_port(m.line_codes_o, out.line_codes);
  }
  void clock_edge() override { model_.clock_edge(); }
  [[nodiscard]] bool assertion_failed() const override { return model_.assertion_failed(); }
  void trace_to(const std::string& file) override { model_.trace_to(file); }
  void write_coverage(const std::string& file) override { model_.write_coverage(file); }

 private:
  VerilatedModel<Model> model_;
};

/// The numbers as tb/z_codec/CMakeLists.txt lists them.
template <class Model>
CodecModel verilated(const std::string& name, int tile_size, int z_parts) {
  return {name,
          {{.TileSize = tile_size, .ZParts = z_parts}},
          [](std::uint64_t seed) -> std::unique_ptr<CodecDut> {
            return std::make_unique<VerilatedCodec<Model>>(seed);
          }};
}

}  // namespace halfspace::tb
