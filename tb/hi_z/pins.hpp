/// HiZDut from a verilated class.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "common/ports.hpp"
#include "common/verilated_model.hpp"
#include "hi_z/models.hpp"

namespace halfspace::tb {

template <class Model>
class VerilatedHiZ final : public HiZDut {
 public:
  explicit VerilatedHiZ(std::uint64_t seed) : model_(seed) {}

  void settle(const HiZInputs& in, HiZOutputs& out) override {
    Model& m = *model_;
    m.rst_ni = in.reset ? 0 : 1;
    m.slot_write_i = in.slot_write;
    m.slot_i = in.slot;
    set_port(m.slot_equation_i, in.equation);
    set_port(m.slot_state_i, in.state);
    m.block_valid_i = in.block_valid;
    set_port(m.block_i, in.block);
    m.block_ready_i = in.left_ready;
    m.job_valid_i = in.job_valid;
    m.job_burst_i = in.job_burst;
    m.update_valid_i = in.update_valid;
    set_port(m.update_i, in.update);
    m.drain_i = in.drain;
    m.clear_i = in.clear;
    m.clear_first_i = static_cast<std::uint16_t>(in.clear_first);
    m.clear_last_i = static_cast<std::uint16_t>(in.clear_last);
    m.forget_i = in.forget;
    model_.settle();
    out.block_ready = m.block_ready_o != 0;
    out.left_valid = m.block_valid_o != 0;
    get_port(m.block_o, out.left);
    out.clear_done = m.clear_done_o != 0;
    out.slot_write = m.slot_write_o != 0;
    out.slot = m.slot_o;
    get_port(m.slot_equation_o, out.equation);
    get_port(m.slot_state_o, out.state);
    out.activity = m.activity_o;
    out.idle = m.idle_o != 0;
  }
  void clock_edge() override { model_.clock_edge(); }
  [[nodiscard]] bool assertion_failed() const override { return model_.assertion_failed(); }
  void trace_to(const std::string& file) override { model_.trace_to(file); }
  void write_coverage(const std::string& file) override { model_.write_coverage(file); }

 private:
  VerilatedModel<Model> model_;
};

/// The numbers as tb/hi_z/CMakeLists.txt lists them.
template <class Model>
HiZModel verilated(const std::string& name, int tile_size, int block_size, int sub_pixel_bits, int z_parts,
                   int fifo, int accept, int bits, int lag, int memory_blocks, int clear_blocks) {
  return {
      name,
      {{.SubPixelBits = sub_pixel_bits, .BlockSize = block_size, .TileSize = tile_size, .ZParts = z_parts},
       fifo,
       accept != 0,
       bits,
       lag,
       memory_blocks,
       clear_blocks},
      [](std::uint64_t seed) -> std::unique_ptr<HiZDut> {
        return std::make_unique<VerilatedHiZ<Model>>(seed);
      }};
}

}  // namespace halfspace::tb
