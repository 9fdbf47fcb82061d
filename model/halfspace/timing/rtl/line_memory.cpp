#include "halfspace/timing/rtl/line_memory.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "halfspace/units/z_codec.hpp"

namespace halfspace::rtl {
namespace {

static_assert(std::endian::native == std::endian::little,
              "words of ports are copied to and from bytes of memory");

}  // namespace

LineMemory::LineMemory(const Config& config, const std::vector<Surface>& surfaces,
                       const std::vector<ZSurface>& places)
    : parts_(config.z_cache.parts),
      tile_size_(config.tile_walker.tile_size),
      samples_(static_cast<std::uint32_t>(config.tile_walker.tile_size * config.tile_walker.tile_size /
                                          config.z_cache.parts)),
      latency_(static_cast<std::uint64_t>(config.memory.latency)),
      read_bytes_(static_cast<std::uint32_t>(config.memory.read_bytes)),
      write_bytes_(static_cast<std::uint32_t>(config.memory.write_bytes)),
      stride_(std::size_t{4} * samples_) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    bytes_of_line_.insert(bytes_of_line_.end(), places[i].tiles * static_cast<std::uint32_t>(parts_),
                          places[i].line_bytes);
  }
  bytes_.resize(bytes_of_line_.size() * stride_);
  stored_ = bytes_of_line_;
  cleared_.resize(bytes_of_line_.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::uint32_t first = places[i].first_tile * static_cast<std::uint32_t>(parts_);
    const std::uint32_t count = places[i].tiles * static_cast<std::uint32_t>(parts_);
    const std::size_t sample = places[i].line_bytes / samples_;
    const std::uint32_t code =
        largest_code(surfaces[i].format);  // without a clear a surface starts at depth 1
    for (std::uint32_t line = first; line < first + count; ++line) {
      for (std::uint32_t s = 0; s < samples_; ++s) {
        std::memcpy(&bytes(line)[s * sample], &code, sample);
      }
    }
  }
}

void LineMemory::request(std::uint64_t cycle, std::uint32_t line, std::uint32_t bytes) {
  Fill& fill = fills_.emplace_back();
  fill.first = std::max(cycle + latency_, read_free_);
  const std::span<std::uint8_t> from = this->bytes(line).first(bytes);
  fill.bytes.assign(from.begin(), from.end());
  read_free_ = fill.first + std::max<std::uint64_t>(1, fill.bytes.size() / read_bytes_);
}

bool LineMemory::fill(std::uint64_t cycle, std::span<std::uint32_t> words) {
  if (fills_.empty() || cycle < fills_.front().first) {
    return false;
  }
  Fill& fill = fills_.front();
  const std::uint32_t count =
      std::min(read_bytes_, static_cast<std::uint32_t>(fill.bytes.size()) - fill.next);
  std::ranges::fill(words, 0);
  std::memcpy(words.data(), &fill.bytes[fill.next], count);
  fill.next += count;
  if (fill.next == fill.bytes.size()) {
    fills_.pop_front();
  }
  return true;
}

bool LineMemory::write(std::uint32_t line, std::uint32_t bytes, std::span<const std::uint32_t> words) {
  const std::span<std::uint8_t> to = this->bytes(line).first(bytes);
  const std::uint32_t count = std::min(write_bytes_, bytes - written_);
  std::memcpy(&to[written_], words.data(), count);
  written_ += count;
  if (written_ != bytes) {
    return false;
  }
  written_ = 0;
  stored_[line] = bytes;
  cleared_[line] = false;
  return true;
}

void LineMemory::clear(const ZSurface& place) {
  const auto parts = static_cast<std::uint32_t>(parts_);
  std::fill_n(cleared_.begin() + place.first_tile * parts, place.tiles * parts, true);
}

void LineMemory::read_surface(const ZSurface& place, std::uint32_t clear_code, Surface& surface) const {
  const auto parts = static_cast<std::uint32_t>(parts_);
  const ZCodecShape shape{.width = tile_size_,
                          .height = tile_size_ / parts_,
                          .sample_bytes = static_cast<int>(place.line_bytes / samples_)};
  std::vector<std::uint32_t> line_codes;
  for (std::uint32_t tile = 0; tile < place.tiles; ++tile) {
    std::uint32_t* codes =
        surface.codes.tile(static_cast<int>(tile % place.tiles_x), static_cast<int>(tile / place.tiles_x));
    for (std::uint32_t line = (place.first_tile + tile) * parts; line < (place.first_tile + tile + 1) * parts;
         ++line) {
      if (cleared_[line]) {
        std::fill_n(codes, samples_, clear_code);
      } else {
        z_decode({&bytes_[std::size_t{line} * stride_], stored_[line]}, shape, line_codes);
        std::ranges::copy(line_codes, codes);
      }
      codes += samples_;
    }
  }
}

}  // namespace halfspace::rtl
