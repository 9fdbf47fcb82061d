// Cases that a random search might miss.
#include <algorithm>
#include <array>
#include <utility>

#include "line_stimulus.hpp"
#include "places.hpp"
#include "stimulus.hpp"

namespace halfspace::tb {
namespace {

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
        SetupJob job;
        job.state = open_state(kFormats[flags % 4]);
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
      SetupJob job;
      job.state = open_state(format);
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
    SetupJob job;
    job.state = state;
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
    SetupJob job;
    job.state = whole;
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
          SetupJob job;
          job.state = open_state(format);
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
        SetupJob job;
        job.state = open_state(static_cast<std::uint8_t>(format));
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
          SetupJob job;
          job.state = open_state(scale.format);
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
    SetupJob job;
    job.state = open_state(2);
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
  if (model.conservative() != Conservative::kOff) {
    const std::size_t by_centres = jobs.size();
    for (std::size_t i = 0; i < by_centres; ++i) {
      jobs.push_back(jobs[i]);
      jobs.back().triangle.by_square = 1;
    }
  }
  if (model.thin_lines && model.interpolator() == DepthInterpolator::kPlane) {
    add_lines(jobs, band);
  }
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    number(jobs[i], i);
  }
  add_states(jobs, band, widths);
  return jobs;
}

}  // namespace halfspace::tb
