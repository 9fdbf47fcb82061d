#include "stimulus.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include "halfspace/units/edge_evaluator.hpp"
#include "halfspace/units/packing.hpp"
#include "halfspace/units/quad_beats.hpp"

namespace halfspace::tb {
namespace {

constexpr std::uint64_t kLongestRun = 32;

std::uint64_t low_bits(std::uint64_t value, int bits) { return value & ((std::uint64_t{1} << bits) - 1); }

/// What only passes through: all of it random, so that no two coverages are alike.
Coverage random_identity(const Widths& widths, Random& random) {
  Coverage coverage;
  coverage.slot = static_cast<std::uint8_t>(low_bits(random.bits(), widths.SlotBits));
  coverage.tile_x = static_cast<std::uint16_t>(low_bits(random.bits(), widths.TileCoordBits));
  coverage.tile_y = static_cast<std::uint16_t>(low_bits(random.bits(), widths.TileCoordBits));
  coverage.sure = static_cast<std::uint8_t>(low_bits(random.bits(), 1));
  for (std::int64_t& e : coverage.e) {
    e = sign_extend(random.bits(), widths.EdgeBits);
  }
  return coverage;
}

void cover(TileMask& mask, int bit) {
  mask.word[static_cast<std::size_t>(bit / 64)] |= std::uint64_t{1} << (bit % 64);
}

/// Covers the samples `samples` of a quad.
void cover_quad(TileMask& mask, int quad, unsigned samples, const Widths& widths) {
  const int row = widths.TileSize / 2;
  const int top_left = quad / row * 2 * widths.TileSize + quad % row * 2;
  for (int sample = 0; sample < 4; ++sample) {
    if ((samples >> sample & 1) != 0) {
      cover(mask, top_left + sample / 2 * widths.TileSize + sample % 2);
    }
  }
}

std::vector<int> first_quads(int count) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

std::vector<int> last_quads(int count, const Widths& widths) {
  std::vector<int> numbers = first_quads(count);
  for (int& number : numbers) {
    number += widths.TileQuads - count;
  }
  return numbers;
}

Coverage full_coverage(const Widths& widths, Random& random) {
  Coverage coverage = random_identity(widths, random);
  for (int bit = 0; bit < widths.MaskBits; ++bit) {
    cover(coverage.mask, bit);
  }
  return coverage;
}

/// Each sample covered with a chance of 1/8, 1/4, 1/2, 3/4 or 7/8.
Coverage random_samples(const Widths& widths, Random& random) {
  Coverage coverage = random_identity(widths, random);
  const std::uint64_t words = 1 + random.below(3);
  const bool sparse = random.below(2) == 0;
  for (int done = 0; done < widths.MaskBits; done += 64) {
    std::uint64_t bits = random.bits();
    for (std::uint64_t left = words - 1; left > 0; --left) {
      bits = sparse ? bits & random.bits() : bits | random.bits();
    }
    coverage.mask.word[static_cast<std::size_t>(done / 64)] =
        widths.MaskBits < 64 ? low_bits(bits, widths.MaskBits) : bits;
  }
  return coverage;
}

/// The samples between two rows and columns.
Coverage random_rectangle(const Widths& widths, Random& random) {
  Coverage coverage = random_identity(widths, random);
  const auto pair = [&] {
    return std::minmax({random.range(0, widths.TileSize - 1), random.range(0, widths.TileSize - 1)});
  };
  const auto [x_first, x_last] = pair();
  const auto [y_first, y_last] = pair();
  for (std::int64_t y = y_first; y <= y_last; ++y) {
    for (std::int64_t x = x_first; x <= x_last; ++x) {
      cover(coverage.mask, static_cast<int>(y * widths.TileSize + x));
    }
  }
  return coverage;
}

void add_samples(std::vector<Coverage>& all, const Widths& widths, Random& random) {
  for (int bit = 0; bit < widths.MaskBits; ++bit) {
    all.push_back(random_identity(widths, random));
    cover(all.back().mask, bit);
  }
  for (int quad = 0; quad < widths.TileQuads; ++quad) {
    for (unsigned samples = 1; samples < 16; ++samples) {
      all.push_back(random_identity(widths, random));
      cover_quad(all.back().mask, quad, samples, widths);
    }
  }
}

void add_pairs(std::vector<Coverage>& all, const Widths& widths, Random& random) {
  for (int first = 0; first < widths.TileQuads; ++first) {
    for (int last = first + 1; last < widths.TileQuads; ++last) {
      all.push_back(coverage_of_quads({first, last}, widths, random));
    }
  }
}

void add_numbers(std::vector<Coverage>& all, const Widths& widths, Random& random) {
  for (int quads = 0; quads <= widths.TileQuads; ++quads) {
    all.push_back(coverage_of_quads(first_quads(quads), widths, random));
    all.push_back(coverage_of_quads(last_quads(quads, widths), widths, random));
    all.push_back(random_coverage(quads, widths, random));
    all.push_back(random_coverage(quads, widths, random));
  }
}

/// Every order of three out of empty, one quad, one full beat and full, and empty ones in a row.
void add_orders(std::vector<Coverage>& all, const Widths& widths, Random& random) {
  const int kinds[] = {0, 1, widths.QuadWidth, widths.TileQuads};
  for (const int first : kinds) {
    for (const int second : kinds) {
      for (const int third : kinds) {
        for (const int quads : {first, second, third}) {
          all.push_back(random_coverage(quads, widths, random));
        }
      }
    }
  }
  for (int left = 100; left > 0; --left) {
    all.push_back(random_identity(widths, random));
  }
}

/// A band of rows each, and all sets of bands.
void add_parts(std::vector<Coverage>& all, const Widths& widths, Random& random) {
  const int quads = widths.TileQuads / widths.ZParts;
  for (unsigned parts = 1; parts < 1u << widths.ZParts; ++parts) {
    for (const int place : {0, quads - 1}) {
      std::vector<int> numbers;
      for (int part = 0; part < widths.ZParts; ++part) {
        if ((parts >> part & 1) != 0) {
          numbers.push_back(part * quads + place);
        }
      }
      all.push_back(coverage_of_quads(numbers, widths, random));
    }
  }
}

/// Every bit of the fields that only pass through, alone set and alone clear.
void add_identities(std::vector<Coverage>& all, const Widths& widths, Random& random) {
  for (int bit = 0; bit < widths.EdgeBits; ++bit) {
    for (const std::uint64_t bits : {std::uint64_t{1} << bit, ~(std::uint64_t{1} << bit)}) {
      Coverage coverage = random_coverage(1, widths, random);
      coverage.slot = static_cast<std::uint8_t>(low_bits(bits, widths.SlotBits));
      coverage.tile_x = static_cast<std::uint16_t>(low_bits(bits, widths.TileCoordBits));
      coverage.tile_y = static_cast<std::uint16_t>(low_bits(~bits, widths.TileCoordBits));
      coverage.e = {sign_extend(bits, widths.EdgeBits), sign_extend(~bits, widths.EdgeBits)};
      all.push_back(coverage);
    }
  }
}

template <int TileSize>
std::vector<QuadBeat> beats_of(const Coverage& coverage, const Widths& widths) {
  return quad_beats<TileSize>(quad_generator<TileSize>(coverage), widths);
}

std::vector<QuadBeat> reference_beats(const Coverage& coverage, const Widths& widths) {
  switch (widths.TileSize) {
    case 4:
      return beats_of<4>(coverage, widths);
    case 8:
      return beats_of<8>(coverage, widths);
    default:
      return beats_of<16>(coverage, widths);
  }
}

template <int TileSize>
Coverage coverage_of_job(const TileJob& job, const Widths& widths) {
  return edge_evaluator<TileSize>(job, widths.SubPixelBits);
}

class CoverageStimulus : public Stimulus {
 public:
  explicit CoverageStimulus(const Widths& widths)
      : widths_(widths), words_(words_for(packed_bits<QuadBeat>(widths))) {}

