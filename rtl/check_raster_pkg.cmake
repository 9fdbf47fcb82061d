# Fails when rtl/raster_pkg.sv (COMMITTED) is not what the tool PRINT prints.
execute_process(COMMAND ${PRINT} OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
file(READ ${COMMITTED} committed)
if(NOT printed STREQUAL committed)
  message(FATAL_ERROR "${COMMITTED} differs from model/halfspace/config/keys.hpp, model/halfspace/numerics/widths.hpp and "
                      "model/halfspace/units/packets.hpp.\nTo print it anew: cmake --build ${BUILD} --target raster_pkg\n")
endif()
