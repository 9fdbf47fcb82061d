# early_z: lint.
halfspace_rtl_unit(early_z)

# tile size, sub-pixel bits, quads of a beat in and tested, parts; lines, ways, bytes of memory in a cycle
foreach(configuration "4;8;4;4;1;16;2;16" "4;5;1;1;1;1;1;1" "8;6;8;2;4;32;1;4" "8;8;4;4;1;128;4;64" "16;8;8;4;2;64;4;128"
                      "16;4;16;16;4;64;16;1024")
  list(GET configuration 0 tile_size)
  list(GET configuration 1 sub_pixel_bits)
  list(GET configuration 2 quad_width)
  list(GET configuration 3 test_width)
  list(GET configuration 4 z_parts)
  list(GET configuration 5 lines)
  list(GET configuration 6 ways)
  list(GET configuration 7 bytes)
  set(test "lint: early_z t${tile_size}_s${sub_pixel_bits}_w${quad_width}_v${test_width}_p${z_parts}")
  add_test(NAME ${test}
           COMMAND ${VERILATOR_BIN} --lint-only -Wall --assert --top-module early_z -DHALFSPACE_TILE_SIZE=${tile_size}
                   -DHALFSPACE_SUB_PIXEL_BITS=${sub_pixel_bits} -DHALFSPACE_QUAD_WIDTH=${quad_width}
                   -DHALFSPACE_TEST_WIDTH=${test_width} -DHALFSPACE_Z_PARTS=${z_parts} -GLines=${lines} -GWays=${ways}
                   -GReadBytes=${bytes} -GWriteBytes=${bytes} ${early_z_sources} ${rtl_dir}/handshake_checker.sv
                   ${PROJECT_SOURCE_DIR}/tb/early_z/early_z_bind.sv)
  set_tests_properties(${test} PROPERTIES LABELS lint)
endforeach()
