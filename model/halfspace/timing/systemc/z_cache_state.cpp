#include "halfspace/timing/systemc/z_cache_state.hpp"

#include "halfspace/machine/surfaces.hpp"
#include "halfspace/timing/contract.hpp"

namespace halfspace::systemc {

ZCacheState::ZCacheState(RunState& state, std::uint64_t base_address)
    : run(state),
      base(base_address),
      pending(state, Fifo::kEarlyZPending),
      fill_buffers(state, Fifo::kFillBuffers),
      write_buffers(state, Fifo::kWriteBuffers) {}

void ZCacheState::begin_frame() {
  const ZCacheShape shape = z_cache_shape(run.config);
  const std::uint32_t memory_line_count = memory_lines(run.places, shape);
  const auto slots = static_cast<std::size_t>(shape.lines);
  memory.layout = DepthLayout(run.result.surfaces, run.places, shape.parts, base);
  tags = ZTags(shape);
  line_of_slot.assign(slots, kNoZLine);
  lines = ZLines(shape, memory_line_count);
  codes.assign(slots, {});
  clear_code.assign(run.places.size(), 0);
  exits.assign(memory_line_count, {});
  writes_sent = 0;
  writes_done = 0;
  next_write = 0;
  std::vector<std::uint8_t> bytes;
  for (std::uint32_t line = 0; line < memory_line_count; ++line) {
    const DepthLayout& layout = memory.layout;
    const std::uint32_t code = largest_code(run.result.surfaces[layout.surface(line)].format);
    layout.pack(line, std::vector<std::uint32_t>(layout.samples(line), code), bytes);
    memory.access_in_no_time(tlm::TLM_WRITE_COMMAND, line, bytes);
  }
}

std::uint32_t ZCacheState::line_of(const PendingToken& token, int part) const {
  const Coverage& coverage = token.burst.burst.packet.coverage;
  return run.places[token.draw->surface].line(coverage.tile_x, coverage.tile_y, run.config.z_cache.parts,
                                              part);
}

void ZCacheState::count_transfer(std::uint64_t CycleStats::*channel, std::uint32_t bytes, int bytes_per_cycle,
                                 const DrawContext* draw) {
  const auto cycles = static_cast<std::uint64_t>(transfer_cycles(static_cast<int>(bytes), bytes_per_cycle));
  run.book.count(draw, [&](CycleStats& stats) { stats.*channel += cycles; });
}

void ZCacheState::send(DrawContext* draw, std::uint32_t line, std::uint32_t bytes, std::uint32_t slot,
                       Cycle at) {
  ++writes_sent;
  write_buffers.use_credit();
  write_buffers.put({.draw = draw, .line = line, .number = writes_sent, .codes = codes[slot]}, at);
  count_transfer(&CycleStats::write_busy, bytes, run.config.memory.write_bytes, draw);
}

std::uint32_t ZCacheState::stored_bytes(std::uint32_t line) const {
  return lines.stored_bytes(line, memory.layout.line_bytes(line));
}

void ZCacheState::pack(std::uint32_t line, std::span<const std::uint32_t> line_codes,
                       std::vector<std::uint8_t>& bytes) const {
  if (run.config.z_cache.compression) {
    z_encode(line_codes, shape(line), bytes);
  } else {
    memory.layout.pack(line, line_codes, bytes);
  }
}

void ZCacheState::unpack(std::uint32_t line, std::span<const std::uint8_t> bytes,
                         std::vector<std::uint32_t>& line_codes) const {
  if (run.config.z_cache.compression) {
    z_decode(bytes, shape(line), line_codes);
  } else {
    memory.layout.unpack(line, bytes, line_codes);
  }
}

int ZCacheState::shift(std::uint32_t line, std::span<const std::uint32_t> line_codes) const {
  return run.config.z_cache.compression ? z_coded_shift(line_codes, shape(line)) : 0;
}

ZCodecShape ZCacheState::shape(std::uint32_t line) const {
  return z_codec_shape(run.places[memory.layout.surface(line)], run.config);
}

}  // namespace halfspace::systemc
