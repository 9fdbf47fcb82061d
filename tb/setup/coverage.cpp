#include "coverage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "halfspace/timing/contract.hpp"
#include "halfspace/units/hi_z_plane.hpp"
#include "halfspace/units/thin_line.hpp"

namespace halfspace::tb {
namespace {

constexpr std::array<const char*, 5> kDecisions = {"dropped", "drawn", "no_triangle", "divider", "no_credit"};
constexpr std::array<const char*, 5> kFormatNames = {"none", "unorm16", "unorm24", "", "float32"};
constexpr std::array<const char*, 7> kVerdicts = {"drawn",     "zero_area", "culled_front", "culled_back",
                                                  "no_sample", "outside",   "empty"};
constexpr std::array<const char*, 2> kSpans = {"block", "blocks"};
constexpr std::array<const char*, 3> kSigns = {"negative", "zero", "positive"};
constexpr std::array<const char*, kFillRules.size()> kRules = {"top_left", "bottom_left", "top_right",
                                                               "bottom_right"};
constexpr std::array<const char*, 5> kDepths = {"equal", "first_least", "first_most", "first_middle", "ties"};

std::string verdict_bin(std::size_t verdict, std::size_t format) {
  return fmt::format("verdict {} format {}", kVerdicts[verdict], kFormatNames[format]);
}
std::string order_bin(bool turned, std::size_t first, std::size_t rule) {
  return fmt::format("turned {:d} first {} rule {}", turned, first, kRules[rule]);
}
std::string size_bin(std::size_t span, std::size_t shift, std::size_t format) {
  return fmt::format("span {} shift {} format {}", kSpans[span], kSigns[shift], kFormatNames[format]);
}
std::string edge_bin(std::size_t side, bool flat_top, std::size_t rule) {
  return fmt::format("edge0 a {} top {} rule {}", kSigns[side], flat_top ? "flat" : "pointed", kRules[rule]);
}
std::string depth_bin(std::size_t depths, std::size_t format) {
  return fmt::format("depths {} format {}", kDepths[depths], kFormatNames[format]);
}

std::string plane_bin(const char* what, std::size_t format) {
  return fmt::format("plane {} format {}", what, kFormatNames[format]);
}

std::string square_bin(std::uint8_t by_square, std::size_t format) {
  return fmt::format("by {} format {}", by_square != 0 ? "squares" : "centres", kFormatNames[format]);
}
std::string flat_bin(std::size_t first) { return fmt::format("without area, first {}", first); }
constexpr std::array<const char*, 4> kLineVerdicts = {"drawn", "no length", "no pixel", "outside"};
constexpr std::array<const char*, 3> kWidths = {"one", "even", "odd"};

std::string line_bin(std::size_t rule, const char* what) {
  return fmt::format("line {} {}", kLineRuleName[rule], what);
}
std::string direction_bin(std::size_t rule, bool x_major, bool forward, std::size_t slope) {
  return fmt::format("line {} {}-major {} slope {}", kLineRuleName[rule], x_major ? 'x' : 'y',
                     forward ? "forward" : "backward", kSigns[slope]);
}

std::size_t sign_of(std::int64_t value) { return value < 0 ? 0 : value == 0 ? 1 : 2; }

std::int64_t twice_area(const SetupJob& job) {
  const auto& x = job.triangle.x;
  const auto& y = job.triangle.y;
  return (std::int64_t{x[1]} - x[0]) * (std::int64_t{y[2]} - y[0]) -
         (std::int64_t{x[2]} - x[0]) * (std::int64_t{y[1]} - y[0]);
}

std::size_t verdict_index(const SetupJob& job, const SetupResult& result) {
  switch (result.verdict) {
    case SetupVerdict::kDrawn:
      return 0;
    case SetupVerdict::kZeroArea:
      return 1;
    case SetupVerdict::kCulled:
      return twice_area(job) != 0 && (twice_area(job) > 0) == (job.state.front_positive_area != 0) ? 2 : 3;
    case SetupVerdict::kNoSample:
      return 4;
    case SetupVerdict::kOutside:
      break;
  }
  return job.state.empty != 0 ? 6 : 5;
}

std::size_t depth_index(const std::array<std::int64_t, 3>& z) {
  if (z[0] == z[1] && z[1] == z[2]) {
    return 0;
  }
  if (z[0] == z[1] || z[1] == z[2] || z[0] == z[2]) {
    return 4;
  }
  return z[0] < z[1] && z[0] < z[2] ? 1 : z[0] > z[1] && z[0] > z[2] ? 2 : 3;
}

}  // namespace

SetupCoverage::SetupCoverage(const SetupModel& model) : interval_(model.interval), queue_(model.queue) {
  const std::array<std::size_t, 4> formats = {0, 1, 2, 4};
  for (std::size_t first = 0; model.conservative() == Conservative::kOuter && first < 3; ++first) {
    counts_[flat_bin(first)];
  }
  for (const std::size_t format : formats) {
    if (model.conservative() != Conservative::kOff) {
      counts_[square_bin(0, format)];
      counts_[square_bin(1, format)];
    }
    if (model.has_planes() && format != 0) {
      for (const char* const what : {"known", "unknown", "largest fall", "short of the largest rise"}) {
        counts_[plane_bin(what, format)];
      }
    }
    for (std::size_t verdict = 0; verdict < 7; ++verdict) {
      counts_[verdict_bin(verdict, format)];
    }
    for (std::size_t span = 0; span < kSpans.size(); ++span) {
      for (std::size_t shift = 0; shift < kSigns.size(); ++shift) {
        counts_[size_bin(span, shift, format)];
      }
    }
    for (std::size_t depths = 0; depths < kDepths.size(); ++depths) {
      counts_[depth_bin(depths, format)];
    }
  }
  for (std::size_t rule = 0; rule < kRules.size(); ++rule) {
    for (std::size_t first = 0; first < 3; ++first) {
      counts_[order_bin(false, first, rule)];
      counts_[order_bin(true, first, rule)];
    }
    for (std::size_t side = 0; side < 3; ++side) {
      counts_[edge_bin(side, false, rule)];
    }
    counts_[edge_bin(0, true, rule)];  // below a flat top edge 0 leads down to the left
  }
  if (model.thin_lines) {
    add_line_bins();
  }
}

void SetupCoverage::add_line_bins() {
  for (std::size_t rule = 1; rule < kLineRuleName.size(); ++rule) {
    for (const char* const verdict : kLineVerdicts) {
      counts_[line_bin(rule, verdict)];
    }
    for (const char* const width : kWidths) {
      counts_[line_bin(rule, width)];
    }
    for (const bool x_major : {false, true}) {
      for (const bool forward : {false, true}) {
        for (std::size_t slope = 0; slope < kSigns.size(); ++slope) {
          counts_[direction_bin(rule, x_major, forward, slope)];
        }
      }
    }
  }
}

void SetupCoverage::line(const SetupJob& job, const SetupResult& result, const SetupModel& model) {
  const std::size_t rule = job.triangle.line_rule;
  const std::size_t verdict = result.verdict == SetupVerdict::kDrawn      ? 0
                              : result.verdict == SetupVerdict::kZeroArea ? 1
                              : result.verdict == SetupVerdict::kNoSample ? 2
                                                                          : 3;
  hit(line_bin(rule, kLineVerdicts[verdict]));
  if (verdict != 0) {
    return;
  }
  const int width = job.triangle.line_width;
  hit(line_bin(rule, kWidths[width == 1 ? 0 : width % 2 == 0 ? 1 : 2]));
  const ThinLine line =
      thin_line({job.triangle.x[0], job.triangle.y[0]}, {job.triangle.x[1], job.triangle.y[1]},
                static_cast<LineRule>(rule), width, model.dut.sub_pixel_bits);
  const auto& minor = line.x_major ? job.triangle.y : job.triangle.x;
  hit(direction_bin(rule, line.x_major, line.forward, sign_of(std::int64_t{minor[1]} - minor[0])));
}

void SetupCoverage::decision(Decision decision, bool refused) {
  ++decisions_[static_cast<std::size_t>(decision)][refused ? 1 : 0];
}

void SetupCoverage::output(bool valid, bool ready, bool full) {
  ++outputs_[valid ? 1 : 0][ready ? 1 : 0][full ? 1 : 0];
}

void SetupCoverage::triangle(const SetupJob& job, const SetupResult& result, const SetupModel& model) {
  if (job.triangle.line_rule != 0) {
    line(job, result, model);
    return;
  }
  const std::size_t format = job.state.format;
  hit(verdict_bin(verdict_index(job, result), format));
  if (result.verdict != SetupVerdict::kDrawn) {
    return;
  }
  const auto& x = job.triangle.x;
  const auto& y = job.triangle.y;
  const std::int64_t area2 = twice_area(job);
  std::size_t first = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    first = std::pair(y[i], x[i]) < std::pair(y[first], x[first]) ? i : first;
  }
  hit(square_bin(job.triangle.by_square, format));
  if (area2 == 0) {
    hit(flat_bin(first));
  }
  const std::size_t rule = job.state.fill_rule;
  hit(order_bin(area2 < 0, first, rule));
  const std::array<Edge, 3>& edge = result.triangle.edge;
  hit(edge_bin(sign_of(edge[0].a), edge[2].a == 0, rule));

