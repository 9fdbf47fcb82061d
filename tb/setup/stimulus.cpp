#include "stimulus.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "common/random.hpp"
#include "line_stimulus.hpp"
#include "places.hpp"

namespace halfspace::tb {
namespace {

/// Makes random jobs, one after the other.
class Generator {
 public:
  Generator(const SetupModel& model, std::uint64_t seed)
      : widths_(model.widths()),
        band_(widths_),
        block_(model.block_size),
        conservative_(model.conservative() != Conservative::kOff),
        uncertainty_(model.uncertainty),
        thin_lines_(model.thin_lines),
        without_depth_(model.interpolator() == DepthInterpolator::kBarycentric),
        random_(seed) {}

  SetupJob next() {
    if (random_.below(4) == 0) {
      new_state();
    }
    SetupJob job;
    job.state = state_;
    job.triangle.by_square = by_square_;
    number(job, count_++);
    std::array<Point, 3> points = conservative_ && one_in(8) ? on_squares() : kind();
    for (std::size_t i = random_.below(3); i > 0; --i) {
      std::ranges::rotate(points, points.begin() + 1);
    }
    if (random_.below(2) == 0) {
      std::swap(points[0], points[1]);
    }
    last_ = points;
    set_vertices(job, points);
    depths(job);
    if (thin_lines_ && (state_.format == 0 || !without_depth_) && one_in(2)) {
      job.triangle.by_square = 0;
      make_random_line(job, band_, centre_, block_, random_);
    }
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
    by_square_ = !one_in(3) ? 1 : 0;  // means nothing where the machine draws by centres
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

  /// On corners and sides of squares, and next to them: on few places, so that many have no area.
  std::array<Point, 3> on_squares() {
    const Point centre = band_.centre(centre_.x, centre_.y);
    const std::int64_t square = band_.one / 2 + uncertainty_;
    const auto place = [&] {
      const std::int64_t side = one_in(3) ? 0 : one_in(2) ? square : -square;
      return random_.range(-2, 2) * band_.one + side + (one_in(3) ? random_.range(-1, 1) : 0);
    };
    std::array<Point, 3> points;
    for (Point& p : points) {
      p = one_in(4) ? points[0] : band_.clamp({centre.x + place(), centre.y + place()});
    }
    return points;
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
  bool conservative_;
  std::int64_t uncertainty_;
  bool thin_lines_;
  bool without_depth_;  ///< lines, that is
  Random random_;
  std::uint64_t count_ = 0;
  DrawStatePacket state_ = open_state(0);
  std::uint8_t by_square_ = 0;
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
