#include "early_z/workload.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <optional>

#include "halfspace/units/hi_z.hpp"
#include "halfspace/units/packing.hpp"
#include "halfspace/units/quad_beats.hpp"
#include "halfspace/units/tile_mask.hpp"

namespace halfspace::tb {
namespace {

constexpr std::size_t kSurfaces = 3;
constexpr std::uint64_t kMostTriangles = 5;  // of a draw
constexpr std::size_t kMostBursts = 16;      // of a triangle
constexpr std::uint64_t kLongWait = 200;     // for a clear or a flush
constexpr std::uint64_t kWholeKeep = 16;     // the shader keeps all that passed

struct Surface {
  DepthFormat format = DepthFormat::kNone;
  ZSurface place;
  int width = 0;  ///< in pixels
  int height = 0;
  std::uint32_t clear_code = 0;
  std::vector<std::uint32_t> codes;  ///< tile by tile
};

class Maker {
 public:
  Maker(const EarlyZShape& shape, std::uint64_t seed, bool local)
      : shape_(shape),
        local_(local),
        random_(seed),
        cache_({.lines = shape.lines, .ways = shape.ways, .parts = parts(), .late_writes = shape.late_queue},
               static_cast<std::uint32_t>(shape.memory_tiles * parts())) {
    make_surfaces();
  }

  Workload make(std::size_t bursts) {
    std::size_t left = bursts;
    while (left > 0) {
      switch (random_.below(8)) {
        case 0:
          clear(surfaces_[random_.below(kSurfaces)]);
          break;
        case 1:
          if (random_.below(3) == 0) {
            flush();
          }
          break;
        default:
          draw(left);
      }
    }
    flush();
    for (std::uint32_t line = 0; line < workload_.memory_before.size(); ++line) {
      FinalLine& last = workload_.memory_after.emplace_back();
      last.known = !cleared_[line];
      if (last.known) {
        last.bytes = shape_.compression && written_[line] ? coded(line) : bytes_of(line);
      }
    }
    return std::move(workload_);
  }

 private:
  [[nodiscard]] int parts() const { return shape_.widths.ZParts; }
  [[nodiscard]] int tile_samples() const { return shape_.widths.MaskBits; }

  /// Surfaces share the tiles of memory: the last takes what is left. Random codes are in them.
  void make_surfaces() {
    static constexpr std::array<DepthFormat, kSurfaces> kFormats = {
        DepthFormat::kUnorm16, DepthFormat::kFloat32, DepthFormat::kUnorm24};
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < kSurfaces; ++i) {
      Surface& surface = surfaces_[i];
      surface.format = kFormats[i];
      const std::uint32_t tiles = static_cast<std::uint32_t>(shape_.memory_tiles) / kSurfaces;
      const auto places = static_cast<std::uint32_t>(3 + 2 * i);
      const std::uint32_t columns = places * static_cast<std::uint32_t>(shape_.widths.PixelSamples);
      surface.place = {
          .first_tile = next,
          .tiles_x = columns,
          .tiles = tiles / columns * columns,
          .line_bytes = static_cast<std::uint32_t>(sample_bytes(surface.format) * tile_samples() / parts())};
      next += surface.place.tiles;
      surface.width = static_cast<int>(places) * shape_.widths.TileSize;
      surface.height = static_cast<int>(surface.place.tiles / columns) * shape_.widths.TileSize;
      for (std::uint32_t n = surface.place.tiles * static_cast<std::uint32_t>(tile_samples()); n > 0; --n) {
        surface.codes.push_back(stored_code(surface.format, random_vertex_depth(surface.format)));
      }
    }
    cleared_.resize(static_cast<std::size_t>(shape_.memory_tiles * parts()));
    written_.resize(cleared_.size());
    for (std::uint32_t line = 0; line < cleared_.size(); ++line) {
      workload_.memory_before.push_back(bytes_of(line));
    }
  }

  std::uint32_t random_vertex_depth(DepthFormat format) {
    return vertex_depth_code(format, static_cast<double>(random_.below(1u << 20)) / ((1u << 20) - 1));
  }

