#include "halfspace/scene/compression.hpp"

#define ZLIB_CONST  // zlib takes its input as const
#include <fmt/format.h>

#include <lzma.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <stdexcept>

#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

constexpr std::array<unsigned char, 2> kGzipMagic{0x1F, 0x8B};
constexpr std::array<unsigned char, 6> kXzMagic{0xFD, '7', 'z', 'X', 'Z', 0x00};
constexpr std::uint64_t kXzMemoryLimit = std::uint64_t{256} << 20;
constexpr std::size_t kFirstChunk = std::size_t{64} << 10;
constexpr std::uint64_t kMaxStep = std::uint64_t{1} << 30;  // zlib counts in 32 bits
constexpr int kGzipWindow = 15 + 16;  // the largest window; a gzip header, not a zlib one
constexpr int kGzipMemory = 8;
constexpr std::uint32_t kXzPreset = 6;

template <std::size_t N>
bool starts_with(std::span<const std::byte> bytes, const std::array<unsigned char, N>& magic) {
  return bytes.size() >= N && std::equal(magic.begin(), magic.end(), bytes.begin(),
                                         [](unsigned char a, std::byte b) { return std::byte{a} == b; });
}

/// Bytes that grow by doubling and never beyond a limit.
class Output {
 public:
  Output(std::string_view name, std::uint64_t limit) : name_(name), limit_(limit) {}

  /// Free space at the end, at least one byte.
  std::span<std::byte> room() {
    if (size_ == bytes_.size()) {
      bytes_.resize(std::min<std::uint64_t>(limit_ + 1, std::max<std::size_t>(kFirstChunk, 2 * size_)));
    }
    return std::span(bytes_).subspan(size_);
  }

  void add(std::size_t count) {
    size_ += count;
    if (size_ > limit_) {
      throw InputError(
          fmt::format("{}: unpacks to more than {} bytes; legal: at most {} bytes", name_, limit_, limit_));
    }
  }

  std::vector<std::byte> take() {
    bytes_.resize(size_);
    return std::move(bytes_);
  }

 private:
  std::string_view name_;
  std::uint64_t limit_;
  std::vector<std::byte> bytes_;
  std::size_t size_ = 0;
};

