#include "stimulus.hpp"

#include <cstddef>
#include <span>
#include <utility>

#include "halfspace/units/packing.hpp"

namespace halfspace::tb {
namespace {

class TriangleStimulus : public Stimulus {
 public:
  TriangleStimulus(const BlockWalkerParameters& parameters, std::uint64_t seed)
      : parameters_(parameters),
        random_(seed),
        payload_(seed),
        words_(parameters.sizes.widths()),
        job_words_(words_for(packed_bits<BlockJob>(parameters.sizes.widths()))) {}

  void reference(std::span<const std::uint32_t> packet, Scoreboard& scoreboard) final {
    bool drawn = false;
    for (const BlockStep& step : reference_walk(packet, slot_, parameters_)) {
      if (step.leaves()) {
        pack(step.job, parameters_.sizes.widths(), job_words_);
        scoreboard.expect(job_words_);
        ++blocks_;
        drawn = true;
      }
    }
    slot_ = static_cast<std::uint8_t>(slot_ + (drawn ? 1 : 0));
  }
  void reset() final { slot_ = 0; }

 protected:
  /// The triangle, with bits of their own in plane, equation and state.
  void fill(const SetupTriangle& triangle, std::span<std::uint32_t> packet) {
    const Widths widths = parameters_.sizes.widths();
    SetupTrianglePacket walked = to_packet(triangle, parameters_.walker());
    walked.z = signed_bits(widths.HiZWordBits);
    walked.z_dx = signed_bits(widths.HiZStepBits);
    walked.z_dy = signed_bits(widths.HiZStepBits);
    walked.z_known = payload_.bits() & 1;
    pack(walked, widths, packet.first(words_.triangle));
    randomise(packet.subspan(words_.triangle, words_.equation), packed_bits<DepthEquationPacket>(widths));
    randomise(packet.last(words_.state), packed_bits<DrawStatePacket>(widths));
  }

  BlockWalkerParameters parameters_;
  Random random_;
  Random payload_;            ///< of what only passes through: triangles do not depend on its width
  std::uint64_t blocks_ = 0;  ///< that the triangles taken so far have given

 private:
  std::int64_t signed_bits(int bits) { return static_cast<std::int64_t>(payload_.bits()) >> (64 - bits); }

  void randomise(std::span<std::uint32_t> words, int bits) {
    for (std::uint32_t& word : words) {
      word = static_cast<std::uint32_t>(payload_.bits());
    }
    if (bits % 32 != 0) {
      words.back() &= (1u << bits % 32) - 1;
    }
  }

  InputWords words_;
  std::vector<std::uint32_t> job_words_;
  std::uint8_t slot_ = 0;
};

class RandomStimulus final : public TriangleStimulus {
 public:
  RandomStimulus(const BlockWalkerParameters& parameters, std::uint64_t seed, std::uint64_t blocks)
      : TriangleStimulus(parameters, seed), wanted_(blocks) {}

  bool next(std::span<std::uint32_t> packet) override {
    if (blocks_ >= wanted_) {
      return false;
    }
    fill(random_triangle(parameters_.sizes, random_), packet);
    return true;
  }

 private:
  std::uint64_t wanted_;
};

class ListStimulus final : public TriangleStimulus {
 public:
  ListStimulus(const BlockWalkerParameters& parameters, std::uint64_t seed,
               std::vector<SetupTriangle> triangles)
      : TriangleStimulus(parameters, seed), triangles_(std::move(triangles)) {}

  bool next(std::span<std::uint32_t> packet) override {
    if (next_ == triangles_.size()) {
      return false;
    }
    fill(triangles_[next_++], packet);
    return true;
  }

 private:
  std::vector<SetupTriangle> triangles_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<Stimulus> random_stimulus(const BlockWalkerParameters& parameters, std::uint64_t seed,
                                          std::uint64_t blocks) {
  return std::make_unique<RandomStimulus>(parameters, seed, blocks);
}

std::unique_ptr<Stimulus> list_stimulus(const BlockWalkerParameters& parameters, std::uint64_t seed,
                                        std::vector<SetupTriangle> triangles) {
  return std::make_unique<ListStimulus>(parameters, seed, std::move(triangles));
}

}  // namespace halfspace::tb
