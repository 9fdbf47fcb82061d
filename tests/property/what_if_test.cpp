// What-ifs against a naive depth buffer: the test knows coverage by exact edge functions, depth by flat
// triangles, and the rule of what may move from the page.
#include <catch2/catch.hpp>

#include "../result_difference.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/report/what_if.hpp"
#include "halfspace/whatif/depth_ahead.hpp"
#include "halfspace/whatif/sort.hpp"
#include "hard_frames.hpp"

namespace halfspace::testing {
namespace {

constexpr int kSide = 32;
constexpr std::uint64_t kWhatIfFrameSamples = 2000;

/// A triangle of one depth: what it covers, by definition.
struct FlatTriangle {
  std::vector<bool> covers = std::vector<bool>(kSide * kSide);
  int eighths = 0;  ///< of the depth
};

struct FlatDraw {
  Command state;
  std::vector<FlatTriangle> triangles;
};

struct FlatFrame {
  Frame frame;
  std::vector<FlatDraw> commands;  ///< clears too, without triangles
};

/// Corners on the grid of 1/256 pixel, none of whose edges passes through a sample.
std::vector<glm::dvec3> random_flat_triangle(Random& random, FlatTriangle& flat) {
  while (true) {
    std::array<std::array<std::int64_t, 2>, 3> at{};
    for (auto& corner : at) {
      corner = {random.between(-8 * 256, 40 * 256), random.between(-8 * 256, 40 * 256)};
    }
    bool on_edge = false;
    for (std::int64_t y = 0; y < kSide; ++y) {
      for (std::int64_t x = 0; x < kSide; ++x) {
        int positive = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          const auto& a = at[i];
          const auto& b = at[(i + 1) % 3];
          const std::int64_t edge =
              (b[0] - a[0]) * (y * 256 + 128 - a[1]) - (b[1] - a[1]) * (x * 256 + 128 - a[0]);
          on_edge = on_edge || edge == 0;
          positive += edge > 0 ? 1 : 0;
        }
        flat.covers[static_cast<std::size_t>(y * kSide + x)] = positive == 0 || positive == 3;
      }
    }
    if (!on_edge) {
      flat.eighths = static_cast<int>(random.between(0, 8));
      std::vector<glm::dvec3> window;
      for (const auto& corner : at) {
        window.emplace_back(static_cast<double>(corner[0]) / 256, static_cast<double>(corner[1]) / 256,
                            flat.eighths / 8.0);
      }
      return window;
    }
  }
}

FlatFrame random_flat_frame(Random& random) {
  FrameBuilder builder(kSide);
  FlatFrame flat;
  const DepthFunc usual = pick(random, {DepthFunc::kLess, DepthFunc::kLequal, DepthFunc::kGequal});
  for (auto n = random.between(1, 12); n > 0; --n) {
    if (random.between(0, 9) == 0) {
      builder.clear(static_cast<float>(random.between(0, 8)) / 8);
    }
    FlatDraw draw;
    std::vector<glm::dvec3> window;
    for (auto triangles = random.between(0, 5); triangles > 0; --triangles) {
      const std::vector<glm::dvec3> corners = random_flat_triangle(random, draw.triangles.emplace_back());
      window.insert(window.end(), corners.begin(), corners.end());
    }
    Command& command = builder.draw(window);
    command.depth_func = random.between(0, 3) != 0 ? usual : static_cast<DepthFunc>(random.between(0, 7));
    if (random.between(0, 5) == 0) {
      command.flags &= ~bits({Flag::kColorWrite});
    }
    if (random.between(0, 9) == 0) {
      command.flags &= ~bits({Flag::kDepthWrite});
    }
    if (random.between(0, 9) == 0) {
      command.flags |= pick(random, {bits({Flag::kBlend}), bits({Flag::kShaderDiscards}),
                                     bits({Flag::kStencilTest}), bits({Flag::kShaderWritesDepth}),
                                     bits({Flag::kShaderSideEffects}), bits({Flag::kAlphaToCoverage})});
    }
    for (std::size_t i = flat.commands.size(); i + 1 < builder.frame.commands.size(); ++i) {
      flat.commands.push_back({.state = builder.frame.commands[i], .triangles = {}});
    }
    draw.state = command;
    flat.commands.push_back(std::move(draw));
  }
  flat.frame = builder.frame;
  return flat;
}

bool passes(DepthFunc func, int incoming, int stored) {
  switch (func) {
    case DepthFunc::kNever:
      return false;
    case DepthFunc::kLess:
      return incoming < stored;
    case DepthFunc::kEqual:
      return incoming == stored;
    case DepthFunc::kLequal:
      return incoming <= stored;
    case DepthFunc::kGreater:
      return incoming > stored;
    case DepthFunc::kNotEqual:
      return incoming != stored;
    case DepthFunc::kGequal:
      return incoming >= stored;
    case DepthFunc::kAlways:
      return true;
  }
  return false;
}

int direction(DepthFunc func) {
  return func == DepthFunc::kLess || func == DepthFunc::kLequal      ? 1
         : func == DepthFunc::kGreater || func == DepthFunc::kGequal ? -1
                                                                     : 0;
}

bool opaque(const Command& c) {
  return c.kind == CommandKind::kDraw && direction(c.depth_func) != 0 && c.has(Flag::kDepthWrite) &&
         (c.flags & bits({Flag::kBlend, Flag::kShaderDiscards, Flag::kStencilTest, Flag::kShaderWritesDepth,
                          Flag::kShaderSideEffects, Flag::kAlphaToCoverage})) == 0;
}

bool has_colour(const Command& c) {
  return (c.flags & bits({Flag::kColorWrite, Flag::kShaderDiscards, Flag::kShaderWritesDepth,
                          Flag::kShaderSideEffects, Flag::kAlphaToCoverage})) != 0;
}

/// A depth buffer of eighths, and how many fragments were shaded.
class NaiveBuffer {
 public:
  std::vector<int> depth = std::vector<int>(kSide * kSide, 0);
  std::uint64_t shaded = 0;

