#include "halfspace/whatif/depth_traffic.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

#include "halfspace/machine/passage/edge_evaluator.hpp"
#include "halfspace/machine/passage/hi_z.hpp"
#include "halfspace/machine/passage/tile_walker.hpp"
#include "halfspace/machine/passage/z_lookup.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/machine/tile_size.hpp"
#include "halfspace/units/z_cache.hpp"
#include "halfspace/whatif/frame_walk.hpp"

namespace halfspace::whatif {
namespace {

template <int TileSize>
class Traffic {
 public:
  Traffic(const Frame& frame, const Config& config)
      : frame_(frame), config_(config), walk_(walker_config(config)) {
    result_.surfaces = make_surfaces(frame, config, Watch{.count_pixels = false});
    places_ = place_surfaces(result_.surfaces, config);
    const ZCacheShape shape = z_cache_shape(config);
    z_cache_ = ZCache(shape, memory_lines(places_, shape));
    blocks_ = place_blocks(result_.surfaces, config);
    hi_z_ = make_hi_z(blocks_, config);
    in_memory_.resize(memory_lines(places_, shape), LineClass::kRaw);
    in_cache_ = in_memory_;
  }

  DepthTraffic run() {
    walk_frame<TileSize>(frame_, config_, result_, at_, *this);
    z_cache_.flush([this](std::uint32_t /*slot*/, std::uint32_t line, std::uint32_t bytes) {
      count(traffic_.written, in_cache_[line], line, bytes);
    });
    return traffic_;
  }

  // See walk_frame().
  void clear(std::uint32_t surface, std::uint32_t code) {
    z_cache_.clear(places_[surface]);
    if (config_.hi_z.enabled) {
      hi_z_.clear(blocks_[surface], code);
    }
  }
  void dropped() {}
  void drawn() {}
  void walked(std::uint32_t /*empty*/) {}
  void block(BlockJob block, std::uint32_t /*empty*/) {
    DrawContext& draw = *at_.draw;
    if (config_.hi_z.enabled) {
      passage::hi_z(hi_z_, block, at_.triangle.depth,
                    draw.surface == kNoSurface ? HiZSurface{} : blocks_[draw.surface], draw);
    }
    passage::tile_walker<TileSize>(block, walk_, draw, [&](const TileJob& job, bool whole) {
      tile(passage::edge_evaluator<TileSize>(job, whole, draw));
    });
  }

 private:
  void tile(const Coverage& coverage) {
    const WalkedTile tile = draw_tile<TileSize>(at_, coverage, config_, codes_);
    if (tile.touches) {
      const std::uint32_t* const stored = at_.stored(coverage);
      look_up(coverage,
              passage::z_access<TileSize>(coverage, tile.tested, stored, *at_.draw,
                                          places_[at_.draw->surface], config_),
              stored);
    }
    if (config_.hi_z.enabled) {
      hi_z_.retire(tile.update);
    }
  }

  void look_up(const Coverage& coverage, const ZAccess& access, const std::uint32_t* stored) {
    const ZSurface& place = places_[at_.draw->surface];
    const ZMisses misses = z_cache_.access(place, coverage.tile_x, coverage.tile_y, access);
    for (const ZMiss& miss : misses.parts()) {
      if (miss.overwritten) {
        ++traffic_.lines_overwritten;
      } else {
        count(traffic_.read, miss.fetch ? in_memory_[miss.line] : LineClass::kCleared, miss.line,
              miss.fetch ? miss.bytes : 0);
      }
      if (miss.write_back) {
        count(traffic_.written, in_cache_[miss.victim], miss.victim, miss.victim_bytes);
        in_memory_[miss.victim] = in_cache_[miss.victim];
      }
    }
    const ZCodecShape shape = z_codec_shape(place, config_);
    const auto samples = static_cast<std::size_t>(shape.samples());
    for (int part = 0; part < config_.z_cache.parts; ++part) {
      if ((access.written >> part & 1) != 0) {
        const std::uint32_t line = place.line(coverage.tile_x, coverage.tile_y, config_.z_cache.parts, part);
        const std::uint32_t* const codes = stored + static_cast<std::size_t>(part) * samples;
        in_cache_[line] = line_class(z_coded_class({codes, samples}, shape));
      }
    }
  }

  void count(ClassTraffic& traffic, LineClass of, std::uint32_t line, std::uint32_t bytes) const {
    traffic[static_cast<std::size_t>(of)] +=
        {.lines = 1, .raw_bytes = line_bytes(line), .stored_bytes = bytes};
  }

  /// Of a line that is not coded.
  [[nodiscard]] std::uint32_t line_bytes(std::uint32_t line) const {
    const std::uint32_t tile = line / static_cast<std::uint32_t>(config_.z_cache.parts);
    const auto behind = std::upper_bound(places_.begin(), places_.end(), tile,
                                         [](std::uint32_t l, const ZSurface& r) { return l < r.first_tile; });
    return std::prev(behind)->line_bytes;
  }

  const Frame& frame_;
  const Config& config_;
  FrameResult result_;
  WalkedDraw at_;
  WalkerConfig walk_;
  std::vector<ZSurface> places_;
  std::vector<HiZSurface> blocks_;
  ZCache z_cache_;
  HiZ hi_z_;
  std::vector<LineClass> in_memory_;  ///< by line of memory; a line that is marked cleared has an old one
  std::vector<LineClass> in_cache_;   ///< of lines that are dirty
  TileCodes<TileSize> codes_{};
  DepthTraffic traffic_;
};

}  // namespace

LineClass line_class(const ZCodedClass& coded) {
  if (coded.form == ZForm::kPlain) {
    return LineClass::kRaw;
  }
  const LineClass eighth = coded.form == ZForm::kPlane ? LineClass::kPlaneEighth : LineClass::kEndsEighth;
  return static_cast<LineClass>(static_cast<int>(eighth) + kMostCodedShift - coded.shift);
}

LineTraffic moved(const ClassTraffic& traffic) {
  LineTraffic sum;
  for (std::size_t i = 0; i < kLineClasses; ++i) {
    if (i != static_cast<std::size_t>(LineClass::kCleared)) {
      sum += traffic[i];
    }
  }
  return sum;
}

DepthTraffic count_depth_traffic(const Frame& frame, const Config& config) {
  Config machine = config;
  machine.z_cache.compression = true;
  validate(machine);
  return with_tile_size(machine.tile_walker.tile_size,
                        [&](auto size) { return Traffic<size()>(frame, machine).run(); });
}

}  // namespace halfspace::whatif
