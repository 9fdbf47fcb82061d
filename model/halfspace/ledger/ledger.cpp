#include "halfspace/ledger/ledger.hpp"

#include <fmt/format.h>

#include <utility>

#include <optional>

#include "halfspace/core/functional.hpp"
#include "halfspace/ledger/fates.hpp"
#include "halfspace/machine/draw_state.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/scene/front_end.hpp"

namespace halfspace::ledger {
namespace {

/// What the front end makes of the triangles of a draw; those that go on are counted behind it.
void account_front_end(TriangleAccount& account, const Frame& frame, const Command& draw, DepthFormat format,
                       const Config& config) {
  const std::uint32_t triangles = draw.primitive_count();
  account.all = triangles;
  if (draw.is_skipped()) {
    account.not_filled = triangles;
    return;
  }
  const FrontEnd front_end(frame, draw, format, config.raster.sub_pixel_bits, fill_rule(draw, config),
                           square_reach(draw, config));
  FrontEndCounters counters;
  std::vector<ScreenTriangle> pieces;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const std::uint64_t dropped = counters.non_finite + counters.clipped_away + counters.degenerate;
    pieces.clear();
    front_end.process(i, pieces, counters);
    const bool kept = dropped == counters.non_finite + counters.clipped_away + counters.degenerate;
    account.no_piece += kept && pieces.empty() ? 1 : 0;
  }
  account.non_finite = counters.non_finite;
  account.clipped_away = counters.clipped_away;
  account.degenerate = counters.degenerate;
}

/// What a draw, or all clears of a surface, moved between the z cache and memory; `plain` counts the same on
/// a machine that does not compress.
void account_traffic(Accounts& accounts, const EarlyZCounters& counted, const EarlyZCounters& plain,
                     std::uint64_t line_bytes) {
  accounts.lines.hit += counted.z_hits;
  accounts.lines.overwritten += counted.z_overwritten;
  accounts.lines.cleared += counted.z_cleared;
  accounts.lines.fetched += counted.z_misses - counted.z_overwritten - counted.z_cleared;
  accounts.read.all += counted.z_misses * line_bytes;
  accounts.read.overwritten += counted.z_overwritten * line_bytes;
  accounts.read.cleared += counted.z_cleared * line_bytes;
  accounts.read.compressed += plain.bytes_read - counted.bytes_read;
  accounts.read.fetched += counted.bytes_read;
  accounts.write_backs.all += plain.z_evicted;
  accounts.write_backs.evicted += counted.z_evicted;
  accounts.written.all += plain.bytes_written;
  accounts.written.compressed += plain.bytes_written - counted.bytes_written;
  accounts.written.evicted += counted.bytes_written;
}

void account_flush(Accounts& accounts, const FrameResult& counted, const FrameResult& plain) {
  accounts.write_backs.all = plain.flushed_lines;
  accounts.write_backs.flushed = counted.flushed_lines;
  accounts.written.all = plain.flushed_bytes;
  accounts.written.compressed = plain.flushed_bytes - counted.flushed_bytes;
  accounts.written.flushed = counted.flushed_bytes;
}

/// The run that is watched, and the accounts of its draws.
std::vector<Accounts> follow(const Frame& frame, const Config& config) {
  Fates fates(frame, config);
  run_functional(frame, config, {.count_pixels = false, .observer = &fates, .core = Core::kReadable});
  return fates.finish();
}

/// The counts of the same frame with all lines uncompressed, where the machine compresses.
std::optional<FrameResult> run_plain(const Frame& frame, Config config) {
  if (!config.z_cache.compression) {
    return std::nullopt;
  }
  config.z_cache.compression = false;
  return run_functional(frame, config, {.count_pixels = false});
}

/// Compares pairs of numbers of a draw or a frame.
class Comparison {
 public:
  explicit Comparison(std::string whose) : whose_(std::move(whose)) {}

