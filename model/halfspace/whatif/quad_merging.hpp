/// Quad merging: how much less a pixel shader would have to do if quads of neighbouring triangles were merged
/// between early_z and shading. A what-if: it looks at the quads of a run and changes nothing of it.
///
/// K. Fatahalian, S. Boulos, J. Hegarty, K. Akeley, W. R. Mark, H. Moreton, P. Hanrahan, "Reducing Shading on
/// GPUs using Quad-Fragment Merging", SIGGRAPH 2010. Taken from it: quads merge at one place, with disjoint
/// coverage, of one facing, and of triangles that an edge connects; docs/guides/quad_merging.md says where
/// this stage differs.
///
/// A buffer holds groups of quads; a group is shaded as one quad, four fragments. Of each quad the samples
/// that survive early-Z count. Quads without any are gone, and so are those of draws that run no shader. A
/// quad joins a group if
///   - both belong to the same draw and lie at the same place,
///   - its triangle shares an edge of the mesh with a triangle of the group (DrawMesh),
///   - their triangles face the same way,
///   - no sample survives in both.
/// If several groups take it, it joins the oldest. A quad that joins none becomes a group of its own, the
/// youngest. A group leaves for shading when all four samples of it survive, when the buffer holds more than
/// it can and the group is the oldest, or when the draw ends. A quad of four samples passes by the buffer.
/// With one sample a pixel a group has at most four quads, so shading falls by a factor of four at most.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <list>
#include <optional>
#include <unordered_map>
#include <vector>

#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/units/counter_struct.hpp"
#include "halfspace/whatif/draw_mesh.hpp"

namespace halfspace {

/// Groups that the buffer may hold: 0, which merges nothing, to this, more than 1920x1080 has places.
inline constexpr int kMostMergeQuads = 1 << 20;

// clang-format off
/// Every quad either joins a group or begins one, for exactly one reason.
#define HALFSPACE_QUAD_MERGING_COUNTERS(C)                                              \
  C(quads,             "quads with a surviving sample, of draws that run a shader")     \
  C(survivors,         "their surviving samples")                                       \
  C(joined,            "quads that joined a group: what is saved")                      \
  C(pairs,             "groups of two quads")                                           \
  C(triples,           "groups of three quads")                                         \
  C(quadruples,        "groups of four quads")                                          \
  C(evictions,         "groups that left because the buffer was full")                  \
  C(whole,             "began a group: all four samples survive")                       \
  C(missed,            "began a group: the last evicted at its place would have taken it") \
  C(overlap,           "began a group: a sample of the closest one is also its own")    \
  C(other_facing,      "began a group: the closest one faces the other way")            \
  C(not_adjacent,      "began a group: it shares no edge with one that is held")        \
  C(alone,             "began a group: none is held at its place")
// clang-format on

HALFSPACE_COUNTER_STRUCT(QuadMergingCounters, HALFSPACE_QUAD_MERGING_COUNTERS)

/// Quads that are shaded after merging; fragments shaded with it and without, helpers included.
constexpr std::uint64_t quads_shaded(const QuadMergingCounters& c) { return c.quads - c.joined; }
constexpr std::uint64_t fragments_shaded(const QuadMergingCounters& c) { return 4 * quads_shaded(c); }
constexpr std::uint64_t fragments_unmerged(const QuadMergingCounters& c) { return 4 * c.quads; }

struct QuadMergingResult {
  int buffer = 0;                          ///< groups that it could hold
  std::vector<QuadMergingCounters> draws;  ///< of the frame, in order
  QuadMergingCounters frame;               ///< their sum
};

/// What is shaded as one quad.
struct QuadGroup {
  std::uint32_t draw = 0;
  std::uint32_t x = 0;  ///< top left pixel
  std::uint32_t y = 0;
  bool front = false;                        ///< its triangles face front
  std::uint8_t mask = 0;                     ///< samples that survive, as in QuadEvent
  std::uint8_t size = 0;                     ///< quads
  std::array<std::uint32_t, 4> triangles{};  ///< of the quads, in the order in which they came
};

/// Takes the quads of a run in the order in which they leave early_z.
class QuadMerging final : public PacketObserver {
 public:
  using Shade = std::function<void(const QuadGroup&)>;

  /// `frame` must be valid and outlive the stage. `shade` gets every group as it leaves. Throws InputError
  /// where `buffer` is not in 0 to kMostMergeQuads.
  QuadMerging(const Frame& frame, int buffer, Shade shade = {});

  [[nodiscard]] bool wants_quads() const override { return true; }
  void quad(const QuadEvent& quad) override;

  /// After the last quad.
  QuadMergingResult finish();

 private:
  using Held = std::list<QuadGroup>;  ///< oldest first

  /// What a quad and a group have in common, from what is asked first to what is asked last.
  enum class Fit : std::uint8_t { kNotAdjacent, kOtherFacing, kOverlap, kJoins };

  struct Place {
    std::vector<Held::iterator> held;  ///< oldest first
    std::optional<QuadGroup> evicted;  ///< the last
  };

  void begin_draw(std::uint32_t draw);
  void end_draw();
  [[nodiscard]] Fit fit(const QuadEvent& quad, const QuadGroup& group) const;
  void join(const QuadEvent& quad, Place& place, std::vector<Held::iterator>::iterator group);
  void hold(const QuadGroup& group, Place& place);
  void leave(const QuadGroup& group);

  const Frame& frame_;
  std::size_t buffer_;
  Shade shade_;
  std::vector<const Command*> commands_;  ///< by draw
  std::vector<QuadMergingCounters> draws_;

  // Of the draw at work.
  std::uint32_t draw_ = 0xFFFFFFFFu;
  std::optional<DrawMesh> mesh_;  ///< where it runs a shader
  Held held_;
  std::unordered_map<std::uint64_t, Place> places_;
};

}  // namespace halfspace