  std::uint16_t random_place(int bits) { return static_cast<std::uint16_t>(random_.bits() >> (64 - bits)); }
  std::uint16_t random_column() { return random_place(shape_.widths.TileColumnBits); }

  [[nodiscard]] const Surface* surface_of(std::uint32_t line) const {
    const std::uint32_t tile = line / static_cast<std::uint32_t>(parts());
    for (const Surface& surface : surfaces_) {
      if (tile >= surface.place.first_tile && tile < surface.place.first_tile + surface.place.tiles) {
        return &surface;
      }
    }
    return nullptr;
  }

  /// The line in memory, as it is now in the picture.
  [[nodiscard]] std::vector<std::uint8_t> bytes_of(std::uint32_t line) const {
    std::vector<std::uint8_t> bytes;
    const Surface* const surface = surface_of(line);
    if (surface == nullptr) {
      return bytes;
    }
    const auto samples = static_cast<std::uint32_t>(tile_samples() / parts());
    const std::uint32_t first =
        (line - surface->place.first_tile * static_cast<std::uint32_t>(parts())) * samples;
    for (std::uint32_t i = 0; i < samples; ++i) {
      const std::uint32_t code = surface->codes[first + i];
      for (int byte = 0; byte < sample_bytes(surface->format); ++byte) {
        bytes.push_back(static_cast<std::uint8_t>(code >> (8 * byte)));
      }
    }
    return bytes;
  }

  /// The same, as early_z writes it.
  [[nodiscard]] std::vector<std::uint8_t> coded(std::uint32_t line) const {
    const ZCodecShape shape = shape_.codec(surface_of(line)->format);
    std::vector<std::uint32_t> codes;
    z_decode(bytes_of(line), shape, codes);
    std::vector<std::uint8_t> bytes;
    z_encode(codes, shape, bytes);
    return bytes;
  }

  void store(std::uint32_t line) {
    cleared_[line] = false;
    written_[line] = true;
  }

  /// Late writes that are out wait for the clear or the flush, where it does not wait for them.
  std::uint64_t random_wait() {
    return shape_.late_queue == 0 || random_.below(2) == 0 ? 0 : random_.below(kLongWait);
  }

  void clear(Surface& surface) {
    surface.clear_code = stored_code(surface.format, random_vertex_depth(surface.format));
    std::ranges::fill(surface.codes, surface.clear_code);
    cache_.clear(surface.place);
    Command& command = workload_.commands.emplace_back();
    command.kind = CommandKind::kClear;
    command.wait = random_wait();
    command.first = surface.place.first_tile;
    command.last = surface.place.first_tile + surface.place.tiles - 1;
    for (std::uint32_t line = command.first * static_cast<std::uint32_t>(parts());
         line < (command.last + 1) * static_cast<std::uint32_t>(parts()); ++line) {
      cleared_[line] = true;
    }
  }

  void flush() {
    Command& command = workload_.commands.emplace_back();
    command.kind = CommandKind::kFlush;
    command.wait = random_wait();
    cache_.flush([&](std::uint32_t slot, std::uint32_t line, std::uint32_t bytes) {
      command.flushed.push_back({slot, line, bytes});
      store(line);
    });
  }

