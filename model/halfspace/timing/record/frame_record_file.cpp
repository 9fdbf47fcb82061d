#include "halfspace/timing/record/frame_record_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/byte_source.hpp"
#include "halfspace/scene/compression.hpp"
#include "halfspace/units/z_codec.hpp"

namespace halfspace {
namespace {

constexpr std::uint32_t kMagic = 0x43525348;  // "HSRC"
constexpr std::uint32_t kVersion = 3;

// Members of a list in the file, one word each.
constexpr auto kSurfaceWords =
    std::to_array({&StreamSurface::tiles_x, &StreamSurface::tiles, &StreamSurface::sample_bytes});
constexpr auto kSegmentWords = std::to_array({&StreamSegment::surface, &StreamSegment::touches_depth,
                                              &StreamSegment::triangles, &StreamSegment::dropped_after});
constexpr auto kTriangleWords =
    std::to_array({&StreamTriangle::dropped_before, &StreamTriangle::blocks, &StreamTriangle::empty_after});

class Writer {
 public:
  void word(std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) {
      bytes_.push_back(static_cast<std::byte>(value >> shift));
    }
  }
  void text(std::string_view text) {
    word(static_cast<std::uint32_t>(text.size()));
    for (const char c : text) {
      bytes_.push_back(static_cast<std::byte>(c));
    }
  }
  template <class List, class Put>
  void list(const List& list, const Put& put) {
    word(static_cast<std::uint32_t>(list.size()));
    for (const auto& item : list) {
      put(item);
    }
  }
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

class Reader {
 public:
  Reader(std::string name, std::span<const std::byte> bytes) : name_(std::move(name)), bytes_(bytes) {}

  [[noreturn]] void fail(const std::string& what) const { throw InputError(name_ + ": " + what); }

  std::uint32_t word() {
    need(4);
    std::uint32_t value = 0;
    for (int shift = 0; shift < 32; shift += 8) {
      value |= std::to_integer<std::uint32_t>(bytes_[at_++]) << shift;
    }
    return value;
  }
  std::string text() {
    const std::uint32_t size = word();
    need(size);
    std::string text(size, '\0');
    std::memcpy(text.data(), bytes_.data() + at_, size);
    at_ += size;
    return text;
  }
  /// A list of items of `words` words, each made by get().
  template <class Item, class Get>
  std::vector<Item> list(std::size_t words, const Get& get) {
    const std::uint32_t size = word();
    need(std::size_t{size} * words * 4);  // before anything is allocated
    std::vector<Item> items;
    items.reserve(size);
    for (std::uint32_t i = 0; i < size; ++i) {
      items.push_back(get());
    }
    return items;
  }
  void end() const {
    if (at_ != bytes_.size()) {
      fail(fmt::format("{} bytes after the end of the record", bytes_.size() - at_));
    }
  }

 private:
  void need(std::size_t size) const {
    if (bytes_.size() - at_ < size) {
      fail(fmt::format("cut short: {} bytes are missing", size - (bytes_.size() - at_)));
    }
  }

