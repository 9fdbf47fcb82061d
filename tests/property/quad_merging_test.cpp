// Quad merging against a second implementation, as plain as the definition: one list of groups, looked
// through from the oldest on, and a mesh as sets of edges. And what holds for every frame: nothing is lost or
// shaded twice.
#include "halfspace/whatif/quad_merging.hpp"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

#include "halfspace/machine/in_order.hpp"
#include "halfspace/scene/ptf.hpp"
#include "halfspace/scene/synthetic.hpp"
#include "hard_frames.hpp"
#include "meshed_frame.hpp"

namespace halfspace::testing {
namespace {

/// A meshed frame counts as so many samples.
constexpr std::uint64_t kMeshSamples = 4000;

class QuadList final : public PacketObserver {
 public:
  [[nodiscard]] bool wants_quads() const override { return true; }
  void quad(const QuadEvent& quad) override { quads.push_back(quad); }

  std::vector<QuadEvent> quads;
};

std::vector<QuadEvent> quads_of(const Frame& frame, const Config& config = {}) {
  QuadList list;
  run_in_order(frame, config, {.observer = &list}, nullptr);
  return list.quads;
}

const Command& draw_of(const Frame& frame, std::uint32_t number) {
  for (const Command& command : frame.commands) {
    if (command.kind == CommandKind::kDraw && number-- == 0) {
      return command;
    }
  }
  throw std::logic_error("a quad of a draw that the frame has not");
}

/// Edges by triangle: pairs of vertices, a vertex being its index where the draw uses one twice, else its
/// position.
class EdgeSets {
 public:
  EdgeSets(const Frame& frame, const Command& draw) {
    std::multiset<std::uint32_t> uses;
    for (std::uint32_t i = 0; i < draw.index_count; ++i) {
      uses.insert(frame.indices[draw.first_index + i]);
    }
    const bool shares =
        std::any_of(uses.begin(), uses.end(), [&](std::uint32_t index) { return uses.count(index) > 1; });
    std::map<std::tuple<float, float, float, float>, std::uint32_t> positions;
    const auto vertex = [&](std::uint32_t i) {
      const std::uint32_t index = frame.indices[draw.first_index + i];
      const glm::vec4& v = frame.vertices[draw.first_vertex + index];
      return shares ? index : positions.emplace(std::tuple(v.x, v.y, v.z, v.w), index).first->second;
    };
    for (std::uint32_t i = 0; i < draw.index_count; i += 3) {
      const std::uint32_t v[] = {vertex(i), vertex(i + 1), vertex(i + 2)};
      edges_.push_back({std::minmax({v[0], v[1]}), std::minmax({v[1], v[2]}), std::minmax({v[2], v[0]})});
    }
  }

  [[nodiscard]] bool common(std::uint32_t a, std::uint32_t b) const {
    return std::any_of(edges_[a].begin(), edges_[a].end(),
                       [&](const auto& edge) { return edges_[b].count(edge) != 0; });
  }

