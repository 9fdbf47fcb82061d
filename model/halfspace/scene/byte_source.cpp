#include "halfspace/scene/byte_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/compression.hpp"
#include "halfspace/scene/quote.hpp"

namespace halfspace {
namespace {

constexpr std::size_t kReadChunk = std::size_t{1} << 20;

std::string last_error() { return std::generic_category().message(errno != 0 ? errno : EIO); }

[[noreturn]] void fail_to_read(const std::string& name, const std::string& reason) {
  throw InputError(fmt::format("{}: cannot be read ({}); legal: a readable file", name, reason));
}

}  // namespace

std::string display_name(const std::filesystem::path& path) { return printable(path.string()); }

std::vector<std::byte> read_raw_bytes(const std::filesystem::path& path, std::uint64_t limit) {
  const std::string name = display_name(path);
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    fail_to_read(name, error ? error.message() : "No such file or directory");
  }
  if (std::filesystem::is_directory(status)) fail_to_read(name, "it is a directory");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) fail_to_read(name, last_error());
  std::vector<std::byte> bytes;
  if (const std::uintmax_t expected = std::filesystem::file_size(path, error); !error && expected <= limit) {
    bytes.reserve(expected + kReadChunk);
  }
  std::size_t size = 0;
  while (file) {
    bytes.resize(std::max(bytes.size(), size + kReadChunk));
    file.read(reinterpret_cast<char*>(bytes.data() + size), kReadChunk);
    size += static_cast<std::size_t>(file.gcount());
    if (size > limit) {
      throw InputError(
          fmt::format("{}: has more than {} bytes; legal: at most {} bytes", name, limit, limit));
    }
  }
  if (file.bad()) fail_to_read(name, last_error());
  bytes.resize(size);
  return bytes;
}

std::vector<std::byte> read_bytes(const std::filesystem::path& path, std::uint64_t limit) {
  return decompress(read_raw_bytes(path, limit), display_name(path), limit);
}

void write_bytes(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const std::string name = display_name(path);
  std::filesystem::path part = path;
  part += ".part";
  errno = 0;
  {
    std::ofstream file(part, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) {
      const std::string reason = last_error();
      std::error_code ignored;
      std::filesystem::remove(part, ignored);
      throw InputError(fmt::format("{}: cannot be written ({}); legal: a writable path", name, reason));
    }
  }
  std::error_code error;
  std::filesystem::rename(part, path, error);
  if (error) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw InputError(
        fmt::format("{}: cannot be written ({}); legal: a writable path", name, error.message()));
  }
}

}  // namespace halfspace
