/// EarlyZDut from a verilated class.
#pragma once

#include <verilated.h>
#include <verilated_cov.h>
#include <verilated_fst_c.h>

#include <memory>
#include <string>

#include "common/ports.hpp"
#include "early_z/dut.hpp"

namespace halfspace::tb {

template <class Model>
class VerilatedEarlyZ final : public EarlyZDut {
 public:
  explicit VerilatedEarlyZ(std::uint64_t seed) {
    context_.randReset(2);
    context_.randSeed(static_cast<int>(seed & 0x7fffffff) | 1);
    context_.fatalOnError(false);
    context_.traceEverOn(true);
    model_ = std::make_unique<Model>(&context_);
    model_->clk_i = 0;
    model_->eval();
  }
  ~VerilatedEarlyZ() override {
    Verilated::threadContextp(
        &context_);  // Verilator 5.006 takes the context of its destructors from the thread
    if (trace_) {
      trace_->close();
    }
    model_->final();
  }

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
    m.read_ready_i = in.read_ready;
    m.fill_valid_i = in.fill_valid;
    set_port(m.fill_data_i, in.fill);
    m.write_ready_i = in.write_ready;
    m.clear_valid_i = in.clear_valid;
    m.clear_first_i = static_cast<std::uint16_t>(in.clear_first);
    m.clear_last_i = static_cast<std::uint16_t>(in.clear_last);
    m.flush_i = in.flush;
    m.clk_i = 0;
    m.eval();
    dump();
    out.beat_ready = m.beat_ready_o != 0;
    out.beat_valid = m.beat_valid_o != 0;
    get_port(m.beat_o, out.beat);
    out.read_valid = m.read_valid_o != 0;
    out.read_line = m.read_line_o;
    out.read_half = m.read_half_o != 0;
    out.write_valid = m.write_valid_o != 0;
    out.write_line = m.write_line_o;
    out.write_half = m.write_half_o != 0;
    out.write_last = m.write_last_o != 0;
    get_port(m.write_data_o, out.write);
    out.idle = m.idle_o != 0;
    out.clear_done = m.clear_done_o != 0;
    out.flush_done = m.flush_done_o != 0;
  }
  void clock_edge() override {
    model_->clk_i = 1;
    model_->eval();
    dump();
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
};

}  // namespace halfspace::tb
