// A reader in a thread of its own gets what the units wrote, and whatever throws ends the run.
#include <catch2/catch.hpp>
#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "halfspace/machine/threaded_reader.hpp"

namespace halfspace::testing {
namespace {

/// Writes down what it is given, part by part. Part `throws_at` it does not read.
class NotingReader final : public StreamReader {
 public:
  std::optional<std::size_t> throws_at;
  bool throws_at_begin = false;
  bool throws_at_end = false;
  std::chrono::microseconds slow{0};

  std::vector<std::uint32_t> blocks;
  std::vector<std::uint32_t> jobs;
  std::vector<std::size_t> sizes;  ///< of the lists of each part
  std::vector<std::thread::id> threads;
  std::vector<std::string> calls;

  [[nodiscard]] bool wants_tiles() const override { return true; }

  void begin(std::span<const StreamSurface> surfaces, std::uint32_t memory_lines) override {
    note("begin " + std::to_string(surfaces.size()) + " " + std::to_string(memory_lines));
    if (throws_at_begin) {
      throw std::runtime_error("at the beginning");
    }
  }

  void read(const StreamView& part, std::vector<std::uint64_t>* burst_cycles) override {
    std::this_thread::sleep_for(slow);
    if (calls.size() - 1 == throws_at) {
      throw std::runtime_error("in the middle");
    }
    note(burst_cycles == nullptr ? "read" : "read, with cycles");
    for (const StreamBlock& block : part.blocks) {
      blocks.push_back(block.word());
    }
    jobs.insert(jobs.end(), part.jobs.begin(), part.jobs.end());
    sizes.insert(sizes.end(),
                 {part.segments.size(), part.triangles.size(), part.blocks.size(), part.jobs.size(),
                  part.accesses.size(), part.misses.size(), part.miss_burst.size(), part.late.size(),
                  part.tiles.size(), part.live.size(),
                  std::size_t{part.continues_segment} + std::size_t{part.continues_triangle} * 2 +
                      std::size_t{part.open_segment} * 4 + std::size_t{part.open_triangle} * 8});
  }

  void end(std::span<const ZFlush> dirty) override {
    note("end " + std::to_string(dirty.size()));
    if (throws_at_end) {
      throw std::runtime_error("at the end");
    }
  }

