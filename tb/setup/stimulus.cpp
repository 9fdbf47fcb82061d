#include "stimulus.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "common/random.hpp"

namespace halfspace::tb {
namespace {

constexpr std::int32_t kScreen = 16383;  // last pixel
constexpr std::array<std::uint8_t, 4> kFormats = {0, 1, 2, 4};

struct Point {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

/// The guard band of a configuration.
struct Band {
  explicit Band(const Widths& widths)
      : one(std::int64_t{1} << widths.SubPixelBits),
        low(-(std::int64_t{1} << (widths.CoordBits - 1))),
        high(-low - 1) {}

  [[nodiscard]] Point clamp(Point p) const {
    return {std::clamp(p.x, low, high), std::clamp(p.y, low, high)};
  }
  [[nodiscard]] Point in_pixel(std::int64_t x, std::int64_t y, const SamplePosition& at) const {
    return {x * one + at.x * one / kSampleGrid, y * one + at.y * one / kSampleGrid};
  }
  [[nodiscard]] Point centre(std::int64_t x, std::int64_t y) const { return in_pixel(x, y, {}); }

  std::int64_t one;  ///< a pixel
  std::int64_t low;
  std::int64_t high;
};

void set_vertices(SetupJob& job, const std::array<Point, 3>& points) {
  for (std::size_t i = 0; i < 3; ++i) {
    job.triangle.x[i] = static_cast<std::int32_t>(points[i].x);
    job.triangle.y[i] = static_cast<std::int32_t>(points[i].y);
  }
}

/// A number for each job, in a field that only passes through.
void number(SetupJob& job, std::uint64_t index) { job.state.first_tile = static_cast<std::uint32_t>(index); }

/// The whole screen, nothing culled.
DrawStatePacket open_state(std::uint8_t format) {
  DrawStatePacket state;
  state.x_last = state.y_last = kScreen;
  state.format = format;
  state.most_code = largest_code(static_cast<DepthFormat>(format));
  return state;
}

std::uint32_t largest_depth(std::uint8_t format) {
  const auto depth_format = static_cast<DepthFormat>(format);
  return format == 0
             ? 0x7FFFFFFF
             : static_cast<std::uint32_t>(vertex_depth_of_code(depth_format, largest_code(depth_format)));
}

/// Every order and turn of a triangle under every rule and culling.
void add_orders(std::vector<SetupJob>& jobs, const Band& band) {
  const std::array<std::array<Point, 3>, 6> shapes = {{
      {{{3, 2}, {40, 11}, {9, 30}}},   // pointed top
      {{{3, 2}, {40, 2}, {9, 30}}},    // flat top
      {{{20, 2}, {40, 30}, {9, 30}}},  // flat bottom
      {{{3, 2}, {3, 30}, {-9, 20}}},   // vertical sides
      {{{3, 2}, {3, 30}, {19, 20}}},
      {{{3, 2}, {4, 2}, {3, 3}}},
  }};
  for (const auto& shape : shapes) {
    std::array<std::size_t, 3> order = {0, 1, 2};
    do {
      for (unsigned flags = 0; flags < 32; ++flags) {
        SetupJob job{.triangle = {}, .state = open_state(kFormats[flags % 4])};
        job.state.front_positive_area = flags & 1;
        job.state.cull_front = flags >> 1 & 1;
        job.state.cull_back = flags >> 2 & 1;
        job.state.fill_rule = flags >> 3 & 3;
        std::array<Point, 3> points;
        for (std::size_t i = 0; i < 3; ++i) {
          points[i] = band.centre(shape[order[i]].x, shape[order[i]].y);
          job.triangle.z[i] = static_cast<std::int64_t>(1000000 * (order[i] + 1));
        }
        set_vertices(job, points);
        jobs.push_back(job);
      }
    } while (std::ranges::next_permutation(order).found);
  }
}

/// Areas at every power of two, the smallest and the largest, around the first pixel.
void add_areas(std::vector<SetupJob>& jobs, const Band& band) {
  const auto add = [&](Point p, Point q, Point r) {
    for (const std::uint8_t format : kFormats) {
      SetupJob job{.triangle = {}, .state = open_state(format)};
      set_vertices(job, {band.clamp(p), band.clamp(q), band.clamp(r)});
      job.triangle.z = {0, largest_depth(format), largest_depth(format) / 3};
      jobs.push_back(job);
    }
  };
  const Point c = band.centre(0, 0);
  add({c.x, c.y}, {c.x + 1, c.y}, {c.x, c.y + 1});
  for (std::int64_t size = 2; size <= band.high - c.x; size *= 2) {
    for (const std::int64_t more : {-1, 0, 1}) {
      add(c, {c.x + size + more, c.y}, {c.x, c.y + size});
      add(c, {c.x + size + more, c.y}, {c.x, c.y + size / 2 + more});
      add({c.x - size, c.y - size}, {c.x + size + more, c.y}, {c.x, c.y + size});
    }
  }
  add({band.low, band.low}, {band.high, band.low}, {band.low, band.high});
  add({band.high, band.high}, {band.low, band.high}, {band.high, band.low});
  add({band.low, band.low}, {band.high, band.low}, {band.high, band.high});
  add({band.low, band.low}, {band.high, band.high}, {band.low, band.low + 1});
  add({band.low, band.low}, {band.high, band.high}, {band.high, band.high - 1});
  add({band.low, band.low}, {band.high, band.high}, {0, 0});
}

/// Triangles of the box from p to q, moved by a sub-pixel to either side or not.
void add_box(std::vector<SetupJob>& jobs, const DrawStatePacket& state, const Point& p, const Point& q) {
  for (const std::int64_t nudge : {-1, 0, 1}) {
    SetupJob job{.triangle = {}, .state = state};
    set_vertices(job, {Point{p.x + nudge, p.y - nudge}, Point{q.x - nudge, p.y}, Point{q.x, q.y + nudge}});
    jobs.push_back(job);
    std::swap(job.triangle.x[1], job.triangle.x[2]);
    jobs.push_back(job);
  }
}

/// Boxes whose corners lie on, before and behind samples, at the borders of tiles, blocks and the scissor.
void add_bounds(std::vector<SetupJob>& jobs, const Band& band, const SetupModel& model) {
  const std::array<std::int64_t, 7> pixels = {
      0, 1, model.dut.tile_size - 1, model.dut.tile_size, model.block_size - 1, model.block_size, kScreen};
  const DrawStatePacket whole = open_state(1);
  DrawStatePacket cut = whole;
  cut.x_first = cut.y_first = static_cast<std::uint16_t>(model.dut.tile_size - 1);
  cut.x_last = cut.y_last = static_cast<std::uint16_t>(model.block_size);
  DrawStatePacket empty = whole;
  empty.empty = 1;
  for (const DrawStatePacket& state : {whole, cut, empty}) {
    for (const std::int64_t first : pixels) {
      for (const std::int64_t last : pixels) {
        for (const SamplePosition& place : model.bounding_places()) {
          add_box(jobs, state, band.in_pixel(first, last, place), band.in_pixel(last, first, place));
        }
      }
    }
  }
  // Beyond each side of the screen.
  for (const Point origin :
       {Point{-100, 50}, Point{kScreen + 100, 50}, Point{50, -100}, Point{50, kScreen + 100}}) {
    SetupJob job{.triangle = {}, .state = whole};
    set_vertices(job, {band.centre(origin.x, origin.y), band.centre(origin.x + 20, origin.y),
                       band.centre(origin.x, origin.y + 20)});
    jobs.push_back(job);
  }
}

/// Depths at the roundings of codes, in every position.
void add_depths(std::vector<SetupJob>& jobs, const Band& band) {
  for (const std::uint8_t format : kFormats) {
    const std::uint32_t most = largest_depth(format);
    std::vector<std::uint32_t> depths = {0, 1, most - 1, most};
    if (format == 1 || format == 2) {
      const std::uint32_t half = 1u << (vertex_depth_fraction(static_cast<DepthFormat>(format)) - 1);
      depths.insert(depths.end(), {half - 1, half, half + 1, most - half, most - half - 1});
    }
    for (const std::uint32_t z0 : depths) {
      for (const std::uint32_t z1 : depths) {
        for (const std::uint32_t z2 : depths) {
          SetupJob job{.triangle = {}, .state = open_state(format)};
          set_vertices(job, {band.centre(5, 4), band.centre(30, 9), band.centre(7, 25)});
          job.triangle.z = {z0, z1, z2};
          jobs.push_back(job);
        }
      }
    }
  }
}

/// A vertex far beyond the farthest code, at every power of two: a code that is cut too short is near again.
/// And at the end of what short words take.
void add_far_depths(std::vector<SetupJob>& jobs, const Band& band) {
  std::vector<std::int64_t> depths;
  for (int bit = kVertexDepthBits; bit < kVertexDepthBits + kVertexDepthRange; ++bit) {
    depths.push_back(std::int64_t{1} << bit);
  }
  for (const std::int64_t more : {-65, -64, -1, 0, 1, 31, 63}) {
    depths.push_back(kShortWordEnd + more);
  }
  for (const DepthFormat format : {DepthFormat::kUnorm16, DepthFormat::kUnorm24}) {
    for (const std::int64_t depth : depths) {
      for (std::size_t vertex = 0; vertex < 3; ++vertex) {
        SetupJob job{.triangle = {}, .state = open_state(static_cast<std::uint8_t>(format))};
        set_vertices(job, {band.centre(5, 4), band.centre(30, 9), band.centre(7, 25)});
        job.triangle.z = {};
        job.triangle.z[vertex] = depth;
        jobs.push_back(job);
      }
    }
  }
}

/// Gradients at the largest that hi_z knows, 2^25 units of a word of 32 bits for a pixel, and a little more
/// and less; in x and in y, up and down.
void add_steep(std::vector<SetupJob>& jobs, const Band& band) {
  constexpr std::int64_t kFar = 128;  // pixels to the vertex that sets the scale, where depth changes slowly
  struct Scale {
    std::uint8_t format;
    std::int64_t top;   ///< depth there
    std::int64_t step;  ///< 2^25 units, as a depth
  };
  for (const Scale& scale : {Scale{1, 1 << 30, 1 << 25}, Scale{2, 1 << 30, 1 << 25},  // short words
                             Scale{2, std::int64_t{1} << 31, 1 << 26},                // beyond
                             Scale{2, std::int64_t{1} << 46, std::int64_t{1} << 41},  // far beyond
                             Scale{4, 0x3F800000, 0x3D000000}}) {                     // 1 and 2^-5
    for (const std::int64_t more : {-2, -1, 0, 1, 2}) {
      for (const std::int64_t times : {1, 2, 4, 1 << 4}) {
        for (unsigned flags = 0; flags < 4; ++flags) {
          const std::int64_t step =
              scale.format == 4 ? scale.step + ((times - 1) << 23) + more : scale.step * times + more;
          const std::int64_t length = (flags & 1) != 0 ? times : 1;
          SetupJob job{.triangle = {}, .state = open_state(scale.format)};
          set_vertices(job, {band.centre(40, 40), band.centre(40 + length, 40), band.centre(40, 40 + kFar)});
          job.triangle.z = {0, step, scale.top};
          if ((flags & 2) != 0) {
            std::swap(job.triangle.z[0], job.triangle.z[1]);
          }
          if (step > scale.top) {
            continue;
          }
          jobs.push_back(job);
          std::swap(job.triangle.x, job.triangle.y);
          jobs.push_back(job);
        }
      }
    }
  }
}

/// All bits of the state that only pass through, on a drawn triangle.
void add_states(std::vector<SetupJob>& jobs, const Band& band, const Widths& widths) {
  const auto add = [&](auto set) {
    SetupJob job{.triangle = {}, .state = open_state(2)};
    set_vertices(job, {band.centre(5, 4), band.centre(30, 9), band.centre(7, 25)});
    set(job.state);
    jobs.push_back(job);
  };
  for (int bit = 0; bit < 32; ++bit) {
    add([&](DrawStatePacket& state) { state.clear_code = 1u << bit; });
    add([&](DrawStatePacket& state) { state.first_tile = 1u << bit; });
    add([&](DrawStatePacket& state) { state.first_block = 1u << bit; });
  }
  for (int bit = 0; bit < widths.TileCoordBits; ++bit) {
    add([&](DrawStatePacket& state) { state.tiles_x = static_cast<std::uint16_t>(1 << bit); });
  }
  for (int bit = 0; bit < widths.BlockCoordBits; ++bit) {
    add([&](DrawStatePacket& state) { state.blocks_x = static_cast<std::uint16_t>(1 << bit); });
  }
  for (unsigned flags = 0; flags < 32; ++flags) {
    add([&](DrawStatePacket& state) {
      state.test = flags & 1;
      state.write = flags >> 1 & 1;
      state.func = static_cast<std::uint8_t>(flags >> 2);
    });
  }
}

/// Makes random jobs, one after the other.
class Generator {
 public:
  Generator(const SetupModel& model, std::uint64_t seed)
      : widths_(model.widths()), band_(widths_), block_(model.block_size), random_(seed) {}

