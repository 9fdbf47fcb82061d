// What a mesh has that is not in its frame is said, by every subcommand, once for each input.
#include <catch2/catch.hpp>
#include <fstream>

#include "program.hpp"

using namespace halfspace::testing;

TEST_CASE("what a reader leaves out is said on stderr by every subcommand, and by info in its listing") {
  const Place place;
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ofstream(place.path / "odd.obj") << triangle << "curv 0 1 1 2\ncdc 1 2 3\ncurv2 1 2\nf 1 2\n";
  std::ofstream(place.path / "clean.obj") << triangle;
  const std::string odd = (place.path / "odd.obj").string();
  const std::string clean = (place.path / "clean.obj").string();
  const std::string what = "left out: faces with fewer than three corners (1), free-form curves (3)\n";
  const std::string line = "halfspace: " + odd + ": " + what;
  const std::string record = " --out " + (place.path / "r").string() + " ";
  for (const std::string& command : std::initializer_list<std::string>{
           "run --size 64x64 ", "run --reference exact --size 64x64 ", "info ", "ledger --size 64x64 ",
           "record --size 64x64 " + record, "bench stages --repeat 1 ", "bench hi-z ", "bench depth-traffic ",
           "bench time --repeat 1 ", "bench read --repeat 2 ", "bench sampled --repeat 1 --machines 2 ",
           "bench speed --repeat 1 --without functional_pixels,scalar_loop,llvmpipe "}) {
    CAPTURE(command);
    const Outcome outcome = place.run(command + odd);
    CHECK(outcome.status == 0);
    CHECK(outcome.err == line);
    const Outcome silent = place.run(command + clean);
    CHECK(silent.status == 0);
    CHECK(silent.err.empty());
  }
  CHECK(place.run("run --size 64x64 " + odd + " " + clean + " " + odd).err == line + line);
  CHECK(place.run("run --size 64x64 --prepass " + odd).err == line);
  CHECK(place.run("info " + odd).out.find("\n" + what) != std::string::npos);
  CHECK(place.run("info " + clean).out.find("left out") == std::string::npos);
}
