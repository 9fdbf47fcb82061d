// Is every damaged PTF1 file refused with an InputError, or read as a valid frame, and nothing else?
#include "halfspace/scene/ptf.hpp"

#include <catch2/catch.hpp>

#include "../scene/fixture.hpp"
#include "halfspace/scene/validate.hpp"

using namespace halfspace;
using namespace halfspace::test;

namespace {

std::string plain_ptf() { return as_text(format_ptf(small_frame())); }

std::string error_of_bytes(std::string_view bytes) {
  return error_of([&] { return parse_ptf(as_bytes(bytes), "f"); });
}

std::string with_word(std::size_t at, std::uint32_t value) {
  std::string bytes = plain_ptf();
  std::memcpy(bytes.data() + at, &value, 4);
  return bytes;
}

constexpr std::size_t kTargets = 64;
constexpr std::size_t kCommands = kTargets + 2 * 32;
constexpr std::size_t kVertices = kCommands + 2 * 128;
constexpr std::size_t kIndices = kVertices + 5 * 16;
constexpr std::size_t kMeta = kIndices + 6 * 4;

}  // namespace

TEST_CASE("a PTF1 file cut short anywhere is refused") {
  const std::string bytes = plain_ptf();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    INFO(size);
    CHECK(error_of_bytes(std::string_view(bytes).substr(0, size)) != "no error");
  }
  CHECK(error_of_bytes("") == "f: has 0 bytes; legal: 64 or more, a PTF1 header");
  CHECK(error_of_bytes(bytes.substr(0, 63)) == "f: has 63 bytes; legal: 64 or more, a PTF1 header");
  CHECK(error_of_bytes(bytes.substr(0, 64)) ==
        "f: targets are 2 x 32 bytes from byte 64, the file has 64; legal: within the file");
  CHECK(error_of_bytes(bytes.substr(0, kCommands)) ==
        "f: commands are 2 x 128 bytes from byte 128, the file has 128; legal: within the file");
  CHECK(error_of_bytes(bytes.substr(0, kVertices)) ==
        "f: vertices are 5 x 16 bytes from byte 384, the file has 384; legal: within the file");
  CHECK(error_of_bytes(bytes.substr(0, kIndices)) ==
        "f: indices are 6 x 4 bytes from byte 464, the file has 464; legal: within the file");
  CHECK(error_of_bytes(bytes.substr(0, kMeta)) ==
        "f: meta bytes are 23 x 1 bytes from byte 488, the file has 488; legal: within the file");
  CHECK(error_of_bytes(bytes + "x") == "f: 1 bytes follow the last section at byte 511; legal: nothing");
}

TEST_CASE("any one byte changed gives a valid frame or an InputError") {
  const std::string bytes = plain_ptf();
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (const int change : {0x01, 0x02, 0x10, 0x40, 0x80, 0x7F, 0xFF}) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ change);
      INFO("byte " << at << " xor " << change);
      try {
        const Frame frame = parse_ptf(as_bytes(damaged), "f");
        validate(frame);
      } catch (const InputError& error) {
        CHECK(std::string_view(error.what()).starts_with("f: "));
      }
    }
  }
}

TEST_CASE("what a header says is checked before anything is allocated") {
  constexpr std::uint32_t kHuge = 0xFFFFFFFF;
  CHECK(error_of_bytes(with_word(0, 0x32465450)) ==
        "f: starts with bytes 50 54 46 32; legal: 50 54 46 31 (\"PTF1\")");
  CHECK(error_of_bytes(with_word(4, 2)) == "f: version is 2; legal: 1");
  CHECK(error_of_bytes(with_word(8, 63)) == "f: header_size is 63; legal: 64 or more");
  CHECK(error_of_bytes(with_word(12, 31)) == "f: target_size is 31; legal: 32 or more");
  CHECK(error_of_bytes(with_word(16, 0)) == "f: command_size is 0; legal: 128 or more");
  CHECK(error_of_bytes(with_word(8, kHuge)) ==
        "f: header bytes are 4294967295 x 1 bytes from byte 0, the file has 511; legal: within the file");
  CHECK(error_of_bytes(with_word(28, kHuge)) ==
        "f: vertices are 4294967295 x 16 bytes from byte 384, the file has 511; legal: within the file");
  for (const std::size_t field : {12, 16, 20, 24, 32, 36}) {
    INFO(field);
    CHECK(error_of_bytes(with_word(field, kHuge)).find("legal: within the file") != std::string::npos);
  }
  // The largest product of all: still no overflow.
  std::string bytes = with_word(12, kHuge);
  std::memcpy(bytes.data() + 20, &kHuge, 4);
  CHECK(
      error_of_bytes(bytes) ==
      "f: targets are 4294967295 x 4294967295 bytes from byte 64, the file has 511; legal: within the file");
}

TEST_CASE("a frame cannot be written into a folder that is not there") {
  const TempFolder folder;
  const std::string path = folder.path("none/small.ptf").string();
  CHECK(error_of([&] {
          write_ptf(small_frame(), path);
          return 0;
        }) == path + ": cannot be written (No such file or directory); legal: a writable path");
}