  SetupJob next() {
    if (random_.below(4) == 0) {
      new_state();
    }
    SetupJob job;
    job.state = state_;
    number(job, count_++);
    std::array<Point, 3> points = kind();
    for (std::size_t i = random_.below(3); i > 0; --i) {
      std::ranges::rotate(points, points.begin() + 1);
    }
    if (random_.below(2) == 0) {
      std::swap(points[0], points[1]);
    }
    last_ = points;
    set_vertices(job, points);
    depths(job);
    return job;
  }

 private:
  bool one_in(std::uint64_t count) { return random_.below(count) == 0; }

  void new_state() {
    state_ = open_state(kFormats[random_.below(4)]);
    state_.front_positive_area = random_.below(2) & 1;
    state_.cull_front = one_in(6) ? 1 : 0;
    state_.cull_back = one_in(4) ? 1 : 0;
    state_.fill_rule = random_.below(kFillRules.size()) & 3;
    state_.empty = one_in(20) ? 1 : 0;
    state_.test = random_.below(2) & 1;
    state_.write = random_.below(2) & 1;
    state_.func = random_.below(8) & 7;
    state_.clear_code = static_cast<std::uint32_t>(random_.bits());
    state_.tiles_x = static_cast<std::uint16_t>(random_.below(std::uint64_t{1} << widths_.TileCoordBits));
    state_.first_block = static_cast<std::uint32_t>(random_.bits());
    state_.blocks_x = static_cast<std::uint16_t>(random_.below(std::uint64_t{1} << widths_.BlockCoordBits));
    // Around the point that triangles of this draw are near to, or all of the screen.
    centre_ = {random_.range(0, kScreen), random_.range(0, kScreen)};
    if (one_in(3)) {
      const std::array<std::int64_t, 4> reaches = {1, widths_.TileSize / 2, block_, 3000};
      const std::int64_t reach = reaches[random_.below(reaches.size())];
      const auto clip = [](std::int64_t pixel) {
        return static_cast<std::uint16_t>(std::clamp<std::int64_t>(pixel, 0, kScreen));
      };
      state_.x_first = clip(centre_.x - random_.range(0, reach));
      state_.x_last = clip(centre_.x + random_.range(0, reach));
      state_.y_first = clip(centre_.y - random_.range(0, reach));
      state_.y_last = clip(centre_.y + random_.range(0, reach));
    }
  }

