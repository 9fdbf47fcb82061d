// A run that is killed, and the next one into the same place.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "program.hpp"

using namespace halfspace::testing;

namespace {

std::string hidden_in(const fs::path& folder) {
  for (const std::string& name : entries(folder)) {
    if (name.starts_with('.')) return name;
  }
  return "";
}

}  // namespace

TEST_CASE("run: what a killed run leaves the next one removes, while a live one keeps its own") {
  const Place place;
  const fs::path results = place.path / "results";
  fs::create_directory(results);
  const std::string out = (results / "r").string();
  // A triangle over 4096x4096 pixels, sixty times: minutes of work, so the run is alive as long as the test
  // wants.
  const std::string triangle = (place.path / "triangle.obj").string();
  std::ofstream(triangle) << "v -9 -9 0\nv 9 -9 0\nv 0 9 0\nf 1 2 3\n";
  std::vector<std::string> words{HALFSPACE_PROGRAM, "run",       "--eye",      "0,0,1",   "--at",  "0,0,0",
                                 "--size",          "4096x4096", "--fidelity", "systemc", "--out", out};
  words.insert(words.end(), 60, triangle);
  std::vector<char*> arguments;
  for (std::string& word : words) {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const int null = open("/dev/null", O_WRONLY);
    dup2(null, STDOUT_FILENO);
    execv(HALFSPACE_PROGRAM, arguments.data());
    _exit(127);
  }
  for (int i = 0; i < 600 && hidden_in(results).empty(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  const std::string staging = hidden_in(results);
  CHECK(!staging.empty());
  const std::string run = "run " + scene("vkcube.ptf.xz") + " --no-pictures --out " + out;
  CHECK(place.run(run).status == 0);
  CHECK(entries(results) == std::set<std::string>{"r", staging});
  kill(child, SIGKILL);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
  CHECK(entries(results) == std::set<std::string>{"r", staging});
  CHECK(place.run(run).status == 0);
  CHECK(entries(results) == std::set<std::string>{"r"});
}

TEST_CASE("a file that a killed process left half-written is gone after the next one") {
  const Place place;
  const std::string in = place.path.string();
  for (const std::string name : {"record", "jobs"}) {
    std::ofstream(place.path / (name + ".part")) << "half";
  }
  REQUIRE(place.run("record " + scene("vkcube.ptf.xz") + " --out " + in + "/record").status == 0);
  REQUIRE(place.run("run " + scene("vkcube.ptf.xz") + " --tile-jobs " + in + "/jobs").status == 0);
  CHECK(entries(place.path) == std::set<std::string>{"jobs", "record", "stderr", "stdout"});
}
