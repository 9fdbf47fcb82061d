# What the benches of the units share. A unit's CMakeLists.txt sets `unit` to its name first.

# begin_bench(target...): an executable for verilated models; the unit's add_model() adds to it, by appending to
# `declarations`, `entries` and `models`, until end_bench(). Needs the object library ${unit}_bench_parts.
macro(begin_bench target)
  set(bench ${target})
  set(declarations "")
  set(entries "")
  set(models "")
  add_executable(${bench} ${ARGN})
  target_link_libraries(${bench} PRIVATE ${unit}_bench_parts)
  halfspace_compile_options(${bench})
endmacro()

macro(end_bench)
  configure_file(models.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/${bench}_models.cpp @ONLY)
  target_sources(${bench} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/${bench}_models.cpp)
endmacro()

# The long tests build ${unit}_bench_all, which holds the configurations that `make test` does not; they want the
# fixture ${unit}_all.
function(add_bench_all)
  set(test "slow: ${unit} in the other configurations is built")
  add_test(NAME ${test} COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR} --target ${unit}_bench_all --parallel 2)
  set_tests_properties(${test} PROPERTIES LABELS slow FIXTURES_SETUP ${unit}_all RUN_SERIAL ON TIMEOUT 1200)
endfunction()

# The bench must fail, and say why: exit status, message, then the program and its arguments: fault, checkers on trial.
function(add_must_fail name status message)
  set(test "rtl: ${unit} must fail: ${name}")
  add_test(NAME ${test}
           COMMAND ${CMAKE_COMMAND} -DSTATUS=${status} "-DMESSAGE=${message}" -P ${PROJECT_SOURCE_DIR}/tb/must_fail.cmake
                   -- ${ARGN})
  set_tests_properties(${test} PROPERTIES LABELS rtl)
endfunction()

# Line and toggle coverage of all cases by a model of ${unit}_bench that counts it; fails below the threshold. Then the
# bench's options.
function(add_rtl_coverage model threshold)
  set(test "rtl: ${unit} coverage")
  set(options ${ARGN})
  if(NOT options)
    set(options --tiles 6000 --failure-wave none)
  endif()
  add_test(NAME ${test}
           COMMAND ${CMAKE_COMMAND} -DBENCH=$<TARGET_FILE:${unit}_bench> -DMODEL=${model} -DTHRESHOLD=${threshold} "-DOPTIONS=${options}"
                   -DVERILATOR_COVERAGE=${VERILATOR_COVERAGE} -P ${PROJECT_SOURCE_DIR}/tb/coverage.cmake)
  set_tests_properties(${test} PROPERTIES LABELS rtl)
endfunction()