  Point around(Point point, std::int64_t reach) {
    return band_.clamp({point.x + random_.range(-reach, reach), point.y + random_.range(-reach, reach)});
  }

  std::array<Point, 3> near(std::int64_t reach) {
    const Point centre = band_.centre(centre_.x, centre_.y);
    return {around(centre, reach), around(centre, reach), around(centre, reach)};
  }

  Point in_corner() {
    return band_.clamp({(one_in(2) ? band_.low : band_.high) + random_.range(-band_.one, band_.one),
                        (one_in(2) ? band_.low : band_.high) + random_.range(-band_.one, band_.one)});
  }

  std::array<Point, 3> kind() {
    const Point centre = band_.centre(centre_.x, centre_.y);
    switch (random_.below(14)) {
      case 0: {  // sliver: the third vertex next to the line between the others
        const std::int64_t reach = (one_in(2) ? 64 : 8000) * band_.one;
        const Point p = around(centre, reach);
        const Point q = around(centre, reach);
        return {p, q, around({(p.x + q.x) / 2, (p.y + q.y) / 2}, 2)};
      }
      case 1:  // tiny: most of them hold no centre
        return near(band_.one / 2 + 1);
      case 2:
        return near(2 * band_.one);
      case 3:
        return near(band_.one * widths_.TileSize / 2);
      case 4:
        return near(band_.one * block_);
      case 5:
        return near(4000 * band_.one);
      case 6:
        return {in_corner(), in_corner(), in_corner()};
      case 7:  // a corner of the guard band and two vertices near the screen
        return {in_corner(), around(centre, 500 * band_.one), around(centre, 500 * band_.one)};
      case 8: {  // on pixel centres: edges run through samples
        std::array<Point, 3> points;
        for (Point& p : points) {
          p = band_.clamp(
              {centre.x + random_.range(-12, 12) * band_.one, centre.y + random_.range(-12, 12) * band_.one});
        }
        return points;
      }
      case 9: {  // no area: on a line, or the same vertex twice
        const Point p = around(centre, 40 * band_.one);
        const Point step{random_.range(-9, 9), random_.range(-9, 9)};
        const std::int64_t far = random_.range(0, 5);
        return {p, band_.clamp({p.x + step.x, p.y + step.y}),
                band_.clamp({p.x + far * step.x, p.y + far * step.y})};
      }
      case 10: {  // horizontal or vertical edges
        std::array<Point, 3> points = near((one_in(2) ? 10 : 2000) * band_.one);
        if (!one_in(3)) {
          points[1].y = points[0].y;
        }
        if (!one_in(3)) {
          points[2].x = points[static_cast<std::size_t>(random_.below(2))].x;
        }
        return points;
      }
      case 11: {  // 2A of 32 bits, which needs no scaling
        const std::int64_t leg = random_.range(46341, 65535);
        const Point p{centre.x - random_.range(0, leg / 2), centre.y - random_.range(0, leg / 2)};
        return {band_.clamp(p), band_.clamp({p.x + leg, p.y}), band_.clamp({p.x, p.y + leg})};
      }
      case 12:  // anywhere in the guard band
        return {around({0, 0}, band_.high), around({0, 0}, band_.high), around({0, 0}, band_.high)};
      default:  // shares an edge with the one before
        return {last_[1], last_[0], around(last_[2], 30 * band_.one)};
    }
  }

