/// StreamDut from a verilated class. Pins names the members of that class.
#pragma once

#include <verilated.h>
#include <verilated_cov.h>
#include <verilated_fst_c.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "stream_dut.hpp"

namespace halfspace::tb {

template <std::size_t N>
void to_port(std::span<const std::uint32_t> words, VlWide<N>& port) {
  std::copy_n(words.begin(), N, &port[0]);
}

template <std::size_t N>
std::span<const std::uint32_t> from_port(const VlWide<N>& port) {
  return {&port[0], N};
}

/// Pins<Model>: static accessors job(model), job_valid(model) and so on; see tb/edge_evaluator. A link of
/// several ports has set_input_payload() in place of input_payload(); outputs that belong to no link:
/// side_outputs().
template <class Model, class Pins>
class VerilatedDut final : public StreamDut {
 public:
  explicit VerilatedDut(std::uint64_t seed) {
    context_.randReset(2);
    context_.randSeed(static_cast<int>(seed & 0x7fffffff) | 1);
    context_.fatalOnError(false);
    context_.traceEverOn(true);
    model_ = std::make_unique<Model>(&context_);
    model_->clk_i = 0;
    model_->eval();
  }
  ~VerilatedDut() override {
    // Verilator 5.006 takes the context of its destructors from the thread: another model's, if that was the
    // last.
    Verilated::threadContextp(&context_);
    if (trace_) {
      trace_->close();
    }
    model_->final();
  }

  void set_reset(bool active) override { model_->rst_ni = active ? 0 : 1; }
  void set_input(bool valid, std::span<const std::uint32_t> payload) override {
    Pins::input_valid(*model_) = valid ? 1 : 0;
    if constexpr (requires { Pins::set_input_payload(*model_, payload); }) {
      Pins::set_input_payload(*model_, payload);
    } else {
      to_port(payload, Pins::input_payload(*model_));
    }
  }
  void set_output_ready(bool ready) override { Pins::output_ready(*model_) = ready ? 1 : 0; }

  void settle() override {
    model_->clk_i = 0;
    model_->eval();
    dump();
  }
  void clock_edge() override {
    model_->clk_i = 1;
    model_->eval();
    dump();
  }

  [[nodiscard]] bool input_ready() const override { return Pins::input_ready(*model_) != 0; }
  [[nodiscard]] bool output_valid() const override { return Pins::output_valid(*model_) != 0; }
  [[nodiscard]] std::span<const std::uint32_t> output_payload() const override {
    return from_port(Pins::output_payload(*model_));
  }
  [[nodiscard]] std::span<const std::uint32_t> side_outputs() override {
    if constexpr (requires { Pins::side_outputs(*model_, side_); }) {
      side_.clear();
      Pins::side_outputs(*model_, side_);
    }
    return side_;
  }
  [[nodiscard]] bool assertion_failed() const override { return context_.gotError(); }

  void trace_to(const std::string& file) override {
    trace_ = std::make_unique<VerilatedFstC>();
    model_->trace(trace_.get(), 99);
    trace_->open(file.c_str());
  }
  void write_coverage(const std::string& file) override { context_.coveragep()->write(file.c_str()); }

 private:
  void dump() {
    context_.timeInc(1);
    if (trace_) {
      trace_->dump(context_.time());
    }
  }

  VerilatedContext context_;
  std::unique_ptr<Model> model_;
  std::unique_ptr<VerilatedFstC> trace_;
  std::vector<std::uint32_t> side_;
};

}  // namespace halfspace::tb
