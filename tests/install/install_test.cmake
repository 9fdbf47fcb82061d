# Installs BUILD into a folder of its own, configures and builds CONSUMER against it, and runs it on SCENE; the same with
# SYSTEMC_CONSUMER, which has its own sc_main, and with C_CONSUMER, which uses the C API.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK}/prefix ${WORK}/consumer)
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${CONSUMER} -B ${WORK}/consumer -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
run(${CMAKE_COMMAND} --build ${WORK}/consumer)
run(${WORK}/consumer/consumer ${SCENE})
if(NOT output STREQUAL "19263 quads\n")
  message(FATAL_ERROR "the consumer printed: ${output}")
endif()
run(${WORK}/prefix/bin/halfspace --version)

file(REMOVE_RECURSE ${WORK}/systemc_consumer)
run(${CMAKE_COMMAND} -S ${SYSTEMC_CONSUMER} -B ${WORK}/systemc_consumer -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -DCMAKE_CXX_STANDARD=20)
run(${CMAKE_COMMAND} --build ${WORK}/systemc_consumer)
run(${WORK}/prefix/bin/halfspace run ${SCENE} --fidelity systemc)
string(REGEX MATCH "cycles +([0-9]+)" cycles "${output}")
run(${WORK}/systemc_consumer/platform ${SCENE})
if(NOT output MATCHES "\n${CMAKE_MATCH_1} cycles\n$")
  message(FATAL_ERROR "the program says ${cycles}, the platform printed: ${output}")
endif()

file(REMOVE_RECURSE ${WORK}/c_consumer)
run(${CMAKE_COMMAND} -S ${C_CONSUMER} -B ${WORK}/c_consumer -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_CXX_COMPILER=${COMPILER})
run(${CMAKE_COMMAND} --build ${WORK}/c_consumer)
foreach(library halfspace_c halfspace_c_static)
  run(${WORK}/c_consumer/with_${library})
  if(NOT output STREQUAL "mask 0000000000000006\n")
    message(FATAL_ERROR "with_${library} printed: ${output}")
  endif()
endforeach()

# The header, the library and the SystemVerilog package speak of one ABI.
file(STRINGS ${WORK}/prefix/include/halfspace.h abi_version REGEX "^#define HALFSPACE_ABI_VERSION ")
string(REGEX REPLACE "[^0-9]" "" abi_version "${abi_version}")
file(GLOB_RECURSE library ${WORK}/prefix/libhalfspace_c.so.${abi_version})
if(NOT library)
  message(FATAL_ERROR "no libhalfspace_c.so.${abi_version}, the ABI version of halfspace.h, is installed")
endif()
file(READ ${WORK}/prefix/share/halfspace/halfspace_dpi.sv dpi)
if(NOT dpi MATCHES "AbiVersion = ${abi_version};")
  message(FATAL_ERROR "halfspace_dpi.sv is not of ABI version ${abi_version}")
endif()

