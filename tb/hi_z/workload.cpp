#include "hi_z/workload.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "common/random.hpp"
#include "early_z/triangles.hpp"
#include "halfspace/units/block_walker.hpp"
#include "halfspace/units/edge_evaluator.hpp"
#include "halfspace/units/hi_z_plane.hpp"
#include "halfspace/units/late_writes.hpp"
#include "halfspace/units/packing.hpp"
#include "halfspace/units/quad_generator.hpp"
#include "halfspace/units/tile_mask.hpp"
#include "halfspace/units/tile_walker.hpp"

namespace halfspace::tb {
namespace {

constexpr std::uint32_t kSurfaces = 3;
constexpr std::uint64_t kMostTriangles = 6;  // of a draw
constexpr std::size_t kMostBlocks = 24;      // of a triangle

struct HiZTarget {
  DepthFormat format = DepthFormat::kNone;
  HiZSurface place;
  int width = 0;  ///< in pixels
  int height = 0;
  int tiles_x = 0;
  std::uint32_t clear_code = 0;
  std::vector<std::uint32_t> codes;  ///< tile by tile
};

class HiZMaker {
 public:
  HiZMaker(const HiZShape& shape, HiZStyle style, std::uint64_t seed)
      : shape_(shape), style_(style), random_(seed) {
    make_surfaces();
    forget();
  }

  HiZWorkload make(std::size_t blocks) {
    left_ = blocks;
    while (left_ > 0) {
      const std::uint64_t kind = random_.below(72);
      if (kind < 12) {
        clear(surfaces_[random_.below(kSurfaces)]);
      } else if (kind == 12) {
        workload_.commands.emplace_back().kind = HiZCommandKind::kFrameEnd;
        forget();
      } else {
        with_tile(shape_.widths.TileSize,
                  [&](auto size) { draw<size()>(surfaces_[random_.below(kSurfaces)]); });
      }
    }
    workload_.commands.emplace_back().kind = HiZCommandKind::kFrameEnd;
    return std::move(workload_);
  }

 private:
  void make_surfaces() {
    static constexpr std::array<DepthFormat, kSurfaces> kFormats = {
        DepthFormat::kUnorm16, DepthFormat::kFloat32, DepthFormat::kUnorm24};
    const int size = shape_.widths.BlockSize;
    const int row_tiles = size / shape_.widths.TileSize;
    const auto most = static_cast<std::uint32_t>(shape_.memory_blocks) / std::uint32_t{kSurfaces};
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < kSurfaces; ++i) {
      HiZTarget& surface = surfaces_[i];
      surface.format = kFormats[i];
      const std::uint32_t columns = style_ == HiZStyle::kOneBlock
                                        ? 1 + static_cast<std::uint32_t>(i % 2)
                                        : std::min(most, 3 + static_cast<std::uint32_t>(i));
      const std::uint32_t rows = style_ == HiZStyle::kOneBlock ? 1 : std::min(most / columns, 4u);
      // The last surface ends where memory does.
      const std::uint32_t first =
          i + 1 == kSurfaces ? static_cast<std::uint32_t>(shape_.memory_blocks) - columns * rows : next;
      surface.place = {.first_block = first, .blocks_x = columns, .blocks = columns * rows};
      next += columns * rows;
      surface.width = static_cast<int>(columns) * size -
                      static_cast<int>(random_.below(static_cast<std::uint64_t>(size / 2)));
      surface.height = static_cast<int>(rows) * size -
                       static_cast<int>(random_.below(static_cast<std::uint64_t>(size / 2)));
      surface.tiles_x = static_cast<int>(columns) * row_tiles;
      surface.codes.resize(static_cast<std::size_t>(columns * rows) * static_cast<std::size_t>(size * size));
      for (std::uint32_t& code : surface.codes) {
        code = random_code(surface.format);
      }
    }
  }

  std::uint32_t random_code(DepthFormat format) {
    return code_of_depth(format,
                         static_cast<float>(random_.below(1u << 20)) / static_cast<float>((1u << 20) - 1));
  }

