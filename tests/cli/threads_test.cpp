// --threads: the same bytes in every file, and what it refuses.
#include <string>

#include "program.hpp"

namespace halfspace::testing {
namespace {

void check_same_files(const Place& place, const std::string& ours, const std::string& other) {
  REQUIRE(entries(place.path / ours) == entries(place.path / other));
  for (const std::string& name : entries(place.path / ours)) {
    CAPTURE(name);
    CHECK(slurp(place.path / ours / name) == slurp(place.path / other / name));
  }
}

}  // namespace

TEST_CASE("threads: run writes the same files with any number") {
  const Place place;
  const std::string to = " --no-pictures --out " + place.path.string() + "/";
  for (const char* options :
       {"functional", "recurrence", "recurrence --core readable", "recurrence --quads --tiles",
        "recurrence --timeline", "recurrence --stall sink:20:8"}) {
    CAPTURE(options);
    const std::string run = "run " + scene("vkcube.ptf.xz") + " --fidelity " + std::string(options) + to;
    REQUIRE(place.run(run + "one").status == 0);
    for (const std::string threads : {"2", "3"}) {
      REQUIRE(place.run(run + threads + " --threads " + threads).status == 0);
      check_same_files(place, "one", threads);
    }
  }
  for (const std::string fidelity : {"functional", "recurrence"}) {
    const std::string truck = "run " + scene("cc0_truck.ptf.xz") + " --fidelity " + fidelity + to;
    REQUIRE(place.run(truck + "one").status == 0);
    REQUIRE(place.run(truck + "2 --threads 2").status == 0);
    check_same_files(place, "one", "2");
  }
}

TEST_CASE("threads: retime writes the same files with any number") {
  const Place place;
  const auto path = [&](const std::string& name) { return (place.path / name).string(); };
  REQUIRE(place.run("record " + scene("cc0_truck.ptf.xz") + " --out " + path("one.rec")).status == 0);
  for (const std::string fidelity : {"recurrence", "sampled"}) {
    const std::string retime = "retime " + path("one.rec") + " --fidelity " + fidelity +
                               " --sweep memory.latency=20,200,5000 --sweep tile_walker.fifo=4,16,64 "
                               "--sweep z_cache.lines=16,128 --sweep early_z.pending=8,32,64 --csv ";
    REQUIRE(place.run(retime + path("one.csv") + " --json " + path("one.json")).status == 0);
    for (const std::string threads : {"2", "3", "64"}) {
      CAPTURE(fidelity, threads);
      REQUIRE(place.run(retime + path("more.csv") + " --json " + path("more.json") + " --threads " + threads)
                  .status == 0);
      CHECK(slurp(path("more.csv")) == slurp(path("one.csv")));
      CHECK(slurp(path("more.json")) == slurp(path("one.json")));
    }
  }
}

TEST_CASE("threads: a number that is legal, of a fidelity that uses them") {
  const Place place;
  const std::string run = "run " + scene("vkcube.ptf.xz") + " ";
  for (const std::string number : {"0", "-1", "65", "two"}) {
    check_error(place.run(run + "--threads " + number), {"--threads", number.c_str()});
    check_error(place.run("retime none.rec --threads " + number), {"--threads", number.c_str()});
  }
  check_error(place.run(run + "--threads 65"), {"65", "1 to 64"});
  for (const char* fidelity : {"systemc", "rtl"}) {
    check_error(place.run(run + "--threads 2 --fidelity " + fidelity),
                {fidelity, "--threads", "legal", "functional, recurrence"});
  }
  CHECK(place.run(run + "--threads 1 --fidelity systemc").status == 0);
}

}  // namespace halfspace::testing
