#include "halfspace/study/precision/edge_measure.hpp"

#include <algorithm>
#include <ctime>
#include <map>

#include "halfspace/reference/clipped_triangle.hpp"
#include "halfspace/study/precision/edge_subjects.hpp"

namespace halfspace::study {
namespace {

using Pixels = std::vector<std::uint32_t>;

/// Fragments of each pixel of a target.
class Picture {
 public:
  explicit Picture(const PixelRect& target)
      : fragments_(static_cast<std::size_t>(area(target))), seen_(fragments_.size()) {}

  static std::int64_t area(const PixelRect& rect) {
    return std::max<std::int64_t>(rect.end_x - rect.first_x, 0) *
           std::max<std::int64_t>(rect.end_y - rect.first_y, 0);
  }

  void add(const Pixels& pixels) {
    ++number_;
    for (const std::uint32_t pixel : pixels) {
      ++fragments_[pixel];
      seen_[pixel] = number_;
    }
  }

  /// How many of them the triangle added last covers.
  [[nodiscard]] std::uint64_t common(const Pixels& pixels) const {
    return static_cast<std::uint64_t>(std::count_if(
        pixels.begin(), pixels.end(), [&](std::uint32_t pixel) { return seen_[pixel] == number_; }));
  }

  [[nodiscard]] const std::vector<std::uint32_t>& fragments() const { return fragments_; }

 private:
  std::vector<std::uint32_t> fragments_;
  std::vector<std::uint32_t> seen_;  ///< the last triangle there
  std::uint32_t number_ = 0;
};

/// The covered pixels by definition, of a triangle on a grid.
Pixels covered(const reference::GridTriangle& grid, int bits, const PlacedTriangle& placed,
               const PixelRect& target) {
  Pixels pixels;
  const PixelRect box = reference::intersect(reference::bounding_box(grid, bits), placed.within);
  for (std::int64_t y = box.first_y; y < box.end_y; ++y) {
    for (std::int64_t x = box.first_x; x < box.end_x; ++x) {
      if (reference::covers(grid, reference::pixel_centre(x, y, bits), reference::TieRule::kTopLeft)) {
        pixels.push_back(static_cast<std::uint32_t>((y - target.first_y) * (target.end_x - target.first_x) +
                                                    x - target.first_x));
      }
    }
  }
  return pixels;
}

/// Pixels of the target from those of a rectangle of it.
void move(Pixels& pixels, const PixelRect& within, const PixelRect& target) {
  const auto width = static_cast<std::uint32_t>(within.end_x - within.first_x);
  for (std::uint32_t& pixel : pixels) {
    const std::int64_t x = pixel % width + within.first_x - target.first_x;
    const std::int64_t y = pixel / width + within.first_y - target.first_y;
    pixel = static_cast<std::uint32_t>(y * (target.end_x - target.first_x) + x);
  }
}

}  // namespace

EdgeTally& EdgeTally::operator+=(const EdgeTally& other) {
  triangles += other.triangles;
  samples += other.samples;
  covered += other.covered;
  wrong += other.wrong;
  moved += other.moved;
  pixels += other.pixels;
  gaps += other.gaps;
  doubles += other.doubles;
  return *this;
}

std::vector<EdgeTally> measure_edges(const Drawing& drawing) {
  const auto subjects = edge_subjects();
  const PixelRect& target = drawing.target;
  std::vector<EdgeTally> tallies(subjects.size());
  std::map<int, Picture> truths;  // by grid; 0: as the triangles are
  truths.emplace(0, target);
  for (const EdgeSubject& subject : subjects) {
    truths.emplace(subject.bits, target);
  }
  std::vector<Picture> drawn(subjects.size(), Picture(target));
  std::map<int, Pixels> pixels;
  Pixels found;
  for (const PlacedTriangle& placed : drawing.triangles) {
    for (auto& [bits, truth] : truths) {
      const int place = bits == 0 ? kPositionBits : bits;
      pixels[bits] = covered(bits == 0 ? in_place(placed.triangle) : snapped(placed.triangle, bits), place,
                             placed, target);
      truth.add(pixels[bits]);
    }
    const auto samples = static_cast<std::uint64_t>(Picture::area(touched(placed.triangle, placed.within)));
    for (std::size_t i = 0; i < subjects.size(); ++i) {
      found.clear();
      subjects[i].cover(placed.triangle, placed.within, found);
      move(found, placed.within, target);
      drawn[i].add(found);
      EdgeTally& tally = tallies[i];
      const auto differ = [&](int bits) {
        return pixels[bits].size() + found.size() - 2 * truths.at(bits).common(found);
      };
      ++tally.triangles;
      tally.samples += samples;
      tally.covered += pixels[subjects[i].bits].size();
      tally.wrong += differ(subjects[i].bits);
      tally.moved += differ(0);
    }
  }
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const auto& truth = truths.at(subjects[i].bits).fragments();
    const auto& fragments = drawn[i].fragments();
    for (std::size_t pixel = 0; pixel < truth.size(); ++pixel) {
      tallies[i].pixels += truth[pixel] != 0 ? 1 : 0;
      tallies[i].gaps += fragments[pixel] < truth[pixel] ? 1 : 0;
      tallies[i].doubles += fragments[pixel] > truth[pixel] ? 1 : 0;
    }
  }
  return tallies;
}

std::vector<EdgeTime> time_edges(std::span<const FloatTriangle> triangles, const PixelRect& target,
                                 int rounds) {
  const auto subjects = edge_subjects();
  const auto baseline =
      static_cast<std::size_t>(std::find_if(subjects.begin(), subjects.end(),
                                            [](const auto& each) { return each.name == kBaseline; }) -
                               subjects.begin());
  std::int64_t samples = 0;
  for (const FloatTriangle& triangle : triangles) {
    samples += Picture::area(touched(triangle, target));
  }
  std::vector<std::vector<double>> times(subjects.size());
  std::uint64_t kept = 0;  // so that nothing is optimised away
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < subjects.size(); ++i) {
      const std::clock_t start = std::clock();
      kept += subjects[i].count(triangles, target);
      const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      times[i].push_back(kept == 0 ? 0 : seconds * 1e9 / static_cast<double>(samples));
    }
  }
  const auto median = [](std::vector<double> list) {
    const auto middle = list.begin() + static_cast<std::ptrdiff_t>(list.size() / 2);
    std::nth_element(list.begin(), middle, list.end());
    return *middle;
  };
  std::vector<EdgeTime> medians;
  for (const std::vector<double>& list : times) {
    std::vector<double> ratios;
    for (std::size_t round = 0; round < list.size(); ++round) {
      ratios.push_back(list[round] / times[baseline][round]);
    }
    medians.push_back({median(list), median(ratios)});
  }
  return medians;
}

}  // namespace halfspace::study
