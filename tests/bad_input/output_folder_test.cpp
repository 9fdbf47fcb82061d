// What a process leaves that is killed is removed by the next one for the same place; what lives is not.
#include "halfspace/report/output_folder.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>
#include <set>

#include "../scene/fixture.hpp"

using namespace halfspace;
using namespace halfspace::test;
namespace fs = std::filesystem;

namespace {

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

/// A process makes a result for `place`, and is killed before it is in place.
void leave_behind(const fs::path& place) {
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    OutputFolder folder(place);
    folder.write("half", "written");
    (void)kill(getpid(), SIGKILL);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
}

}  // namespace

TEST_CASE("a result that a killed process left is removed by the next one for the same place") {
  const TempFolder temporary;
  const fs::path place = temporary.path("result");
  leave_behind(place);
  leave_behind(place);
  const std::set<std::string> left = names_in(temporary.path(""));
  REQUIRE(left.size() == 1);
  CHECK(left.begin()->starts_with(".result.halfspace-"));
  SECTION("when it begins") {
    const OutputFolder folder(place);
    CHECK(names_in(temporary.path("")).size() == 1);
    CHECK(names_in(temporary.path("")) != left);
  }
  SECTION("for good") {
    { const OutputFolder folder(place); }
    CHECK(names_in(temporary.path("")).empty());
  }
  SECTION("not by one for another place") {
    { const OutputFolder folder(temporary.path("resul")); }
    { const OutputFolder folder(temporary.path("result.halfspace-abcdef")); }
    CHECK(names_in(temporary.path("")) == left);
  }
}

TEST_CASE("a result in the making is left alone by another one for the same place") {
  const TempFolder temporary;
  const fs::path place = temporary.path("result");
  OutputFolder first(place);
  first.write("stats.json", R"({"schema": "halfspace-stats", "files": ["stats.json"]})");
  {
    OutputFolder second(place);
    second.write("other", "text");
    CHECK(names_in(temporary.path("")).size() == 2);
  }
  CHECK(names_in(temporary.path("")).size() == 1);
  first.commit();
  CHECK(names_in(place) == std::set<std::string>{"stats.json"});
}

TEST_CASE("hidden neighbours that are no result in the making stay") {
  const TempFolder temporary;
  const std::set<std::string> mine{".result.backup", ".result.halfspace-abcdef", ".result.halfspace-abcdefg",
                                   ".result.halfspace-link00", ".result"};
  fs::create_directory(temporary.path(".result.backup"));
  fs::create_directory(temporary.path(".result.halfspace-abcdefg"));
  temporary.write(".result.halfspace-abcdef", "a file");
  temporary.write(".result", "a file");
  fs::create_directory_symlink(temporary.path(".result.backup"), temporary.path(".result.halfspace-link00"));
  { const OutputFolder folder(temporary.path("result")); }
  CHECK(names_in(temporary.path("")) == mine);
}
