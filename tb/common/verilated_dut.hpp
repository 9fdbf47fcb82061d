/// StreamDut from a verilated class. Pins names the members of that class.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ports.hpp"
#include "stream_dut.hpp"
#include "verilated_model.hpp"

namespace halfspace::tb {

/// Pins: static accessors input_payload(model), input_valid(model) and so on; see tb/edge_evaluator. A link
/// of several ports has set_input_payload() in place of input_payload(); outputs that belong to no link:
/// side_outputs().
template <class Model, class Pins>
class VerilatedDut final : public StreamDut {
 public:
  explicit VerilatedDut(std::uint64_t seed) : model_(seed) {}

  void set_reset(bool active) override { model_->rst_ni = active ? 0 : 1; }
  void set_input(bool valid, std::span<const std::uint32_t> payload) override {
    Pins::input_valid(*model_) = valid ? 1 : 0;
    if constexpr (requires { Pins::set_input_payload(*model_, payload); }) {
      Pins::set_input_payload(*model_, payload);
    } else {
      set_port(Pins::input_payload(*model_), payload);
    }
  }
  void set_output_ready(bool ready) override { Pins::output_ready(*model_) = ready ? 1 : 0; }

  void settle() override { model_.settle(); }
  void clock_edge() override { model_.clock_edge(); }

  [[nodiscard]] bool input_ready() const override { return Pins::input_ready(*model_) != 0; }
  [[nodiscard]] bool output_valid() const override { return Pins::output_valid(*model_) != 0; }
  [[nodiscard]] std::span<const std::uint32_t> output_payload() const override {
    return words_of(Pins::output_payload(*model_));
  }
  [[nodiscard]] std::span<const std::uint32_t> side_outputs() override {
    if constexpr (requires { Pins::side_outputs(*model_, side_); }) {
      side_.clear();
      Pins::side_outputs(*model_, side_);
    }
    return side_;
  }
  [[nodiscard]] bool assertion_failed() const override { return model_.assertion_failed(); }

  void trace_to(const std::string& file) override { model_.trace_to(file); }
  void write_coverage(const std::string& file) override { model_.write_coverage(file); }

 private:
  VerilatedModel<Model> model_;
  std::vector<std::uint32_t> side_;
};

template <class Model, class Pins>
std::unique_ptr<StreamDut> make_dut(std::uint64_t seed) {
  return std::make_unique<VerilatedDut<Model, Pins>>(seed);
}

}  // namespace halfspace::tb