  void in_order(const FlatDraw& draw) {
    for (const FlatTriangle& t : draw.triangles) {
      for (std::size_t i = 0; i < depth.size(); ++i) {
        if (t.covers[i] && passes(draw.state.depth_func, t.eighths, depth[i])) {
          shaded += has_colour(draw.state) ? 1 : 0;
          depth[i] = draw.state.has(Flag::kDepthWrite) ? t.eighths : depth[i];
        }
      }
    }
  }

  /// A range, of whose n triangles the first entered(t) have laid their depth when triangle t is shaded.
  template <class Entered>
  void depth_ahead(std::span<const FlatDraw> range, const Entered& entered) {
    const int sign = direction(range.front().state.depth_func);
    std::vector<std::pair<const FlatTriangle*, bool>> triangles;
    for (const FlatDraw& draw : range) {
      for (const FlatTriangle& t : draw.triangles) {
        triangles.emplace_back(&t, has_colour(draw.state));
      }
    }
    const auto nearest = [&](std::size_t i, std::size_t count) {
      int least = sign * depth[i];
      for (std::size_t t = 0; t < count; ++t) {
        least = triangles[t].first->covers[i] ? std::min(least, sign * triangles[t].first->eighths) : least;
      }
      return sign * least;
    };
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& [triangle, colour] = triangles[t];
      for (std::size_t i = 0; i < depth.size() && colour; ++i) {
        shaded +=
            triangle->covers[i] && triangle->eighths == nearest(i, entered(t, triangles.size())) ? 1 : 0;
      }
    }
    for (std::size_t i = 0; i < depth.size(); ++i) {
      depth[i] = nearest(i, triangles.size());
    }
  }

  /// The frame with depth ahead of shading in its ranges.
  template <class Entered>
  void frame_ahead(const FlatFrame& flat, const Entered& entered) {
    const std::span<const FlatDraw> all(flat.commands);
    for (std::size_t i = 0; i < all.size();) {
      std::size_t end = i;
      while (end < all.size() && opaque(all[end].state) &&
             direction(all[end].state.depth_func) == direction(all[i].state.depth_func)) {
        ++end;
      }
      if (end != i) {
        depth_ahead(all.subspan(i, end - i), entered);
        i = end;
      } else if (all[i].state.kind == CommandKind::kClear) {
        std::ranges::fill(depth, static_cast<int>(8 * all[i++].state.clear_depth));
      } else {
        in_order(all[i++]);
      }
    }
  }
};