  void operator()(std::string_view what, std::uint64_t ours, std::string_view other_what,
                  std::uint64_t other) {
    ++count_;
    if (ours != other) {
      throw LedgerError(fmt::format("the ledger of {} does not add up: {} is {}, {} {}", whose_, what, ours,
                                    other_what, other));
    }
  }
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  std::string whose_;
  std::uint64_t count_ = 0;
};

std::uint64_t check_sums(const Accounts& accounts, const std::string& whose) {
  Comparison equal(whose);
  Accounts::each([&](const char* name, auto account) {
    equal(fmt::format("{}.all", name), (accounts.*account).all, "the sum of its causes",
          explained(accounts.*account));
  });
  return equal.count();
}

std::uint64_t check_counters(const Accounts& a, const Counters& c, const std::string& whose) {
  Comparison equal(whose);
  const std::uint64_t late = a.fragments.late;
  equal("triangles.all - triangles.not_filled", a.triangles.all - a.triangles.not_filled,
        "front_end.triangles", c.front_end.triangles);
  equal("triangles.non_finite", a.triangles.non_finite, "front_end.non_finite", c.front_end.non_finite);
  equal("triangles.clipped_away", a.triangles.clipped_away, "front_end.clipped_away",
        c.front_end.clipped_away);
  equal("triangles.degenerate", a.triangles.degenerate, "front_end.degenerate", c.front_end.degenerate);
  equal("pieces.all", a.pieces.all, "front_end.emitted", c.front_end.emitted);
  equal("pieces.all", a.pieces.all, "setup.triangles", c.setup.triangles);
  equal("pieces.zero_area", a.pieces.zero_area, "setup.zero_area", c.setup.zero_area);
  equal("pieces.culled", a.pieces.culled, "setup.culled", c.setup.culled);
  equal("pieces.no_sample", a.pieces.no_sample, "setup.no_sample", c.setup.no_sample);
  equal("pieces.outside", a.pieces.outside, "setup.outside", c.setup.outside);
  equal("blocks.all", a.blocks.all, "block_walker.blocks", c.block_walker.blocks);
  equal("blocks.edges", a.blocks.edges, "block_walker.blocks_empty", c.block_walker.blocks_empty);
  equal("blocks.hi_z", a.blocks.hi_z, "hi_z.blocks_rejected", c.hi_z.blocks_rejected);
  equal("tiles.edges_block + tiles.edges_tile", a.tiles.edges_block + a.tiles.edges_tile,
        "block_walker.tiles_rejected", c.block_walker.tiles_rejected);
  equal("tiles.hi_z_block + tiles.hi_z_tile", a.tiles.hi_z_block + a.tiles.hi_z_tile, "hi_z.tiles_rejected",
        c.hi_z.tiles_rejected);
  equal("tiles.empty", a.tiles.empty, "edge_evaluator.tiles_empty", c.edge_evaluator.tiles_empty);
  equal("tiles.early_z", a.tiles.early_z, "early_z.tiles_killed", c.early_z.tiles_killed);
  equal("tiles.early_z + tiles.late + tiles.survive", a.tiles.early_z + a.tiles.late + a.tiles.survive,
        "quad_generator.tiles", c.quad_generator.tiles);
  equal("quads.early_z + quads.late + quads.survive", a.quads.early_z + a.quads.late + a.quads.survive,
        "quad_generator.quads", c.quad_generator.quads);
  equal("fragments.early_z + fragments.late + fragments.survive",
        a.fragments.early_z + late + a.fragments.survive, "quad_generator.fragments",
        c.quad_generator.fragments);
  equal("fragments.late + fragments.survive", late + a.fragments.survive, "early_z.survivors",
        c.early_z.survivors);
  equal("fragments.late", late, "early_z.discarded", c.early_z.discarded);
  equal("lines.all", a.lines.all, "early_z.z_hits + early_z.z_misses", c.early_z.z_hits + c.early_z.z_misses);
  equal("read.fetched", a.read.fetched, "early_z.bytes_read", c.early_z.bytes_read);
  equal("write_backs.evicted", a.write_backs.evicted, "early_z.z_evicted", c.early_z.z_evicted);
  equal("written.evicted", a.written.evicted, "early_z.bytes_written", c.early_z.bytes_written);
  return equal.count();
}

}  // namespace