struct Inflater {
  z_stream stream{};
  Inflater() {
    if (inflateInit2(&stream, kGzipWindow) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&stream); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
};

std::vector<std::byte> gunzip(std::span<const std::byte> raw, std::string_view name, std::uint64_t limit) {
  Inflater inflater;
  z_stream& stream = inflater.stream;
  Output output(name, limit);
  std::size_t at = 0;
  for (;;) {
    const std::span<std::byte> room = output.room();
    const auto input = static_cast<uInt>(std::min<std::uint64_t>(raw.size() - at, kMaxStep));
    const auto space = static_cast<uInt>(std::min<std::uint64_t>(room.size(), kMaxStep));
    stream.next_in = reinterpret_cast<const Bytef*>(raw.data() + at);
    stream.avail_in = input;
    stream.next_out = reinterpret_cast<Bytef*>(room.data());
    stream.avail_out = space;
    const int status = inflate(&stream, Z_NO_FLUSH);
    at += input - stream.avail_in;
    output.add(space - stream.avail_out);
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    if (status == Z_STREAM_END) {
      if (at == raw.size()) return output.take();
      if (!starts_with(raw.subspan(at), kGzipMagic)) {
        throw InputError(fmt::format(
            "{}: {} bytes follow the gzip stream at byte {}; legal: nothing, or another gzip member", name,
            raw.size() - at, at));
      }
      inflateReset(&stream);
    } else if (status != Z_OK && at == raw.size()) {
      throw InputError(
          fmt::format("{}: the gzip stream is cut short after {} bytes; legal: a whole stream", name, at));
    } else if (status != Z_OK) {
      throw InputError(
          fmt::format("{}: the gzip stream is damaged near byte {} ({}); legal: an intact stream", name, at,
                      stream.msg != nullptr ? stream.msg : "no progress"));
    }
  }
}

struct LzmaStream {
  lzma_stream stream = LZMA_STREAM_INIT;
  LzmaStream() = default;
  ~LzmaStream() { lzma_end(&stream); }
  LzmaStream(const LzmaStream&) = delete;
  LzmaStream& operator=(const LzmaStream&) = delete;
};

std::vector<std::byte> unxz(std::span<const std::byte> raw, std::string_view name, std::uint64_t limit) {
  LzmaStream decoder;
  lzma_stream& stream = decoder.stream;
  if (lzma_stream_decoder(&stream, kXzMemoryLimit, LZMA_CONCATENATED) != LZMA_OK) throw std::bad_alloc();
  stream.next_in = reinterpret_cast<const std::uint8_t*>(raw.data());
  stream.avail_in = raw.size();
  Output output(name, limit);
  for (;;) {
    const std::span<std::byte> room = output.room();
    stream.next_out = reinterpret_cast<std::uint8_t*>(room.data());
    stream.avail_out = room.size();
    const lzma_ret status = lzma_code(&stream, LZMA_FINISH);
    output.add(room.size() - stream.avail_out);
    switch (status) {
      case LZMA_OK:
        break;
      case LZMA_STREAM_END:
        return output.take();
      case LZMA_MEM_ERROR:
        throw std::bad_alloc();
      case LZMA_MEMLIMIT_ERROR:
        throw InputError(fmt::format("{}: the xz stream needs {} bytes to unpack; legal: at most {}", name,
                                     lzma_memusage(&stream), kXzMemoryLimit));
      case LZMA_BUF_ERROR:
        throw InputError(fmt::format("{}: the xz stream is cut short after {} bytes; legal: a whole stream",
                                     name, raw.size()));
      default:
        throw InputError(
            fmt::format("{}: the xz stream is damaged or followed by something else near byte {}; legal: "
                        "intact xz streams",
                        name, raw.size() - stream.avail_in));
    }
  }
}

}  // namespace

std::vector<std::byte> decompress(std::vector<std::byte> raw, std::string_view name, std::uint64_t limit) {
  if (starts_with(raw, kGzipMagic)) return gunzip(raw, name, limit);
  if (starts_with(raw, kXzMagic)) return unxz(raw, name, limit);
  return raw;
}

std::vector<std::byte> compress_gzip(std::span<const std::byte> plain) {
  if (plain.size() > std::numeric_limits<uInt>::max()) {
    throw InputError(fmt::format("gzip: {} bytes to pack; legal: at most {}", plain.size(),
                                 std::numeric_limits<uInt>::max()));
  }
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzipWindow, kGzipMemory,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
  std::vector<std::byte> packed(deflateBound(&stream, plain.size()));
  stream.next_in = reinterpret_cast<const Bytef*>(plain.data());
  stream.avail_in = static_cast<uInt>(plain.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out =
      static_cast<uInt>(std::min<std::size_t>(packed.size(), std::numeric_limits<uInt>::max()));
  const int status = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("gzip: packing failed");
  return packed;
}

std::vector<std::byte> compress_xz(std::span<const std::byte> plain) {
  std::vector<std::byte> packed(lzma_stream_buffer_bound(plain.size()));
  std::size_t size = 0;
  const lzma_ret status = lzma_easy_buffer_encode(
      kXzPreset, LZMA_CHECK_CRC64, nullptr, reinterpret_cast<const std::uint8_t*>(plain.data()), plain.size(),
      reinterpret_cast<std::uint8_t*>(packed.data()), &size, packed.size());
  if (status == LZMA_MEM_ERROR) throw std::bad_alloc();
  if (status != LZMA_OK) throw std::runtime_error("xz: packing failed");
  packed.resize(size);
  return packed;
}

}  // namespace halfspace