/// Compares the buffer with a run of the frame.
void check_against(const NaiveBuffer& naive, const Frame& frame) {
  const FrameResult result = run_functional(frame, {});
  const Surface& surface = result.surfaces[0];
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      CAPTURE(x, y);
      const int eighths = naive.depth[static_cast<std::size_t>(y * kSide + x)];
      REQUIRE(surface.codes.at(x, y) == code_of_depth(surface.format, eighths / 8.0));
    }
  }
  const RunResult run{.frame = result,
                      .cycles = {},
                      .times = {},
                      .rtl = {},
                      .quad_merging = {},
                      .pixel_rate = {},
                      .reference = {}};
  REQUIRE(work_of(frame, run).shaded == naive.shaded);
}

std::string depth_difference(const Frame& ours, const Frame& other, const Config& config) {
  const FrameResult a = run_functional(ours, config);
  const FrameResult b = run_functional(other, config);
  std::string text = difference("surfaces", a.surfaces.size(), b.surfaces.size());
  for (std::size_t i = 0; text.empty() && i < a.surfaces.size(); ++i) {
    text += image_difference("surface " + std::to_string(i), a.surfaces[i].codes, b.surfaces[i].codes);
  }
  return text;
}

/// The commands that may not move, in order.
std::vector<std::uint32_t> fixed_events(const Frame& frame) {
  std::vector<std::uint32_t> events;
  for (const Command& command : frame.commands) {
    if (command.source_event != 0) {
      events.push_back(command.source_event);
    }
  }
  return events;
}

}  // namespace

TEST_CASE("what if: depth that goes ahead shades what a naive depth buffer says", "[property]") {
  Random random(seed());
  std::uint64_t saved = 0;
  for (std::uint64_t run = 0; run < samples(1'000'000) / kWhatIfFrameSamples; ++run) {
    CAPTURE(seed(), run);
    const FlatFrame flat = random_flat_frame(random);
    NaiveBuffer plain;
    for (const FlatDraw& command : flat.commands) {
      if (command.state.kind == CommandKind::kClear) {
        std::ranges::fill(plain.depth, static_cast<int>(8 * command.state.clear_depth));
      } else {
        plain.in_order(command);
      }
    }
    check_against(plain, flat.frame);

    Frame frame = flat.frame;
    whatif::prepass(frame);
    NaiveBuffer first;
    first.frame_ahead(flat, [](std::size_t, std::size_t all) { return all; });
    check_against(first, frame);
    saved += plain.shaded > first.shaded ? 1 : 0;

    const auto triangles = static_cast<std::uint64_t>(random.between(1, 20));
    CAPTURE(triangles);
    frame = flat.frame;
    whatif::delay(frame, triangles);
    const std::size_t batch = (triangles + 7) / 8;
    std::size_t ahead = 0;
    while (ahead * batch < triangles) {
      ++ahead;
    }
    NaiveBuffer queue;
    queue.frame_ahead(flat, [&](std::size_t t, std::size_t all) {
      const std::size_t entered = (t / batch + 1 + ahead) * batch;
      REQUIRE(entered - 1 - t >= triangles);  // what the header promises
      REQUIRE(entered - 1 - t < triangles + 2 * batch);
      return std::min(all, entered);
    });
    check_against(queue, frame);
  }
  CHECK(saved > 0);
}

TEST_CASE("what if: no order changes the depth of random frames, nor moves what may not move",
          "[property][exhaustive]") {
  Random random(seed() + 1);
  std::uint64_t acted = 0;
  for (std::uint64_t run = 0; run < samples(2'000'000) / kWhatIfFrameSamples; ++run) {
    CAPTURE(seed(), run);
    Frame frame = random.between(0, 2) == 0 ? depth_stack(random) : hard_frame(random);
    std::uint32_t event = 0;
    for (Command& command : frame.commands) {
      command.source_event = whatif::may_move(frame, command) ? 0 : ++event;
    }
    Config config;
    config.late_z.mode = pick(random, {LateZ::kOpaque, LateZ::kNoWrite});
    const auto check = [&](const auto& act) {
      Frame changed = frame;
      acted += act(changed).draws;
      REQUIRE(depth_difference(changed, frame, config) == "");
      REQUIRE(fixed_events(changed) == fixed_events(frame));
    };
    check([](Frame& f) { return whatif::prepass(f); });
    check([&](Frame& f) { return whatif::delay(f, static_cast<std::uint64_t>(random.between(1, 300))); });
    check([](Frame& f) { return whatif::sort(f, whatif::SortOrder::kFrontToBack); });
    check([](Frame& f) { return whatif::sort(f, whatif::SortOrder::kBackToFront); });
    check([](Frame& f) { return whatif::reverse(f); });
  }
  CHECK(acted > 1000);
}

}  // namespace halfspace::testing