 private:
  void note(const std::string& call) {
    calls.push_back(call);
    threads.push_back(std::this_thread::get_id());
  }
};

/// Gives part `number` of a stream away; its lists are gone afterwards.
void write_part(StreamReader& reader, std::size_t number) {
  std::vector<StreamSegment> segments(number % 2);
  std::vector<StreamTriangle> triangles(number % 3);
  std::vector<StreamBlock> blocks;
  std::vector<StreamJob> jobs;
  for (std::size_t i = 0; i < number % 100; ++i) {
    blocks.emplace_back(static_cast<std::uint32_t>(number * 100 + i + 1), 1);
    jobs.push_back(static_cast<StreamJob>(i));
  }
  std::vector<StreamAccess> accesses(number % 5);
  std::vector<ZMiss> misses(number % 7);
  std::vector<std::uint32_t> miss_burst(number % 7 + 1, kNoBurst);
  std::vector<StreamLate> late(number % 3 + 1, StreamLate{.access = kNoBurst});
  std::vector<StreamTile> tiles(jobs.size());
  std::vector<std::uint64_t> live(number % 4, number);
  reader.read({.segments = segments,
               .triangles = triangles,
               .blocks = blocks,
               .jobs = jobs,
               .accesses = accesses,
               .misses = misses,
               .miss_burst = miss_burst,
               .late = late,
               .tiles = tiles,
               .live = live,
               .continues_segment = number % 2 == 0,
               .continues_triangle = number % 4 < 2,
               .open_segment = number % 8 < 4,
               .open_triangle = number % 16 < 8},
              nullptr);
  blocks.assign(blocks.size(), StreamBlock(1, 0));
  jobs.assign(jobs.size(), 77);
}

/// A frame of so many parts.
void write_frame(StreamReader& reader, std::size_t parts) {
  const std::vector<StreamSurface> surfaces(2);
  reader.begin(surfaces, 77);
  for (std::size_t i = 0; i < parts; ++i) {
    write_part(reader, i);
  }
  const std::vector<ZFlush> dirty(3);
  reader.end(dirty);
}

void write_beside(NotingReader& reader, std::size_t parts) {
  ThreadedReader beside(reader);
  write_frame(beside, parts);
  beside.finish();
}

}  // namespace

TEST_CASE("threaded reader: all parts, in order, in one other thread, then the end") {
  for (const std::size_t parts : {0, 1, 2, 7, 8, 9, 500}) {
    for (const int slow : {0, 1, 50}) {
      CAPTURE(parts, slow);
      NotingReader reader;
      reader.slow = std::chrono::microseconds(slow);
      NotingReader expected;
      write_frame(expected, parts);
      write_beside(reader, parts);
      CHECK(reader.blocks == expected.blocks);
      CHECK(reader.jobs == expected.jobs);
      CHECK(reader.sizes == expected.sizes);
      CHECK(reader.calls == expected.calls);
      CHECK(reader.threads.front() == std::this_thread::get_id());
      CHECK(reader.threads.back() != std::this_thread::get_id());
      CHECK(std::vector(reader.threads.begin() + 1, reader.threads.end()) ==
            std::vector(parts + 1, reader.threads.back()));
    }
  }
}

TEST_CASE("threaded reader: asks for what its reader asks for") {
  NotingReader reader;
  const ThreadedReader beside(reader);
  CHECK(beside.wants_tiles());
  CHECK_FALSE(beside.wants_accesses());
  CHECK_FALSE(beside.has_time());
}

TEST_CASE("threaded reader: what the reader throws reaches the writer") {
  for (const int slow : {0, 200}) {
    for (const std::size_t at : {0, 1, 3, 99}) {
      CAPTURE(slow, at);
      NotingReader reader;
      reader.throws_at = at;
      reader.slow = std::chrono::microseconds(at < 99 ? slow : 0);
      REQUIRE_THROWS_WITH(write_beside(reader, 100), "in the middle");
      CHECK(reader.calls.size() == 1 + at);  // and nothing more, not even the end
    }
  }
  NotingReader reader;
  SECTION("at the beginning") {
    reader.throws_at_begin = true;
    CHECK_THROWS_WITH(write_beside(reader, 100), "at the beginning");
    CHECK(reader.calls.size() == 1);
  }
  SECTION("at the end") {
    reader.throws_at_end = true;
    CHECK_THROWS_WITH(write_beside(reader, 100), "at the end");
    CHECK(reader.calls.size() == 102);
  }
}

TEST_CASE("threaded reader: a writer that throws leaves a frame unread, and no thread") {
  for (const int slow : {0, 200}) {
    for (const std::size_t parts : {0, 1, 8, 9, 100}) {
      CAPTURE(slow, parts);
      NotingReader reader;
      reader.slow = std::chrono::microseconds(slow);
      const auto write = [&] {
        ThreadedReader beside(reader);
        beside.begin({}, 0);
        for (std::size_t i = 0; i < parts; ++i) {
          write_part(beside, i);
        }
        throw std::runtime_error("the writer");
      };
      REQUIRE_THROWS_WITH(write(), "the writer");
      CHECK(reader.calls.size() <= 1 + parts);
      CHECK(std::vector(reader.calls.begin() + 1, reader.calls.end()) ==
            std::vector<std::string>(reader.calls.size() - 1, "read"));
    }
  }
}

TEST_CASE("threaded reader: one that throws beside a writer that throws") {
  NotingReader reader;
  reader.throws_at = 2;
  const auto write = [&] {
    ThreadedReader beside(reader);
    beside.begin({}, 0);
    for (std::size_t i = 0; i < 5; ++i) {
      write_part(beside, i);
    }
    throw std::runtime_error("in the middle");
  };
  CHECK_THROWS_WITH(write(), "in the middle");
  CHECK(reader.calls.size() <= 3);
}

TEST_CASE("threaded reader: before the beginning there is nothing to end") {
  NotingReader reader;
  { const ThreadedReader beside(reader); }
  CHECK(reader.calls.empty());
}

}  // namespace halfspace::testing