  void forget() { hi_z_ = HiZ(shape_.config(), static_cast<std::uint32_t>(shape_.memory_blocks)); }

  void clear(HiZTarget& surface) {
    static constexpr std::array<double, 4> kDepths = {0, 1, 0.5, 0.25};
    surface.clear_code = random_.below(2) == 0
                             ? random_code(surface.format)
                             : code_of_depth(surface.format, static_cast<float>(kDepths[random_.below(4)]));
    std::ranges::fill(surface.codes, surface.clear_code);
    hi_z_.clear(surface.place, surface.clear_code);
    HiZCommand& command = workload_.commands.emplace_back();
    command.kind = HiZCommandKind::kClear;
    command.first = surface.place.first_block;
    command.last = surface.place.first_block + surface.place.blocks - 1;
  }

  template <int TileSize>
  void draw(HiZTarget& surface) {
    const bool none = random_.below(16) == 0;
    EarlyZState state{
        .test = !none && random_.below(8) != 0,
        .write = random_.below(4) != 0,
        .func = static_cast<DepthFunc>(random_.below(8)),
        .format = none ? DepthFormat::kNone : surface.format,
        .interpolator = random_.below(8) == 0 ? DepthInterpolator::kBarycentric : DepthInterpolator::kPlane,
        .sub_pixel_bits = shape_.widths.SubPixelBits};
    if (random_.below(2) == 0) {
      state.func = random_.below(3) == 0 ? DepthFunc::kGequal : DepthFunc::kLess;  // most games
    }
    state.late = state.write && touches_depth(state) && random_.below(4) == 0;
    DrawStatePacket packet{.format = static_cast<std::uint8_t>(state.format),
                           .test = state.test,
                           .write = state.write,
                           .late = state.late,
                           .func = static_cast<std::uint8_t>(state.func),
                           .clear_code = surface.clear_code,
                           .first_tile = static_cast<std::uint32_t>(random_.bits()),
                           .first_block = surface.place.first_block,
                           .blocks_x = static_cast<std::uint16_t>(surface.place.blocks_x - 1)};
    if (!state.test) {
      packet.first_block = static_cast<std::uint32_t>(random_.bits());
      packet.blocks_x = static_cast<std::uint16_t>(random_.bits() >> (64 - shape_.widths.BlockCoordBits));
    }
    for (std::uint64_t count = 1 + random_.below(kMostTriangles); count > 0 && left_ > 0; --count) {
      const SetupTriangle triangle = random_triangle(shape_.widths, state.format, state.interpolator,
                                                     surface.width, surface.height, random_);
      std::vector<BlockJob> blocks = blocks_of<TileSize>(triangle);
      if (blocks.empty()) {
        continue;
      }
      HiZTriangleWords& words = workload_.triangles.emplace_back();
      words.equation.resize(words_for(packed_bits<DepthEquationPacket>(shape_.widths)));
      words.state.resize(words_for(packed_bits<DrawStatePacket>(shape_.widths)));
      pack(to_packet(triangle, state.format, state.interpolator), shape_.widths, words.equation);
      pack(packet, shape_.widths, words.state);
      for (BlockJob& block : blocks) {
        block.slot = static_cast<std::uint8_t>(workload_.triangles.size() - 1);
        if (left_ > 0) {
          --left_;
          add_block<TileSize>(triangle, block, state, surface);
        }
      }
    }
  }

  [[nodiscard]] WalkerConfig walker() const {
    return {.sub_pixel_bits = shape_.widths.SubPixelBits, .block_size = shape_.widths.BlockSize};
  }

