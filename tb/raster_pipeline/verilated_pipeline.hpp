/// rtl::VerilatedPipeline from a verilated class.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/ports.hpp"
#include "common/verilated_model.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/timing/rtl/verilated_pipeline.hpp"

namespace halfspace::tb {

/// kTraced: the model was verilated with --trace-fst.
template <class Model, bool kTraced>
class VerilatedRasterPipeline final : public rtl::VerilatedPipeline {
 public:
  explicit VerilatedRasterPipeline(std::uint64_t seed) : model_(seed) {
    model_->read_ready_i = 1;
    model_->write_ready_i = 1;
    model_->count_i = 1;
  }

  void settle(const rtl::PipelineInputs& in, rtl::PipelineOutputs& out) override {
    Model& m = *model_;
    m.rst_ni = in.reset ? 0 : 1;
    m.triangle_valid_i = in.triangle_valid;
    if (in.triangle_valid) {
      set_port(m.triangle_i, in.triangle);
      set_port(m.state_i, in.state);
    }
    m.beat_ready_i = in.beat_ready;
    m.late_valid_i = in.late_valid;
    if (in.late_valid) {
      set_port(m.late_keep_i, in.late_keep);
    }
    m.fill_valid_i = in.fill_valid;
    if (in.fill_valid) {
      set_port(m.fill_data_i, in.fill);
    }
    m.clear_valid_i = in.clear_valid;
    set_number(m.clear_first_i, in.clear_first);
    set_number(m.clear_last_i, in.clear_last);
    set_number(m.clear_first_block_i, in.clear_first_block);
    set_number(m.clear_last_block_i, in.clear_last_block);
    m.flush_i = in.flush;
    set_number(m.counter_select_i, in.counter_select);
    model_.settle();
    out.triangle_ready = m.triangle_ready_o != 0;
    out.beat_valid = m.beat_valid_o != 0;
    out.read_valid = m.read_valid_o != 0;
    out.read_half = m.read_half_o != 0;
    out.read_shift = m.read_shift_o;
    out.write_valid = m.write_valid_o != 0;
    out.write_half = m.write_half_o != 0;
    out.write_shift = m.write_shift_o;
    out.write_last = m.write_last_o != 0;
    out.idle = m.idle_o != 0;
    out.read_line = m.read_line_o;
    out.write_line = m.write_line_o;
    out.activity = m.activity_o;
    out.events = m.rootp->raster_pipeline__DOT__u_probe__DOT__events;
    out.counter = m.counter_o;
  }
  void clock_edge() override { model_.clock_edge(); }
  void count_cycles(bool on) override { model_->count_i = on; }
  void keep_state() override {
    kept_.resize(sizeof(State));
    std::memcpy(kept_.data(), model_->rootp->vlSymsp, sizeof(State));
  }
  [[nodiscard]] bool holds_kept_state() const override {
    return std::memcmp(kept_.data(), model_->rootp->vlSymsp, sizeof(State)) == 0;
  }
  [[nodiscard]] bool clear_done() const override { return model_->clear_done_o != 0; }
  [[nodiscard]] bool flush_done() const override { return model_->flush_done_o != 0; }

  [[nodiscard]] std::span<const std::uint32_t> setup_triangle() const override {
    return words_of(model_->rootp->raster_pipeline__DOT__u_probe__DOT__triangle);
  }
  [[nodiscard]] std::span<const std::uint32_t> depth_equation() const override {
    return words_of(model_->rootp->raster_pipeline__DOT__u_probe__DOT__equation);
  }
  [[nodiscard]] std::span<const std::uint32_t> draw_state() const override {
    return words_of(model_->rootp->raster_pipeline__DOT__u_probe__DOT__state);
  }
  [[nodiscard]] std::span<const std::uint32_t> walked_job() const override {
    return words_of(model_->rootp->raster_pipeline__DOT__u_probe__DOT__walked_job);
  }
  [[nodiscard]] std::span<const std::uint32_t> block_job() const override {
    return words_of(model_->rootp->raster_pipeline__DOT__u_probe__DOT__block_job);
  }
  [[nodiscard]] std::span<const std::uint32_t> tile_job() const override {
    return words_of(model_->rootp->raster_pipeline__DOT__u_probe__DOT__tile_job);
  }
  [[nodiscard]] std::span<const std::uint32_t> coverage() const override {
    return words_of(model_->rootp->raster_pipeline__DOT__u_probe__DOT__coverage);
  }
  [[nodiscard]] std::span<const std::uint32_t> quad_beat() const override {
    return words_of(model_->rootp->raster_pipeline__DOT__u_probe__DOT__quad_beat);
  }
  [[nodiscard]] std::span<const std::uint32_t> tested_beat() const override {
    return words_of(model_->beat_o);
  }
  void write_data(std::vector<std::uint32_t>& data) const override { get_port(model_->write_data_o, data); }

  [[nodiscard]] bool assertion_failed() const override { return model_.assertion_failed(); }
  void trace_to(const std::filesystem::path& file) override {
    if constexpr (kTraced) {
      model_.trace_to(file.string());
    } else {
      throw InputError(file.string() +
                       ": this pipeline was verilated without waveforms; one with checks has them");
    }
  }

 private:
  /// The class in which Verilator has all state of a model: the root, modules that are classes of their own,
  /// and pointers that stay.
  using State = std::remove_reference_t<decltype(*std::declval<Model>().rootp->vlSymsp)>;

  template <class Port>
  static void set_number(Port& port, std::uint32_t value) {
    port = static_cast<Port>(value);
  }

  VerilatedModel<Model, kTraced> model_;
  std::vector<std::byte> kept_;
};

}  // namespace halfspace::tb
