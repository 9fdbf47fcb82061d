#include "halfspace/fast/fast_core.hpp"

#include <algorithm>
#include <bit>
#include <deque>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "halfspace/fast/block_cache.hpp"
#include "halfspace/fast/crew.hpp"
#include "halfspace/fast/front_end_task.hpp"
#include "halfspace/fast/raster.hpp"
#include "halfspace/fast/surface_tiles.hpp"
#include "halfspace/machine/draw_state.hpp"
#include "halfspace/machine/frame_source.hpp"
#include "halfspace/machine/passage/edge_evaluator.hpp"
#include "halfspace/machine/passage/quad_generator.hpp"
#include "halfspace/machine/passage/setup.hpp"
#include "halfspace/machine/passage/sink.hpp"
#include "halfspace/machine/passage/tile_walker.hpp"
#include "halfspace/machine/passage/z_lookup.hpp"
#include "halfspace/machine/passage/z_test.hpp"
#include "halfspace/machine/surfaces.hpp"

namespace halfspace::fast {

class FastCore::Runner {
 public:
  Runner(const Config& config, const Watch& watch, StreamReader* reader)
      : config_(config),
        tile_size_(config.tile_walker.tile_size),
        block_tiles_(config.tile_walker.block_size / config.tile_walker.tile_size),
        watch_(watch),
        reader_(reader),
        walker_(walker_config(config)) {
    const std::uint32_t threads = useful_threads();
    if (threads > 1) {
      crew_.emplace(tile_size_, threads);
      set_up_ = &crew_->triangles();
    } else {
      alone_ = std::make_unique<SetUpTriangles>();
      set_up_ = alone_.get();
    }
    thread_counters_.resize(threads - 1);
  }