  std::string name_;
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
};

void check_surfaces(const Reader& reader, const FrameRecord& record) {
  const auto samples = static_cast<std::uint32_t>(record.config.raster.samples);
  const std::uint32_t columns = 4096 * samples;
  std::uint64_t tiles = 0;
  for (const StreamSurface& surface : record.surfaces) {
    tiles += surface.tiles;
    if (surface.tiles != 0 &&
        (surface.tiles_x == 0 || surface.tiles % surface.tiles_x != 0 || surface.tiles_x > columns ||
         surface.tiles_x % samples != 0 || surface.tiles / surface.tiles_x > 4096)) {
      reader.fail(fmt::format("a surface of {} tiles, {} in a row; legal: whole rows, at most {} x 4096",
                              surface.tiles, surface.tiles_x, columns));
    }
    if (surface.sample_bytes != 2 && surface.sample_bytes != 4) {
      reader.fail(fmt::format("samples of {} bytes; legal: 2, 4", surface.sample_bytes));
    }
  }
  if (tiles > kMostRecordedTiles) {
    reader.fail(fmt::format("{} tiles in all surfaces; legal: at most {}", tiles, kMostRecordedTiles));
  }
}

void check_access(const Reader& reader, const FrameRecord& record, const StreamSurface& surface,
                  const StreamAccess& access) {
  const unsigned bands = (1u << stream_bands(record.config.tile_walker.tile_size)) - 1;
  if (access.tile_x() >= surface.tiles_x || access.tile_y() >= surface.tiles / surface.tiles_x) {
    reader.fail(fmt::format("a burst in tile ({}, {}) of a surface of {} x {} tiles", access.tile_x(),
                            access.tile_y(), surface.tiles_x, surface.tiles / surface.tiles_x));
  }
  if (access.touched() == 0 || (access.touched() & ~bands) != 0 ||
      (access.written() & ~access.touched()) != 0 || (access.sure() & ~access.written()) != 0 ||
      access.words()[1] >> 18 != 0) {
    reader.fail(
        fmt::format("a burst that touches bands {:04b}, writes {:04b} and overwrites {:04b}, in bits {:b}",
                    access.touched(), access.written(), access.sure(), access.words()[1]));
  }
  const Config& config = record.config;
  if ((access.late() && config.late_z.mode != LateZ::kLate) || (access.late_write() && !access.late())) {
    reader.fail(fmt::format("a burst with a late write, of a draw that is {}, where late_z.mode is {}",
                            access.late() ? "late" : "not late",
                            config.late_z.mode == LateZ::kLate ? "late" : "not late"));
  }
  const int samples = config.tile_walker.tile_size * config.tile_walker.tile_size / config.z_cache.parts;
  const int bytes = samples * static_cast<int>(surface.sample_bytes);
  for (int part = 0; part < kMaxZParts; ++part) {
    const int shift = access.shifts().of(part);
    if (shift != 0 && (!config.z_cache.compression || bytes >> shift < kLeastCodedBytes)) {
      reader.fail(fmt::format("a line of {} bytes in {}", bytes, bytes >> shift));
    }
  }
}

/// Everything the replay relies on: that lists are as long as others say, and numbers in range.
void check(const Reader& reader, const FrameRecord& record) {
  check_surfaces(reader, record);
  const PacketStream& packets = record.packets;
  const int tile_size = record.config.tile_walker.tile_size;
  const int most_quads = tile_size * tile_size / 4;
  const int row_tiles = record.config.block_walker.block_size / tile_size;
  const int most_jobs = row_tiles * row_tiles * record.config.raster.samples;
  std::size_t triangle = 0;
  std::size_t block = 0;
  std::size_t job = 0;
  std::size_t access = 0;
  for (const StreamSegment& segment : packets.segments) {
    const bool clear = segment.kind == StreamSegment::Kind::kFastClear;
    const bool has_surface = segment.surface < record.surfaces.size();
    if (segment.touches_depth > 1 || ((clear || segment.touches_depth == 1) &&
                                      (!has_surface || record.surfaces[segment.surface].tiles == 0))) {
      reader.fail(fmt::format("a draw or clear of depth surface {}, which is not there", segment.surface));
    }
    if ((clear && segment.triangles != 0) || segment.triangles > packets.triangles.size() - triangle) {
      reader.fail("more triangles in draws than in the list");
    }
    for (std::uint32_t i = 0; i < segment.triangles; ++i, ++triangle) {
      if (packets.triangles[triangle].blocks > packets.blocks.size() - block) {
        reader.fail("more block jobs in triangles than in the list");
      }
      for (std::uint32_t b = 0; b < packets.triangles[triangle].blocks; ++b, ++block) {
        const int jobs = packets.blocks[block].jobs();
        const int least = record.config.hi_z.enabled ? 0 : 1;
        if (jobs < least || jobs > most_jobs) {
          reader.fail(fmt::format("{} tile jobs in a block; legal: {} to {}", jobs, least, most_jobs));
        }
        if (static_cast<std::size_t>(jobs) > packets.jobs.size() - job) {
          reader.fail("more tile jobs in blocks than in the list");
        }
        for (const std::size_t end = job + static_cast<std::size_t>(jobs); job != end; ++job) {
          if (packets.jobs[job] > most_quads) {
            reader.fail(fmt::format("{} quads in a tile; legal: at most {}", packets.jobs[job], most_quads));
          }
          if (segment.touches_depth == 1 && packets.jobs[job] != 0) {
            if (access == packets.accesses.size()) {
              reader.fail("more bursts with depth than in the list");
            }
            check_access(reader, record, record.surfaces[segment.surface], packets.accesses[access++]);
          }
        }
      }
    }
  }
  if (triangle != packets.triangles.size() || block != packets.blocks.size() || job != packets.jobs.size() ||
      access != packets.accesses.size()) {
    reader.fail("lists are longer than draws and triangles say");
  }
}

}  // namespace

void write_record(const std::filesystem::path& path, const FrameRecord& record) {
  Writer writer;
  writer.word(kMagic);
  writer.word(kVersion);
  writer.text(record.name);
  writer.text(to_toml(record.config));
  const auto put_members = [&](const auto& item, const auto& members) {
    for (const auto member : members) {
      writer.word(item.*member);
    }
  };
  writer.list(record.surfaces, [&](const StreamSurface& s) { put_members(s, kSurfaceWords); });
  writer.list(record.packets.segments, [&](const StreamSegment& s) {
    writer.word(static_cast<std::uint32_t>(s.kind));
    put_members(s, kSegmentWords);
  });
  writer.list(record.packets.triangles, [&](const StreamTriangle& t) { put_members(t, kTriangleWords); });
  writer.list(record.packets.blocks, [&](const StreamBlock& b) { writer.word(b.word()); });
  writer.list(record.packets.jobs, [&](const StreamJob& j) { writer.word(j); });
  writer.list(record.packets.accesses, [&](const StreamAccess& a) {
    writer.word(a.words()[0]);
    writer.word(a.words()[1]);
  });
  write_bytes(path, compress_gzip(writer.bytes()));
}

FrameRecord read_record(const std::filesystem::path& path) {
  return parse_record(read_bytes(path), display_name(path));
}

FrameRecord parse_record(std::span<const std::byte> bytes, const std::string& name) {
  Reader reader(name, bytes);
  if (bytes.size() < 8 || reader.word() != kMagic) {
    reader.fail("not a record of a frame: it does not start with HSRC");
  }
  if (const std::uint32_t version = reader.word(); version != kVersion) {
    reader.fail(fmt::format("version {}; legal: {}", version, kVersion));
  }
  FrameRecord record;
  record.name = reader.text();
  record.config = parse_config(reader.text(), name);
  validate(record.config);
  const auto get_members = [&](auto item, const auto& members) {
    for (const auto member : members) {
      item.*member = reader.word();
    }
    return item;
  };
  record.surfaces = reader.list<StreamSurface>(kSurfaceWords.size(),
                                               [&] { return get_members(StreamSurface{}, kSurfaceWords); });
  record.packets.segments = reader.list<StreamSegment>(kSegmentWords.size() + 1, [&] {
    const std::uint32_t kind = reader.word();
    if (kind > static_cast<std::uint32_t>(StreamSegment::Kind::kFastClear)) {
      reader.fail(fmt::format("a segment of kind {}; legal: 0 to 2", kind));
    }
    StreamSegment segment = get_members(StreamSegment{}, kSegmentWords);
    segment.kind = static_cast<StreamSegment::Kind>(kind);
    return segment;
  });
  record.packets.triangles = reader.list<StreamTriangle>(
      kTriangleWords.size(), [&] { return get_members(StreamTriangle{}, kTriangleWords); });
  record.packets.blocks = reader.list<StreamBlock>(1, [&] { return StreamBlock(reader.word()); });
  record.packets.jobs =
      reader.list<StreamJob>(1, [&] { return static_cast<StreamJob>(std::min(reader.word(), 0xFFu)); });
  record.packets.accesses = reader.list<StreamAccess>(2, [&] {
    const std::uint32_t first = reader.word();
    return StreamAccess({first, reader.word()});
  });
  reader.end();
  check(reader, record);
  return record;
}

}  // namespace halfspace
