# halfspace_verilated_runtime: Verilator's run-time library, compiled once for all models.
#
# halfspace_verilate(TARGET PREFIX TOP OPTIMIZE SOURCES... ARGS... [DEPENDS...] [UNCHECKED]) verilates at build time and
# adds the model, class PREFIX, to TARGET, compiled with OPTIMIZE (-O2). UNCHECKED: without assertions and waveforms, and as
# fast as can be: by clang 19 where it is installed, for the processor of this machine; BY_GCC: not by clang.
# Verilator's own verilate() runs at configure time and compiles the run-time library for each target.
set(runtime_dir ${VERILATOR_ROOT}/include)
add_library(halfspace_verilated_runtime STATIC ${runtime_dir}/verilated.cpp ${runtime_dir}/verilated_cov.cpp
                                               ${runtime_dir}/verilated_fst_c.cpp ${runtime_dir}/verilated_threads.cpp)
set_target_properties(halfspace_verilated_runtime PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_include_directories(halfspace_verilated_runtime SYSTEM PUBLIC ${runtime_dir} ${runtime_dir}/vltstd)
target_compile_definitions(halfspace_verilated_runtime PUBLIC VM_TRACE=1 VM_TRACE_FST=1 VM_COVERAGE=1)
find_package(Threads REQUIRED)
target_link_libraries(halfspace_verilated_runtime PUBLIC ZLIB::ZLIB Threads::Threads)

# Not our code: no warnings, no instrumentation, and fast in every build type.
set(halfspace_generated_options -w -fno-sanitize=all -fno-profile-arcs -fno-test-coverage)
target_compile_options(halfspace_verilated_runtime PRIVATE ${halfspace_generated_options} -O2)

# What it makes of these models runs 1.2 to 1.3 times as fast as what GCC 12 makes of them. `make rtl` installs it.
find_program(HALFSPACE_CLANG clang++-19 DOC "Compiler of the pipelines of --fidelity rtl; without it that of the rest")

# Compiles `source` by HALFSPACE_CLANG and adds the object to `target`.
function(halfspace_compile_by_clang target source)
  set(object ${source}.o)
  set(runtime $<TARGET_PROPERTY:halfspace_verilated_runtime,INTERFACE_COMPILE_DEFINITIONS>)
  add_custom_command(
    OUTPUT ${object}
    COMMAND ${CMAKE_CXX_COMPILER_LAUNCHER} ${HALFSPACE_CLANG} -std=c++20 -w -O2 -march=native -DNDEBUG "-D$<JOIN:${runtime},;-D>"
            -fPIC -fvisibility=hidden -I${runtime_dir} -I${runtime_dir}/vltstd -c ${source} -o ${object}
    DEPENDS ${source} COMMENT "Compiling ${object}" VERBATIM COMMAND_EXPAND_LISTS)
  target_sources(${target} PRIVATE ${object})
endfunction()

function(halfspace_verilate target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "UNCHECKED;BY_GCC" "PREFIX;TOP;OPTIMIZE" "SOURCES;ARGS;DEPENDS")
  set(checks --assert --trace-fst --trace-structs)
  if(arg_UNCHECKED)
    set(checks --no-assert)
  endif()
  set(dir ${CMAKE_CURRENT_BINARY_DIR}/${arg_PREFIX})
  set(all ${dir}/${arg_PREFIX}__all.cpp)
  add_custom_command(
    OUTPUT ${all} ${dir}/${arg_PREFIX}.h
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${dir}  # Verilator leaves what it wrote of an older design
    COMMAND ${VERILATOR_BIN} --cc --prefix ${arg_PREFIX} --Mdir ${dir} --top-module ${arg_TOP} -Wall -O3 ${checks}
            --x-assign unique --x-initial unique ${arg_ARGS} ${arg_SOURCES}
    COMMAND ${CMAKE_COMMAND} -DDIR=${dir} -DALL=${all} -P ${PROJECT_SOURCE_DIR}/tb/one_file.cmake
    DEPENDS ${arg_SOURCES} ${arg_DEPENDS} ${PROJECT_SOURCE_DIR}/tb/one_file.cmake raster_pkg_is_current
    COMMENT "Verilating ${arg_PREFIX}" VERBATIM)
  if(arg_UNCHECKED AND HALFSPACE_CLANG AND NOT arg_BY_GCC)
    halfspace_compile_by_clang(${target} ${all})
  else()
    set_source_files_properties(${all} PROPERTIES COMPILE_OPTIONS "${halfspace_generated_options};${arg_OPTIMIZE}")
    target_sources(${target} PRIVATE ${all})
  endif()
  target_include_directories(${target} SYSTEM PUBLIC ${dir})
  target_link_libraries(${target} PUBLIC halfspace_verilated_runtime)
endfunction()
