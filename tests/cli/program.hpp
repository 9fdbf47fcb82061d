/// The program, run as a user runs it, for tests.
#pragma once

#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace halfspace::testing {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct Outcome {
  int status = -1;
  std::string out;
  std::string err;
};

inline std::string slurp(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A folder for one test, empty at first and removed afterwards.
class Place {
 public:
  Place() {
    std::string pattern = (fs::temp_directory_path() / "halfspace_cli.XXXXXX").string();
    REQUIRE(mkdtemp(pattern.data()) != nullptr);
    path = pattern;
  }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  ~Place() { fs::remove_all(path); }

  [[nodiscard]] Outcome run(const std::string& arguments) const {
    const std::string command = std::string(HALFSPACE_PROGRAM) + " " + arguments + " >" +
                                (path / "stdout").string() + " 2>" + (path / "stderr").string() +
                                " </dev/null";
    const int status = std::system(command.c_str());
    Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(path / "stdout"),
                    slurp(path / "stderr")};
    return outcome;
  }

  fs::path path;
};

inline std::string scene(const char* name) { return std::string(HALFSPACE_SOURCE) + "/scenes/" + name; }

inline const std::string kCube = scene("vkcube.ptf.xz");

inline std::set<std::string> entries(const fs::path& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

/// The stats.json of a result.
inline Json read_stats(const fs::path& folder) { return Json::parse(slurp(folder / "stats.json")); }

/// One line on stderr that holds all of `parts`, and a status that is not 0.
inline void check_error(const Outcome& outcome, std::initializer_list<const char*> parts) {
  CAPTURE(outcome.out, outcome.err);
  CHECK(outcome.status != 0);
  CHECK(outcome.status != -1);
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  for (const char* part : parts) {
    CAPTURE(part);
    CHECK(outcome.err.find(part) != std::string::npos);
  }
}

}  // namespace halfspace::testing
