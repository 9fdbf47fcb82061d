/// What a run leaves of the walk over each triangle: triangles.npy and steps.npy.
#pragma once

#include <cstdint>
#include <filesystem>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/report/npy.hpp"

namespace halfspace {

/// What a record of steps.npy is.
enum class StepKind : std::uint8_t {
  kLead,    ///< a step of block_walker that only leads the walk
  kDecide,  ///< a step of block_walker that decides a tile (one level) or the tiles of a block
  kJob,     ///< a tile that leaves tile_walker, one for each of its samples
};

/// Streams the records of a run whose units work in order: a triangle's jobs come before the next triangle.
class StepRecorder final : public PacketObserver {
 public:
  StepRecorder(const Config& config, const std::filesystem::path& triangles,
               const std::filesystem::path& steps);

  [[nodiscard]] bool wants_walk() const override { return true; }
  [[nodiscard]] bool wants_tile_jobs() const override { return true; }
  void set_up(const SetupEvent& event) override;
  void walk_led(const GridPlace& pixel, int side) override;
  void block_walked(const BlockJob& job, std::uint64_t touched) override;
  void tile_job(const TileJob& job) override;

  /// Completes the files. Throws InputError.
  void finish();

 private:
  struct Step {
    StepKind kind;
    int x;  ///< top left pixel
    int y;
    int side;                 ///< pixels
    std::uint64_t touched;    ///< tiles that the step looks at, as in BlockJob
    std::uint64_t left;       ///< of these; of a job its accept
    std::uint8_t sample = 0;  ///< of a job
  };
  void append(const Step& step);

  Config config_;
  NpyWriter triangles_;
  NpyWriter steps_;
  std::uint32_t draw_ = 0;  ///< of the triangle at work
  std::uint32_t triangle_ = 0;
};

}  // namespace halfspace
