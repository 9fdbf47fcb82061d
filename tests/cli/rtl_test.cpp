// A run on the RTL where no pipeline was verilated.
#include <catch2/catch.hpp>

#include "program.hpp"

using namespace halfspace::testing;

TEST_CASE("rtl: without a pipeline the error says how to make one, and where an installed program finds it") {
  const Place place;
  const std::string rtl = scene("vkcube.ptf.xz") + " --fidelity rtl --rtl-folder ";
  const std::string empty = place.path.string();
  for (const std::string& command :
       {"run " + rtl + empty, "ledger " + rtl + empty, "run " + rtl + empty + "/none"}) {
    CAPTURE(command);
    check_error(place.run(command),
                {"no verilated pipeline of this configuration", empty.c_str(), "there: none", "`make rtl`",
                 "build/release/lib/halfspace", "--rtl-folder", "installed"});
  }
}