  void draw(std::size_t& left) {
    Surface& surface = surfaces_[random_.below(kSurfaces)];
    const bool none = random_.below(16) == 0;
    EarlyZState state{.test = !none && random_.below(8) != 0,
                      .write = random_.below(4) != 0,
                      .func = static_cast<DepthFunc>(random_.below(8)),
                      .format = none ? DepthFormat::kNone : surface.format,
                      .interpolator = shape_.interpolator(),
                      .sub_pixel_bits = shape_.widths.SubPixelBits,
                      .samples = standard_samples(shape_.widths.PixelSamples)};
    if (shape_.late_queue != 0) {
      state.late = touches_depth(state) && state.write && random_.below(4) != 0;
      keep_share_ = random_.below(kWholeKeep + 1);
    }
    const auto pixel = [&] {
      return static_cast<std::uint16_t>(random_.bits() >> (64 - shape_.widths.PixelBits));
    };
    DrawStatePacket packet{.front_positive_area = static_cast<std::uint8_t>(random_.below(2)),
                           .cull_front = static_cast<std::uint8_t>(random_.below(2)),
                           .cull_back = static_cast<std::uint8_t>(random_.below(2)),
                           .fill_rule = static_cast<std::uint8_t>(random_.below(kFillRules.size())),
                           .empty = static_cast<std::uint8_t>(random_.below(2)),
                           .x_first = pixel(),
                           .x_last = pixel(),
                           .y_first = pixel(),
                           .y_last = pixel(),
                           .format = static_cast<std::uint8_t>(state.format),
                           .test = state.test,
                           .write = state.write,
                           .late = state.late,
                           .func = static_cast<std::uint8_t>(state.func),
                           .clear_code = surface.clear_code,
                           .first_tile = surface.place.first_tile,
                           .tiles_x = static_cast<std::uint16_t>(surface.place.tiles_x - 1)};
    // What touches no depth may be anywhere on the screen, and needs no surface. But a plane is where its
    // triangle is.
    std::optional<std::array<std::uint16_t, 2>> place;
    if (!touches_depth(state) && (none || state.interpolator == DepthInterpolator::kBarycentric)) {
      place = {random_column(), random_place(shape_.widths.TileCoordBits)};
      packet.first_tile = static_cast<std::uint32_t>(random_.bits());
      packet.tiles_x = random_column();
    }
    const int height = local_ ? std::min(surface.height, 2 * shape_.widths.TileSize) : surface.height;
    for (std::uint64_t count = 1 + random_.below(kMostTriangles); count > 0 && left > 0; --count) {
      const bool by_square = shape_.conservative() != Conservative::kOff && random_.below(4) != 0;
      const Squares squares =
          by_square ? Squares{.mode = shape_.conservative(), .uncertainty = shape_.uncertainty} : Squares{};
      state.square_reach = squares.reach(shape_.widths);
      SetupTriangle triangle = random_triangle(shape_.widths, state.format, state.interpolator, surface.width,
                                               height, random_, squares);
      const std::vector<QuadBurst> bursts =
          bursts_of(shape_.widths, triangle, std::min(left, kMostBursts), random_);
      if (bursts.empty()) {
        continue;
      }
      left -= bursts.size();
      TriangleWords words;
      words.equation.resize(words_for(packed_bits<DepthEquationPacket>(shape_.widths)));
      words.state.resize(words_for(packed_bits<DrawStatePacket>(shape_.widths)));
      pack(to_packet(triangle, state.format, state.interpolator), shape_.widths, words.equation);
      pack(packet, shape_.widths, words.state);
      workload_.triangles.push_back(words);
      for (const QuadBurst& burst : bursts) {
        with_tile(shape_.widths.TileSize,
                  [&](auto size) { add_burst<size()>(triangle, burst, state, surface, place); });
      }
    }
  }

  /// Whether all samples of a burst pass and write.
  template <int TileSize>
  static bool overwrites(const SetupTriangle& triangle, const QuadBurst& burst, const EarlyZState& state,
                         const std::uint32_t* stored) {
    TileCodes<TileSize> before;
    std::copy_n(stored, before.size(), before.begin());
    TileCodes<TileSize> codes{};
    return touches_depth(state) && state.write &&
           z_test<TileSize>(triangle, burst, state, before.data(), codes) == burst.coverage.mask;
  }

