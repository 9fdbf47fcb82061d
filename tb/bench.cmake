# What the benches of the units share. `unit` is the name of the unit and of its folder here, see CMakeLists.txt.

# add_bench(TOP module PARAMETERS names... SOURCES...): two programs, ${unit}_bench with the models of `make test`, and
# ${unit}_bench_all, which only the long tests build, with the others too; --model picks one. PARAMETERS: what Verilator
# calls the numbers of a model. The folder's pins.hpp makes the bench's model of a class and of the same numbers.
function(add_bench)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "TOP" "PARAMETERS;SOURCES")
  set(parts ${unit}_bench_parts)
  add_library(${parts} OBJECT ${arg_SOURCES})
  target_include_directories(${parts} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(${parts} PUBLIC halfspace_bench)
  halfspace_compile_options(${parts})
  set_target_properties(${parts} PROPERTIES MODEL_TOP ${arg_TOP} MODEL_PARAMETERS "${arg_PARAMETERS}")
  foreach(bench ${unit}_bench ${unit}_bench_all)
    set(list ${CMAKE_CURRENT_BINARY_DIR}/${bench}_models.cpp)
    add_executable(${bench} ${list})
    target_include_directories(${bench} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
    target_link_libraries(${bench} PRIVATE ${parts})
    halfspace_compile_options(${bench})
    file(GENERATE OUTPUT ${list} CONTENT
"$<TARGET_PROPERTY:${bench},MODEL_HEADERS>#include \"${unit}/pins.hpp\"

namespace halfspace::tb {

decltype(${unit}_models()) ${unit}_models() {
  return {
$<TARGET_PROPERTY:${bench},MODEL_ENTRIES>  };
}

}  // namespace halfspace::tb
")
  endforeach()
  set_target_properties(${unit}_bench_all PROPERTIES EXCLUDE_FROM_ALL ON)
  add_dependencies(slow_benches ${unit}_bench_all)
endfunction()

# add_slow_model(name numbers... [Verilator's arguments...]): a configuration for the long tests.
function(add_slow_model name)
  get_target_property(top ${unit}_bench_parts MODEL_TOP)
  get_target_property(parameters ${unit}_bench_parts MODEL_PARAMETERS)
  get_target_property(sources rtl_${unit} SV_SOURCES)
  file(GLOB checkers CONFIGURE_DEPENDS *.sv)
  set(arguments ${ARGN})
  set(numbers "")
  foreach(parameter IN LISTS parameters)
    list(POP_FRONT arguments number)
    list(APPEND arguments ${parameter}${number})
    list(APPEND numbers ${number})
  endforeach()
  set(optimize -O1)  # the least of compiling and running together
  if(arguments MATCHES "--coverage")
    set(optimize -O0)  # thousands of counters take the compiler long
  endif()
  set(prefix V${unit}_${name})
  add_library(${prefix} OBJECT EXCLUDE_FROM_ALL)
  halfspace_verilate(${prefix} PREFIX ${prefix} TOP ${top} OPTIMIZE ${optimize} SOURCES ${sources} ${checkers}
                     ${PROJECT_SOURCE_DIR}/rtl/handshake_checker.sv ARGS ${arguments})
  list(JOIN numbers ", " numbers)
  list_model(${unit}_bench_all ${name} ${prefix} "${numbers}")
  set(prefix ${prefix} PARENT_SCOPE)
  set(numbers ${numbers} PARENT_SCOPE)
endfunction()

# add_model(name numbers... [Verilator's arguments...]): one for `make test`. The first is the bench's default.
function(add_model name)
  add_slow_model(${name} ${ARGN})
  list_model(${unit}_bench ${name} ${prefix} "${numbers}")
endfunction()

# list_model(bench name prefix numbers): the class `prefix` in `bench`, under that name and with those numbers.
function(list_model bench name prefix numbers)
  target_link_libraries(${bench} PRIVATE ${prefix})
  set_property(TARGET ${bench} APPEND PROPERTY MODELS ${name})
  set_property(TARGET ${bench} APPEND_STRING PROPERTY MODEL_HEADERS "#include \"${prefix}.h\"\n")
  set_property(TARGET ${bench} APPEND_STRING PROPERTY MODEL_ENTRIES
               "      verilated<${prefix}>(\"${name}\", ${numbers}),\n")
endfunction()

# add_bench_test(label model what arguments...): the test "label: unit model what". `slow` runs ${unit}_bench_all.
function(add_bench_test label model what)
  string(STRIP "${label}: ${unit} ${model} ${what}" test)
  set(bench ${unit}_bench)
  set(timeout 120)
  if(label STREQUAL slow)
    set(bench ${unit}_bench_all)
    set(timeout 1200)
  endif()
  add_test(NAME ${test} COMMAND ${bench} --model ${model} ${ARGN})
  set_tests_properties(${test} PROPERTIES LABELS ${label} TIMEOUT ${timeout})
  set(test ${test} PARENT_SCOPE)
endfunction()

# The bench must fail, and say why: exit status, message, then the program and its arguments: fault, checkers on trial.
# The label is `label`, or rtl.
function(add_must_fail name status message)
  if(NOT label)
    set(label rtl)
  endif()
  set(test "${label}: ${unit} must fail: ${name}")
  add_test(NAME ${test}
           COMMAND ${CMAKE_COMMAND} -DSTATUS=${status} "-DMESSAGE=${message}" -P ${PROJECT_SOURCE_DIR}/tb/must_fail.cmake
                   -- ${ARGN})
  set_tests_properties(${test} PROPERTIES LABELS ${label})
  set(test ${test} PARENT_SCOPE)
endfunction()

# What the bench of every stream must find: packets of the kind `packet`, in whose `field` a bit is flipped; the arguments
# are those of a random run.
function(add_stream_must_fails packet field)
  set(random $<TARGET_FILE:${unit}_bench> --case random --failure-wave none ${ARGN})
  add_must_fail("flipped bit" 10 "payload in cycle [0-9]+: packet 100, field ${field}: expected 0x"
                ${random} --fault flip-bit)
  add_must_fail("dropped ${packet}" 11 "missing in cycle [0-9]+: packet 100 is missing: packet 101 came in its place"
                ${random} --fault drop --check packets)
  add_must_fail("all dropped from one ${packet} on" 11
                "missing in cycle [0-9]+: packet 100 is missing: [0-9]+ of the packets"
                ${random} --fault drop-last --check packets)
  add_must_fail("dropped ${packet}, by its time" 15 "timing in cycle [0-9]+: packet 100 should be valid since"
                ${random} --fault drop)
  add_must_fail("swapped order" 12 "order in cycle [0-9]+: packets 100 and 101 came in swapped order"
                ${random} --fault swap --check packets)
  add_must_fail("${packet} twice" 13 "extra in cycle [0-9]+: packet 100 came a second time"
                ${random} --fault duplicate --check packets)
  add_must_fail("extra ${packet} at the end" 13 "extra in cycle [0-9]+: packet [0-9]+ came a second time"
                ${random} --fault extra --check packets)
  add_must_fail("valid before the ${packet}" 14 "handshake in cycle [0-9]+: output: (valid withdrawn before ready|payload changed while stalled)"
                ${random} --idle 0.5 --stall 0.5 --fault early-valid --check handshake)
  add_must_fail("valid before the ${packet}, by its time" 15
                "timing in cycle [0-9]+: (packet [0-9]+ valid before|output valid with nothing)"
                ${random} --idle 0.5 --stall 0.5 --fault early-valid)
  add_must_fail("payload changed while stalled" 14 "handshake in cycle [0-9]+: output: payload changed while stalled"
                ${random} --stall 0.9 --fault change-payload --fault-packet 0)
  add_must_fail("one cycle late" 15 "timing in cycle [0-9]+: packet 100 should be valid since cycle"
                ${random} --fault late)
  add_must_fail("deadlock" 16
                "deadlock in cycle [0-9]+: nothing moved for [0-9]+ cycles: input valid 1 ready 0, output valid 1"
                ${random} --fault stuck --check packets)
  add_must_fail("source breaks the law" 17 "payload changed while stalled" ${random} --stall 0.9 --fault source-change)
endfunction()

# add_rtl_coverage(threshold MODEL numbers... OPTIONS...): line and toggle coverage of all cases by a model that counts it,
# run with OPTIONS; fails below `threshold` percent. MODEL is as in add_model(). Registers start at 0, so that a random
# start does not count as a toggle.
function(add_rtl_coverage threshold)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "MODEL;OPTIONS")
  add_slow_model(coverage ${arg_MODEL} --coverage-line --coverage-toggle --x-initial 0)
  set(test "slow: ${unit} coverage")
  add_test(NAME ${test}
           COMMAND ${CMAKE_COMMAND} -DBENCH=$<TARGET_FILE:${unit}_bench_all> -DMODEL=coverage -DTHRESHOLD=${threshold}
                   "-DOPTIONS=${arg_OPTIONS}" -DVERILATOR_COVERAGE=${VERILATOR_COVERAGE}
                   -P ${PROJECT_SOURCE_DIR}/tb/coverage.cmake)
  set_tests_properties(${test} PROPERTIES LABELS slow TIMEOUT 1200)
endfunction()
