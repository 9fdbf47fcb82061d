/// A verilated class with its context, its clock and its waveform: what every wrapper of one needs.
#pragma once

#include <verilated.h>
#include <verilated_cov.h>
#include <verilated_fst_c.h>

#include <cstdint>
#include <memory>
#include <string>

namespace halfspace::tb {

/// kTraced: the class was verilated with --trace-fst.
template <class Model, bool kTraced = true>
class VerilatedModel {
 public:
  /// `seed`: of the registers before reset.
  explicit VerilatedModel(std::uint64_t seed) {
    context_.randReset(2);
    context_.randSeed(static_cast<int>(seed & 0x7fffffff) | 1);
    context_.fatalOnError(false);
    context_.traceEverOn(kTraced);
    model_ = std::make_unique<Model>(&context_);
    model_->clk_i = 0;
    model_->eval();
  }
  VerilatedModel(const VerilatedModel&) = delete;
  VerilatedModel& operator=(const VerilatedModel&) = delete;
  ~VerilatedModel() {
    // Verilator 5.006 takes the context of its destructors from the thread: another model's, if that was the
    // last.
    Verilated::threadContextp(&context_);
    if (trace_) {
      trace_->close();
    }
    model_->final();
  }

  Model* operator->() const { return model_.get(); }
  Model& operator*() const { return *model_; }

  /// Lets the logic follow the inputs, clock low; then the edge.
  void settle() { eval(0); }
  void clock_edge() { eval(1); }

  /// True once an assertion of the RTL has failed; its message is on standard output.
  [[nodiscard]] bool assertion_failed() const { return context_.gotError(); }

  void trace_to(const std::string& file) requires kTraced {
    trace_ = std::make_unique<VerilatedFstC>();
    model_->trace(trace_.get(), 99);
    trace_->open(file.c_str());
  }
  void write_coverage(const std::string& file) { context_.coveragep()->write(file.c_str()); }

 private:
  void eval(int clock) {
    model_->clk_i = static_cast<std::uint8_t>(clock);
    model_->eval();
    if constexpr (kTraced) {
      context_.timeInc(1);
      if (trace_) {
        trace_->dump(context_.time());
      }
    }
  }

  VerilatedContext context_;
  std::unique_ptr<Model> model_;
  std::unique_ptr<VerilatedFstC> trace_;
};

}  // namespace halfspace::tb
