#include "halfspace/report/step_recorder.hpp"

#include <bit>
#include <cstddef>
#include <span>

namespace halfspace {
namespace {

#pragma pack(push, 1)
/// A record of triangles.npy.
struct TriangleRecord {
  std::uint32_t draw, triangle, surface;
  std::uint8_t verdict, shape;
  std::int32_t x[3], y[3];
  std::int32_t x_first, y_first, x_last, y_last;
};

/// A record of steps.npy.
struct StepRecord {
  std::uint32_t draw, triangle, x, y;
  std::uint16_t side;
  std::uint8_t kind, sample;
  std::uint64_t touched, left;
};
#pragma pack(pop)

constexpr const char* kTriangleDescr =
    "[('draw','<u4'),('triangle','<u4'),('surface','<u4'),('verdict','|u1'),('shape','|u1'),('x','<i4',(3,)),"
    "('y','<i4',(3,)),('x_first','<i4'),('y_first','<i4'),('x_last','<i4'),('y_last','<i4')]";
constexpr const char* kStepDescr =
    "[('draw','<u4'),('triangle','<u4'),('x','<u4'),('y','<u4'),('side','<u2'),('kind','|u1'),('sample','|u1'"
    "),"
    "('touched','<u8'),('left','<u8')]";

}  // namespace

StepRecorder::StepRecorder(const Config& config, const std::filesystem::path& triangles,
                           const std::filesystem::path& steps)
    : config_(config),
      triangles_(triangles, kTriangleDescr, sizeof(TriangleRecord)),
      steps_(steps, kStepDescr, sizeof(StepRecord)) {}

void StepRecorder::set_up(const SetupEvent& event) {
  draw_ = event.draw;
  triangle_ = event.triangle;
  const auto& v = event.screen->v;
  const PixelRect bounds = event.drawn != nullptr ? event.drawn->bounds : PixelRect{};
  const TriangleRecord record{event.draw,
                              event.triangle,
                              event.surface,
                              static_cast<std::uint8_t>(event.verdict),
                              static_cast<std::uint8_t>(event.screen->shape),
                              {v[0].x, v[1].x, v[2].x},
                              {v[0].y, v[1].y, v[2].y},
                              bounds.x_first,
                              bounds.y_first,
                              bounds.x_last,
                              bounds.y_last};
  triangles_.append(std::as_bytes(std::span(&record, 1)));
}

void StepRecorder::walk_led(const GridPlace& pixel, int side) {
  append({.kind = StepKind::kLead, .x = pixel.x, .y = pixel.y, .side = side, .touched = 0, .left = 0});
}

void StepRecorder::block_walked(const BlockJob& job, std::uint64_t touched) {
  const int block = config_.block_walker.block_size;
  Step step{.kind = StepKind::kDecide,
            .x = job.block_x * block,
            .y = job.block_y * block,
            .side = block,
            .touched = touched,
            .left = job.tiles};
  if (config_.block_walker.levels == 1) {
    const int size = config_.tile_walker.tile_size;
    const int tile = std::countr_zero(touched);
    step.x += tile % (block / size) * size;
    step.y += tile / (block / size) * size;
    step.side = size;
  }
  append(step);
}

void StepRecorder::tile_job(const TileJob& job) {
  const int size = config_.tile_walker.tile_size;
  const int samples = config_.raster.samples;
  append({.kind = StepKind::kJob,
          .x = job.tile_x / samples * size,
          .y = job.tile_y * size,
          .side = size,
          .touched = 0,
          .left = job.accept,
          .sample = static_cast<std::uint8_t>(job.tile_x % samples)});
}

void StepRecorder::append(const Step& step) {
  const StepRecord record{draw_,
                          triangle_,
                          static_cast<std::uint32_t>(step.x),
                          static_cast<std::uint32_t>(step.y),
                          static_cast<std::uint16_t>(step.side),
                          static_cast<std::uint8_t>(step.kind),
                          step.sample,
                          step.touched,
                          step.left};
  steps_.append(std::as_bytes(std::span(&record, 1)));
}

void StepRecorder::finish() {
  triangles_.finish();
  steps_.finish();
}

}  // namespace halfspace