  void depths(SetupJob& job) {
    const std::uint32_t most = one_in(8) ? 0x7FFFFFFF : largest_depth(job.state.format);
    const std::uint64_t how = random_.below(8);
    for (std::int64_t& z : job.triangle.z) {
      z = how == 0                ? (one_in(2) ? 0 : most)
          : how > 5 && !one_in(3) ? depth_beyond(job.state.format)
                                  : static_cast<std::int64_t>(random_.below(std::uint64_t{most} + 1));
    }
    if (how == 1) {
      job.triangle.z[1] = job.triangle.z[2] = job.triangle.z[0];
    } else if (how == 2) {
      job.triangle.z[random_.below(2) + 1] = job.triangle.z[0];
    } else if (how == 3) {
      job.triangle.z[1] = job.triangle.z[0] ^ 1;
    }
    job.triangle.offset = !one_in(3) ? 0 : one_in(4) ? depth_beyond(job.state.format) : offset(job);
    if (one_in(4)) {
      const std::uint32_t one = largest_code(static_cast<DepthFormat>(job.state.format));
      const auto code = [&] { return static_cast<std::uint32_t>(random_.below(std::uint64_t{one} + 1)); };
      std::tie(job.state.least_code, job.state.most_code) = std::minmax({code(), code()});
    }
  }