std::uint64_t check_sums(const Ledger& ledger) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < ledger.draws.size(); ++i) {
    count += check_sums(ledger.draws[i].accounts, fmt::format("draw {}", i));
  }
  return count + check_sums(ledger.clears, "the clears") + check_sums(ledger.frame, "the frame");
}

std::uint64_t check_counters(const Ledger& ledger, const FrameResult& counted) {
  std::uint64_t count = 0;
  Comparison frame("the frame");
  frame("draws", ledger.draws.size(), "draws counted", counted.draws.size());
  for (std::size_t i = 0; i < ledger.draws.size(); ++i) {
    count += check_counters(ledger.draws[i].accounts, counted.draws[i].counters, fmt::format("draw {}", i));
  }
  frame("read.fetched", ledger.frame.read.fetched, "bytes read",
        counted.counters.early_z.bytes_read + counted.drawn_clears.early_z.bytes_read);
  frame("written.evicted + written.flushed", ledger.frame.written.evicted + ledger.frame.written.flushed,
        "bytes written",
        counted.counters.early_z.bytes_written + counted.drawn_clears.early_z.bytes_written +
            counted.flushed_bytes);
  frame("write_backs.flushed", ledger.frame.write_backs.flushed, "flushed lines", counted.flushed_lines);
  return count + frame.count();
}

void check_machine(const Config& config) {
  const auto& walker = config.block_walker;
  if (walker.levels != 2) {
    throw OptionError(
        fmt::format("configuration key 'block_walker.levels' is {}; legal for a ledger: 2", walker.levels));
  }
  if (is_led(walker.order)) {
    throw OptionError(
        fmt::format("configuration key 'block_walker.order' is {}; legal for a ledger: raster, "
                    "boustrophedonic, morton, hilbert",
                    walker.order == WalkOrder::kZigzag ? "zigzag" : "backtracking"));
  }
}

Ledger make_ledger(const Frame& frame, const Config& config, const FrameResult& counted) {
  check_machine(config);
  const std::vector<Accounts> fates = follow(frame, config);
  const std::optional<FrameResult> uncompressed = run_plain(frame, config);
  const FrameResult& plain = uncompressed ? *uncompressed : counted;
  const std::vector<ZSurface> places = place_surfaces(counted.surfaces, config);
  Ledger ledger;
  for (std::size_t i = 0; i < fates.size(); ++i) {
    const DrawStats& draw = counted.draws.at(i);
    DrawLedger& line = ledger.draws.emplace_back(
        DrawLedger{.command = draw.command, .surface = draw.surface, .accounts = fates[i]});
    const bool has_depth = draw.surface != kNoSurface;
    account_front_end(line.accounts.triangles, frame, frame.commands[draw.command],
                      has_depth ? counted.surfaces[draw.surface].format : DepthFormat::kNone, config);
    account_traffic(line.accounts, draw.counters.early_z, plain.draws.at(i).counters.early_z,
                    has_depth ? places[draw.surface].line_bytes : 0);
    ledger.frame += line.accounts;
  }
  for (std::size_t s = 0; s < places.size(); ++s) {
    const EarlyZCounters& clears = counted.surfaces[s].drawn_clears.early_z;
    ledger.clears.lines.all += clears.z_hits + clears.z_misses;
    account_traffic(ledger.clears, clears, plain.surfaces[s].drawn_clears.early_z, places[s].line_bytes);
  }
  account_flush(ledger.flush, counted, plain);
  ledger.frame += ledger.clears;
  ledger.frame += ledger.flush;
  ledger.numbers = check_sums(ledger) + check_counters(ledger, counted);
  return ledger;
}

}  // namespace halfspace::ledger
