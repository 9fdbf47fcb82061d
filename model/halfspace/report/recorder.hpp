/// What a run leaves of its packets: quads.npy and tiles.npy.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/report/npy.hpp"

namespace halfspace {

/// Streams records to files, as asked.
class Recorder : public PacketObserver {
 public:
  struct Options {
    std::optional<std::filesystem::path> quads;  ///< file to write
    std::optional<std::filesystem::path> tiles;  ///< file to write
    int samples = 1;                             ///< of a pixel; with several a quad's record says which
    bool inner_coverage = false;                 ///< a quad's record says which pixels the triangle fills
    int attributes = 0;                          ///< that the interpolator gives of a quad
  };

  explicit Recorder(const Options& options);

  [[nodiscard]] bool wants_quads() const override { return quads_.has_value(); }
  [[nodiscard]] bool wants_decisions() const override { return tiles_.has_value(); }
  void quad(const QuadEvent& event) override;
  void decision(const DecisionEvent& event) override;

  /// Completes the files. Throws InputError.
  void finish();

 private:
  bool with_sample_;
  bool with_inner_;
  std::size_t attributes_;
  std::optional<NpyWriter> quads_;
  std::optional<NpyWriter> tiles_;
};

}  // namespace halfspace