  /// Any that a vertex depth can hold.
  std::int64_t depth_beyond(std::uint8_t format) {
    if (format == 4) {
      constexpr std::int64_t kMost = 0x47000000;  // 2^kVertexDepthRange
      return random_.range(0, kMost) | (one_in(2) ? std::int64_t{1} << 31 : 0);
    }
    const std::int64_t limit = std::int64_t{1} << random_.range(0, kVertexDepthBits + kVertexDepthRange);
    return random_.range(-limit, limit);
  }

  /// One about as large as the depths, or as their last place.
  std::int64_t offset(const SetupJob& job) {
    if (job.state.format == 4) {
      const std::int64_t magnitude = job.triangle.z[0] & 0x7FFFFFFF;
      return std::max<std::int64_t>(magnitude - (one_in(2) ? 23 << 23 : 0), 0) |
             (one_in(2) ? std::int64_t{1} << 31 : 0);
    }
    const std::int64_t limit = std::int64_t{1} << random_.range(0, kVertexDepthBits);
    return random_.range(-limit, limit);
  }

  Widths widths_;
  Band band_;
  int block_;
  Random random_;
  std::uint64_t count_ = 0;
  DrawStatePacket state_ = open_state(0);
  Point centre_{100, 100};  ///< in pixels
  std::array<Point, 3> last_{};
};

/// Expects what the C++ definition makes of each job.
class JobStimulus : public Stimulus {
 public:
  explicit JobStimulus(const SetupModel& model) : model_(model) {}

