#include "halfspace/fast/frame_run.hpp"

#include <algorithm>

#include "halfspace/machine/draw_state.hpp"
#include "halfspace/machine/passage/block_walker.hpp"
#include "halfspace/machine/passage/edge_evaluator.hpp"
#include "halfspace/machine/passage/quad_generator.hpp"
#include "halfspace/machine/passage/setup.hpp"
#include "halfspace/machine/passage/sink.hpp"
#include "halfspace/machine/passage/tile_walker.hpp"
#include "halfspace/machine/passage/z_lookup.hpp"
#include "halfspace/machine/passage/z_test.hpp"

namespace halfspace::fast {
namespace {

/// Planes of a list; with more, its tiles are resolved.
constexpr std::size_t kMostPlanes = 1 << 16;

/// Whether front end and setup have vectors for the draw.
bool takes_vectors(const DrawContext& draw, const Command& command) {
  const DepthFormat format = draw.setup.depth_format;
  return command.fills_triangles() && !command.has(Flag::kPolygonOffset) &&
         !command.is_unrestricted(format) &&
         (format == DepthFormat::kNone || draw.setup.interpolator == DepthInterpolator::kPlane);
}

}  // namespace

FrameRun::FrameRun(FrameMemory& memory, std::uint32_t thread, StreamReader* reader)
    : memory_(memory),
      tile_size_(memory.config.tile_walker.tile_size),
      walker_(walker_config(memory.config)),
      columns_{.mask = memory.threads - 1, .own = thread},
      reader_(reader) {
  if (!columns_.all()) {
    share_ = std::make_unique<SetUpTriangles>();
  }
}

void FrameRun::run(const Frame& frame, Barrier& all, FrameResult& result) {
  frame_ = &frame;
  draws_.clear();
  if (reader_ != nullptr) {
    stream_.emplace(*reader_);
    reader_->begin(stream_surfaces(memory_.surfaces), memory_.lines());
  }
  PacketObserver* const observer = columns_.own == 0 ? memory_.watch.observer : nullptr;
  FrameSource source(frame, memory_.config, observer, memory_.surfaces, result, draws_);
  for (std::uint32_t i = 0; i < frame.commands.size(); ++i) {
    DrawContext* const draw = source.begin(i);
    if (draw != nullptr) {
      begin(*draw);
      if (const std::optional<RawTriangles> raw = source.take_raw()) {
        draw_raw(*raw, frame.commands[i]);
      }
    }
    while (const std::optional<SourceItem> item = source.next()) {
      if (item->draw == nullptr) {
        clear(*item, all);
      } else {
        set_up(item->triangles);
        flush();
      }
    }
    if (draw != nullptr && stream_) {
      stream_->end_segment(draw->counters.setup.triangles);
    }
  }
  all.arrive_and_wait();
  if (columns_.own != 0) {
    return;
  }
  const std::vector<ZFlush> dirty = memory_.flush();
  for (const ZFlush& line : dirty) {
    ++result.flushed_lines;
    result.flushed_bytes += line.bytes;
  }
  if (stream_) {
    stream_->give(false, nullptr);
    reader_->end(dirty);
  }
}

void FrameRun::begin(DrawContext& draw) {
  draw_ = &draw;
  const bool has_depth = draw.surface != kNoSurface;
  const bool counts_pixels = !draw.is_clear() && memory_.watch.count_pixels;
  const bool keeps = has_depth || counts_pixels || draw.keeps_visible || draw.sums != nullptr;
  const bool by_blocks = memory_.by_blocks;
  task_ = {.draw = &draw,
           .columns = columns_,
           .walker = walker_,
           .tiles = keeps ? &memory_.tiles[draw.drawn_on] : nullptr,
           .surface = keeps ? &memory_.surfaces[draw.drawn_on] : nullptr,
           .counts_pixels = counts_pixels,
           .cache = has_depth && by_blocks ? &memory_.cache : nullptr,
           .cached = has_depth && by_blocks ? memory_.cache.surfaces[draw.surface] : BlockSurface{},
           .tile_cache = has_depth && !by_blocks ? &memory_.tile_cache : nullptr,
           .place = has_depth ? memory_.places[draw.surface] : ZSurface{},
           .z_parts = memory_.config.z_cache.parts,
           .stream = stream_ ? &*stream_ : nullptr};
  if (stream_) {
    using Kind = StreamSegment::Kind;
    stream_->begin_segment(draw.is_clear() ? Kind::kDrawnClear : Kind::kDraw, draw.surface,
                           touches_depth(draw.early_z));
  }
}

void FrameRun::clear(const SourceItem& item, Barrier& all) {
  all.arrive_and_wait();
  if (columns_.own == 0) {
    memory_.clear(item.surface, item.code);
  }
  all.arrive_and_wait();
  if (stream_) {
    stream_->begin_segment(StreamSegment::Kind::kFastClear, item.surface, false);
    stream_->end_segment(0);
  }
}

void FrameRun::draw_raw(const RawTriangles& raw, const Command& command) {
  DrawContext& draw = *draw_;
  const bool vectors = takes_vectors(draw, command);
  const FrontEndTask task = vectors ? front_end_task(*raw.front_end, command) : FrontEndTask{};
  constexpr std::uint32_t kOneByOne = 8;
  chunk_->first = chunk_->end = 0;
  for (std::uint32_t next = 0; next < raw.count;) {
    if (vectors) {
      next = fast::set_up(task, next, raw.count, *chunk_, *set_up_, draw.counters.front_end,
                          draw.counters.setup);
      if (set_up_->count + kOneByOne > SetUpTriangles::kMost) {
        flush();
        continue;
      }
    }
    const std::uint32_t end = std::min(next + kOneByOne, raw.count);
    batch_.clear();
    for (; next < end; ++next) {
      raw.front_end->process(next, batch_, draw.counters.front_end);
    }
    set_up(batch_);
  }
  flush();
}

FrontEndTask FrameRun::front_end_task(const FrontEnd& front_end, const Command& command) const {
  const DrawContext& draw = *task_.draw;
  const FrontEnd::Depth depth = front_end.depth();
  FrontEndTask task;
  task.vertices = frame_->vertices.data() + command.first_vertex;
  task.indices = frame_->indices.data() + command.first_index;
  task.viewport_x = command.viewport.x;
  task.viewport_y = command.viewport.y;
  task.viewport_width = command.viewport.z;
  task.viewport_height = command.viewport.w;
  task.x_half = command.viewport.z / 2.0;
  task.y_half = command.viewport.w / 2.0;
  task.x_centre = command.viewport.x + task.x_half;
  task.y_centre = command.viewport.y + task.y_half;
  task.sub_pixels = 1 << walker_.sub_pixel_bits;
  task.clips_depth = front_end.clips_depth();
  task.symmetric = command.has(Flag::kNdcZMinusOneToOne);
  task.has_depth = draw.early_z.test;
  task.z_scale = depth.scale;
  task.z_bias = depth.bias;
  task.z_least = depth.least;
  task.z_most = depth.most;
  const DepthFormat format = draw.setup.depth_format;
  task.is_float = format == DepthFormat::kFloat32;
  if (task.is_float) {
    task.least = static_cast<std::int32_t>(draw.setup.limits.least);
    task.most = static_cast<std::int32_t>(std::min(draw.setup.limits.most, largest_code(format)));
  } else if (format != DepthFormat::kNone) {
    task.fraction = vertex_depth_fraction(format);
    task.depth_one = static_cast<double>(vertex_depth_of_code(format, max_unorm_code(format)));
    const std::uint32_t most = std::min(draw.setup.limits.most, largest_code(format));
    task.least = static_cast<std::int32_t>(vertex_depth_of_code(format, draw.setup.limits.least));
    task.most = static_cast<std::int32_t>(vertex_depth_of_code(format, most));
  }
  task.most_extent = ((1 << 30) - 1) / walker_.block_size;
  task.setup = draw.setup;
  return task;
}

void FrameRun::set_up(std::span<const ScreenTriangle> triangles) {
  for (const ScreenTriangle& in : triangles) {
    SetupTriangle out;
    if (!passage::setup(in, *draw_, out)) {
      continue;
    }
    if (in.shape == ScreenShape::kTriangle && raster_takes(out, walker_)) {
      set_up_->append(out, *task_.draw, walker_.sub_pixel_bits, task_.draw->early_z.test);
      if (set_up_->count == SetUpTriangles::kMost) {
        flush();
      }
      continue;
    }
    flush();
    tile_size_ == 4 ? draw_by_units<4>(out) : draw_by_units<8>(out);
  }
}

void FrameRun::flush() {
  const SetUpTriangles* triangles = set_up_.get();
  if (share_) {
    take_share(*set_up_, columns_, walker_.block_size, *share_);
    triangles = share_.get();
  }
  raster(tile_size_, task_, *triangles);
  set_up_->clear();
  const std::uint32_t list = columns_.own;
  if (task_.tiles != nullptr && task_.tiles->lists[list].planes.size() > kMostPlanes) {
    resolve(tile_size_, walker_.sub_pixel_bits, columns_, *task_.surface, *task_.tiles);
    task_.tiles->forget_planes(list);
  }
}

template <int TileSize>
void FrameRun::draw_by_units(const SetupTriangle& triangle) {
  passage::BlockWalker walker(walker_);
  DrawContext& draw = *draw_;
  if (stream_) {
    stream_->drawn(static_cast<std::uint32_t>(draw.counters.setup.triangles - 1));
  }
  const BlockWalkerCounters before = draw.counters.block_walker;
  const auto draw_own = [&](const BlockJob& block, std::uint32_t empty_before) {
    if (!columns_.has(block.block_x)) {
      return;
    }
    if (stream_) {
      if (stream_->full()) {
        stream_->give(true, nullptr);
      }
      stream_->block(empty_before);
    }
    passage::tile_walker<TileSize>(block, walker_, draw, [&](const TileJob& job, bool whole) {
      draw_job<TileSize>(triangle, job, whole);
    });
  };
  const std::uint32_t empty_after = walker.walk<TileSize>(triangle, draw, draw_own);
  if (columns_.own != 0) {
    draw.counters.block_walker = before;  // the first thread has counted all blocks
  }
  if (stream_) {
    stream_->walked(empty_after);
  }
}

template <int TileSize>
void FrameRun::draw_job(const SetupTriangle& triangle, const TileJob& job, bool whole) {
  DrawContext& draw = *draw_;
  const Coverage coverage = passage::edge_evaluator<TileSize>(job, whole, draw);
  if (!any(coverage.mask)) {
    tell_job(0);
    return;
  }
  const Burst burst = passage::quad_generator<TileSize>(coverage, draw);
  std::uint32_t* stored = nullptr;
  std::size_t at = 0;
  std::uint32_t block = 0;
  if (task_.surface != nullptr) {
    stored = passage::stored_codes(*task_.surface, draw, coverage);
    block = task_.tiles->block(static_cast<std::uint32_t>(job.tile_x >> task_.tiles->block_shift),
                               static_cast<std::uint32_t>(job.tile_y >> task_.tiles->block_shift));
    task_.tiles->open(block);
    at = task_.tiles->index(job.tile_x, job.tile_y);
    if (task_.tiles->plane[at] != kResolved) {
      resolve(tile_size_, walker_.sub_pixel_bits, columns_, *task_.surface, *task_.tiles);
    }
  }
  TileCodes<TileSize> codes;
  const passage::Tested tested = passage::z_test<TileSize>(triangle, burst, draw, stored, codes);
  if (stored != nullptr) {
    const auto [least, most] = std::minmax_element(stored, stored + TileSize * TileSize, is_nearer);
    task_.tiles->z_min[at] = code_order(*least);
    task_.tiles->z_max[at] = code_order(*most);
    task_.tiles->change(block);
  }
  if (task_.counts_pixels || draw.keeps_visible || draw.sums != nullptr) {
    passage::sink<TileSize>(coverage.mask, tested, job.tile_x, job.tile_y, triangle.triangle, draw,
                            *task_.surface);
  }
  if (touches_depth(draw.early_z)) {
    const int parts = memory_.config.z_cache.parts;
    look_up(job.tile_x, job.tile_y, parts_of_mask<TileSize>(coverage.mask, parts),
            draw.early_z.write ? parts_of_mask<TileSize>(tested.passed, parts) : std::uint8_t{0});
    if (stream_ && stream_->wants_accesses()) {
      constexpr int kBands = stream_bands(TileSize);
      stream_->access({job.tile_x, job.tile_y, passage::touched_parts<TileSize>(coverage, draw, kBands),
                       passage::written_parts<TileSize>(tested.kept, draw, kBands)});
    }
  }
  tell_job(burst.quads);
}

void FrameRun::tell_job(int quads) {
  if (stream_) {
    stream_->job(quads);
  }
}

void FrameRun::look_up(std::uint32_t tile_x, std::uint32_t tile_y, std::uint8_t touched,
                       std::uint8_t written) {
  if (!memory_.by_blocks) {
    const ZMisses misses =
        memory_.tile_cache.access(task_.place, tile_x, tile_y, {.touched = touched, .written = written});
    passage::count_z_cache(draw_->counters.early_z, touched, misses);
    if (stream_) {
      stream_->accessed(misses.parts());
    }
    return;
  }
  const SurfaceTiles& tiles = *task_.tiles;
  const std::uint32_t block_x = tile_x >> tiles.block_shift;
  const std::uint32_t block_y = tile_y >> tiles.block_shift;
  const std::uint32_t block = tiles.block(block_x, block_y);
  const auto in_block = static_cast<std::uint32_t>(
      tiles.index(static_cast<int>(tile_x), static_cast<int>(tile_y)) - block * tiles.entries);
  const CachePlace place = memory_.cache.place(task_.cached, block, block_x, block_y, in_block / kLanes);
  EarlyZCounters& counters = draw_->counters.early_z;
  ++counters.z_bursts;
  access_parts(memory_.cache, place, static_cast<int>(in_block % kLanes), touched, written, counters,
               task_.stream);
}

}  // namespace halfspace::fast