 private:
  std::vector<std::set<std::pair<std::uint32_t, std::uint32_t>>> edges_;
};

using Groups = std::vector<std::vector<QuadEvent>>;

bool colours(const Command& draw) {
  return (draw.flags & bits({Flag::kColorWrite, Flag::kShaderDiscards, Flag::kShaderWritesDepth,
                             Flag::kShaderSideEffects, Flag::kAlphaToCoverage})) != 0;
}

unsigned mask_of(const std::vector<QuadEvent>& group) {
  unsigned mask = 0;
  for (const QuadEvent& quad : group) {
    mask |= quad.passed;
  }
  return mask;
}

bool joins(const QuadEvent& quad, const std::vector<QuadEvent>& group, const EdgeSets& mesh) {
  return std::tuple(group[0].x, group[0].y, group[0].front) == std::tuple(quad.x, quad.y, quad.front) &&
         (mask_of(group) & quad.passed) == 0 &&
         std::any_of(group.begin(), group.end(),
                     [&](const QuadEvent& other) { return mesh.common(quad.triangle, other.triangle); });
}

/// The groups in the order in which they leave.
Groups merge_plainly(const Frame& frame, const std::vector<QuadEvent>& quads, std::size_t buffer) {
  Groups left;
  Groups held;
  const auto leave = [&](std::size_t i) {
    left.push_back(held[i]);
    held.erase(held.begin() + static_cast<std::ptrdiff_t>(i));
  };
  std::map<std::uint32_t, EdgeSets> meshes;
  for (const QuadEvent& quad : quads) {
    if (quad.passed == 0 || !colours(draw_of(frame, quad.draw))) {
      continue;
    }
    while (!held.empty() && held[0][0].draw != quad.draw) {
      leave(0);
    }
    const EdgeSets& mesh = meshes.try_emplace(quad.draw, frame, draw_of(frame, quad.draw)).first->second;
    std::size_t at = 0;
    while (at < held.size() && !joins(quad, held[at], mesh)) {
      ++at;
    }
    if (at < held.size()) {
      held[at].push_back(quad);
    } else {
      held.push_back({quad});
    }
    if (mask_of(held[at]) == 15) {
      leave(at);
    }
    if (held.size() > buffer) {
      leave(0);
    }
  }
  while (!held.empty()) {
    leave(0);
  }
  return left;
}

struct Merged {
  std::vector<QuadGroup> groups;
  QuadMergingResult result;
};

Merged merge(const Frame& frame, const std::vector<QuadEvent>& quads, int buffer) {
  Merged merged;
  QuadMerging merging(frame, buffer, [&](const QuadGroup& group) { merged.groups.push_back(group); });
  for (const QuadEvent& quad : quads) {
    merging.quad(quad);
  }
  merged.result = merging.finish();
  return merged;
}

std::string text(const QuadGroup& group) {
  std::string text = std::to_string(group.draw) + ": " + std::to_string(group.x) + " " +
                     std::to_string(group.y) + " mask " + std::to_string(group.mask) + " of";
  for (std::size_t i = 0; i < group.size; ++i) {
    text += " " + std::to_string(group.triangles[i]);
  }
  return text;
}

std::string text(const std::vector<QuadEvent>& group) {
  QuadGroup same{.draw = group[0].draw, .x = group[0].x, .y = group[0].y, .front = group[0].front};
  for (const QuadEvent& quad : group) {
    same.mask |= quad.passed;
    same.triangles.at(same.size++) = quad.triangle;
  }
  return text(same);
}

/// The first group that is another; empty where none is.
std::string first_difference(const std::vector<QuadGroup>& ours, const Groups& plain) {
  for (std::size_t i = 0; i < std::min(ours.size(), plain.size()); ++i) {
    if (text(ours[i]) != text(plain[i])) {
      return "group " + std::to_string(i) + ": " + text(ours[i]) + " against " + text(plain[i]);
    }
  }
  return ours.size() == plain.size()
             ? ""
             : std::to_string(ours.size()) + " groups against " + std::to_string(plain.size());
}

/// Every counter that follows from the groups, and every quad accounted for once.
void check_counters(const QuadMergingCounters& c, const Groups& groups) {
  std::array<std::uint64_t, 5> of_size{};
  std::uint64_t quads = 0;
  std::uint64_t survivors = 0;
  for (const std::vector<QuadEvent>& group : groups) {
    ++of_size.at(group.size());
    quads += group.size();
    survivors += static_cast<std::uint64_t>(std::popcount(mask_of(group)));
  }
  REQUIRE(c.quads == quads);
  REQUIRE(c.survivors == survivors);
  REQUIRE(quads_shaded(c) == groups.size());
  REQUIRE(c.pairs == of_size[2]);
  REQUIRE(c.triples == of_size[3]);
  REQUIRE(c.quadruples == of_size[4]);
  REQUIRE(c.quads == c.joined + c.whole + c.missed + c.overlap + c.other_facing + c.not_adjacent + c.alone);
}

/// How often each sample of each draw is shaded.
using Shaded = std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint64_t>;

void add_samples(Shaded& shaded, std::uint32_t draw, std::uint32_t x, std::uint32_t y, unsigned mask) {
  for (unsigned i = 0; i < 4; ++i) {
    if ((mask >> i & 1) != 0) {
      ++shaded[{draw, x + i % 2, y + i / 2}];
    }
  }
}

}  // namespace

TEST_CASE("quad merging: the groups of a second implementation", "[property]") {
  Random random(seed());
  std::uint64_t merged_quads = 0;
  std::uint64_t missed = 0;
  for (std::uint64_t run = 0; run < samples(4'000'000) / kMeshSamples; ++run) {
    CAPTURE(seed(), run);
    const Frame frame = random.between(0, 9) == 0 ? hard_frame(random) : meshed_frame(random);
    const int buffer = random_buffer(random);
    CAPTURE(buffer);
    const std::vector<QuadEvent> quads = quads_of(frame);
    const Merged ours = merge(frame, quads, buffer);
    const Groups plain = merge_plainly(frame, quads, static_cast<std::size_t>(buffer));
    REQUIRE(first_difference(ours.groups, plain) == "");
    check_counters(ours.result.frame, plain);
    merged_quads += ours.result.frame.joined;
    missed += ours.result.frame.missed;
  }
  CHECK(merged_quads > 1000);
  CHECK(missed > 1000);
}

TEST_CASE("quad merging: each surviving sample is shaded as often as before", "[property]") {
  Random random(seed() + 1);
  for (std::uint64_t run = 0; run < samples(2'000'000) / kMeshSamples; ++run) {
    CAPTURE(seed(), run);
    const Frame frame = meshed_frame(random);
    const std::vector<QuadEvent> quads = quads_of(frame, random_config(random));
    Shaded before;
    for (const QuadEvent& quad : quads) {
      if (colours(draw_of(frame, quad.draw))) {
        add_samples(before, quad.draw, quad.x, quad.y, quad.passed);
      }
    }
    Shaded after;
    for (const QuadGroup& group : merge(frame, quads, random_buffer(random)).groups) {
      add_samples(after, group.draw, group.x, group.y, group.mask);
    }
    REQUIRE((before == after));
  }
}

TEST_CASE("quad merging: without a bound, no fewer groups than connected parts, and as many where two meet",
          "[property]") {
  // The parts of a place: its quads, joined where triangles share an edge. Here no triangles overlap and all
  // face one way, so only the order in which they come can keep quads of a part from being one group, and no
  // order can where there are two.
  Random random(seed() + 2);
  std::uint64_t pairs = 0;
  for (std::uint64_t run = 0; run < samples(2'000'000) / kMeshSamples; ++run) {
    CAPTURE(seed(), run);
    Frame frame = meshed_frame(random);
    frame.commands.resize(2);  // the clear and a draw
    Command& draw = frame.commands.back();
    draw.flags |= bits({Flag::kColorWrite, Flag::kCullBack});
    const std::vector<QuadEvent> quads = quads_of(frame);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<QuadEvent>> places;
    for (const QuadEvent& quad : quads) {
      if (quad.passed != 0) {
        places[{quad.x, quad.y}].push_back(quad);
      }
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> groups;
    for (const QuadGroup& group : merge(frame, quads, kMostMergeQuads).groups) {
      ++groups[{group.x, group.y}];
    }
    const EdgeSets mesh(frame, draw);
    for (const auto& [place, there] : places) {
      std::vector<std::size_t> part(there.size());
      for (std::size_t i = 0; i < there.size(); ++i) {
        part[i] = i;
        for (std::size_t k = 0; k < i; ++k) {
          if (mesh.common(there[i].triangle, there[k].triangle)) {
            const std::size_t old = part[k];
            std::replace(part.begin(), part.end(), old, i);
          }
        }
      }
      const std::size_t parts = std::set<std::size_t>(part.begin(), part.end()).size();
      REQUIRE(groups[place] >= parts);
      if (there.size() <= 2) {
        REQUIRE(groups[place] == parts);
        pairs += there.size() - parts;
      }
    }
  }
  CHECK(pairs > 1000);
}

TEST_CASE("quad merging: the frames that ship, by a second implementation", "[property]") {
  for (const Frame& frame : {read_ptf(HALFSPACE_SCENES "/vkcube.ptf.xz"), synthetic_frame("tiny_grid")}) {
    CAPTURE(frame.name);
    const std::vector<QuadEvent> quads = quads_of(frame);
    for (const int buffer : {0, 1, 32}) {
      CAPTURE(buffer);
      const Merged ours = merge(frame, quads, buffer);
      const Groups plain = merge_plainly(frame, quads, static_cast<std::size_t>(buffer));
      REQUIRE(first_difference(ours.groups, plain) == "");
      check_counters(ours.result.frame, plain);
    }
  }
}

}  // namespace halfspace::testing