  /// What the shader answers for a burst, and the samples of those that passed which it keeps.
  template <int TileSize>
  TileMask make_late(const TileMask& passed, LateWrite& late) {
    // Most bursts as their draw, some all or none.
    const std::uint64_t which = random_.below(8);
    const std::uint64_t share = which == 0 ? 0 : which == 1 ? kWholeKeep : keep_share_;
    late.out = any(passed);
    late.keep.resize(words_for(tile_samples()));
    TileMask kept;
    for (int bit = 0; bit < TileSize * TileSize && late.out; ++bit) {
      const int x = bit % TileSize;
      const int y = bit / TileSize;
      const auto at = static_cast<std::size_t>(4 * (y / 2 * (TileSize / 2) + x / 2) + y % 2 * 2 + x % 2);
      const auto word = static_cast<std::size_t>(bit / 64);
      const bool pass = (passed.word[word] >> (bit % 64) & 1) != 0;
      const bool keep = random_.below(kWholeKeep) < (pass ? share : kWholeKeep / 2);
      late.keep[at / 32] |= std::uint32_t{keep} << (at % 32);
      if (pass) {
        late.passed_word = at / 32;
        late.passed_bit = 1u << (at % 32);
        kept.word[word] |= std::uint64_t{keep} << (bit % 64);
      }
    }
    late.passed = popcount(passed);
    late.kept = popcount(kept);
    late.passed_parts = parts_of_mask<TileSize>(passed, parts());
    late.kept_parts = parts_of_mask<TileSize>(kept, parts());
    return kept;
  }

  /// By how much the parts that a burst wrote to are coded.
  [[nodiscard]] ZShifts shifts(const std::uint32_t* codes, std::uint8_t written,
                               const Surface& surface) const {
    const ZCodecShape shape = shape_.codec(surface.format);
    const auto samples = static_cast<std::size_t>(shape.samples());
    ZShifts shifts;
    for (int part = 0; shape_.compression && part < parts(); ++part) {
      if ((written >> part & 1) != 0) {
        shifts.set(part, z_coded_shift({codes + static_cast<std::size_t>(part) * samples, samples}, shape));
      }
    }
    return shifts;
  }

  template <int TileSize>
  void add_burst(const SetupTriangle& triangle, QuadBurst burst, const EarlyZState& state, Surface& surface,
                 const std::optional<std::array<std::uint16_t, 2>>& place) {
    Command& command = workload_.commands.emplace_back();
    command.triangle = workload_.triangles.size() - 1;
    command.state = state;
    command.quads = popcount(burst.quads);
    const std::uint32_t tile =
        burst.coverage.tile_y * surface.place.tiles_x + static_cast<std::uint32_t>(burst.coverage.tile_x);
    std::uint32_t* const stored = &surface.codes[tile * static_cast<std::uint32_t>(TileSize * TileSize)];
    burst.coverage.sure =
        !state.late && overwrites<TileSize>(triangle, burst, state, stored) && random_.below(4) != 0 ? 1 : 0;
    TileCodes<TileSize> codes{};
    const TileMask passed = z_test<TileSize>(triangle, burst, state, stored, codes);
    if (state.format == DepthFormat::kNone) {
      codes.fill(0);
    } else if (!state.test) {
      interpolate_tile<TileSize>(triangle, burst, state, codes);
    }
    HiZUpdate update;
    TileMask kept = passed;
    if (state.late) {
      update = hi_z_update<TileSize>(stored, parts_of_mask<TileSize>(burst.coverage.mask, parts()), parts());
      allow_for_late_write(update, triangle.depth, state);
      kept = make_late<TileSize>(passed, command.late);
      write_codes<TileSize>(codes.data(), kept, stored);
    }
    const std::uint8_t covered = parts_of_mask<TileSize>(burst.coverage.mask, parts());
    if (touches_depth(state)) {
      command.touched = covered;
      const std::uint8_t written = state.write ? parts_of_mask<TileSize>(kept, parts()) : std::uint8_t{0};
      command.misses = cache_.access(surface.place, burst.coverage.tile_x, burst.coverage.tile_y,
                                     {.touched = covered,
                                      .written = written,
                                      .sure = sure_parts<TileSize>(burst.coverage, parts()),
                                      .shifts = shifts(stored, written, surface),
                                      .late = state.late,
                                      .late_write = command.late.out});
      for (int part = 0; part < parts(); ++part) {
        if ((covered >> part & 1) != 0) {
          command.lines.push_back(surface.place.line(static_cast<std::uint32_t>(burst.coverage.tile_x),
                                                     static_cast<std::uint32_t>(burst.coverage.tile_y),
                                                     parts(), part));
        }
      }
      for (const ZMiss& miss : command.misses.parts()) {
        if (miss.fetch) {
          command.fetched.push_back(std::countr_zero(surface.place.line_bytes / miss.bytes));
        }
        if (miss.write_back) {
          store(miss.victim);
          command.written.push_back(
              std::countr_zero(surface_of(miss.victim)->place.line_bytes / miss.victim_bytes));
        }
      }
    }
    if (!state.late) {
      update = hi_z_update<TileSize>(stored, command.touched, parts());
    }
    HiZUpdatePacket told;
    for (std::size_t part = 0; part < update.bounds.size(); ++part) {
      if ((update.touched >> part & 1) != 0) {
        told.touched[part] = 1;
        told.least[part] = update.bounds[part].least;
        told.most[part] = update.bounds[part].most;
      }
    }
    command.update.resize(words_for(packed_bits<HiZUpdatePacket>(shape_.widths)));
    pack(told, shape_.widths, command.update);
    const auto slot = static_cast<std::uint8_t>(command.triangle);
    QuadBurst in_slot = burst;
    in_slot.coverage.slot = slot;
    if (place) {
      in_slot.coverage.tile_x = (*place)[0];
      in_slot.coverage.tile_y = (*place)[1];
    }
    for (const QuadBeat& beat : quad_beats<TileSize>(in_slot, shape_.widths)) {
      pack(beat, shape_.widths, command.beats.emplace_back(words_for(packed_bits<QuadBeat>(shape_.widths))));
    }
    for (const TestedBeat& beat : tested_beats<TileSize>(in_slot, passed, TileMask{}, codes, shape_.widths)) {
      pack(beat, shape_.widths,
           command.tested.emplace_back(words_for(packed_bits<TestedBeat>(shape_.widths))));
    }
  }

