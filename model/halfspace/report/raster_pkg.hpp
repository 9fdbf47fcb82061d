/// Prints the SystemVerilog package: the widths and packets of the links, from the tables that C++ compiles.
#pragma once

#include <string>

namespace halfspace {

/// The text of rtl/raster_pkg.sv.
[[nodiscard]] std::string raster_pkg();

}  // namespace halfspace
