/// EarlyZDut from a verilated class.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "common/ports.hpp"
#include "common/verilated_model.hpp"
#include "early_z/models.hpp"

namespace halfspace::tb {

template <class Model>
class VerilatedEarlyZ final : public EarlyZDut {
 public:
  explicit VerilatedEarlyZ(std::uint64_t seed) : model_(seed) {}

  void settle(const EarlyZInputs& in, EarlyZOutputs& out) override {
    Model& m = *model_;
    m.rst_ni = in.reset ? 0 : 1;
    m.slot_write_i = in.slot_write;
    m.slot_i = in.slot;
    set_port(m.slot_equation_i, in.equation);
    set_port(m.slot_state_i, in.state);
    m.beat_valid_i = in.beat_valid;
    set_port(m.beat_i, in.beat);
    m.beat_ready_i = in.beat_ready;
    m.late_valid_i = in.late_valid;
    set_port(m.late_keep_i, in.late_keep);
    m.read_ready_i = in.read_ready;
    m.fill_valid_i = in.fill_valid;
    set_port(m.fill_data_i, in.fill);
    m.write_ready_i = in.write_ready;
    m.clear_valid_i = in.clear_valid;
    m.clear_first_i = static_cast<std::uint16_t>(in.clear_first);
    m.clear_last_i = static_cast<std::uint16_t>(in.clear_last);
    m.flush_i = in.flush;
    model_.settle();
    out.beat_ready = m.beat_ready_o != 0;
    out.beat_valid = m.beat_valid_o != 0;
    get_port(m.beat_o, out.beat);
    out.read_valid = m.read_valid_o != 0;
    out.read_line = m.read_line_o;
    out.read_half = m.read_half_o != 0;
    out.read_shift = m.read_shift_o;
    out.write_valid = m.write_valid_o != 0;
    out.write_line = m.write_line_o;
    out.write_half = m.write_half_o != 0;
    out.write_shift = m.write_shift_o;
    out.write_last = m.write_last_o != 0;
    get_port(m.write_data_o, out.write);
    out.idle = m.idle_o != 0;
    out.clear_done = m.clear_done_o != 0;
    out.flush_done = m.flush_done_o != 0;
    out.update_valid = m.update_valid_o != 0;
    get_port(m.update_o, out.update);
  }
  void clock_edge() override { model_.clock_edge(); }
  [[nodiscard]] bool assertion_failed() const override { return model_.assertion_failed(); }
  void trace_to(const std::string& file) override { model_.trace_to(file); }
  void write_coverage(const std::string& file) override { model_.write_coverage(file); }

 private:
  VerilatedModel<Model> model_;
};

/// The numbers as tb/early_z/CMakeLists.txt lists them.
template <class Model>
EarlyZModel verilated(const std::string& name, int tile_size, int sub_pixel_bits, int quad_width,
                      int test_width, int z_parts, int pending, int fifo, int lines, int ways, int misses,
                      int write_buffers, int read_bytes, int write_bytes, int clear_tiles, int memory_tiles,
                      int interpolator, int hi_z, int compression, int late_queue, int conservative,
                      int uncertainty, int samples) {
  return {name,
          {{.SubPixelBits = sub_pixel_bits,
            .PixelSamples = samples,
            .TileSize = tile_size,
            .QuadWidth = quad_width,
            .TestWidth = test_width,
            .ZParts = z_parts},
           pending,
           fifo,
           lines,
           ways,
           misses,
           write_buffers,
           read_bytes,
           write_bytes,
           clear_tiles,
           memory_tiles,
           interpolator,
           hi_z != 0,
           compression != 0,
           late_queue,
           conservative,
           uncertainty},
          [](std::uint64_t seed) -> std::unique_ptr<EarlyZDut> {
            return std::make_unique<VerilatedEarlyZ<Model>>(seed);
          }};
}

}  // namespace halfspace::tb