  void reference(std::span<const std::uint32_t> packet, Scoreboard& scoreboard) final {
    for (const QuadBeat& beat : reference_beats(unpack<Coverage>(packet, widths_), widths_)) {
      pack(beat, widths_, words_);
      scoreboard.expect(words_);
    }
  }

 protected:
  Widths widths_;

 private:
  std::vector<std::uint32_t> words_;
};

class RandomStimulus final : public CoverageStimulus {
 public:
  RandomStimulus(const Widths& widths, std::uint64_t seed, std::uint64_t count)
      : CoverageStimulus(widths), random_(seed), left_(count) {}

  bool next(std::span<std::uint32_t> packet) override {
    if (left_ == 0) {
      return false;
    }
    --left_;
    if (run_ == 0) {
      run_ = 1 + random_.below(kLongestRun);
      kind_ = random_.below(7);
    }
    --run_;
    pack(make(), widths_, packet);
    return true;
  }

 private:
  Coverage make() {
    switch (kind_) {
      case 0:
        return random_identity(widths_, random_);
      case 1:
        return random_coverage(1, widths_, random_);
      case 2:
        return random_coverage(static_cast<int>(random_.range(0, widths_.QuadWidth + 1)), widths_, random_);
      case 3:
        return random_.below(4) == 0 ? random_identity(widths_, random_) : full_coverage(widths_, random_);
      case 4:
        return random_samples(widths_, random_);
      case 5:
        return random_rectangle(widths_, random_);
      default:
        return random_coverage(static_cast<int>(random_.range(0, widths_.TileQuads)), widths_, random_);
    }
  }