  bool next(std::span<std::uint32_t> packet) final {
    const std::optional<SetupJob> job = next_job();
    if (job) {
      pack_job(*job, model_.widths(), packet);
    }
    return job.has_value();
  }

  void reference(std::span<const std::uint32_t> packet, Scoreboard& scoreboard) final {
    const SetupJob job = unpack_job(packet, model_.widths());
    const SetupResult result = tb::reference(job, model_);
    if (result.verdict == SetupVerdict::kDrawn) {
      scoreboard.expect(output_words(job, result.triangle, model_));
    }
  }

 protected:
  virtual std::optional<SetupJob> next_job() = 0;

 private:
  const SetupModel& model_;
};

class RandomStimulus final : public JobStimulus {
 public:
  RandomStimulus(const SetupModel& model, std::uint64_t seed, std::uint64_t count)
      : JobStimulus(model), generator_(model, seed), left_(count) {}

 private:
  std::optional<SetupJob> next_job() override {
    if (left_ == 0) {
      return std::nullopt;
    }
    --left_;
    return generator_.next();
  }

  Generator generator_;
  std::uint64_t left_;
};

class ListStimulus final : public JobStimulus {
 public:
  ListStimulus(const SetupModel& model, std::vector<SetupJob> jobs)
      : JobStimulus(model), jobs_(std::move(jobs)) {}

 private:
  std::optional<SetupJob> next_job() override {
    return next_ == jobs_.size() ? std::nullopt : std::optional<SetupJob>(jobs_[next_++]);
  }

  std::vector<SetupJob> jobs_;
  std::size_t next_ = 0;
};

}  // namespace

std::vector<SetupJob> directed_jobs(const SetupModel& model) {
  const Widths widths = model.widths();
  const Band band(widths);
  std::vector<SetupJob> jobs;
  add_orders(jobs, band);
  add_areas(jobs, band);
  add_bounds(jobs, band, model);
  add_depths(jobs, band);
  add_far_depths(jobs, band);
  add_steep(jobs, band);
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    number(jobs[i], i);
  }
  add_states(jobs, band, widths);
  return jobs;
}

std::vector<SetupJob> timing_jobs(const SetupModel& model, const std::vector<bool>& drawn) {
  const Band band(model.widths());
  std::vector<SetupJob> jobs;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    SetupJob job{.triangle = {}, .state = open_state(kFormats[i % 4])};
    number(job, i);
    const auto column = static_cast<std::int64_t>(i % 1000);
    set_vertices(job, {band.centre(column, 4), band.centre(column + 20, drawn[i] ? 9 : 4),
                       band.centre(column + 7, drawn[i] ? 25 : 4)});
    jobs.push_back(job);
  }
  return jobs;
}

std::unique_ptr<Stimulus> random_stimulus(const SetupModel& model, std::uint64_t seed, std::uint64_t count) {
  return std::make_unique<RandomStimulus>(model, seed, count);
}

std::unique_ptr<Stimulus> list_stimulus(const SetupModel& model, std::vector<SetupJob> jobs) {
  return std::make_unique<ListStimulus>(model, std::move(jobs));
}

}  // namespace halfspace::tb