  template <int TileSize>
  std::vector<BlockJob> blocks_of(const SetupTriangle& triangle) {
    struct Sink {
      std::vector<BlockJob> jobs;
      void block(const BlockJob& job, std::uint64_t /*touched*/) {
        if (job.tiles != 0) {
          jobs.push_back(job);
        }
      }
      static void pass(const GridPlace& /*cell*/, int /*side*/) {}
    };
    Sink sink;
    block_walker<TileSize>(triangle, walker(), 0, sink);
    if (sink.jobs.size() > kMostBlocks) {
      const auto first = static_cast<std::ptrdiff_t>(random_.below(sink.jobs.size() - kMostBlocks));
      sink.jobs = {sink.jobs.begin() + first,
                   sink.jobs.begin() + first + static_cast<std::ptrdiff_t>(kMostBlocks)};
    }
    // The same block again and again, as triangles of a mesh have it.
    if (random_.below(4) == 0) {
      const BlockJob again = sink.jobs.empty() ? BlockJob{} : sink.jobs[random_.below(sink.jobs.size())];
      sink.jobs.insert(sink.jobs.end(), sink.jobs.empty() ? 0 : random_.below(8), again);
    }
    return std::move(sink.jobs);
  }

  template <int TileSize>
  void add_block(const SetupTriangle& triangle, BlockJob block, const EarlyZState& state,
                 HiZTarget& surface) {
    HiZCommand& command = workload_.commands.emplace_back();
    command.triangle = workload_.triangles.size() - 1;
    command.number = state.test ? surface.place.block(block.block_x, block.block_y) : 0;
    command.tiles = block.tiles;
    command.state = state;
    command.moves = state.test ? depth_moves(state.func, state.write) : DepthMoves{};
    command.clear_code = surface.clear_code;
    if (style_ == HiZStyle::kMadeUp && state.test && block.z_known != 0 && random_.below(2) == 0) {
      move_plane(triangle.depth, surface, block);
    }
    command.plane = block.z_known != 0;
    command.words.resize(words_for(packed_bits<BlockJob>(shape_.widths)));
    pack(block, shape_.widths, command.words);
    const HiZ::Verdict verdict = hi_z_.decide(block, triangle.depth, state, surface.place);
    command.rejected = verdict.rejected;
    command.sure = verdict.sure;
    command.gets_slot = verdict.first;
    command.slot = verdict.slot;
    block.slot = verdict.slot;
    block.tiles &= ~verdict.rejected;
    block.sure = verdict.sure;
    command.left.resize(command.words.size());
    pack(block, shape_.widths, command.left);
    struct Sink {
      std::vector<TileJob> jobs;
      void tile(const TileJob& job, bool /*whole*/) { jobs.push_back(job); }
    };
    Sink sink;
    tile_walker<TileSize>(block, walker(), sink);
    std::uint64_t left = block.tiles;
    for (const TileJob& tile : sink.jobs) {
      HiZJob& job = command.jobs.emplace_back();
      job.tile = static_cast<std::uint8_t>(std::countr_zero(left));
      left &= left - 1;
      back<TileSize>(triangle, tile, state, surface, job);
      hi_z_.retire(job.update);
      HiZUpdatePacket packet;
      for (std::size_t part = 0; part < static_cast<std::size_t>(shape_.widths.ZParts); ++part) {
        packet.touched[part] = job.update.touched >> part & 1;
        packet.least[part] = packet.touched[part] != 0 ? job.update.bounds[part].least : 0;
        packet.most[part] = packet.touched[part] != 0 ? job.update.bounds[part].most : 0;
      }
      job.words.resize(words_for(packed_bits<HiZUpdatePacket>(shape_.widths)));
      pack(packet, shape_.widths, job.words);
    }
  }

