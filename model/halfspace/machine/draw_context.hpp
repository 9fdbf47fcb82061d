/// A draw, or a clear that is drawn, as the units see it while its packets are under way.
#pragma once

#include <cstdint>
#include <memory>

#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/machine/packet_sums.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/units/counters.hpp"
#include "halfspace/units/late_writes.hpp"
#include "halfspace/units/setup.hpp"
#include "halfspace/units/z_test.hpp"

namespace halfspace {

class AttributeSource;

/// Draw number of what belongs to no draw: clears that are drawn.
inline constexpr std::uint32_t kNoDraw = 0xFFFFFFFFu;

/// Every packet points to its own: each unit may be at another draw.
struct DrawContext {
  std::uint32_t draw = kNoDraw;        ///< counts the draws of the frame
  std::uint32_t command = 0;           ///< index in Frame::commands
  std::uint32_t surface = kNoSurface;  ///< depth surface
  std::uint32_t drawn_on = 0;          ///< in FrameResult::surfaces
  std::uint32_t first_triangle = 0;    ///< triangles of the draws before
  SetupState setup;
  EarlyZState early_z;
  ShaderDiscard discard;
  int attributes = 0;  ///< that its shader reads of each quad, from the interpolator
  std::shared_ptr<const AttributeSource> source;  ///< their values; null where nobody looks at them
  bool keeps_visible = false;                     ///< its survivors go into Surface::visible
  PacketSums* sums = nullptr;                     ///< of the surface, where they are kept
  PacketObserver* observer = nullptr;             ///< not null where one of the following is set
  bool record_quads = false;
  bool record_decisions = false;
  bool record_jobs = false;
  bool record_walk = false;
  Counters counters;

  [[nodiscard]] bool is_clear() const { return draw == kNoDraw; }
};

}  // namespace halfspace
