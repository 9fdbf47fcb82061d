// Depth traffic by class of line: its sums are what the machine counts, and its classes what the bytes say.
#include <catch2/catch.hpp>

#include "halfspace/machine/in_order.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/whatif/depth_traffic.hpp"
#include "hard_frames.hpp"

namespace halfspace::testing {
namespace {

using whatif::ClassTraffic;
using whatif::DepthTraffic;
using whatif::LineClass;
using whatif::LineTraffic;

std::uint64_t lines_of(const ClassTraffic& traffic) {
  std::uint64_t lines = 0;
  for (const LineTraffic& line : traffic) {
    lines += line.lines;
  }
  return lines;
}

/// The class of a line by its bytes: their number, and the bit that tells the form.
LineClass class_by_bytes(std::span<const std::uint32_t> codes, const ZCodecShape& shape) {
  std::vector<std::uint8_t> bytes;
  z_encode(codes, shape, bytes);
  const int share = shape.bytes() / static_cast<int>(bytes.size());
  if (share == 1) {
    return LineClass::kRaw;
  }
  const bool ends = (bytes[0] & 1) != 0;
  return share == 8   ? (ends ? LineClass::kEndsEighth : LineClass::kPlaneEighth)
         : share == 4 ? (ends ? LineClass::kEndsQuarter : LineClass::kPlaneQuarter)
                      : (ends ? LineClass::kEndsHalf : LineClass::kPlaneHalf);
}

/// What the surface's lines with a survivor would take, each written once.
ClassTraffic lines_at_the_end(FrameResult& result, const Config& config) {
  ClassTraffic traffic{};
  Surface& surface = result.surfaces.at(0);
  const ZCodecShape shape = z_codec_shape(place_surfaces(result.surfaces, config).at(0), config);
  const auto samples = static_cast<std::size_t>(shape.samples());
  for (int y = 0; y < surface.codes.tiles_y(); ++y) {
    for (int x = 0; x < surface.codes.tiles_x(); ++x) {
      for (int part = 0; part < config.z_cache.parts; ++part) {
        const std::size_t first = static_cast<std::size_t>(part) * samples;
        const std::uint16_t* const survivors = surface.survivors.tile(x, y) + first;
        if (std::any_of(survivors, survivors + samples, [](std::uint16_t n) { return n != 0; })) {
          const std::span<const std::uint32_t> codes{surface.codes.tile(x, y) + first, samples};
          std::vector<std::uint8_t> bytes;
          z_encode(codes, shape, bytes);
          traffic[static_cast<std::size_t>(class_by_bytes(codes, shape))] +=
              {.lines = 1,
               .raw_bytes = static_cast<std::uint64_t>(shape.bytes()),
               .stored_bytes = bytes.size()};
        }
      }
    }
  }
  return traffic;
}

}  // namespace

TEST_CASE("depth traffic: the classes add up to what the machine counts", "[property]") {
  Random random(seed());
  std::array<std::uint64_t, whatif::kLineClasses> read{};
  for (std::uint64_t run = 0; run < samples(400'000) / 2000; ++run) {
    CAPTURE(seed(), run);
    Config config = random_config(random);
    config.z_cache.compression = true;
    CAPTURE(difference_from_default(config));
    const Frame frame = random.between(0, 1) == 0 ? depth_stack(random) : hard_frame(random);
    const DepthTraffic traffic = whatif::count_depth_traffic(frame, config);
    const FrameResult result = run_in_order(frame, config, {}, nullptr);
    const auto sum = [&](auto counter) {
      return result.counters.early_z.*counter + result.drawn_clears.early_z.*counter;
    };
    CHECK(moved(traffic.read).stored_bytes == sum(&EarlyZCounters::bytes_read));
    CHECK(moved(traffic.written).stored_bytes == sum(&EarlyZCounters::bytes_written) + result.flushed_bytes);
    CHECK(lines_of(traffic.written) == sum(&EarlyZCounters::z_evicted) + result.flushed_lines);
    CHECK(lines_of(traffic.read) + traffic.lines_overwritten == sum(&EarlyZCounters::z_misses));
    CHECK(traffic.lines_overwritten == sum(&EarlyZCounters::z_overwritten));
    CHECK(traffic.read[0].lines == sum(&EarlyZCounters::z_cleared));
    CHECK(traffic.read[0].stored_bytes == 0);
    CHECK(traffic.written[0].lines == 0);
    for (std::size_t i = 1; i < whatif::kLineClasses; ++i) {
      const std::uint64_t share = i == 7 ? 1 : 8u >> ((i - 1) % 3);
      CHECK(traffic.read[i].raw_bytes == share * traffic.read[i].stored_bytes);
      CHECK(traffic.written[i].raw_bytes == share * traffic.written[i].stored_bytes);
      read[i] += traffic.read[i].lines;
    }
  }
  CAPTURE(read);
  CHECK(std::all_of(read.begin() + 1, read.end(), [](std::uint64_t lines) { return lines > 0; }));
}

TEST_CASE("depth traffic: the flush of a large z cache has the classes that the bytes say", "[property]") {
  Random random(seed());
  std::array<std::uint64_t, whatif::kLineClasses> written{};
  for (std::uint64_t run = 0; run < samples(400'000) / 4000; ++run) {
    CAPTURE(seed(), run);
    Config config = random_config(random);
    config.z_cache.compression = true;
    config.z_cache.fast_clear = true;
    config.z_cache.lines = 4096;  // all of the surface
    config.z_cache.ways = 16;
    CAPTURE(difference_from_default(config));
    FrameBuilder builder(128,
                         pick(random, {DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32}));
    builder.draw(hard_triangles(random, 128, static_cast<int>(random.between(1, 60))));
    const DepthTraffic traffic = whatif::count_depth_traffic(builder.frame, config);
    FrameResult result = run_in_order(builder.frame, config, {}, nullptr);
    const ClassTraffic expected = lines_at_the_end(result, config);
    CHECK(traffic.written == expected);
    for (std::size_t i = 0; i < whatif::kLineClasses; ++i) {
      written[i] += expected[i].lines;
    }
  }
  CAPTURE(written);
  CHECK(std::all_of(written.begin() + 1, written.end(), [](std::uint64_t lines) { return lines > 0; }));
}

}  // namespace halfspace::testing