  /// Moves the plane so that in the first tile its least or its most word is the first of a code that may be
  /// stored, or the one before. No plane of a triangle comes that near by chance.
  void move_plane(const DepthEquation& equation, const HiZTarget& surface, BlockJob& block) {
    const std::uint64_t near = (random_.below(2) == 0 ? surface.clear_code : middle_) + random_.below(2);
    const std::uint64_t code = std::clamp<std::uint64_t>(near, 1, largest_code(surface.format));
    const bool scaled = surface.format == DepthFormat::kFloat32 || equation.beyond;
    const std::int64_t word =
        word_of_code(static_cast<std::uint32_t>(code), surface.format, scaled ? equation.exponent : 0);
    const bool least = random_.below(2) == 0;
    const auto corner = [&](std::int64_t step) { return (step < 0) == least ? step : 0; };
    const int size = shape_.widths.TileSize;
    const int row = shape_.widths.BlockSize / size;
    const int tile = std::countr_zero(block.tiles);
    const std::int64_t way = block.z_dx * (tile % row * size) + block.z_dy * (tile / row * size) +
                             (corner(block.z_dx) + corner(block.z_dy)) * (size - 1);
    const std::int64_t target = (word + (least ? kHiZMargin : -kHiZMargin - 1)) << kHiZFraction;
    block.z = hi_z_wrap(target + static_cast<std::int64_t>(random_.below(3)) - 1 - way);
  }

  /// Whether a job has a burst, and the bounds behind it.
  template <int TileSize>
  void back(const SetupTriangle& triangle, const TileJob& tile, const EarlyZState& state, HiZTarget& surface,
            HiZJob& job) {
    const Coverage coverage = edge_evaluator<TileSize>(tile, shape_.widths.SubPixelBits);
    job.burst = any(coverage.mask);
    if (!job.burst) {
      return;
    }
    const std::size_t at =
        static_cast<std::size_t>(coverage.tile_y) * static_cast<std::size_t>(surface.tiles_x) +
        coverage.tile_x;
    std::uint32_t* const stored = &surface.codes[at * static_cast<std::size_t>(TileSize * TileSize)];
    TileCodes<TileSize> codes{};
    const TileMask passed =
        z_test<TileSize>(triangle, quad_generator<TileSize>(coverage), state, stored, codes);
    const std::uint8_t touched =
        touches_depth(state) ? parts_of_mask<TileSize>(coverage.mask, shape_.widths.ZParts) : std::uint8_t{0};
    job.update = hi_z_update<TileSize>(stored, touched, shape_.widths.ZParts);
    if (state.late) {
      allow_for_late_write(job.update, triangle.depth, state);
      write_codes<TileSize>(codes.data(), passed, stored);
    }
    if (style_ == HiZStyle::kMadeUp && state.test) {
      make_up(surface.format, job.update);
    }
  }

  /// Other bounds: around a middle that stays for a while, as wide as a random power of two; now and then the
  /// ends.
  void make_up(DepthFormat format, HiZUpdate& update) {
    const auto largest = std::uint64_t{largest_code(format)};
    if (random_.below(8) == 0) {
      middle_ = random_.below(largest + 1);
      reach_ = random_.below(32);
    }
    update.touched = static_cast<std::uint8_t>(random_.bits() & ((1u << shape_.widths.ZParts) - 1));
    for (CodeBounds& bounds : update.bounds) {
      const auto any = [&] {
        const std::uint64_t reach = random_.below((std::uint64_t{1} << reach_) + 1);
        const std::uint64_t code =
            random_.below(2) == 0 ? middle_ + reach : middle_ - std::min(middle_, reach);
        const std::uint64_t kind = random_.below(64);
        return kind == 0 ? 0 : kind == 1 ? ~0u : static_cast<std::uint32_t>(std::min(code, largest));
      };
      const auto [least, most] = std::minmax({any(), any()});
      bounds = {.least = least, .most = random_.below(3) == 0 ? least : most};
    }
  }

  HiZShape shape_;
  HiZStyle style_;
  Random random_;
  std::array<HiZTarget, kSurfaces> surfaces_;
  HiZ hi_z_;
  HiZWorkload workload_;
  std::size_t left_ = 0;  ///< blocks
  std::uint64_t middle_ = 0;
  std::uint64_t reach_ = 4;
};

}  // namespace

HiZWorkload make_hi_z_workload(const HiZShape& shape, HiZStyle style, std::uint64_t seed,
                               std::size_t blocks) {
  return HiZMaker(shape, style, seed).make(blocks);
}

}  // namespace halfspace::tb
