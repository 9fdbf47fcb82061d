#include "stimulus.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <utility>

#include "halfspace/units/edge_evaluator.hpp"
#include "halfspace/units/packing.hpp"

namespace halfspace::tb {
namespace {

std::int64_t lowest(int bits) { return -(std::int64_t{1} << (bits - 1)); }
std::int64_t highest(int bits) { return (std::int64_t{1} << (bits - 1)) - 1; }

/// Identity of a job: not looked at by the unit, so that every job has its own.
void number(TileJob& job, std::uint64_t index, const Widths& widths) {
  const auto field = [&](int shift, int bits) { return index >> shift & ((std::uint64_t{1} << bits) - 1); };
  job.slot = static_cast<std::uint8_t>(field(0, widths.SlotBits));
  job.tile_x = static_cast<std::uint16_t>(field(widths.SlotBits, widths.TileCoordBits));
  job.tile_y =
      static_cast<std::uint16_t>(field(widths.SlotBits + widths.TileCoordBits, widths.TileCoordBits));
  job.sure = static_cast<std::uint8_t>(field(widths.SlotBits + 2 * widths.TileCoordBits, 1));
}

/// A job in which every sample is covered.
TileJob full_job(const Widths& widths) {
  TileJob job;
  job.x_last = job.y_last = static_cast<std::uint8_t>(widths.TileSize - 1);
  return job;
}

/// E so that its value in pixel steps is `pixel_edge`, with the given sub-pixel bits below.
std::int64_t edge_at(std::int64_t pixel_edge, std::int64_t sub_pixel, const Widths& widths) {
  return pixel_edge * (std::int64_t{1} << widths.SubPixelBits) + sub_pixel;
}

void add_extremes(std::vector<TileJob>& jobs, const Widths& widths) {
  const std::array<std::int64_t, 7> edges = {
      lowest(widths.EdgeBits),      lowest(widths.EdgeBits) + 1, -1, 0, 1,
      highest(widths.EdgeBits) - 1, highest(widths.EdgeBits)};
  const std::array<std::int64_t, 5> steps = {lowest(widths.StepBits), -1, 0, 1, highest(widths.StepBits)};
  for (std::size_t i = 0; i < 3; ++i) {
    for (const std::int64_t e : edges) {
      for (const std::int64_t a : steps) {
        for (const std::int64_t b : steps) {
          TileJob job = full_job(widths);
          job.e[i] = e;
          job.a[i] = static_cast<std::int32_t>(a);
          job.b[i] = static_cast<std::int32_t>(b);
          jobs.push_back(job);
        }
      }
    }
  }
}

/// Around the limit itself, and around the values at which the farthest pixel of the tile changes sides.
void add_saturation(std::vector<TileJob>& jobs, const Widths& widths) {
  const std::int64_t limit = std::int64_t{widths.TileSize} << widths.StepBits;
  const std::int64_t across = widths.TileSize - 1;
  for (std::size_t i = 0; i < 3; ++i) {
    for (const std::int64_t step : {lowest(widths.StepBits), highest(widths.StepBits)}) {
      for (const std::int64_t centre : {limit, -limit, -2 * across * step, -across * step, std::int64_t{0}}) {
        for (std::int64_t delta = -2; delta <= 2; ++delta) {
          for (const std::int64_t sub_pixel :
               {std::int64_t{0}, (std::int64_t{1} << widths.SubPixelBits) - 1}) {
            TileJob job = full_job(widths);
            job.e[i] = edge_at(centre + delta, sub_pixel, widths);
            job.a[i] = job.b[i] = static_cast<std::int32_t>(step);
            jobs.push_back(job);
          }
        }
      }
    }
  }
}

/// E == 0 and E == -1 at each pixel in turn, for edges in eight directions.
void add_edges_through_samples(std::vector<TileJob>& jobs, const Widths& widths) {
  constexpr std::array<std::array<std::int32_t, 2>, 8> kDirections = {
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {3, 5}, {-3, 5}, {257, -100}, {-40000, -39999}}};
  for (int y = 0; y < widths.TileSize; ++y) {
    for (int x = 0; x < widths.TileSize; ++x) {
      for (std::size_t k = 0; k < kDirections.size(); ++k) {
        TileJob job = full_job(widths);
        const std::size_t i = k % 3;
        job.a[i] = kDirections[k][0];
        job.b[i] = kDirections[k][1];
        const std::int64_t at_pixel = std::int64_t{x} * job.a[i] + std::int64_t{y} * job.b[i];
        job.e[i] = edge_at(-at_pixel, 0, widths);
        jobs.push_back(job);
        --job.e[i];
        jobs.push_back(job);
      }
    }
  }
}

/// A triangle around one pixel, at every pixel: its two neighbours are the edges' other side.
void add_single_pixels(std::vector<TileJob>& jobs, const Widths& widths) {
  for (int y = 0; y < widths.TileSize; ++y) {
    for (int x = 0; x < widths.TileSize; ++x) {
      TileJob job = full_job(widths);
      job.a = {256, 0, -256};
      job.b = {0, 256, -256};
      job.e = {edge_at(-256 * x, 0, widths), edge_at(-256 * y, 0, widths), edge_at(256 * (x + y), 0, widths)};
      jobs.push_back(job);
    }
  }
}

/// All accept combinations over edges that cover nothing: what is not accepted must be seen.
void add_accepts(std::vector<TileJob>& jobs, const Widths& widths) {
  for (unsigned outside = 0; outside < 8; ++outside) {
    for (unsigned accept = 0; accept < 8; ++accept) {
      TileJob job = full_job(widths);
      job.accept = static_cast<std::uint8_t>(accept);
      for (std::size_t i = 0; i < 3; ++i) {
        job.e[i] = (outside >> i & 1) != 0 ? lowest(widths.EdgeBits) : 0;
      }
      jobs.push_back(job);
    }
  }
}

/// Every rectangle, the empty ones too.
void add_bounds(std::vector<TileJob>& jobs, const Widths& widths) {
  const int size = widths.TileSize;
  for (int first = 0; first < size; ++first) {
    for (int last = 0; last < size; ++last) {
      // All pairs of one axis over a few of the other; all pairs of both for the sizes where that is few.
      for (int other_first = 0; other_first < size; other_first += size == 4 ? 1 : size - 1) {
        for (int other_last = 0; other_last < size; other_last += size == 4 ? 1 : size - 1) {
          TileJob job;
          job.x_first = job.y_first = static_cast<std::uint8_t>(other_first);
          job.x_last = job.y_last = static_cast<std::uint8_t>(other_last);
          TileJob columns = job;
          columns.x_first = static_cast<std::uint8_t>(first);
          columns.x_last = static_cast<std::uint8_t>(last);
          jobs.push_back(columns);
          job.y_first = static_cast<std::uint8_t>(first);
          job.y_last = static_cast<std::uint8_t>(last);
          jobs.push_back(job);
        }
      }
    }
  }
  if (size == 8) {
    for (unsigned rectangle = 0; rectangle < 8 * 8 * 8 * 8; ++rectangle) {
      TileJob job;
      job.x_first = rectangle & 7;
      job.x_last = rectangle >> 3 & 7;
      job.y_first = rectangle >> 6 & 7;
      job.y_last = rectangle >> 9 & 7;
      jobs.push_back(job);
    }
  }
}

/// All bits of the fields that only pass through.
void add_identities(std::vector<TileJob>& jobs, const Widths& widths) {
  for (int bit = 0; bit <= widths.SlotBits + 2 * widths.TileCoordBits; ++bit) {
    TileJob job = full_job(widths);
    number(job, std::uint64_t{1} << bit, widths);
    jobs.push_back(job);
    number(job, ~(std::uint64_t{1} << bit), widths);
    jobs.push_back(job);
  }
}

std::int32_t random_step(const Widths& widths, Random& random) {
  switch (random.below(6)) {
    case 0:
      return 0;
    case 1:
      return static_cast<std::int32_t>(random.below(2) == 0 ? lowest(widths.StepBits)
                                                            : highest(widths.StepBits));
    case 2:
      return static_cast<std::int32_t>(random.range(-4, 4));
    case 3:
      return static_cast<std::int32_t>(random.range(-2048, 2048));
    default: {
      const int bits = static_cast<int>(random.range(2, widths.StepBits));
      return static_cast<std::int32_t>(random.range(lowest(bits), highest(bits)));
    }
  }
}

void random_bounds(TileJob& job, const Widths& widths, Random& random) {
  const auto coordinate = [&] {
    return static_cast<std::uint8_t>(random.below(static_cast<std::uint64_t>(widths.TileSize)));
  };
  switch (random.below(4)) {
    case 0:  // any, the empty ones too
      job.x_first = coordinate();
      job.x_last = coordinate();
      job.y_first = coordinate();
      job.y_last = coordinate();
      break;
    case 1: {  // not empty
      std::tie(job.x_first, job.x_last) = std::minmax({coordinate(), coordinate()});
      std::tie(job.y_first, job.y_last) = std::minmax({coordinate(), coordinate()});
      break;
    }
    default:
      job.x_first = job.y_first = 0;
      job.x_last = job.y_last = static_cast<std::uint8_t>(widths.TileSize - 1);
      break;
  }
}

struct Vertex {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

/// Snapped vertices of one of the kinds that matter; all in the range of CoordBits.
std::array<Vertex, 3> random_triangle(const Widths& widths, Random& random) {
  const std::int64_t one = std::int64_t{1} << widths.SubPixelBits;
  const std::int64_t low = lowest(widths.CoordBits);
  const std::int64_t high = highest(widths.CoordBits);
  const auto clamp = [&](Vertex v) { return Vertex{std::clamp(v.x, low, high), std::clamp(v.y, low, high)}; };
  const auto around = [&](Vertex centre, std::int64_t reach) {
    return clamp({centre.x + random.range(-reach, reach), centre.y + random.range(-reach, reach)});
  };
  const Vertex centre{random.range(0, 16383) * one + one / 2, random.range(0, 16383) * one + one / 2};
  switch (random.below(6)) {
    case 0: {  // sliver: the third vertex next to the line between the others
      const Vertex first = around(centre, 64 * one);
      const Vertex second = around(centre, 64 * one);
      return {first, second, around({(first.x + second.x) / 2, (first.y + second.y) / 2}, 2)};
    }
    case 1:
      return {around(centre, 2 * one), around(centre, 2 * one), around(centre, 2 * one)};
    case 2:
      return {around(centre, 40 * one), around(centre, 40 * one), around(centre, 40 * one)};
    case 3:
      return {around(centre, 4000 * one), around(centre, 4000 * one), around(centre, 4000 * one)};
    case 4: {  // vertices on pixel centres: edges run through samples
      std::array<Vertex, 3> triangle;
      for (Vertex& v : triangle) {
        v = clamp({centre.x + random.range(-12, 12) * one, centre.y + random.range(-12, 12) * one});
      }
      return triangle;
    }
    default: {  // corners of the guard band, or close to them
      std::array<Vertex, 3> triangle;
      for (Vertex& v : triangle) {
        v = clamp({(random.below(2) == 0 ? low : high) + random.range(-one, one),
                   (random.below(2) == 0 ? low : high) + random.range(-one, one)});
      }
      return triangle;
    }
  }
}

/// The edges of a triangle with positive area, E at `origin`, as setup makes them.
void set_edges(TileJob& job, const std::array<Vertex, 3>& v, Vertex origin) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vertex& from = v[(i + 1) % 3];
    const Vertex& to = v[(i + 2) % 3];
    const std::int64_t a = from.y - to.y;
    const std::int64_t b = to.x - from.x;
    const bool owns = a > 0 || (a == 0 && b > 0);
    job.a[i] = static_cast<std::int32_t>(a);
    job.b[i] = static_cast<std::int32_t>(b);
    job.e[i] = a * (origin.x - from.x) + b * (origin.y - from.y) - (owns ? 0 : 1);
  }
}

