#include "halfspace/report/tile_job_file.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include "halfspace/numerics/error.hpp"
#include "halfspace/units/packing.hpp"

namespace halfspace {
namespace {

constexpr std::uint32_t kMagic = 0x4a545348;  // "HSTJ"
constexpr std::uint32_t kVersion = 1;
using Header = std::array<std::uint32_t, 5>;

/// Words as they lie in the file, or back.
void swap_on_big_endian(std::span<std::uint32_t> words) {
  if constexpr (std::endian::native == std::endian::big) {
    for (std::uint32_t& word : words) {
      word = word >> 24 | (word >> 8 & 0xff00) | (word << 8 & 0xff0000) | word << 24;
    }
  }
}

void write_words(std::ostream& stream, std::span<std::uint32_t> words) {
  swap_on_big_endian(words);
  stream.write(reinterpret_cast<const char*>(words.data()), static_cast<std::streamsize>(words.size_bytes()));
}

/// False at the end of the file, or in front of a part of `words`.
bool read_words(std::istream& stream, std::span<std::uint32_t> words) {
  stream.read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size_bytes()));
  swap_on_big_endian(words);
  return stream.gcount() == static_cast<std::streamsize>(words.size_bytes());
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw InputError(path.string() + ": " + what);
}

Widths check_header(const std::filesystem::path& path, const Header& header) {
  const auto [magic, version, tile_size, sub_pixel_bits, record_words] = header;
  if (magic != kMagic) {
    fail(path, "not a file of tile jobs: it does not start with HSTJ");
  }
  if (version != kVersion) {
    fail(path, "version " + std::to_string(version) + ", expected " + std::to_string(kVersion));
  }
  if (tile_size != 4 && tile_size != 8 && tile_size != 16) {
    fail(path, "tile size " + std::to_string(tile_size) + ", expected 4, 8 or 16");
  }
  if (sub_pixel_bits < 4 || sub_pixel_bits > 8) {
    fail(path, "sub-pixel bits " + std::to_string(sub_pixel_bits) + ", expected 4 to 8");
  }
  const Widths widths{.SubPixelBits = static_cast<int>(sub_pixel_bits),
                      .TileSize = static_cast<int>(tile_size)};
  const std::size_t expected = words_for(packed_bits<TileJob>(widths));
  if (record_words != expected) {
    fail(path, "records of " + std::to_string(record_words) + " words, expected " + std::to_string(expected));
  }
  return widths;
}

}  // namespace

TileJobWriter::TileJobWriter(std::filesystem::path path, const Widths& widths)
    : path_(std::move(path)),
      partial_(path_.string() + ".part"),
      widths_(widths),
      words_(words_for(packed_bits<TileJob>(widths))),
      stream_(partial_, std::ios::binary) {
  if (!stream_) {
    fail(partial_, "cannot be created");
  }
  Header header = {kMagic, kVersion, static_cast<std::uint32_t>(widths.TileSize),
                   static_cast<std::uint32_t>(widths.SubPixelBits),
                   static_cast<std::uint32_t>(words_.size())};
  write_words(stream_, header);
}

TileJobWriter::~TileJobWriter() {
  if (stream_.is_open()) {
    stream_.close();
    std::error_code ignored;  // a destructor has nobody to tell
    std::filesystem::remove(partial_, ignored);
  }
}

void TileJobWriter::write(const TileJob& job) {
  pack(job, widths_, words_);
  write_words(stream_, words_);
}

void TileJobWriter::close() {
  stream_.close();
  if (!stream_) {
    fail(partial_, "cannot be written");
  }
  std::filesystem::rename(partial_, path_);
}

TileJobFile read_tile_jobs(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    fail(path, "cannot be opened");
  }
  Header header{};
  if (!read_words(stream, header)) {
    fail(path, "shorter than the header of a file of tile jobs");
  }
  TileJobFile file{check_header(path, header), {}};
  const int bits = packed_bits<TileJob>(file.widths);
  std::vector<std::uint32_t> words(words_for(bits));
  while (read_words(stream, words)) {
    if (bits % 32 != 0 && words.back() >> bits % 32 != 0) {
      fail(path, "record " + std::to_string(file.jobs.size()) + ": bits above the packet are set");
    }
    file.jobs.push_back(unpack<TileJob>(words, file.widths));
  }
  if (stream.gcount() != 0) {
    fail(path, "ends within record " + std::to_string(file.jobs.size()));
  }
  return file;
}

}  // namespace halfspace
