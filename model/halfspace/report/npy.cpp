#include "halfspace/report/npy.hpp"

#include <fmt/format.h>

#include <bit>
#include <cerrno>
#include <charconv>
#include <cstring>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/byte_source.hpp"

namespace halfspace {
namespace {

static_assert(std::endian::native == std::endian::little, "records are written as they lie in memory");

constexpr std::string_view kMagic{"\x93NUMPY\x01\x00", 8};
constexpr std::size_t kLengthAt = 8;
constexpr std::size_t kDictionaryAt = 10;

/// The text after `key` in the header's dictionary, up to the comma that ends the value.
std::string value_of(const std::string& dictionary, std::string_view key) {
  const std::size_t at = dictionary.find(key);
  if (at == std::string::npos) {
    return "";
  }
  std::string value;
  int depth = 0;
  for (std::size_t i = at + key.size(); i < dictionary.size(); ++i) {
    const char c = dictionary[i];
    depth += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
    if (depth < 0 || (depth == 0 && (c == ',' || c == '}'))) {
      break;
    }
    if (c != ' ') {
      value += c;
    }
  }
  return value;
}

std::vector<std::uint64_t> parse_shape(const std::string& text) {
  std::vector<std::uint64_t> shape;
  const char* at = text.data();
  const char* end = at + text.size();
  while (at < end) {
    std::uint64_t extent = 0;
    const auto [next, error] = std::from_chars(at, end, extent);
    if (error == std::errc{}) {
      shape.push_back(extent);
    }
    at = error == std::errc{} ? next : at + 1;
  }
  return shape;
}

}  // namespace

NpyWriter::NpyWriter(std::filesystem::path path, std::string descr, std::size_t record_size,
                     std::string shape_tail)
    : path_(std::move(path)),
      descr_(std::move(descr)),
      record_size_(record_size),
      shape_tail_(std::move(shape_tail)),
      file_(path_, std::ios::binary) {
  write_header(0);
}

void NpyWriter::write_header(std::uint64_t count) {
  // A fixed width for the count keeps the header's size, so that finish() can write it again.
  std::string dictionary = fmt::format("{{'descr': {}, 'fortran_order': False, 'shape': ({:<20},{}), }}",
                                       descr_, count, shape_tail_);
  const std::size_t total = (kDictionaryAt + dictionary.size() + 1 + 63) / 64 * 64;
  dictionary.resize(total - kDictionaryAt - 1, ' ');
  dictionary += '\n';
  const auto length = static_cast<std::uint16_t>(dictionary.size());
  file_.write(kMagic.data(), kMagic.size());
  file_.write(reinterpret_cast<const char*>(&length), sizeof length);
  file_.write(dictionary.data(), static_cast<std::streamsize>(dictionary.size()));
}

void NpyWriter::append(std::span<const std::byte> bytes) {
  file_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  bytes_ += bytes.size();
}

void NpyWriter::finish() {
  file_.seekp(0);
  write_header(bytes_ / record_size_);
  file_.close();
  if (!file_) {
    throw InputError(fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(errno)));
  }
}

NpyArray read_npy(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_bytes(path);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.size() < kDictionaryAt || text.substr(0, kMagic.size()) != kMagic) {
    throw InputError(fmt::format("{}: not an .npy file of version 1.0", path.string()));
  }
  std::uint16_t length = 0;
  std::memcpy(&length, bytes.data() + kLengthAt, sizeof length);
  const std::string dictionary(text.substr(kDictionaryAt, length));
  if (dictionary.size() != length || value_of(dictionary, "'fortran_order':") != "False") {
    throw InputError(fmt::format("{}: its header is cut off or not of an array in row order", path.string()));
  }
  return {.descr = value_of(dictionary, "'descr':"),
          .shape = parse_shape(value_of(dictionary, "'shape':")),
          .data = {bytes.begin() + static_cast<std::ptrdiff_t>(kDictionaryAt + length), bytes.end()}};
}

}  // namespace halfspace
