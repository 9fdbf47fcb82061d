// Conservative rasterization from the command line: who cannot draw it says so.
#include <catch2/catch.hpp>

#include "program.hpp"

using namespace halfspace::testing;

TEST_CASE("conservative rasterization is refused by what draws centres alone, by name") {
  const Place place;
  const std::string outer = " --set raster.conservative=outer --set depth.interpolator=barycentric ";
  check_error(place.run("run " + kCube + outer + "--reference scanline"),
              {"raster.conservative is outer", "legal", "scanline: off", "exact"});
  CHECK(place.run("run " + kCube + outer + "--reference exact").status == 0);
  // Whether or not a pipeline of such a machine is there.
  check_error(place.run("run " + kCube + " --set raster.conservative=outer --fidelity rtl"),
              {"'depth.interpolator' is plane", "legal for the RTL", "barycentric"});
  for (const std::string job :
       {"--exhaustive", "--sharpness --cases 1", "--engine reference:exact --cases 1"}) {
    CAPTURE(job);
    check_error(place.run("stress " + job + outer), {"raster.conservative is on", "legal off"});
  }
  check_error(place.run("stress --cases 1 --family grazer" + outer), {"grazer", "clipped", "legal"});
  CHECK(place.run("stress --cases 1 --family sliver" + outer).status == 0);
}
