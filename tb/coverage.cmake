# Line and toggle coverage of all cases of BENCH together, run with OPTIONS, by a MODEL that counts it; fails below
# THRESHOLD percent.
set(dir coverage_${MODEL})
file(REMOVE_RECURSE ${dir})
file(MAKE_DIRECTORY ${dir})
execute_process(COMMAND ${BENCH} --model ${MODEL} --coverage ${dir}/run.dat ${OPTIONS}
                COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
file(GLOB runs ${dir}/*.dat)
# The annotated sources that verilator_coverage writes count lines; here every point counts, so every bit of a signal.
execute_process(COMMAND ${VERILATOR_COVERAGE} --write ${dir}/all.dat ${runs} COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
execute_process(COMMAND ${VERILATOR_COVERAGE} --annotate ${dir} ${dir}/all.dat COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
file(READ ${dir}/all.dat data)
string(ASCII 1 key_mark)
string(ASCII 2 value_mark)
string(REGEX REPLACE "[][${key_mark}${value_mark}]" " " data "${data}")  # brackets would join list elements
string(REGEX MATCHALL "C '[^\n]*' [0-9]+\n" points "${data}")
list(LENGTH points total)
set(missed ${points})
list(FILTER missed INCLUDE REGEX "' [01]\n")  # a bit must go up and down: two changes
list(LENGTH missed missed_count)
foreach(point IN LISTS missed)
  string(REGEX REPLACE ".* page ([^ ]*) o ([^']*) h .*" "\\1 \\2" point "${point}")
  message(STATUS "not covered: ${point}")
endforeach()
math(EXPR tenths "1000 * (${total} - ${missed_count}) / ${total}")
math(EXPR percent "${tenths} / 10")
math(EXPR rest "${tenths} % 10")
message(STATUS "line and toggle coverage: ${percent}.${rest} % of ${total} points (sources with counts in ${dir})")
if(percent LESS THRESHOLD)
  message(FATAL_ERROR "below the threshold of ${THRESHOLD} %")
endif()
