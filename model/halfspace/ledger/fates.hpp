/// Follows every piece of a triangle through a run, to where it ends.
#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/ledger/accounts.hpp"
#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace::ledger {

/// Fills the accounts of pieces, blocks, tiles, quads, fragments and lines of each draw; of lines only `all`,
/// of triangles only `set_up`. Belongs into a run in which each piece comes out before the next goes in:
/// run_in_order without a reader, which is what run_functional does for it.
///
/// hi_z drops tiles before their coverage is known, so what it killed is evaluated here, by the same units.
class Fates final : public PacketObserver {
 public:
  /// Both must be valid and outlive the run.
  Fates(const Frame& frame, const Config& config);

  [[nodiscard]] bool wants_quads() const override { return true; }
  [[nodiscard]] bool wants_tile_jobs() const override { return true; }
  [[nodiscard]] bool wants_walk() const override { return true; }
  void set_up(const SetupEvent& event) override;
  void block_walked(const BlockJob& job, std::uint64_t touched) override;
  void hi_z_decided(const BlockJob& block, std::uint64_t rejected) override;
  void tile_job(const TileJob& job) override;
  void quad(const QuadEvent& quad) override;

  /// After the run: by draw.
  std::vector<Accounts> finish();

 private:
  void begin_piece(const SetupTriangle& triangle);
  void end_piece();
  void end_tile();

  const Config& config_;
  std::vector<bool> touches_depth_;  ///< by draw
  std::vector<Accounts> draws_;

  // Of the piece at work.
  Accounts* accounts_ = nullptr;
  std::uint32_t draw_ = 0;
  std::uint32_t triangle_ = 0;
  bool in_piece_ = false;
  std::uint64_t covered_ = 0;  ///< samples: all of them,
  std::uint64_t hidden_ = 0;   ///< in tiles that hi_z rejected,
  std::uint64_t tested_ = 0;   ///< that came to early_z,
  std::uint64_t passed_ = 0;   ///< that passed,
  std::uint64_t kept_ = 0;     ///< and that the shader kept

  // Of the tile at work.
  bool in_tile_ = false;
  bool tile_covered_ = false;
  bool tile_passes_ = false;
  bool tile_survives_ = false;
  std::uint8_t tile_parts_ = 0;  ///< bit i: a sample of part i is covered
};

}  // namespace halfspace::ledger
