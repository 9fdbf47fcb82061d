/// Does a file of tile jobs come back as it was written? Is a broken one refused, with the reason?
#include "halfspace/report/tile_job_file.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

constexpr Widths kWidths{.SubPixelBits = 6, .TileSize = 16};

/// A path in the temporary directory, removed with what is there.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("halfspace_" + name + ".jobs")) {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() { std::filesystem::remove(path_); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

void write_two_jobs(const std::filesystem::path& path) {
  TileJob job;
  job.tile_x = 1023;
  job.e = {-1, 0, 1};
  job.a = {-5, 6, 7};
  job.y_last = 15;
  TileJobWriter writer(path, kWidths);
  writer.write(job);
  job.slot = 255;
  writer.write(job);
  writer.close();
}

void overwrite(const std::filesystem::path& path, std::streamoff offset, char byte) {
  std::fstream stream(path, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(offset);
  stream.put(byte);
}

TEST_CASE("tile jobs come back from a file") {
  const TemporaryFile file("round_trip");
  write_two_jobs(file.path());
  const TileJobFile read = read_tile_jobs(file.path());
  CHECK(read.widths.TileSize == 16);
  CHECK(read.widths.SubPixelBits == 6);
  REQUIRE(read.jobs.size() == 2);
  CHECK(read.jobs[0].tile_x == 1023);
  CHECK(read.jobs[0].e == std::array<std::int64_t, 3>{-1, 0, 1});
  CHECK(read.jobs[0].a == std::array<std::int32_t, 3>{-5, 6, 7});
  CHECK(read.jobs[0].y_last == 15);
  CHECK(read.jobs[1].slot == 255);
}

TEST_CASE("a file of tile jobs that was not closed leaves nothing") {
  const TemporaryFile file("not_closed");
  { TileJobWriter writer(file.path(), kWidths); }
  CHECK_FALSE(std::filesystem::exists(file.path()));
  CHECK_FALSE(std::filesystem::exists(file.path().string() + ".part"));
}

TEST_CASE("broken files of tile jobs are refused") {
  const TemporaryFile file("broken");
  write_two_jobs(file.path());
  const auto check_refused = [&](const std::string& reason) {
    CHECK_THROWS_WITH(read_tile_jobs(file.path()), Catch::Contains(reason));
    CHECK_THROWS_AS(read_tile_jobs(file.path()), InputError);
  };
  SECTION("magic") {
    overwrite(file.path(), 0, 'X');
    check_refused("does not start with HSTJ");
  }
  SECTION("version") {
    overwrite(file.path(), 4, 9);
    check_refused("version 9, expected 1");
  }
  SECTION("tile size") {
    overwrite(file.path(), 8, 5);
    check_refused("tile size 5, expected 4, 8 or 16");
  }
  SECTION("sub-pixel bits") {
    overwrite(file.path(), 12, 3);
    check_refused("sub-pixel bits 3, expected 4 to 8");
  }
  SECTION("record size") {
    overwrite(file.path(), 16, 1);
    check_refused("records of 1 words");
  }
  SECTION("cut off in a record") {
    std::filesystem::resize_file(file.path(), std::filesystem::file_size(file.path()) - 3);
    check_refused("ends within record 1");
  }
  SECTION("cut off in the header") {
    std::filesystem::resize_file(file.path(), 7);
    check_refused("shorter than the header");
  }
  SECTION("bits above the packet") {
    overwrite(file.path(), static_cast<std::streamoff>(std::filesystem::file_size(file.path())) - 1, '\x80');
    check_refused("bits above the packet are set");
  }
  SECTION("no file") {
    std::filesystem::remove(file.path());
    check_refused("cannot be opened");
  }
}

}  // namespace
}  // namespace halfspace
