#include "halfspace/timing/systemc/z_lookup.hpp"

#include <algorithm>
#include <utility>

#include "halfspace/machine/passage/z_lookup.hpp"
#include "halfspace/machine/tile_size.hpp"
#include "halfspace/timing/contract.hpp"

namespace halfspace::systemc {

ZLookup::ZLookup(const sc_core::sc_module_name& name, RunState& run, ZCacheState& cache)
    : sc_module(name), in("in"), run_(run), cache_(cache), meter_(Stage::kZLookup, run) {
  SC_THREAD(look_up_bursts);
}

void ZLookup::begin_frame() { next_ = 0; }

void ZLookup::look_up_bursts() {
  run_.guard([&] {
    for (;;) {
      const Cycle at = meter_.wait_to_begin(*in.operator->(), next_, stall::kLookupPendingFull,
                                            [this] { return cache_.pending.credit(1); });
      const int width = run_.config.quad_generator.quads_per_cycle;
      next_ = at + static_cast<Cycle>(beats(in->front().burst.quads, width));
      looked_up_.burst = in->take(next_ - 1);
      looked_up_.draw = looked_up_.burst.draw;
      run_.record(&PacketTimes::f, at);
      cache_.pending.use_credit();
      meter_.busy(next_);
      look_up(at);
      cache_.pending.put(std::move(looked_up_), at);
      looked_up_ = {};
    }
  });
}

/// Of a burst that was taken in cycle `at`; asks memory for what is missing.
void ZLookup::look_up(Cycle at) {
  PendingToken& token = looked_up_;
  const Coverage& coverage = token.burst.burst.packet.coverage;
  const int parts = run_.config.z_cache.parts;
  token.touched = with_tile_size(run_.config.tile_walker.tile_size, [&](auto size) {
    return passage::touched_parts<size()>(coverage, *token.draw, parts);
  });
  token.sure = with_tile_size(run_.config.tile_walker.tile_size,
                              [&](auto size) { return sure_parts<size()>(coverage, parts); });
  for (int part = 0; part < parts; ++part) {
    if ((token.touched >> part & 1) == 0) {
      continue;
    }
    const std::uint32_t line = cache_.line_of(token, part);
    const ZTags::Lookup found = cache_.tags.lookup(coverage.tile_x, coverage.tile_y, part, line);
    token.slot[static_cast<std::size_t>(part)] = found.slot;
    if (!found.hit) {
      token.missed |= static_cast<std::uint8_t>(1u << part);
      const std::uint32_t victim = std::exchange(cache_.line_of_slot[found.slot], line);
      if (victim != kNoZLine) {
        cache_.exits[victim] = {.looked_up = true, .write = 0, .left = 0};
      }
    }
  }
  Cycle last = at;
  for (int part = 0; part < parts; ++part) {
    if ((token.missed >> part & 1) == 0) {
      continue;
    }
    const bool more = token.missed >> part != 1;
    last = resolve(part, last + 1);
    meter_.stalled(stall::kLookupRequest, more ? last + 1 : last);
  }
  next_ = std::max(next_, last);
}

/// A missing part, in cycle `earliest` or later: asks memory for it, unless it is only marked cleared or the
/// burst overwrites it whole.
/// Returns the cycle.
Cycle ZLookup::resolve(int part, Cycle earliest) {
  const std::uint32_t line = cache_.line_of(looked_up_, part);
  const ZCacheState::Exit& exit = cache_.exits[line];
  // Where an earlier burst replaced the line, only the test of that burst can say whether it was dirty, and
  // so is stored in memory.
  meter_.waits_for(stall::kLookupWriteBack);
  while (exit.looked_up) {
    run_.clock.wait_for(cache_.exit_changed);
  }
  const bool fetch = (looked_up_.sure >> part & 1) == 0 && !cache_.lines.cleared(line);
  while (exit.write > cache_.writes_done) {
    run_.clock.wait_for(cache_.exit_changed);
  }
  const Cycle left = exit.left;
  meter_.stalled(stall::kLookupWriteBack, left);
  meter_.waits_for(stall::kLookupFillBuffers);
  const Cycle buffer = fetch ? cache_.fill_buffers.credit(1) : 0;
  meter_.stalled(stall::kLookupFillBuffers, buffer);
  const Cycle at = std::max({earliest, buffer, left});
  run_.clock.wait_until(at);

  const Cycle there = fetch ? request(line) : at;
  looked_up_.fetched |= static_cast<std::uint8_t>((fetch ? 1u : 0u) << part);
  looked_up_.there = std::max(looked_up_.there, there + 1);
  return at;
}

/// Asks memory for a line, in this cycle. Returns the one in which all of it is there.
Cycle ZLookup::request(std::uint32_t line) {
  cache_.fill_buffers.use_credit();
  bytes_.resize(cache_.stored_bytes(line));
  sc_core::sc_time delay;
  cache_.memory.access(tlm::TLM_READ_COMMAND, line, bytes_, delay);
  const Cycle filled = run_.clock.after(delay);
  cache_.count_transfer(&CycleStats::read_busy, cache_.stored_bytes(line), run_.config.memory.read_bytes,
                        looked_up_.draw);
  FillToken fill{.draw = looked_up_.draw, .codes = {}};
  cache_.unpack(line, bytes_, fill.codes);
  const Cycle decoded = filled + static_cast<Cycle>(decode_cycles(run_.config));
  cache_.fill_buffers.put(std::move(fill), decoded);
  return decoded;
}

}  // namespace halfspace::systemc
