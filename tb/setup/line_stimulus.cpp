#include "line_stimulus.hpp"

#include <array>

namespace halfspace::tb {
namespace {

/// A thin line from vertex 0 to vertex 1.
void make_line(SetupJob& job, LineRule rule, int width) {
  job.triangle.line_rule = static_cast<std::uint8_t>(rule);
  job.triangle.line_width = static_cast<std::uint8_t>(width);
}

constexpr std::array kThinRules = {LineRule::kBresenham, LineRule::kDiamondExit, LineRule::kMidpoint,
                                   LineRule::kDda};

}  // namespace

void add_lines(std::vector<SetupJob>& jobs, const Band& band) {
  const auto add = [&](Point a, Point b, int width) {
    for (const LineRule rule : kThinRules) {
      SetupJob job;
      job.state = open_state(2);
      set_vertices(job, {band.clamp(a), band.clamp(b), Point{17, 1234}});
      job.triangle.z = {1 << 20, 1 << 29, 12345};
      make_line(job, rule, width);
      jobs.push_back(job);
    }
  };
  constexpr int kSide = 6;  // quarters of a pixel
  const Point origin = band.centre(31, 31);
  const auto at = [&](int number) {
    return Point{origin.x + number % kSide * band.one / 4, origin.y + number / kSide * band.one / 4};
  };
  for (int a = 0; a < kSide * kSide; ++a) {
    for (int b = 0; b < kSide * kSide; ++b) {
      add(at(a), at(b), 1 + (a + b) % 3);
    }
  }
  const std::array<std::int64_t, 7> ends = {band.low, band.low + 1,  -1,       0,
                                            band.one, band.high - 1, band.high};
  for (std::size_t n = 0; n < 7 * 7 * 7 * 7; ++n) {
    add({ends[n % 7], ends[n / 7 % 7]}, {ends[n / 49 % 7], ends[n / 343]}, n % 2 == 0 ? 1 : kMaxLineWidth);
  }
}

void make_random_line(SetupJob& job, const Band& band, const Point& centre_pixel, int block_size,
                      Random& random) {
  const auto one_in = [&](std::uint64_t n) { return random.below(n) == 0; };
  constexpr std::array kWidths = {1, 1, 1, 2, 3, 4, 7, kMaxLineWidth};
  make_line(job, kThinRules[random.below(4)], kWidths[random.below(kWidths.size())]);
  const auto anywhere = [&] {
    return Point{random.range(band.low, band.high), random.range(band.low, band.high)};
  };
  const std::uint64_t how = random.below(7);
  if (how < 2) {
    return;
  }
  const std::array<std::int64_t, 5> reaches = {1, 2, 9, block_size, 3000};
  const std::int64_t reach = reaches[random.below(reaches.size())] * band.one;
  const std::int64_t step = how == 2 ? band.one / 2 : how == 3 ? band.one / 4 : 1;
  const Point centre = band.centre(centre_pixel.x, centre_pixel.y);
  const auto end = [&] {
    return Point{centre.x + random.range(-reach, reach) / step * step,
                 centre.y + random.range(-reach, reach) / step * step};
  };
  const Point a = end();
  Point b = end();
  if (how == 5) {
    const std::int64_t other = (one_in(2) ? b.x - a.x : a.x - b.x) + random.range(-1, 1);
    b.y = a.y + other;
  } else if (how == 6) {
    const std::int64_t aside = random.range(-2, 2);
    b = one_in(2) ? Point{a.x + aside, b.y} : Point{b.x, a.y + aside};
  }
  set_vertices(job, {band.clamp(a), band.clamp(b), anywhere()});
}

}  // namespace halfspace::tb
