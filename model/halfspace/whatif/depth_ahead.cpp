#include "halfspace/whatif/depth_ahead.hpp"

#include <algorithm>
#include <limits>

namespace halfspace::whatif {
namespace {

/// Draws and parts of draws.
using Batch = std::vector<Command>;

std::vector<Batch> cut(std::span<const Command> draws, std::uint64_t triangles) {
  std::vector<Batch> batches(1);
  std::uint64_t room = triangles;
  for (const Command& draw : draws) {
    const std::uint32_t end = draw.first_index + draw.index_count;
    Command part = draw;
    do {  // a draw without triangles is a part too
      if (room == 0) {
        batches.emplace_back();
        room = triangles;
      }
      const std::uint64_t taken = std::min<std::uint64_t>((end - part.first_index) / 3, room);
      part.index_count = static_cast<std::uint32_t>(3 * taken);
      batches.back().push_back(part);
      part.first_index += part.index_count;
      room -= taken;
    } while (part.first_index != end);
  }
  return batches;
}

void enter(const Batch& batch, std::vector<Command>& out) {
  for (Command draw : batch) {
    draw.flags &= ~static_cast<std::uint32_t>(Flag::kColorWrite);
    out.push_back(draw);
  }
}

void leave(const Batch& batch, std::vector<Command>& out) {
  for (Command draw : batch) {
    if (shades(draw)) {
      draw.depth_func = DepthFunc::kEqual;
      draw.flags &= ~static_cast<std::uint32_t>(Flag::kDepthWrite);
      out.push_back(draw);
    }
  }
}

/// `ahead`: batches that enter before the first one leaves, itself not counted.
Acted through_queue(Frame& frame, std::uint64_t batch_triangles, std::uint64_t ahead) {
  return rewrite_ranges(frame, [&](std::span<const Command> draws) {
    std::vector<Command> out;
    if (std::ranges::none_of(draws, shades)) {
      return out;
    }
    const std::vector<Batch> batches = cut(draws, batch_triangles);
    for (std::size_t i = 0; i < batches.size() + ahead; ++i) {
      if (i < batches.size()) {
        enter(batches[i], out);
      }
      if (i >= ahead) {
        leave(batches[i - ahead], out);
      }
    }
    return out;
  });
}

}  // namespace

Acted delay(Frame& frame, std::uint64_t triangles) {
  const std::uint64_t batch = (triangles + kQueueSteps - 1) / kQueueSteps;
  return through_queue(frame, batch, (triangles + batch - 1) / batch);
}

Acted prepass(Frame& frame) { return through_queue(frame, std::numeric_limits<std::uint64_t>::max(), 0); }

}  // namespace halfspace::whatif
