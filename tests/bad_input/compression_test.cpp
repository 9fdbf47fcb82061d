// Is a damaged, cut or hostile gzip or xz stream refused without harm?
#include "halfspace/scene/compression.hpp"

#include <lzma.h>

#include <catch2/catch.hpp>

#include "../scene/fixture.hpp"

using namespace halfspace;
using namespace halfspace::test;

namespace {

constexpr std::uint64_t kLimit = 1 << 20;

std::vector<std::byte> plain() {
  std::vector<std::byte> bytes(3000);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i * i >> 3);
  return bytes;
}

std::string error_of_stream(const std::vector<std::byte>& packed, std::uint64_t limit = kLimit) {
  return error_of([&] { return decompress(packed, "f", limit); });
}

}  // namespace

TEST_CASE("a packed stream cut short anywhere after its magic is refused") {
  const auto pack = GENERATE(compress_gzip, compress_xz);
  const std::vector<std::byte> packed = pack(plain());
  for (std::size_t size = 6; size < packed.size(); ++size) {
    INFO(size);
    CHECK(error_of_stream({packed.begin(), packed.begin() + static_cast<std::ptrdiff_t>(size)}) !=
          "no error");
  }
}

TEST_CASE("any one byte of a packed stream changed gives the same bytes or an InputError") {
  const auto pack = GENERATE(compress_gzip, compress_xz);
  const std::vector<std::byte> bytes = plain();
  const std::vector<std::byte> packed = pack(bytes);
  for (std::size_t at = 6; at < packed.size(); ++at) {
    for (const int change : {0x01, 0x80, 0xFF}) {
      std::vector<std::byte> damaged = packed;
      damaged[at] ^= static_cast<std::byte>(change);
      INFO("byte " << at << " xor " << change);
      try {
        if (decompress(damaged, "f", kLimit) != bytes) FAIL_CHECK("other bytes, and no error");
      } catch (const InputError& error) {
        CHECK(std::string_view(error.what()).starts_with("f: "));
      }
    }
  }
}

TEST_CASE("errors of packed streams say what is wrong") {
  const std::vector<std::byte> gzip = compress_gzip(plain());
  const std::vector<std::byte> xz = compress_xz(plain());
  const auto cut = [](std::vector<std::byte> bytes) {
    bytes.resize(bytes.size() - 1);
    return bytes;
  };
  const auto more = [](std::vector<std::byte> bytes) {
    bytes.insert(bytes.end(), 16, std::byte{'x'});
    return bytes;
  };
  CHECK(error_of_stream(cut(gzip)) == "f: the gzip stream is cut short after " +
                                          std::to_string(gzip.size() - 1) + " bytes; legal: a whole stream");
  CHECK(error_of_stream(cut(xz)) == "f: the xz stream is cut short after " + std::to_string(xz.size() - 1) +
                                        " bytes; legal: a whole stream");
  CHECK(error_of_stream(more(gzip)) == "f: 16 bytes follow the gzip stream at byte " +
                                           std::to_string(gzip.size()) +
                                           "; legal: nothing, or another gzip member");
  CHECK(error_of_stream(more(xz)).find("damaged or followed by something else") != std::string::npos);
}

TEST_CASE("a stream that unpacks to too much is refused at the limit") {
  const auto pack = GENERATE(compress_gzip, compress_xz);
  const std::vector<std::byte> bomb = pack(std::vector<std::byte>(std::size_t{64} << 20));
  CHECK(bomb.size() < 100000);
  CHECK(error_of_stream(bomb) == "f: unpacks to more than 1048576 bytes; legal: at most 1048576 bytes");
  const std::vector<std::byte> fits = pack(std::vector<std::byte>(1000));
  CHECK(decompress(fits, "f", 1000).size() == 1000);
  CHECK(error_of_stream(fits, 999) == "f: unpacks to more than 999 bytes; legal: at most 999 bytes");
}

TEST_CASE("an xz stream that asks for a huge dictionary is refused") {
  std::vector<std::byte> packed = compress_xz(plain());
  // The header of the first block, from byte 12: its size / 4 - 1, ..., filter LZMA2, 1, dictionary, ...,
  // CRC.
  constexpr std::size_t kBlock = 12;
  const std::size_t size = 4 * (std::to_integer<std::size_t>(packed[kBlock]) + 1);
  std::size_t filter = kBlock + 2;
  while (packed[filter] != std::byte{0x21} || packed[filter + 1] != std::byte{1}) ++filter;
  REQUIRE(filter + 2 < kBlock + size);
  packed[filter + 2] = std::byte{39};  // 3 GiB
  const std::uint32_t crc =
      lzma_crc32(reinterpret_cast<const std::uint8_t*>(packed.data()) + kBlock, size - 4, 0);
  std::memcpy(packed.data() + kBlock + size - 4, &crc, 4);
  const std::string error = error_of_stream(packed);
  CHECK(error.starts_with("f: the xz stream needs 322"));
  CHECK(error.ends_with(" bytes to unpack; legal: at most 268435456"));
}
