#include "halfspace/report/recorder.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace halfspace {
namespace {

#pragma pack(push, 1)
/// A record of quads.npy. Where a pixel has several samples a byte follows, the number of the sample; with
/// inner coverage a byte, the pixels that the triangle fills; where the machine has the interpolator, the
/// attributes of the quad: 4 pixels of 4 components each.
struct QuadRecord {
  std::uint32_t draw, triangle, surface, x, y;
  std::uint8_t mask, passed;
  std::uint32_t depth[4];
  std::uint64_t cycle;
};

/// A record of tiles.npy.
struct TileRecord {
  std::uint32_t draw, triangle, tile_x, tile_y;
  std::uint8_t verdict;
};
#pragma pack(pop)

constexpr const char* kQuadDescr =
    "[('draw','<u4'),('triangle','<u4'),('surface','<u4'),('x','<u4'),('y','<u4'),('mask','|u1'),('passed','|"
    "u1'),"
    "('depth','<u4',(4,)),('cycle','<u8')";
constexpr const char* kSampleDescr = ",('sample','|u1')";
constexpr const char* kInnerDescr = ",('inner','|u1')";
constexpr const char* kTileDescr =
    "[('draw','<u4'),('triangle','<u4'),('tile_x','<u4'),('tile_y','<u4'),('verdict','|u1')]";

template <class Record>
void append(NpyWriter& file, const Record& record) {
  file.append(std::as_bytes(std::span(&record, 1)));
}

}  // namespace

Recorder::Recorder(const Options& options)
    : with_sample_(options.samples > 1),
      with_inner_(options.inner_coverage),
      attributes_(static_cast<std::size_t>(options.attributes)) {
  if (options.quads) {
    const std::string attributes =
        attributes_ != 0 ? fmt::format(",('attributes','<i4',({},4,4))", attributes_) : "";
    const std::string descr = fmt::format("{}{}{}{}]", kQuadDescr, with_sample_ ? kSampleDescr : "",
                                          with_inner_ ? kInnerDescr : "", attributes);
    quads_.emplace(*options.quads, descr,
                   sizeof(QuadRecord) + (with_sample_ ? 1 : 0) + (with_inner_ ? 1 : 0) +
                       attributes_ * sizeof(QuadAttribute));
  }
  if (options.tiles) {
    tiles_.emplace(*options.tiles, kTileDescr, sizeof(TileRecord));
  }
}

void Recorder::quad(const QuadEvent& event) {
  const auto& z = event.depth;
  append(*quads_, QuadRecord{event.draw,
                             event.triangle,
                             event.surface,
                             event.x,
                             event.y,
                             event.mask,
                             event.passed,
                             {z[0], z[1], z[2], z[3]},
                             event.cycle});
  if (with_sample_) {
    append(*quads_, event.sample);
  }
  if (with_inner_) {
    append(*quads_, event.inner);
  }
  for (std::size_t i = 0; i < attributes_; ++i) {
    append(*quads_, i < event.attributes.size() ? event.attributes[i] : QuadAttribute{});
  }
}

void Recorder::decision(const DecisionEvent& event) {
  append(*tiles_, TileRecord{event.draw, event.triangle, event.tile_x, event.tile_y,
                             static_cast<std::uint8_t>(event.verdict)});
}

void Recorder::finish() {
  if (quads_) {
    quads_->finish();
  }
  if (tiles_) {
    tiles_->finish();
  }
}

}  // namespace halfspace
