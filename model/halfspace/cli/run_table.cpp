#include "halfspace/cli/run_table.hpp"
#include "halfspace/cli/percent.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "halfspace/machine/surfaces.hpp"
#include "halfspace/report/stats.hpp"

namespace halfspace {
namespace {

void row(std::string_view unit, std::uint64_t value, const std::string& what) {
  fmt::print("  {:<16}{:>12}  {}\n", unit, value, what);
}

/// Where the cycles went: each stage's two largest reasons to wait, memory.
void print_cycles(const FrameResult& result, const FrameCycles& frame) {
  const auto share = [&frame](std::uint64_t cycles) {
    return fmt::format("{:.1f}%", percent(cycles, frame.cycles));
  };
  for (std::size_t i = 0; i < kStages; ++i) {
    const StageCycles& cycles = frame.stats.stage[i];
    std::array<std::size_t, kMostStallReasons> reasons{0, 1, 2, 3, 4};
    std::partial_sort(reasons.begin(), reasons.begin() + 2, reasons.end(),
                      [&](std::size_t l, std::size_t r) { return cycles.stall[l] > cycles.stall[r]; });
    std::string text = "busy";
    for (const std::size_t reason : {reasons[0], reasons[1]}) {
      if (cycles.stall[reason] != 0) {
        text += fmt::format(", {} {}", kStageInfo[i].stall[reason], share(cycles.stall[reason]));
      }
    }
    fmt::print("  {:<16}{:>12}  {}\n", kStageInfo[i].name, share(cycles.busy), text);
  }
  const std::uint64_t read = memory_bytes_read(result);
  const std::uint64_t written = memory_bytes_written(result);
  row("memory", read + written,
      fmt::format("bytes; {} read ({} of the cycles), {} written ({})", read, share(frame.stats.read_busy),
                  written, share(frame.stats.write_busy)));
}

void print_table(const Frame& frame, const FrameResult& result) {
  const Counters& c = result.counters;
  fmt::print("{}: {} draws on {}\n", frame.name, result.draws.size(), surfaces_text(result));
  row("front end", c.front_end.triangles,
      fmt::format("triangles; {} clipped away, {} cut, {} not finite", c.front_end.clipped_away,
                  c.front_end.clipped, c.front_end.non_finite + c.front_end.degenerate));
  row("setup", c.setup.drawn,
      fmt::format("drawn; {} face away, {} without area, {} hit no sample, {} outside", c.setup.culled,
                  c.setup.zero_area, c.setup.no_sample, c.setup.outside));
  const BlockWalkerCounters& w = c.block_walker;
  row("block_walker", w.blocks - w.blocks_empty,
      fmt::format("blocks; {} without a tile, {} tiles rejected", w.blocks_empty, w.tiles_rejected));
  row("tile_walker", c.tile_walker.tiles_accepted + c.tile_walker.tiles_partial,
      fmt::format("tiles; {} covered whole", c.tile_walker.tiles_accepted));
  row("edge_evaluator", c.edge_evaluator.tiles,
      fmt::format(
          "tiles evaluated; {} empty, {:.1f}% of edges skipped", c.edge_evaluator.tiles_empty,
          percent(c.edge_evaluator.edges_skipped, c.edge_evaluator.edges + c.edge_evaluator.edges_skipped)));
  row("quad_generator", c.quad_generator.quads,
      fmt::format("quads; {} fragments, {} helpers ({:.1f}% of lanes)", c.quad_generator.fragments,
                  c.quad_generator.helpers, percent(c.quad_generator.helpers, 4 * c.quad_generator.quads)));
  row("early_z", c.early_z.survivors,
      fmt::format("fragments survive ({:.1f}%); {} tested, {} written",
                  percent(c.early_z.survivors, c.quad_generator.fragments), c.early_z.tested,
                  c.early_z.written));
  if (c.interpolator.quads + c.interpolator.quads_killed != 0) {
    row("interpolator", c.interpolator.quads,
        fmt::format("quads ({:.1f}%); {} with an attribute each, {} helpers",
                    percent(c.interpolator.quads, c.quad_generator.quads), c.interpolator.attributes,
                    c.interpolator.helpers));
  }
  if (result.draws_not_filled != 0) {
    fmt::print("  {} draws skipped: their polygons are drawn as lines or points\n", result.draws_not_filled);
  }
}

void print_quad_merging(const QuadMergingResult& merging) {
  const QuadMergingCounters& c = merging.frame;
  const auto per_survivor = [&c](std::uint64_t fragments) { return percent(fragments, c.survivors) / 100; };
  row("quad_merging", quads_shaded(c),
      fmt::format(
          "quads shaded with {} held, not {} ({:.1f}% saved); {:.2f} fragments a survivor, not {:.2f}",
          merging.buffer, c.quads, percent(c.joined, c.quads), per_survivor(fragments_shaded(c)),
          per_survivor(fragments_unmerged(c))));
  row("  merged", c.joined,
      fmt::format("quads joined another; {} pairs, {} triples, {} of four; {} groups evicted", c.pairs,
                  c.triples, c.quadruples, c.evictions));
  row("  not merged", quads_shaded(c),
      fmt::format("quads; {} whole, {} alone, {} not adjacent, {} other facing, {} overlap, {} missed an "
                  "evicted one",
                  c.whole, c.alone, c.not_adjacent, c.other_facing, c.overlap, c.missed));
}

void print_pixel_rate(const PixelRateCounters& c) {
  row("shading", c.quads,
      fmt::format("quads once a pixel, not {} once a sample; {} pixels, {} helpers, {:.1f}% with all samples "
                  "covered",
                  c.sample_quads, c.pixels, c.helpers, percent(c.at_centre, c.pixels)));
}

/// What the scoreboard of a verilated run says. Returns whether RTL and model agree.
bool print_report(const rtl::PacketReport& report) {
  row("model", report.compared,
      report.different == 0 ? "packets, pixels and counters compared, all equal"
                            : fmt::format("packets, pixels and counters compared, {} DIFFER; first: {}",
                                          report.different, report.first));
  return report.different == 0;
}

}  // namespace

std::string surfaces_text(const FrameResult& result) {
  const std::size_t depth = depth_surfaces(result.surfaces).size();
  const std::size_t bare = result.surfaces.size() - depth;
  const std::string targets = fmt::format(" and {} target{} without depth", bare, bare == 1 ? "" : "s");
  return fmt::format("{} depth surfaces{}", depth, bare == 0 ? "" : targets);
}

bool print_result(const Frame& frame, const RunResult& result) {
  print_table(frame, result.frame);
  if (result.cycles) {
    const std::uint64_t cycles = result.cycles->cycles;
    const auto quads = static_cast<double>(result.frame.counters.quad_generator.quads);
    row("cycles", cycles, fmt::format("{:.2f} quads a cycle", quads / static_cast<double>(cycles)));
    print_cycles(result.frame, *result.cycles);
  }
  if (result.quad_merging) {
    print_quad_merging(*result.quad_merging);
  }
  if (result.pixel_rate) {
    print_pixel_rate(result.pixel_rate->frame);
  }
  return !result.rtl || print_report(*result.rtl);
}

void print_frame_time(double median, int passes, const std::string& by) {
  row("time", static_cast<std::uint64_t>(std::llround(1e6 * median)),
      fmt::format("ns a frame, the median of {} passes of {}", passes, by));
}

void print_what_if(const WhatIfReport& report) {
  for (const whatif::Applied& applied : report.applied) {
    const whatif::Acted& acted = applied.acted;
    const std::string where = acted.ranges == 0 ? "" : fmt::format(" in {} ranges", acted.ranges);
    fmt::print("  what if {}: acts on {} draws{}\n", applied.name, acted.draws, where);
  }
  fmt::print("  {:<16}{:>12}{:>13}  with / without\n", "", "without", "with");
  for (const WhatIfRow& row : rows(report)) {
    const std::optional<double> ratio = row.ratio();
    fmt::print("  {:<16}{:>12}{:>13}  {}\n", row.name, row.without, row.with,
               ratio ? fmt::format("{:.3f}", *ratio) : "-");
  }
}

}  // namespace halfspace
