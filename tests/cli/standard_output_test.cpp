// A table that does not arrive is an error, in every subcommand.
#include <catch2/catch.hpp>
#include <csignal>

#include "program.hpp"

using namespace halfspace::testing;

namespace {

/// The program with its output sent elsewhere, by the shell.
Outcome run_to(const Place& place, const std::string& arguments, const std::string& redirection) {
  const std::string command = std::string(HALFSPACE_PROGRAM) + " " + arguments + " 2>" +
                              (place.path / "err").string() + " " + redirection;
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, "", slurp(place.path / "err")};
}

}  // namespace

TEST_CASE("a table that cannot be written is an error") {
  const Place place;
  const std::string in = place.path.string();
  REQUIRE(place.run("record " + kCube + " --out " + in + "/record").status == 0);
  REQUIRE(place.run("run " + kCube + " --no-pictures --out " + in + "/a").status == 0);
  for (const std::string& arguments :
       std::initializer_list<std::string>{"--help",
                                          "--version",
                                          "run --help",
                                          "run " + kCube,
                                          "run " + kCube + " --reference exact",
                                          "info " + kCube,
                                          "info --commands " + scene("cc0_truck.ptf.xz"),
                                          "config",
                                          "config --toml",
                                          "config --markdown",
                                          "config --rtl",
                                          "diff " + in + "/a " + in + "/a",
                                          "record " + kCube + " --out " + in + "/again",
                                          "retime " + in + "/record",
                                          "ledger " + kCube,
                                          "ledger --json " + kCube,
                                          "stress --cases 1 --family mesh",
                                          "stress --exhaustive --every 512",
                                          "stress --cases 1 --write " + in + "/cases",
                                          "bench stages --repeat 1 synthetic:one_triangle",
                                          "bench hi-z synthetic:one_triangle",
                                          "bench depth-traffic synthetic:one_triangle",
                                          "bench time --repeat 1 synthetic:one_triangle"}) {
    CAPTURE(arguments);
    check_error(run_to(place, arguments, ">/dev/full"),
                {"halfspace: standard output: cannot be written: No space left on device"});
    CHECK(run_to(place, arguments, ">/dev/full").status == 3);
    const Outcome closed = run_to(place, arguments, ">&-");
    check_error(closed, {"halfspace: standard output: cannot be written: Bad file descriptor"});
    CHECK(closed.status == 3);
  }
}

TEST_CASE("a closed standard output does not get into a result") {
  const Place place;
  const std::string in = place.path.string();
  const std::string run = "run " + kCube + " --quads --out " + in;
  REQUIRE(place.run(run + "/a").status == 0);
  CHECK(run_to(place, run + "/b", "<&- >&-").status == 3);
  CHECK(place.run("diff " + in + "/a " + in + "/b").status == 0);
  CHECK(slurp(place.path / "a" / "quads.npy") == slurp(place.path / "b" / "quads.npy"));
}

TEST_CASE("an error with nowhere to say it still has its status") {
  const Place place;
  const std::string program = HALFSPACE_PROGRAM;
  CHECK(WEXITSTATUS(std::system((program + " run nothing.ptf 2>&-").c_str())) == 3);
  CHECK(WEXITSTATUS(std::system((program + " run nothing.ptf 2>/dev/full").c_str())) == 3);
  CHECK(WEXITSTATUS(std::system((program + " nonsense 2>&- >&- <&-").c_str())) == 2);
}

TEST_CASE("a pipe that nobody reads any more ends the program by its signal, as it does others") {
  // The shell reports the signal of a program of a pipeline as 128 and its number.
  const Place place;
  const std::string status = (place.path / "status").string();
  const std::string command = "{ { sleep 1; " + std::string(HALFSPACE_PROGRAM) +
                              " config --markdown; echo $? >" + status + "; } 2>" +
                              (place.path / "err").string() + "; } | true";
  REQUIRE(std::system(command.c_str()) == 0);
  CHECK(slurp(status) == std::to_string(128 + SIGPIPE) + "\n");
}
