/// Prints rtl/raster_pkg.sv to standard output.
#include <iostream>

#include "halfspace/report/raster_pkg.hpp"

int main() {
  std::cout << halfspace::raster_pkg() << std::flush;
  return std::cout ? 0 : 1;
}
