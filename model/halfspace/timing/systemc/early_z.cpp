#include "halfspace/timing/systemc/early_z.hpp"

#include <algorithm>

#include "halfspace/timing/contract.hpp"
#include "halfspace/timing/tally.hpp"

namespace halfspace::systemc {

EarlyZ::EarlyZ(const sc_core::sc_module_name& name, RunState& run, std::uint64_t base)
    : sc_module(name),
      in("in"),
      out("out"),
      memory("memory"),
      run_(run),
      base_(base),
      lookup_meter_(Stage::kZLookup, run),
      test_meter_(Stage::kEarlyZ, run),
      pending_("early_z_pending", run,
               {.capacity = run.config.early_z.pending,
                .latency = kLookupLatency,
                .statistics = Link::kEarlyZPending,
                .stalls = {}}),
      fills_("fill_buffers", run,
             {.capacity = run.config.z_cache.misses_in_flight, .latency = 1, .statistics = {}, .stalls = {}}),
      writes_("write_buffer", run,
              {.capacity = run.config.z_cache.write_buffers, .latency = 1, .statistics = {}, .stalls = {}}) {
  SC_THREAD(look_up_bursts);
  SC_THREAD(test_bursts);
  set_stack_size(kStackBytes);
  SC_THREAD(write_back);
}

void EarlyZ::begin_frame() {
  const ZCacheShape shape = z_cache_shape(run_.config);
  const std::uint32_t lines = memory_lines(run_.places, shape);
  const auto slots = static_cast<std::size_t>(shape.lines);
  layout_ = DepthLayout(run_.result.surfaces, run_.places, shape.parts, base_);
  tags_ = ZTags(shape);
  line_of_slot_.assign(slots, kNoZLine);
  next_lookup_ = 0;
  lines_ = ZLines(shape, lines);
  codes_.assign(slots, {});
  clear_code_.assign(run_.places.size(), 0);
  next_test_ = 0;
  exits_.assign(lines, {});
  writes_sent_ = 0;
  writes_done_ = 0;
  next_write_ = 0;
  for (std::uint32_t line = 0; line < lines; ++line) {
    const std::uint32_t code = clear_code(run_.result.surfaces[layout_.surface(line)].format, 1);
    layout_.pack(line, std::vector<std::uint32_t>(layout_.samples(line), code), write_bytes_);
    access_in_no_time(tlm::TLM_WRITE_COMMAND, line, write_bytes_);
  }
}

std::uint32_t EarlyZ::line_of(const PendingToken& token, int part) const {
  const Coverage& coverage = token.burst.burst.coverage;
  return run_.places[token.work->surface].line(coverage.tile_x, coverage.tile_y, run_.config.z_cache.parts,
                                               part);
}

// Lookup.

void EarlyZ::look_up_bursts() {
  run_.guard([&] {
    for (;;) {
      lookup_meter_.waits_for(stall::kNoInput);
      const Cycle visible = in->visible();
      lookup_meter_.work_on(in->front().work);
      lookup_meter_.stalled(stall::kNoInput, visible);
      lookup_meter_.waits_for(stall::kLookupPendingFull);
      const Cycle at = std::max({visible, next_lookup_, pending_.credit(1)});
      lookup_meter_.stalled(stall::kLookupPendingFull, at);
      run_.clock.wait_until(at);

      const auto width =
          static_cast<Cycle>(beats(in->front().quads, run_.config.quad_generator.quads_per_cycle));
      next_lookup_ = at + width;
      looked_up_.burst = in->take(next_lookup_ - 1);
      looked_up_.work = looked_up_.burst.work;
      run_.record(&PacketTimes::f, at);
      pending_.use_credit();
      lookup_meter_.busy(next_lookup_);
      if (touches_depth(looked_up_.work->early_z)) {
        look_up(at);
      }
      pending_.put(std::move(looked_up_), at);
      looked_up_ = {};
    }
  });
}

/// Of a burst that was taken in cycle `at`; asks memory for what is missing.
void EarlyZ::look_up(Cycle at) {
  PendingToken& token = looked_up_;
  const Coverage& coverage = token.burst.burst.coverage;
  const int parts = run_.config.z_cache.parts;
  token.touched = with_tile_size(run_.config.tile_walker.tile_size,
                                 [&](auto size) { return parts_of_mask<size()>(coverage.mask, parts); });
  for (int part = 0; part < parts; ++part) {
    if ((token.touched >> part & 1) == 0) {
      continue;
    }
    const std::uint32_t line = line_of(token, part);
    const ZTags::Lookup found = tags_.lookup(coverage.tile_x, coverage.tile_y, part, line);
    token.slot[static_cast<std::size_t>(part)] = found.slot;
    if (!found.hit) {
      token.missed |= static_cast<std::uint8_t>(1u << part);
      const std::uint32_t victim = std::exchange(line_of_slot_[found.slot], line);
      if (victim != kNoZLine) {
        exits_[victim] = {.looked_up = true, .write = 0, .left = 0};
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
    lookup_meter_.stalled(stall::kLookupRequest, more ? last + 1 : last);
  }
  next_lookup_ = std::max(next_lookup_, last);
}

/// A missing part, in cycle `earliest` or later: asks memory for it, unless it is only marked cleared.
/// Returns the cycle.
Cycle EarlyZ::resolve(int part, Cycle earliest) {
  const std::uint32_t line = line_of(looked_up_, part);
  // Where an earlier burst replaced the line, only the test of that burst can say whether it was dirty, and
  // so is stored in memory.
  lookup_meter_.waits_for(stall::kLookupWriteBack);
  while (exits_[line].looked_up) {
    wait(exit_changed_);
  }
  const bool fetch = !lines_.cleared(line);
  while (exits_[line].write > writes_done_) {
    wait(exit_changed_);
  }
  const Cycle left = exits_[line].left;
  lookup_meter_.stalled(stall::kLookupWriteBack, left);
  lookup_meter_.waits_for(stall::kLookupFillBuffers);
  const Cycle buffer = fetch ? fills_.credit(1) : 0;
  lookup_meter_.stalled(stall::kLookupFillBuffers, buffer);
  const Cycle at = std::max({earliest, buffer, left});
  run_.clock.wait_until(at);

  const Cycle there = fetch ? request(line) : at;
  looked_up_.fetched |= static_cast<std::uint8_t>((fetch ? 1u : 0u) << part);
  looked_up_.there = std::max(looked_up_.there, there + 1);
  return at;
}

/// Asks memory for a line, in this cycle. Returns the one in which the last of it comes.
Cycle EarlyZ::request(std::uint32_t line) {
  fills_.use_credit();
  read_bytes_.resize(layout_.line_bytes(line));
  sc_core::sc_time delay;
  access(tlm::TLM_READ_COMMAND, line, read_bytes_, delay);
  const Cycle filled = run_.clock.after(delay);
  count_transfer(&CycleStats::read_busy, line, run_.config.memory.read_bytes, looked_up_.work);
  FillToken fill{.work = looked_up_.work, .codes = {}};
  layout_.unpack(line, read_bytes_, fill.codes);
  fills_.put(std::move(fill), filled);
  return filled;
}

// Test.

void EarlyZ::test_bursts() {
  run_.guard([&] {
    for (;;) {
      test_meter_.waits_for(stall::kNoInput);
      const Cycle visible = pending_.visible();
      const PendingToken& head = pending_.front();
      test_meter_.work_on(head.work);
      test_meter_.stalled(stall::kNoInput, visible);
      test_meter_.stalled(stall::kTestFill, head.there);
      const int dirty = replace_lines(head);
      test_meter_.waits_for(stall::kTestWriteBuffer);
      const Cycle slots = dirty != 0 ? writes_.credit(dirty) : 0;
      test_meter_.stalled(stall::kTestWriteBuffer, slots);
      test_meter_.waits_for(stall::kTestNoCredit);
      const Cycle at = std::max({visible, next_test_, head.there, slots, out->credit()});
      test_meter_.stalled(stall::kTestNoCredit, at);
      run_.clock.wait_until(at);

      next_test_ = at + static_cast<Cycle>(beats(head.burst.quads, run_.config.early_z.quads_per_cycle));
      PendingToken token = pending_.take(next_test_ - 1);
      run_.record(&PacketTimes::b, at);
      test_meter_.busy(next_test_);
      move_lines(token, at);
      TestedToken tested;
      with_tile_size(run_.config.tile_walker.tile_size, [&](auto size) { test<size()>(token, tested); });
      out->use_credit();
      out->put(std::move(tested), at);
    }
  });
}

/// Gives the slots of the missing parts to their lines, and returns how many dirty ones have to leave. The
/// lookup learns of it only when the data moves.
int EarlyZ::replace_lines(const PendingToken& token) {
  int dirty = 0;
  for (int part = 0; part < run_.config.z_cache.parts; ++part) {
    if ((token.missed >> part & 1) != 0) {
      const auto i = static_cast<std::size_t>(part);
      const std::uint32_t line = line_of(token, part);
      victims_[i] = lines_.replace(token.slot[i], line, layout_.line_bytes(line));
      dirty += victims_[i].dirty ? 1 : 0;
    }
  }
  return dirty;
}

void EarlyZ::move_lines(const PendingToken& token, Cycle at) {
  if (token.touched == 0) {
    return;
  }
  ZMisses misses;
  for (int part = 0; part < run_.config.z_cache.parts; ++part) {
    if ((token.missed >> part & 1) == 0) {
      continue;
    }
    const auto i = static_cast<std::size_t>(part);
    const std::uint32_t line = line_of(token, part);
    const ZLines::Victim& victim = victims_[i];
    take_victim(victim, token.slot[i], token.work, at);
    const bool fetched = (token.fetched >> part & 1) != 0;
    if (fetched) {
      codes_[token.slot[i]] = fills_.take(at).codes;
    } else {
      codes_[token.slot[i]].assign(layout_.samples(line), clear_code_[token.work->surface]);
    }
    misses.part[misses.count++] = {.line = line,
                                   .victim = victim.line,
                                   .bytes = static_cast<std::uint16_t>(layout_.line_bytes(line)),
                                   .victim_bytes = static_cast<std::uint16_t>(victim.bytes),
                                   .fetch = fetched,
                                   .write_back = victim.dirty};
  }
  tally(token.work->counters.early_z, std::popcount(token.touched), misses);
}

void EarlyZ::take_victim(const ZLines::Victim& victim, std::uint32_t slot, DrawWork* work, Cycle at) {
  if (victim.line == kNoZLine) {
    return;
  }
  Exit& exit = exits_[victim.line];
  exit.looked_up = false;
  if (victim.dirty) {
    send(work, victim.line, codes_[slot], at);
    exit.write = writes_sent_;
  } else {
    exit.left = at + 1;
  }
  exit_changed_.notify();
}

template <int TileSize>
void EarlyZ::test(PendingToken& token, TestedToken& tested) {
  DrawWork& work = *token.work;
  const QuadBurst& burst = token.burst.burst;
  const SetupTriangle& triangle = *token.burst.triangle;
  const int parts = run_.config.z_cache.parts;
  const std::size_t samples = static_cast<std::size_t>(TileSize * TileSize / parts);
  TileCodes<TileSize> stored{};
  TileCodes<TileSize> codes{};
  const auto for_each_touched = [&](auto&& visit) {
    for (std::size_t part = 0; part < static_cast<std::size_t>(parts); ++part) {
      if ((token.touched >> part & 1) != 0) {
        visit(part, codes_[token.slot[part]].begin(),
              stored.begin() + static_cast<std::ptrdiff_t>(part * samples));
      }
    }
  };
  for_each_touched([&](std::size_t, auto line, auto tile) { std::copy_n(line, samples, tile); });
  tested.passed = halfspace::early_z<TileSize>(triangle, burst, work.early_z, stored.data(), codes);
  if (work.early_z.write) {
    const std::uint8_t written = parts_of_mask<TileSize>(tested.passed, parts);
    for_each_touched([&](std::size_t part, auto line, auto tile) {
      if ((written >> part & 1) != 0) {
        std::copy_n(tile, samples, line);
        lines_.mark_written(token.slot[part]);
      }
    });
  }
  tally(work.counters.early_z, work.early_z, static_cast<std::uint64_t>(popcount(burst.coverage.mask)),
        static_cast<std::uint64_t>(popcount(tested.passed)));
  if (work.record_quads && work.surface != kNoSurface) {
    if (!work.early_z.test) {
      interpolate_tile<TileSize>(triangle, burst, work.early_z, codes);
    }
    tested.codes.assign(codes.begin(), codes.end());
  }
  tested.work = token.work;
  tested.triangle = std::move(token.burst.triangle);
  tested.burst = burst;
  tested.quads = token.burst.quads;
}

// Write-back.

/// Puts a line into the write buffer in cycle `at`.
void EarlyZ::send(DrawWork* work, std::uint32_t line, const std::vector<std::uint32_t>& codes, Cycle at) {
  ++writes_sent_;
  writes_.use_credit();
  writes_.put({.work = work, .line = line, .number = writes_sent_, .codes = codes}, at);
  count_transfer(&CycleStats::write_busy, line, run_.config.memory.write_bytes, work);
}

void EarlyZ::write_back() {
  run_.guard([&] {
    for (;;) {
      const Cycle at = std::max(writes_.visible(), next_write_);
      run_.clock.wait_until(at);
      const std::uint32_t line = writes_.front().line;
      layout_.pack(line, writes_.front().codes, write_bytes_);
      sc_core::sc_time delay;
      access(tlm::TLM_WRITE_COMMAND, line, write_bytes_, delay);
      const Cycle written = run_.clock.after(delay);
      run_.clock.wait_until(written);

      writing_ = writes_.take(written);
      writes_done_ = writing_.number;
      next_write_ = written + 1;
      if (exits_[line].write == writing_.number) {
        exits_[line].left = written + 1;
      }
      exit_changed_.notify();
    }
  });
}

Cycle EarlyZ::flush(Cycle begin) {
  Cycle next = begin;
  std::uint32_t next_slot = 0;
  lines_.flush([&](std::uint32_t slot, std::uint32_t line, std::uint32_t bytes) {
    const Cycle at = std::max(next + (slot - next_slot), writes_.credit(1));
    run_.clock.wait_until(at);
    send(nullptr, line, codes_[slot], at);
    next = at + 1;
    next_slot = slot + 1;
    ++run_.result.flushed_lines;
    run_.result.flushed_bytes += bytes;
  });
  const Cycle scanned = next + (static_cast<std::uint32_t>(run_.config.z_cache.lines) - next_slot);
  return std::max(scanned, wait_until_written()) - 1;
}

Cycle EarlyZ::wait_until_written() {
  while (writes_done_ != writes_sent_) {
    wait(exit_changed_);
  }
  return next_write_;
}

void EarlyZ::clear(std::uint32_t surface, std::uint32_t code) {
  const auto parts = static_cast<std::uint32_t>(run_.config.z_cache.parts);
  const std::uint32_t first = run_.places[surface].first_tile * parts;
  const std::uint32_t last = first + run_.places[surface].tiles * parts - 1;
  tags_.drop(first, last);
  for (std::uint32_t& line : line_of_slot_) {
    line = line >= first && line <= last ? kNoZLine : line;
  }
  lines_.clear(first, last);
  clear_code_[surface] = code;
}

// Memory.

void EarlyZ::access(tlm::tlm_command command, std::uint32_t line, std::vector<std::uint8_t>& bytes,
                    sc_core::sc_time& delay) {
  tlm::tlm_generic_payload payload;
  payload.set_command(command);
  payload.set_address(layout_.address(line));
  payload.set_data_ptr(bytes.data());
  payload.set_data_length(static_cast<unsigned>(bytes.size()));
  payload.set_streaming_width(static_cast<unsigned>(bytes.size()));
  memory->b_transport(payload, delay);
  if (payload.is_response_error()) {
    throw std::runtime_error("memory: " + payload.get_response_string() + " for the line at address " +
                             std::to_string(layout_.address(line)));
  }
}

void EarlyZ::access_in_no_time(tlm::tlm_command command, std::uint32_t line,
                               std::vector<std::uint8_t>& bytes) {
  tlm::tlm_generic_payload payload;
  payload.set_command(command);
  payload.set_address(layout_.address(line));
  payload.set_data_ptr(bytes.data());
  payload.set_data_length(static_cast<unsigned>(bytes.size()));
  payload.set_streaming_width(static_cast<unsigned>(bytes.size()));
  if (memory->transport_dbg(payload) != bytes.size()) {
    throw std::runtime_error("memory: no line at address " + std::to_string(layout_.address(line)));
  }
}

void EarlyZ::count_transfer(std::uint64_t CycleStats::*channel, std::uint32_t line, int width,
                            DrawWork* work) {
  const auto cycles =
      static_cast<std::uint64_t>(transfer_cycles(static_cast<int>(layout_.line_bytes(line)), width));
  run_.cycles.stats.*channel += cycles;
  if (CycleStats* const of_draw = work != nullptr ? work->stats() : nullptr) {
    of_draw->*channel += cycles;
  }
}

void EarlyZ::read_surface(std::uint32_t surface, TiledImage<std::uint32_t>& codes) {
  const ZSurface& place = run_.places[surface];
  const int parts = run_.config.z_cache.parts;
  std::vector<std::uint32_t> line_codes;
  for (std::uint32_t tile = 0; tile < place.tiles; ++tile) {
    const std::uint32_t x = tile % place.tiles_x;
    const std::uint32_t y = tile / place.tiles_x;
    std::uint32_t* to = codes.tile(static_cast<int>(x), static_cast<int>(y));
    for (int part = 0; part < parts; ++part) {
      const std::uint32_t line = place.line(x, y, parts, part);
      if (lines_.cleared(line)) {
        to = std::fill_n(to, layout_.samples(line), clear_code_[surface]);
      } else {
        read_bytes_.resize(layout_.line_bytes(line));
        access_in_no_time(tlm::TLM_READ_COMMAND, line, read_bytes_);
        layout_.unpack(line, read_bytes_, line_codes);
        to = std::copy(line_codes.begin(), line_codes.end(), to);
      }
    }
  }
}

}  // namespace halfspace::systemc
