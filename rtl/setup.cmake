# setup: lint.
halfspace_rtl_unit(setup)

foreach(sub_pixel_bits RANGE 4 8)
  foreach(configuration "4;1;8;1" "8;2;32;0" "8;4;16;1" "16;8;64;1" "8;16;32;1")
    list(GET configuration 0 tile_size)
    list(GET configuration 1 interval)
    list(GET configuration 2 block_size)
    list(GET configuration 3 block_level)
    set(test "lint: setup t${tile_size}_s${sub_pixel_bits}_i${interval}")
    add_test(NAME ${test}
             COMMAND ${VERILATOR_BIN} --lint-only -Wall --assert --top-module setup
                     -DHALFSPACE_TILE_SIZE=${tile_size} -DHALFSPACE_SUB_PIXEL_BITS=${sub_pixel_bits}
                     -GInterval=${interval} -GBlockSize=${block_size} -GBlockLevel=1'b${block_level} ${setup_sources}
                     ${rtl_dir}/handshake_checker.sv ${PROJECT_SOURCE_DIR}/tb/setup/setup_bind.sv)
    set_tests_properties(${test} PROPERTIES LABELS lint)
  endforeach()
endforeach()