/// True when the whole tile is inside edge i: its least corner is.
bool accepts(const TileJob& job, std::size_t i, const Widths& widths) {
  const std::int64_t across = std::int64_t{widths.TileSize - 1} << widths.SubPixelBits;
  return job.e[i] + std::min<std::int64_t>(job.a[i], 0) * across +
             std::min<std::int64_t>(job.b[i], 0) * across >=
         0;
}

class JobStimulus : public Stimulus {
 public:
  explicit JobStimulus(const Widths& widths)
      : widths_(widths), words_(words_for(packed_bits<Coverage>(widths))) {}

  void reference(std::span<const std::uint32_t> packet, Scoreboard& scoreboard) final {
    pack(reference_coverage(unpack<TileJob>(packet, widths_), widths_), widths_, words_);
    scoreboard.expect(words_);
  }

 protected:
  Widths widths_;

 private:
  std::vector<std::uint32_t> words_;
};

class RandomStimulus final : public JobStimulus {
 public:
  RandomStimulus(const Widths& widths, std::uint64_t seed, std::uint64_t count)
      : JobStimulus(widths), random_(seed), left_(count) {}

  bool next(std::span<std::uint32_t> packet) override {
    if (left_ == 0) {
      return false;
    }
    --left_;
    pack(random_.below(2) == 0 ? random_job(widths_, random_) : triangle_job(widths_, random_), widths_,
         packet);
    return true;
  }

