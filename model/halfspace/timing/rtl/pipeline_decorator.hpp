/// A verilated pipeline in front of another, for those who change or watch a little of it: hands everything
/// on.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "halfspace/timing/rtl/verilated_pipeline.hpp"

namespace halfspace::rtl {

class PipelineDecorator : public VerilatedPipeline {
 public:
  explicit PipelineDecorator(std::unique_ptr<VerilatedPipeline> pipeline) : pipeline_(std::move(pipeline)) {}

  void settle(const PipelineInputs& in, PipelineOutputs& out) override { pipeline_->settle(in, out); }
  void clock_edge() override { pipeline_->clock_edge(); }
  void count_cycles(bool on) override { pipeline_->count_cycles(on); }
  void keep_state() override { pipeline_->keep_state(); }
  [[nodiscard]] bool holds_kept_state() const override { return pipeline_->holds_kept_state(); }
  [[nodiscard]] bool clear_done() const override { return pipeline_->clear_done(); }
  [[nodiscard]] bool flush_done() const override { return pipeline_->flush_done(); }
  [[nodiscard]] std::span<const std::uint32_t> setup_triangle() const override {
    return pipeline_->setup_triangle();
  }
  [[nodiscard]] std::span<const std::uint32_t> depth_equation() const override {
    return pipeline_->depth_equation();
  }
  [[nodiscard]] std::span<const std::uint32_t> draw_state() const override { return pipeline_->draw_state(); }
  [[nodiscard]] std::span<const std::uint32_t> walked_job() const override { return pipeline_->walked_job(); }
  [[nodiscard]] std::span<const std::uint32_t> block_job() const override { return pipeline_->block_job(); }
  [[nodiscard]] std::span<const std::uint32_t> tile_job() const override { return pipeline_->tile_job(); }
  [[nodiscard]] std::span<const std::uint32_t> coverage() const override { return pipeline_->coverage(); }
  [[nodiscard]] std::span<const std::uint32_t> quad_beat() const override { return pipeline_->quad_beat(); }
  [[nodiscard]] std::span<const std::uint32_t> tested_beat() const override {
    return pipeline_->tested_beat();
  }
  void write_data(std::vector<std::uint32_t>& words) const override { pipeline_->write_data(words); }
  [[nodiscard]] bool assertion_failed() const override { return pipeline_->assertion_failed(); }
  void trace_to(const std::filesystem::path& file) override { pipeline_->trace_to(file); }

 protected:
  [[nodiscard]] VerilatedPipeline& pipeline() { return *pipeline_; }
  [[nodiscard]] const VerilatedPipeline& pipeline() const { return *pipeline_; }

 private:
  std::unique_ptr<VerilatedPipeline> pipeline_;
};

}  // namespace halfspace::rtl
