#include "halfspace/report/pixel_quad_file.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace halfspace {
namespace {

#pragma pack(push, 1)
struct Record {
  std::uint32_t draw, triangle, surface, x, y;
  std::uint16_t covered[4], passed[4];
  std::uint8_t centroid[4][2];
};
#pragma pack(pop)

constexpr const char* kDescr =
    "[('draw','<u4'),('triangle','<u4'),('surface','<u4'),('x','<u4'),('y','<u4'),('covered','<u2',(4,)),"
    "('passed','<u2',(4,)),('centroid','|u1',(4,2))]";

}  // namespace

PixelQuadFile::PixelQuadFile(const std::filesystem::path& path) : file_(path, kDescr, sizeof(Record)) {}

void PixelQuadFile::write(const PixelQuadEvent& event) {
  Record record{event.draw, event.triangle, event.surface, event.x, event.y, {}, {}, {}};
  for (std::size_t pixel = 0; pixel < 4; ++pixel) {
    record.covered[pixel] = event.covered[pixel];
    record.passed[pixel] = event.passed[pixel];
    record.centroid[pixel][0] = event.centroid[pixel].x;
    record.centroid[pixel][1] = event.centroid[pixel].y;
  }
  file_.append(std::as_bytes(std::span(&record, 1)));
}

}  // namespace halfspace