 private:
  Random random_;
  std::uint64_t left_;
};

class ListStimulus final : public JobStimulus {
 public:
  ListStimulus(const Widths& widths, std::vector<TileJob> jobs)
      : JobStimulus(widths), jobs_(std::move(jobs)) {}

  bool next(std::span<std::uint32_t> packet) override {
    if (next_ == jobs_.size()) {
      return false;
    }
    pack(jobs_[next_++], widths_, packet);
    return true;
  }

 private:
  std::vector<TileJob> jobs_;
  std::size_t next_ = 0;
};

}  // namespace

Coverage reference_coverage(const TileJob& job, const Widths& widths) {
  switch (widths.TileSize) {
    case 4:
      return edge_evaluator<4>(job, widths.SubPixelBits);
    case 8:
      return edge_evaluator<8>(job, widths.SubPixelBits);
    default:
      return edge_evaluator<16>(job, widths.SubPixelBits);
  }
}

std::vector<TileJob> directed_jobs(const Widths& widths) {
  std::vector<TileJob> jobs;
  jobs.push_back(full_job(widths));
  jobs.push_back(full_job(widths));
  jobs.back().e[0] = -1;  // empty
  add_extremes(jobs, widths);
  add_saturation(jobs, widths);
  add_edges_through_samples(jobs, widths);
  add_single_pixels(jobs, widths);
  add_accepts(jobs, widths);
  add_bounds(jobs, widths);
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    number(jobs[i], i, widths);
  }
  add_identities(jobs, widths);
  return jobs;
}