  const PixelRect& bounds = result.triangle.bounds;
  const int size = model.block_size;
  const bool one_block =
      bounds.x_first / size == bounds.x_last / size && bounds.y_first / size == bounds.y_last / size;
  const std::size_t span = one_block ? 0 : 1;
  const int width = std::bit_width(static_cast<std::uint64_t>(area2 < 0 ? -area2 : area2));
  hit(size_bin(span, sign_of(width - 32), format));
  hit(depth_bin(depth_index(job.triangle.z), format));
  if (format != 0) {
    constexpr std::int64_t kMost = std::int64_t{1} << (kHiZMostStep + kHiZFraction);
    const HiZPlane& plane = result.triangle.plane;
    hit(plane_bin(plane.known ? "known" : "unknown", format));
    if (std::min(plane.dx, plane.dy) == -kMost) {
      hit(plane_bin("largest fall", format));
    }
    if (std::max(plane.dx, plane.dy) >= kMost - (std::int64_t{1} << (kHiZFraction + 2))) {
      hit(plane_bin("short of the largest rise", format));
    }
  }
}

std::map<std::string, std::uint64_t> SetupCoverage::bins() const {
  std::map<std::string, std::uint64_t> bins = counts_;
  for (const std::size_t yes : {0u, 1u}) {
    for (std::size_t decision = 0; decision < kDecisions.size(); ++decision) {
      // A full queue whose cull stage does not hold all of it has a visible head, which waits. A dropped one
      // does not, and after a drawn one it takes two cycles until the queue is full again.
      const auto kind = static_cast<Decision>(decision);
      const bool refused = yes != 0;
      const bool all_in_stage = queue_ <= kSetupCullLatency;
      const bool reachable = kind == Decision::kDivider ? interval_ > (refused ? 2 : 1)
                             : kind == Decision::kNoTriangle || kind == Decision::kDropped
                                 ? !refused || all_in_stage
                                 : true;
      if (reachable) {
        bins[fmt::format("decision {} input {}", kDecisions[decision], refused ? "refused" : "open")] =
            decisions_[decision][yes];
      }
    }
    bins[fmt::format("output waits, ready {}", yes)] = outputs_[0][yes][0];
    bins[fmt::format("output valid, ready {}", yes)] = outputs_[1][yes][0];
    bins[fmt::format("output valid, fifo full, ready {}", yes)] = outputs_[1][yes][1];
  }
  return bins;
}

void SetupCoverage::hit(const std::string& bin) {
  if (const auto found = counts_.find(bin); found != counts_.end()) {
    ++found->second;
  }
}

}  // namespace halfspace::tb
