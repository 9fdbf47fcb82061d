// Does a surface cost memory only where something is drawn?
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "../frames.hpp"
#include "halfspace/scene/ptf.hpp"
#include "program.hpp"

using namespace halfspace::testing;

namespace {

constexpr std::uint32_t kSide = 16384;
constexpr long kMostKilobytes = 50'000;

/// Peak memory of `halfspace run` in kilobytes. The test's own, when it starts the program, counts too.
long peak_of_run(const fs::path& frame, const char* fidelity) {
  malloc_trim(0);
  const pid_t child = fork();
  if (child == 0) {
    if (std::freopen("/dev/null", "w", stdout) != nullptr) {
      execl(HALFSPACE_PROGRAM, HALFSPACE_PROGRAM, "run", frame.c_str(), "--fidelity", fidelity, nullptr);
    }
    _exit(127);
  }
  REQUIRE(child > 0);
  int status = -1;
  rusage usage{};
  REQUIRE(wait4(child, &status, 0, &usage) == child);
  REQUIRE(WIFEXITED(status));
  REQUIRE(WEXITSTATUS(status) == 0);
  return usage.ru_maxrss;
}

}  // namespace

TEST_CASE("a frame of 16384x16384 in which nothing is drawn takes less than 50 MB") {
  const Place place;
  for (const int clears : {0, 1, 300}) {
    FrameBuilder builder(kSide);
    builder.frame.commands.clear();
    for (int i = 0; i < clears; ++i) {
      builder.clear(i % 2 == 0 ? 1.0f : 0.5f);
    }
    const fs::path file = place.path / "empty.ptf";
    halfspace::write_ptf(builder.frame, file);
    for (const char* fidelity : {"functional", "recurrence"}) {
      CAPTURE(clears, fidelity);
      CHECK(peak_of_run(file, fidelity) < kMostKilobytes);
    }
  }
}

TEST_CASE("a triangle on 16384x16384 takes the memory of its tiles") {
  const Place place;
  FrameBuilder builder(kSide);
  builder.draw({{8000, 8000, 0.5}, {8256, 8000, 0.5}, {8000, 8256, 0.5}});
  const fs::path file = place.path / "triangle.ptf";
  halfspace::write_ptf(builder.frame, file);
  CHECK(peak_of_run(file, "functional") < kMostKilobytes);
}

TEST_CASE("bench surfaces has a row for each frame, and draws on ever more tiles") {
  const Place place;
  const Outcome outcome = place.run("bench surfaces --side 128 --repeat 1");
  CAPTURE(outcome.out, outcome.err);
  REQUIRE(outcome.status == 0);
  for (const char* row :
       {"\n| nothing | 0 | ", "\n| a clear | 0 | ", "\n| 1000 clears | 0 | ", "\n| a square | 1 | ",
        "\n| a square | 64 | ", "\n| scattered | 1 | ", "\n| scattered | 64 | "}) {
    CAPTURE(row);
    CHECK(outcome.out.find(row) != std::string::npos);
  }
}