TileJob random_job(const Widths& widths, Random& random) {
  TileJob job;
  number(job, random.bits(), widths);
  const std::int64_t limit = std::int64_t{widths.TileSize} << widths.StepBits;
  const std::int64_t last = widths.TileSize - 1;
  for (std::size_t i = 0; i < 3; ++i) {
    job.a[i] = random_step(widths, random);
    job.b[i] = random_step(widths, random);
    const std::int64_t sub_pixel = random.range(0, (std::int64_t{1} << widths.SubPixelBits) - 1);
    switch (random.below(8)) {
      case 0:
        job.e[i] = random.range(lowest(widths.EdgeBits), highest(widths.EdgeBits));
        break;
      case 1: {
        const std::int64_t near_limit = (random.below(2) == 0 ? limit : -limit) + random.range(-3, 3);
        job.e[i] = edge_at(near_limit, sub_pixel, widths);
        break;
      }
      case 2:
        job.e[i] = random.range(-2, 2);
        break;
      default: {  // through a pixel of the tile, or just beside it
        const std::int64_t at_pixel = random.range(0, last) * job.a[i] + random.range(0, last) * job.b[i];
        job.e[i] = edge_at(-at_pixel + random.range(-1, 1), sub_pixel, widths);
        break;
      }
    }
  }
  job.accept = static_cast<std::uint8_t>(random.below(4) == 0 ? random.below(8) : 0);
  random_bounds(job, widths, random);
  return job;
}

TileJob triangle_job(const Widths& widths, Random& random) {
  TileJob job;
  number(job, random.bits(), widths);
  std::array<Vertex, 3> v = random_triangle(widths, random);
  if ((v[1].x - v[0].x) * (v[2].y - v[0].y) - (v[2].x - v[0].x) * (v[1].y - v[0].y) < 0) {
    std::swap(v[1], v[2]);
  }
  // A tile that a point of the triangle, or of its border, is in or next to.
  const std::int64_t one = std::int64_t{1} << widths.SubPixelBits;
  const std::int64_t weight = random.range(0, 64);
  const std::size_t corner = random.below(3);
  const Vertex& from = v[corner];
  const Vertex& to = v[(corner + 1) % 3];
  const std::int64_t tiles = std::int64_t{1} << widths.TileCoordBits;
  const auto tile_of = [&](std::int64_t coordinate) {
    const std::int64_t tile = (coordinate >> widths.SubPixelBits >> widths.TileLog2) + random.range(-1, 1);
    return std::clamp<std::int64_t>(tile, 0, tiles - 1);
  };
  job.tile_x = static_cast<std::uint16_t>(tile_of((from.x * weight + to.x * (64 - weight)) / 64));
  job.tile_y = static_cast<std::uint16_t>(tile_of((from.y * weight + to.y * (64 - weight)) / 64));
  set_edges(job, v,
            {(std::int64_t{job.tile_x} * widths.TileSize) * one + one / 2,
             (std::int64_t{job.tile_y} * widths.TileSize) * one + one / 2});
  for (std::size_t i = 0; i < 3; ++i) {
    if (accepts(job, i, widths)) {
      job.accept = static_cast<std::uint8_t>(job.accept | 1u << i);
    }
  }
  random_bounds(job, widths, random);
  return job;
}

std::unique_ptr<Stimulus> random_stimulus(const Widths& widths, std::uint64_t seed, std::uint64_t count) {
  return std::make_unique<RandomStimulus>(widths, seed, count);
}

std::unique_ptr<Stimulus> list_stimulus(const Widths& widths, std::vector<TileJob> jobs) {
  return std::make_unique<ListStimulus>(widths, std::move(jobs));
}

}  // namespace halfspace::tb