  Random random_;
  std::uint64_t left_;
  std::uint64_t run_ = 0;  ///< coverages of the kind that are left
  std::uint64_t kind_ = 0;
};

class ListStimulus final : public CoverageStimulus {
 public:
  ListStimulus(const Widths& widths, std::vector<Coverage> coverages)
      : CoverageStimulus(widths), coverages_(std::move(coverages)) {}

  bool next(std::span<std::uint32_t> packet) override {
    if (next_ == coverages_.size()) {
      return false;
    }
    pack(coverages_[next_++], widths_, packet);
    return true;
  }

 private:
  std::vector<Coverage> coverages_;
  std::size_t next_ = 0;
};

}  // namespace

Coverage coverage_of_quads(const std::vector<int>& numbers, const Widths& widths, Random& random) {
  Coverage coverage = random_identity(widths, random);
  for (const int number : numbers) {
    cover_quad(coverage.mask, number, 1 + static_cast<unsigned>(random.below(15)), widths);
  }
  return coverage;
}

Coverage random_coverage(int quads, const Widths& widths, Random& random) {
  // Each quad of the tile in turn, by the chance that makes all sets of that size as likely.
  std::vector<int> numbers;
  int left = std::min(quads, widths.TileQuads);
  for (int quad = 0; quad < widths.TileQuads; ++quad) {
    if (random.below(static_cast<std::uint64_t>(widths.TileQuads - quad)) <
        static_cast<std::uint64_t>(left)) {
      numbers.push_back(quad);
      --left;
    }
  }
  return coverage_of_quads(numbers, widths, random);
}

std::vector<Coverage> directed_coverages(const Widths& widths) {
  Random random(1);
  std::vector<Coverage> all;
  all.push_back(full_coverage(widths, random));
  all.push_back(random_identity(widths, random));
  add_samples(all, widths, random);
  add_pairs(all, widths, random);
  add_numbers(all, widths, random);
  add_orders(all, widths, random);
  add_parts(all, widths, random);
  add_identities(all, widths, random);
  return all;
}

std::vector<Coverage> coverages_of_jobs(const std::vector<TileJob>& jobs, const Widths& widths) {
  std::vector<Coverage> coverages;
  coverages.reserve(jobs.size());
  for (const TileJob& job : jobs) {
    coverages.push_back(widths.TileSize == 4   ? coverage_of_job<4>(job, widths)
                        : widths.TileSize == 8 ? coverage_of_job<8>(job, widths)
                                               : coverage_of_job<16>(job, widths));
  }
  return coverages;
}

std::unique_ptr<Stimulus> random_stimulus(const Widths& widths, std::uint64_t seed, std::uint64_t count) {
  return std::make_unique<RandomStimulus>(widths, seed, count);
}

std::unique_ptr<Stimulus> list_stimulus(const Widths& widths, std::vector<Coverage> coverages) {
  return std::make_unique<ListStimulus>(widths, std::move(coverages));
}

}  // namespace halfspace::tb
