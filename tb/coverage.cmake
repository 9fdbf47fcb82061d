# Line and toggle coverage of all cases of BENCH together, by a MODEL that counts it; fails below THRESHOLD percent.
set(dir coverage_${MODEL})
file(REMOVE_RECURSE ${dir})
file(MAKE_DIRECTORY ${dir})
execute_process(COMMAND ${BENCH} --model ${MODEL} --tiles 6000 --coverage ${dir}/run.dat --failure-wave none
                COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
file(GLOB runs ${dir}/*.dat)
execute_process(COMMAND ${VERILATOR_COVERAGE} --annotate ${dir} ${runs}
                COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE output)
if(NOT output MATCHES "Total coverage \\(([0-9]+)/([0-9]+)\\)")
  message(FATAL_ERROR "no total in the output of verilator_coverage:\n${output}")
endif()
math(EXPR tenths "1000 * ${CMAKE_MATCH_1} / ${CMAKE_MATCH_2}")
math(EXPR percent "${tenths} / 10")
math(EXPR rest "${tenths} % 10")
message(STATUS "line and toggle coverage: ${CMAKE_MATCH_1} of ${CMAKE_MATCH_2} points, ${percent}.${rest} %"
               " (sources with counts in ${dir})")
if(percent LESS THRESHOLD)
  message(FATAL_ERROR "below the threshold of ${THRESHOLD} %")
endif()
