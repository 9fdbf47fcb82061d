#include "walk_coverage.hpp"

#include <fmt/format.h>

#include "halfspace/units/packing.hpp"

namespace halfspace::tb {
namespace {

constexpr std::array<const char*, kStepKinds> kKindNames = {
    "block rejected", "block accepted", "block partial",         "tile rejected",
    "tile accepted",  "tile partial",   "tile of accepted block"};
constexpr std::array<const char*, 3> kSigns = {"-", "0", "+"};
constexpr std::array<const char*, 4> kSides = {"left", "right", "top", "bottom"};
constexpr std::array<const char*, 2> kNoYes = {"", "not "};

std::size_t sign(std::int32_t step) { return step < 0 ? 0 : step == 0 ? 1 : 2; }

/// An edge of a triangle has no direction 0, 0.
constexpr std::size_t kNoDirection = 4;

/// A left edge goes through the leftmost sample column of the bounds or passes it on the left, and owns what
/// it goes through: no square of the bounds is outside it.
constexpr std::size_t kLeftEdge = 7;

constexpr const char* kLastSlot = "last slot";

std::string wait_name(bool first_step, bool last_step) {
  return fmt::format("waits, {}in the first step, {}in the last", kNoYes[first_step ? 0 : 1],
                     kNoYes[last_step ? 0 : 1]);
}

}  // namespace

WalkCoverage::WalkCoverage(const WalkerParameters& parameters) : parameters_(parameters) {
  for (std::size_t kind = 0; kind < kStepKinds; ++kind) {
    const bool rejects = !gives_out(static_cast<StepKind>(kind)) && kind % 3 == 0;
    for (std::size_t edge = 0; edge < 3; ++edge) {
      for (std::size_t direction = 0; direction < 9; ++direction) {
        if (possible(static_cast<StepKind>(kind)) && direction != kNoDirection &&
            !(rejects && direction == kLeftEdge)) {
          decisions_[kind][edge][direction] = &bins_[fmt::format(
              "{}, edge {} ({}, {})", kKindNames[kind], edge, kSigns[direction / 3], kSigns[direction % 3])];
        }
      }
    }
  }
  for (std::size_t accept = 0; accept < (parameters.trivial_accept ? 8 : 1); ++accept) {
    accepts_[accept] = &bins_[fmt::format("job with accept bits {:03b}", accept)];
  }
  for (std::size_t side = 0; side < kSides.size(); ++side) {
    for (std::size_t no = 0; no < kNoYes.size(); ++no) {
      cuts_[side][no] = &bins_[fmt::format("job {}cut on the {}", kNoYes[no], kSides[side])];
    }
  }
  for (const char* no : kNoYes) {
    bins_[fmt::format("{}in one tile, drawn", no)];
    if (parameters.trivial_reject) {
      bins_[fmt::format("{}in one tile, no job", no)];
    }
    if (parameters.block_level) {
      bins_[fmt::format("{}in the first tile column of its block", no)];
      bins_[fmt::format("{}in the first tile row of its block", no)];
    }
    bins_[fmt::format("reset, triangle {}under way", no)];
    for (const StepKind last : {StepKind::kBlockReject, StepKind::kTileReject, StepKind::kTilePartial}) {
      if (possible(last)) {
        bins_[fmt::format("next {}taken in the last step, {}", no,
                          kKindNames[static_cast<std::size_t>(last)])];
      }
    }
  }
  // A walk of several steps begins with a block, if there are blocks.
  bins_[wait_name(true, true)];
  bins_[wait_name(false, true)];
  bins_[wait_name(false, false)];
  if (!parameters.block_level) {
    bins_[wait_name(true, false)];
  }
  bins_["taken when idle"];
  bins_["reset in a wait"];
  bins_[kLastSlot];
}

void WalkCoverage::taken(std::span<const std::uint32_t> triangle, const Walk& walk, std::uint8_t slot) {
  const auto packet = unpack<SetupTrianglePacket>(triangle, parameters_.widths());
  std::array<std::size_t, 3> direction{};
  for (std::size_t i = 0; i < 3; ++i) {
    direction[i] = 3 * sign(packet.a[i]) + sign(packet.b[i]);
  }
  for (const WalkStep& step : walk.steps) {
    for (std::size_t i = 0; i < 3; ++i) {
      if ((step.edges >> i & 1) != 0) {
        hit_decision(step.kind, i, direction[i]);
      }
    }
  }
  const int last = parameters_.tile_size - 1;
  for (const TileJob& job : walk.jobs) {
    ++*accepts_[job.accept];
    ++*cuts_[0][job.x_first == 0 ? 1 : 0];
    ++*cuts_[1][job.x_last == last ? 1 : 0];
    ++*cuts_[2][job.y_first == 0 ? 1 : 0];
    ++*cuts_[3][job.y_last == last ? 1 : 0];
  }
  const char* const no_one_tile = kNoYes[walk.one_tile ? 0 : 1];
  hit(fmt::format("{}in one tile, {}", no_one_tile, walk.jobs.empty() ? "no job" : "drawn"));
  if (!walk.one_tile) {
    const int first_x = packet.x_first % parameters_.block_size;
    const int first_y = packet.y_first % parameters_.block_size;
    hit(fmt::format("{}in the first tile column of its block", kNoYes[first_x <= last ? 0 : 1]));
    hit(fmt::format("{}in the first tile row of its block", kNoYes[first_y <= last ? 0 : 1]));
  }
  if (slot == 255 && !walk.jobs.empty()) {
    hit(kLastSlot);
  }
}

void WalkCoverage::loaded_when_idle() { hit("taken when idle"); }

void WalkCoverage::triangle_done(StepKind last, bool next) {
  const StepKind kind = gives_out(last) ? StepKind::kTilePartial : last;
  hit(fmt::format("next {}taken in the last step, {}", kNoYes[next ? 0 : 1],
                  kKindNames[static_cast<std::size_t>(kind)]));
}

void WalkCoverage::waited(bool first_step, bool last_step) { hit(wait_name(first_step, last_step)); }

void WalkCoverage::reset(bool under_way, bool waiting) {
  hit(fmt::format("reset, triangle {}under way", kNoYes[under_way ? 0 : 1]));
  if (waiting) {
    hit("reset in a wait");
  }
}

std::vector<std::string> WalkCoverage::missed() const {
  std::vector<std::string> names;
  for (const auto& [name, hits] : bins_) {
    if (hits == 0) {
      names.push_back(name);
    }
  }
  return names;
}

void WalkCoverage::hit(const std::string& name) {
  const auto bin = bins_.find(name);
  if (bin != bins_.end()) {
    ++bin->second;
  }
}

void WalkCoverage::hit_decision(StepKind kind, std::size_t edge, std::size_t direction) {
  std::uint64_t* const bin = decisions_[static_cast<std::size_t>(kind)][edge][direction];
  if (bin != nullptr) {
    ++*bin;
  }
}

bool WalkCoverage::possible(StepKind kind) const {
  switch (kind) {
    case StepKind::kBlockReject:
      return parameters_.block_level && parameters_.trivial_reject;
    case StepKind::kBlockAccept:
    case StepKind::kTileByBlock:
      return parameters_.block_level && parameters_.trivial_accept;
    case StepKind::kBlockPartial:
      return parameters_.block_level;
    case StepKind::kTileReject:
      return parameters_.trivial_reject;
    case StepKind::kTileAccept:
      return parameters_.trivial_accept;
    case StepKind::kTilePartial:
      return true;
  }
  return false;
}

}  // namespace halfspace::tb
