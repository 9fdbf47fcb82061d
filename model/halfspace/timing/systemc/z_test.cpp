#include "halfspace/timing/systemc/z_test.hpp"

#include <algorithm>
#include <utility>

#include "halfspace/machine/passage/hi_z.hpp"
#include "halfspace/machine/passage/z_lookup.hpp"
#include "halfspace/machine/passage/z_test.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/machine/tile_size.hpp"
#include "halfspace/timing/contract.hpp"

namespace halfspace::systemc {

ZTest::ZTest(const sc_core::sc_module_name& name, RunState& run, JobReturns& returns, ZCacheState& cache)
    : sc_module(name), out("out"), run_(run), returns_(returns), cache_(cache), meter_(Stage::kZTest, run) {
  SC_THREAD(test_bursts);
  set_stack_size(kStackBytes);
  SC_THREAD(write_back);
}

void ZTest::begin_frame() {
  next_ = 0;
  order_ = LateWrites(z_cache_shape(run_.config).late_writes);
  late_.clear();
  late_begun_ = late_next_ = 0;
  answers.begin_frame();
}

void ZTest::test_bursts() {
  run_.guard([&] {
    for (;;) {
      meter_.waits_for(stall::kNoInput);
      const Cycle visible = cache_.pending.visible();
      const PendingToken& head = cache_.pending.front();
      meter_.work_on(head.draw);
      tell_of_late();
      meter_.stalled(stall::kNoInput, visible);
      next_ = std::max(next_, visible);
      make_way(head);
      meter_.stalled(stall::kTestFill, head.there);
      const int dirty = replace_lines(head);
      meter_.waits_for(stall::kTestWriteBuffer);
      const Cycle slots = dirty != 0 ? cache_.write_buffers.credit(dirty) : 0;
      meter_.stalled(stall::kTestWriteBuffer, slots);
      meter_.waits_for(stall::kTestNoCredit);
      const Cycle at = std::max({visible, next_, head.there, slots, out->credit()});
      meter_.stalled(stall::kTestNoCredit, at);
      run_.clock.wait_until(at);

      next_ = at + static_cast<Cycle>(beats(head.burst.burst.quads, run_.config.early_z.quads_per_cycle));
      PendingToken token = cache_.pending.take(next_ - 1);
      run_.record(&PacketTimes::b, at);
      meter_.busy(next_);
      move_lines(token, at);
      out->use_credit();
      out->put(
          with_tile_size(run_.config.tile_walker.tile_size, [&](auto size) { return test<size()>(token); }),
          at);
    }
  });
}

/// Does the late writes that go before the burst.
void ZTest::make_way(const PendingToken& token) {
  ZSlots slots;
  for (int part = 0; part < run_.config.z_cache.parts; ++part) {
    if ((token.touched >> part & 1) != 0) {
      slots.add(part, token.slot[static_cast<std::size_t>(part)]);
    }
  }
  meter_.waits_for(stall::kTestLate);
  const std::uint32_t done = order_.done();
  order_.make_way(slots, token.draw->early_z.late);
  for (std::uint32_t left = order_.done() - done; left != 0; --left) {
    write_late();
  }
  meter_.stalled(stall::kTestLate, next_);
}

/// Does the oldest one.
void ZTest::write_late() {
  const LateWrite& late = late_.front();
  next_ = std::max(next_, answers.take(run_.clock)) +
          static_cast<Cycle>(beats(late.quads, run_.config.early_z.quads_per_cycle));
  with_tile_size(run_.config.tile_walker.tile_size, [&](auto size) { write<size()>(late); });
  late_.pop_front();
}

template <int TileSize>
void ZTest::write(const LateWrite& late) {
  const int parts = run_.config.z_cache.parts;
  const auto samples = static_cast<std::ptrdiff_t>(TileSize * TileSize / parts);
  const std::uint8_t written = parts_of_mask<TileSize>(late.kept, parts);
  TileCodes<TileSize> tile{};
  for (int part = 0; part < parts; ++part) {
    if ((written >> part & 1) == 0) {
      continue;
    }
    const auto i = static_cast<std::size_t>(part);
    std::vector<std::uint32_t>& line = cache_.codes[late.slots.slot[i]];
    const auto first = tile.begin() + part * samples;
    std::ranges::copy(line, first);
    write_codes<TileSize>(late.codes.data(), late.kept, tile.data());
    std::copy(first, first + samples, line.begin());
    cache_.lines.mark_written(late.slots.slot[i], cache_.shift(late.line[i], line));
  }
}

Cycle ZTest::write_all_late(Cycle from) {
  if (late_.empty()) {
    return late_next_;
  }
  late_begun_ = next_ = std::max(next_, from);
  order_.finish_all();
  while (!late_.empty()) {
    write_late();
  }
  return late_next_ = next_;
}

/// What write_all_late() did since the last burst belongs to whom the next one does.
void ZTest::tell_of_late() {
  if (late_next_ > meter_.next()) {
    meter_.stalled(stall::kNoInput, late_begun_);
    meter_.stalled(stall::kTestLate, late_next_);
  }
}

void ZTest::end_frame() {
  meter_.work_on(nullptr);
  tell_of_late();
}

/// Gives the slots of the missing parts to their lines, and returns how many dirty ones have to leave. The
/// lookup learns of it only when the data moves.
int ZTest::replace_lines(const PendingToken& token) {
  int dirty = 0;
  for (int part = 0; part < run_.config.z_cache.parts; ++part) {
    if ((token.missed >> part & 1) != 0) {
      const auto i = static_cast<std::size_t>(part);
      const std::uint32_t line = cache_.line_of(token, part);
      victims_[i] = cache_.lines.replace(token.slot[i], line, cache_.memory.layout.line_bytes(line));
      dirty += victims_[i].dirty ? 1 : 0;
    }
  }
  return dirty;
}

void ZTest::move_lines(const PendingToken& token, Cycle at) {
  if (token.touched == 0) {
    return;
  }
  ZMisses misses;
  for (int part = 0; part < run_.config.z_cache.parts; ++part) {
    if ((token.missed >> part & 1) == 0) {
      continue;
    }
    const auto i = static_cast<std::size_t>(part);
    const std::uint32_t line = cache_.line_of(token, part);
    const ZLines::Victim& victim = victims_[i];
    const std::uint32_t stored = cache_.stored_bytes(line);
    take_victim(victim, token.slot[i], token.draw, at);
    const bool fetched = (token.fetched >> part & 1) != 0;
    std::vector<std::uint32_t>& codes = cache_.codes[token.slot[i]];
    if (fetched) {
      codes = cache_.fill_buffers.take(at).codes;
    } else {
      codes.assign(cache_.memory.layout.samples(line), cache_.clear_code[token.draw->surface]);
    }
    misses.part[misses.count++] = {.line = line,
                                   .victim = victim.line,
                                   .bytes = static_cast<std::uint16_t>(stored),
                                   .victim_bytes = static_cast<std::uint16_t>(victim.bytes),
                                   .fetch = fetched,
                                   .overwritten = (token.sure >> part & 1) != 0,
                                   .write_back = victim.dirty};
  }
  passage::count_z_cache(token.draw->counters.early_z, token.touched, misses);
}

void ZTest::take_victim(const ZLines::Victim& victim, std::uint32_t slot, DrawContext* draw, Cycle at) {
  if (victim.line == kNoZLine) {
    return;
  }
  ZCacheState::Exit& exit = cache_.exits[victim.line];
  exit.looked_up = false;
  if (victim.dirty) {
    cache_.send(draw, victim.line, victim.bytes, slot, at);
    exit.write = cache_.writes_sent;
  } else {
    exit.left = at + 1;
  }
  cache_.exit_changed.notify();
}

template <int TileSize>
TestedToken ZTest::test(PendingToken& token) {
  DrawContext& draw = *token.draw;
  const Burst& burst = token.burst.burst;
  const int parts = run_.config.z_cache.parts;
  const std::size_t samples = static_cast<std::size_t>(TileSize * TileSize / parts);
  TileCodes<TileSize> stored{};
  TileCodes<TileSize> codes{};
  const auto for_each_touched = [&](auto&& visit) {
    for (std::size_t part = 0; part < static_cast<std::size_t>(parts); ++part) {
      if ((token.touched >> part & 1) != 0) {
        visit(part, cache_.codes[token.slot[part]].begin(),
              stored.begin() + static_cast<std::ptrdiff_t>(part * samples));
      }
    }
  };
  for_each_touched([&](std::size_t, auto line, auto tile) { std::copy_n(line, samples, tile); });
  const passage::Tested result =
      passage::z_test<TileSize>(*token.burst.triangle, burst, draw, stored.data(), codes);
  const std::uint8_t written =
      draw.early_z.late ? std::uint8_t{0} : passage::written_parts<TileSize>(result.kept, draw, parts);
  for_each_touched([&](std::size_t part, auto line, auto tile) {
    if ((written >> part & 1) != 0) {
      std::copy_n(tile, samples, line);
      cache_.lines.mark_written(token.slot[part], cache_.shift(cache_.line_of(token, static_cast<int>(part)),
                                                               cache_.codes[token.slot[part]]));
    }
  });
  if (run_.config.hi_z.enabled) {
    returns_.tested(passage::hi_z_update<TileSize>(draw, token.burst.triangle->depth, stored.data(),
                                                   token.touched, parts),
                    next_ - 1);
  }
  if (draw.early_z.late && any(result.passed)) {
    LateWrite& late = late_.emplace_back();
    late.quads = burst.quads;
    late.kept = result.kept;
    late.codes.assign(codes.begin(), codes.end());
    for_each_touched([&](std::size_t part, auto, auto) {
      late.slots.add(static_cast<int>(part), token.slot[part]);
      late.line[part] = cache_.line_of(token, static_cast<int>(part));
    });
    order_.add(late.slots);
  }
  TestedToken tested{.draw = &draw, .burst = std::move(token.burst), .result = result, .codes = {}};
  if (draw.record_quads) {
    tested.codes.assign(codes.begin(), codes.end());
  }
  return tested;
}

void ZTest::write_back() {
  run_.guard([&] {
    const auto encode = static_cast<Cycle>(encode_cycles(run_.config));
    for (;;) {
      const Cycle at = std::max(cache_.write_buffers.visible() + encode, cache_.next_write);
      run_.clock.wait_until(at);
      const std::uint32_t line = cache_.write_buffers.front().line;
      cache_.pack(line, cache_.write_buffers.front().codes, bytes_);
      sc_core::sc_time delay;
      cache_.memory.access(tlm::TLM_WRITE_COMMAND, line, bytes_, delay);
      const Cycle written = run_.clock.after(delay);
      run_.clock.wait_until(written);

      writing_ = cache_.write_buffers.take(written);
      cache_.writes_done = writing_.number;
      cache_.next_write = written + 1;
      if (cache_.exits[line].write == writing_.number) {
        cache_.exits[line].left = written + 1;
      }
      cache_.exit_changed.notify();
    }
  });
}

}  // namespace halfspace::systemc