  void run(const Frame& frame) {
    begin(frame);
    FrameSource source(frame, config_, watch_.observer, result_, draws_);
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
          clear(*item);
        } else {
          set_up(item->triangles);
          flush();
        }
      }
      if (draw != nullptr && stream_) {
        stream_->end_segment(draw->counters.setup.triangles);
      }
    }
    settle();
    add_thread_counters();
    flush_cache();
    collect_draws(draws_, result_);
  }

  [[nodiscard]] const Counters& counters() const { return result_.counters; }

  FrameResult take() {
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      resolve(tile_size_, walker_.sub_pixel_bits, {}, result_.surfaces[i], tiles_[i]);
    }
    tiles_.clear();
    shape_.clear();
    return std::move(result_);
  }

 private:
  /// Columns of blocks have nothing in common only where they have sets of the z cache of their own. The
  /// packets of a stream are in order, so one thread writes them.
  [[nodiscard]] std::uint32_t useful_threads() const {
    const ZCacheShape shape = z_cache_shape(config_);
    const int block_shift = std::countr_zero(static_cast<unsigned>(block_tiles_));
    if (reader_ != nullptr || !BlockCache::takes(shape, block_shift)) {
      return 1;
    }
    return std::bit_floor(std::min({static_cast<std::uint32_t>(watch_.threads), Crew::kMostThreads,
                                    BlockCache::columns(shape, block_shift)}));
  }

  /// Surfaces as they are before the first command, in the memory of the last run where they fit.
  void begin(const Frame& frame) {
    frame_ = &frame;
    std::vector<Surface> surfaces = std::move(result_.surfaces);
    draws_.clear();
    for (std::deque<Counters>& each : thread_counters_) {
      each.clear();
    }
    result_ = {};
    result_.core = Core::kFast;
    std::vector<SurfaceShape> shape = surface_shapes(frame);
    if (shape == shape_) {
      result_.surfaces = std::move(surfaces);
      for (std::size_t i = 0; i < result_.surfaces.size(); ++i) {
        reset(result_.surfaces[i], tiles_[i]);
      }
    } else {
      shape_.clear();  // until all of it is there
      tiles_.clear();
      result_.surfaces = make_surfaces(frame, tile_size_, watch_);
      for (const Surface& surface : result_.surfaces) {
        tiles_.emplace_back(surface.codes, block_tiles_, largest_code(surface.format),
                            static_cast<std::uint32_t>(thread_counters_.size()) + 1);
      }
      shape_ = std::move(shape);
    }
    make_cache();
    if (reader_ != nullptr) {
      stream_.emplace(*reader_, frame.name);
      reader_->begin(stream_surfaces(result_.surfaces),
                     by_blocks_ ? cache_.memory_lines() : memory_lines(places_, z_cache_shape(config_)));
    }
  }

  void make_cache() {
    places_ = place_surfaces(result_.surfaces, config_);
    const ZCacheShape shape = z_cache_shape(config_);
    const int block_shift = std::countr_zero(static_cast<unsigned>(block_tiles_));
    by_blocks_ = BlockCache::takes(shape, block_shift);
    if (!by_blocks_) {
      tile_cache_ = ZCache(shape, memory_lines(places_, shape));
      return;
    }
    std::vector<BlockSurface> cached;
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      cached.push_back({.first = first, .blocks = tiles_[i].blocks, .line_bytes = places_[i].line_bytes});
      first += tiles_[i].blocks;
    }
    cached.push_back({.first = first});
    cache_ = BlockCache(shape, block_shift, std::move(cached));
  }

  static void reset(Surface& surface, SurfaceTiles& tiles) {
    surface.counters = {};
    const PixelRect all{.x_last = surface.codes.width() - 1, .y_last = surface.codes.height() - 1};
    surface.codes.fill(all, largest_code(surface.format));
    tiles.clear(largest_code(surface.format));
    if (!surface.fragments.empty()) {
      surface.fragments.fill(all, 0);
      surface.survivors.fill(all, 0);
    }
    if (!surface.visible.empty()) {
      surface.visible.fill(all, kNothingVisible);
    }
  }

  void begin(DrawContext& draw) {
    draw_ = &draw;
    const bool has_depth = draw.surface != kNoSurface;
    task_ = {.draw = &draw,
             .counters = &draw.counters,
             .columns = {},
             .walker = walker_,
             .tiles = has_depth ? &tiles_[draw.surface] : nullptr,
             .surface = has_depth ? &result_.surfaces[draw.surface] : nullptr,
             .counts_pixels = has_depth && !draw.is_clear() && watch_.count_pixels,
             .cache = has_depth && by_blocks_ ? &cache_ : nullptr,
             .cached = has_depth && by_blocks_ ? cache_.surfaces[draw.surface] : BlockSurface{},
             .tile_cache = has_depth && !by_blocks_ ? &tile_cache_ : nullptr,
             .place = has_depth ? places_[draw.surface] : ZSurface{},
             .z_parts = config_.z_cache.parts,
             .stream = stream_ ? &*stream_ : nullptr};
    counters_ = {&draw.counters};
    for (std::deque<Counters>& each : thread_counters_) {
      counters_.push_back(&each.emplace_back());
    }
    if (stream_) {
      using Kind = StreamSegment::Kind;
      stream_->begin_segment(draw.is_clear() ? Kind::kDrawnClear : Kind::kDraw, draw.surface,
                             touches_depth(draw.early_z));
    }
  }

  void flush_cache() {
    std::vector<ZFlush> dirty;
    if (by_blocks_) {
      dirty = cache_.flush();
    } else {
      tile_cache_.flush([&](std::uint32_t slot, std::uint32_t /*line*/, std::uint32_t bytes) {
        dirty.push_back({.slot = slot, .bytes = bytes});
      });
    }
    for (const ZFlush& line : dirty) {
      ++result_.flushed_lines;
      result_.flushed_bytes += line.bytes;
    }
    if (stream_) {
      stream_->give(false, nullptr);
      reader_->end(dirty);
    }
  }

  void clear(const SourceItem& item) {
    settle();
    clear_surface(result_.surfaces[item.surface], item.code);
    tiles_[item.surface].clear(item.code);
    if (by_blocks_) {
      cache_.clear(cache_.surfaces[item.surface]);
    } else {
      tile_cache_.clear(places_[item.surface]);
    }
    if (stream_) {
      stream_->begin_segment(StreamSegment::Kind::kFastClear, item.surface, false);
      stream_->end_segment(0);
    }
  }

  void draw_raw(const RawTriangles& raw, const Command& command) {
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

  /// Whether front end and setup have vectors for the draw.
  static bool takes_vectors(const DrawContext& draw, const Command& command) {
    const DepthFormat format = draw.setup.depth_format;
    return !command.has(Flag::kPolygonOffset) &&
           (format == DepthFormat::kNone || draw.setup.interpolator == DepthInterpolator::kPlane);
  }

  FrontEndTask front_end_task(const FrontEnd& front_end, const Command& command) const {
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
    task.has_depth = task_.tiles != nullptr && draw.early_z.test;
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

  void set_up(std::span<const ScreenTriangle> triangles) {
    const bool has_depth = task_.tiles != nullptr && task_.draw->early_z.test;
    for (const ScreenTriangle& in : triangles) {
      SetupTriangle out;
      if (!passage::setup(in, *draw_, out)) {
        continue;
      }
      if (raster_takes(out, walker_)) {
        set_up_->append(out, *task_.draw, walker_.sub_pixel_bits, has_depth);
        if (set_up_->count == SetUpTriangles::kMost) {
          flush();
        }
        continue;
      }
      flush();
      settle();
      tile_size_ == 4 ? draw_by_units<4>(out) : draw_by_units<8>(out);
    }
  }

  /// Draws what is set up.
  void flush() {
    if (set_up_->count == 0) {
      return;
    }
    if (crew_) {
      crew_->draw(task_, counters_);
      set_up_ = &crew_->triangles();
      return;
    }
    draw_columns(tile_size_, task_, *set_up_);
    set_up_->clear();
  }

  /// Before somebody else than the crew looks at what it draws.
  void settle() {
    if (crew_) {
      crew_->wait();
    }
  }

  /// Of all threads but the first, to those of the draws.
  void add_thread_counters() {
    for (const std::deque<Counters>& each : thread_counters_) {
      for (std::size_t i = 0; i < each.size(); ++i) {
        draws_[i].counters += each[i];
      }
    }
  }

  /// The units themselves, on the fast core's surfaces.
  template <int TileSize>
  void draw_by_units(const SetupTriangle& triangle) {
    passage::TileWalker walker(walker_);
    DrawContext& draw = *draw_;
    if (stream_) {
      stream_->drawn(static_cast<std::uint32_t>(draw.counters.setup.triangles - 1));
    }
    const auto draw_job = [&](const TileJob& job, TileWork work, std::uint32_t steps) {
      const Coverage coverage = passage::edge_evaluator<TileSize>(job, work, draw);
      if (!any(coverage.mask)) {
        tell_job(steps, 0);
        return;
      }
      const Burst burst = passage::quad_generator<TileSize>(coverage, draw);
      std::uint32_t* stored = nullptr;
      std::size_t at = 0;
      if (task_.surface != nullptr) {
        stored = task_.surface->codes.tile(job.tile_x, job.tile_y);
        task_.tiles->open(
            task_.tiles->block(static_cast<std::uint32_t>(job.tile_x >> task_.tiles->block_shift),
                               static_cast<std::uint32_t>(job.tile_y >> task_.tiles->block_shift)));
        at = task_.tiles->index(job.tile_x, job.tile_y);
        if (task_.tiles->plane[at] != kResolved) {
          resolve(tile_size_, walker_.sub_pixel_bits, {}, *task_.surface, *task_.tiles);
        }
      }
      TileCodes<TileSize> codes;
      const TileMask passed = passage::z_test<TileSize>(triangle, burst, draw, stored, codes);
      if (task_.surface != nullptr) {
        const auto [least, most] = std::minmax_element(stored, stored + TileSize * TileSize);
        task_.tiles->z_min[at] = static_cast<std::int32_t>(*least);
        task_.tiles->z_max[at] = static_cast<std::int32_t>(*most);
        if (task_.counts_pixels || draw.keeps_visible) {
          passage::sink<TileSize>(coverage.mask, passed, job.tile_x, job.tile_y, triangle.triangle, draw,
                                  task_.surface);
        }
      }
      if (touches_depth(draw.early_z)) {
        const int parts = config_.z_cache.parts;
        look_up(job.tile_x, job.tile_y, parts_of_mask<TileSize>(coverage.mask, parts),
                draw.early_z.write ? parts_of_mask<TileSize>(passed, parts) : std::uint8_t{0});
      }
      tell_job(steps, burst.quads);
    };
    const std::uint32_t steps_after = walker.walk<TileSize>(triangle, draw, draw_job);
    if (stream_) {
      stream_->walked(steps_after);
    }
  }

  void tell_job(std::uint32_t steps, int quads) {
    if (stream_) {
      stream_->job(steps, quads);
      if (stream_->full()) {
        stream_->give(true, nullptr);
      }
    }
  }

  /// Lines of a tile, a bit a part.
  void look_up(std::uint32_t tile_x, std::uint32_t tile_y, std::uint8_t touched, std::uint8_t written) {
    if (!by_blocks_) {
      const ZMisses misses = tile_cache_.access(task_.place, tile_x, tile_y, touched, written);
      passage::count_z_cache(task_.counters->early_z, touched, misses);
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
    const CachePlace place = cache_.place(task_.cached, block, block_x, block_y, in_block / kLanes);
    EarlyZCounters& counters = task_.counters->early_z;
    ++counters.z_bursts;
    access_parts(cache_, place, static_cast<int>(in_block % kLanes), touched, written, counters,
                 task_.stream);
  }

  const Frame* frame_ = nullptr;
  Config config_;
  int tile_size_;
  int block_tiles_;  ///< on a side
  Watch watch_;
  StreamReader* reader_;
  std::optional<StreamWriter> stream_;  ///< where there is a reader
  WalkerConfig walker_;
  FrameResult result_;
  std::vector<SurfaceShape> shape_;  ///< that result_ has
  std::vector<SurfaceTiles> tiles_;
  std::deque<DrawContext> draws_;
  DrawContext* draw_ = nullptr;  ///< at work
  bool by_blocks_ = false;       ///< the z cache is cache_, else tile_cache_
  BlockCache cache_;
  ZCache tile_cache_;
  std::vector<ZSurface> places_;
  RasterTask task_;
  std::vector<ScreenTriangle> batch_;
  std::unique_ptr<VertexChunk> chunk_ = std::make_unique<VertexChunk>();
  std::vector<std::deque<Counters>> thread_counters_;  ///< of each thread but the first, by draw
  std::vector<Counters*> counters_;                    ///< of the draw at work, by thread
  SetUpTriangles* set_up_ = nullptr;                   ///< what is not drawn yet
  std::unique_ptr<SetUpTriangles> alone_;              ///< where there is no crew
  std::optional<Crew> crew_;                           ///< ends before what it works on
};

FastCore::FastCore(const Config& config, const Watch& watch, StreamReader* reader)
    : runner_(std::make_unique<Runner>(config, watch, reader)) {}
FastCore::~FastCore() = default;
FastCore::FastCore(FastCore&&) noexcept = default;

void FastCore::run(const Frame& frame) { runner_->run(frame); }
const Counters& FastCore::counters() const { return runner_->counters(); }
FrameResult FastCore::take() { return runner_->take(); }

std::string_view gap(const Config& config, const Watch& watch, const StreamReader* reader) {
  if (reader != nullptr && (reader->wants_accesses() || reader->wants_tiles())) {
    return reader->wants_tiles() ? "a timeline" : "a record";
  }
  if (config.tile_walker.tile_size > 8) {
    return "tile_walker.tile_size = 16";
  }
  if (!config.tile_walker.block_level) {
    return "tile_walker.block_level = false";
  }
  const PacketObserver* const observer = watch.observer;
  const bool shows = observer != nullptr &&
                     (observer->wants_quads() || observer->wants_decisions() || observer->wants_tile_jobs());
  return shows ? "a run whose packets are recorded" : "";
}

}  // namespace halfspace::fast