  EarlyZShape shape_;
  bool local_;
  std::uint64_t keep_share_ = 0;  ///< of the draw, out of kWholeKeep: of the samples that pass
  Random random_;
  ZCache cache_;
  std::array<Surface, kSurfaces> surfaces_;
  std::vector<bool> cleared_;  ///< by line: memory does not hold it
  std::vector<bool> written_;  ///< by line: early_z has written it
  Workload workload_;
};

}  // namespace

Workload make_workload(const EarlyZShape& shape, std::uint64_t seed, std::size_t bursts, bool local) {
  return Maker(shape, seed, local).make(bursts);
}

MemoryOrder memory_order(const Workload& workload) {
  MemoryOrder order;
  for (const Command& command : workload.commands) {
    for (const ZMiss& miss : command.misses.parts()) {
      if (miss.fetch) {
        order.read.push_back(miss.line);
      }
      if (miss.write_back) {
        order.written.push_back(miss.victim);
      }
    }
    for (const FlushedLine& flushed : command.flushed) {
      order.written.push_back(flushed.line);
    }
  }
  return order;
}

std::optional<Failure> compare_memory(const Workload& workload,
                                      const std::vector<std::vector<std::uint8_t>>& memory,
                                      std::uint64_t cycle, std::uint64_t& lines) {
  for (std::size_t line = 0; line < workload.memory_after.size(); ++line) {
    const FinalLine& last = workload.memory_after[line];
    if (!last.known) {
      continue;
    }
    ++lines;
    if (last.bytes.size() != memory[line].size()) {
      return Failure{FailureKind::kPayload, cycle,
                     fmt::format("memory at the end: line {} has {} bytes, not {}", line, memory[line].size(),
                                 last.bytes.size())};
    }
    const auto [want, have] = std::ranges::mismatch(last.bytes, memory[line]);
    if (want != last.bytes.end()) {
      return Failure{FailureKind::kPayload, cycle,
                     fmt::format("memory at the end: line {}, byte {}: expected {:#x}, got {:#x}", line,
                                 want - last.bytes.begin(), *want, *have)};
    }
  }
  return std::nullopt;
}

}  // namespace halfspace::tb
