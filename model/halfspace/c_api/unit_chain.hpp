/// The units one behind the other, from any link on.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "halfspace/c_api/depth_surfaces.hpp"
#include "halfspace/c_api/expected_packets.hpp"
#include "halfspace/c_api/link.hpp"
#include "halfspace/units/square_edges.hpp"

namespace halfspace::c_api {

/// What the units of one machine have in common with their user.
struct ChainContext {
  Widths widths;
  WalkerConfig walker;
  DepthInterpolator interpolator = DepthInterpolator::kPlane;
  DepthSurfaces surfaces;
  std::vector<ExpectedPackets> expected;  ///< by link
  std::array<bool, HALFSPACE_LINKS> watched{};
  LinkId last = LinkId::kTriangle;  ///< the last that is watched: no unit behind it works

  [[nodiscard]] bool reaches(LinkId link) const { return last >= link; }
};

class UnitChain {
 public:
  UnitChain() = default;
  UnitChain(const UnitChain&) = delete;
  UnitChain& operator=(const UnitChain&) = delete;
  virtual ~UnitChain() = default;

  /// Takes a packet of a link and pushes what follows from it onto the watched links behind. Throws
  /// InputError; then packets may have been pushed, but nothing else has changed.
  virtual void put(LinkId link, std::span<const std::uint32_t> words) = 0;

  /// As after a reset of the RTL.
  virtual void reset() = 0;
};

/// `context` must outlive it.
std::unique_ptr<UnitChain> make_unit_chain(ChainContext& context);

}  // namespace halfspace::c_api
