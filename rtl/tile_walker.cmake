# tile_walker: lint over its parameters.
halfspace_rtl_unit(tile_walker)

# Every pair of sizes; the other parameters take turns.
set(turn 0)
foreach(tile_size 4 8 16)
  foreach(block_size 8 16 32 64)
    if(block_size GREATER tile_size)
      math(EXPR sub_pixel_bits "4 + ${turn} % 5")
      foreach(which 0 1 2)
        set(test "lint: tile_walker t${tile_size}_b${block_size}_s${sub_pixel_bits}_${which}")
        if(which EQUAL 0)
          set(arguments -GStepInterval=1)
        elseif(which EQUAL 1)
          set(arguments -GStepInterval=3 -GBlockLevel=1'b0 -GFifoDepth=2)
        else()
          set(arguments -GStepInterval=8 -GTrivialReject=1'b0 -GTrivialAccept=1'b0 -GFifoDepth=64)
        endif()
        add_test(NAME ${test}
                 COMMAND ${VERILATOR_BIN} --lint-only -Wall --assert --top-module tile_walker
                         -DHALFSPACE_TILE_SIZE=${tile_size} -DHALFSPACE_SUB_PIXEL_BITS=${sub_pixel_bits}
                         -GBlockSize=${block_size} ${arguments} ${tile_walker_sources} ${rtl_dir}/handshake_checker.sv
                         ${PROJECT_SOURCE_DIR}/tb/tile_walker/tile_walker_bind.sv)
        set_tests_properties(${test} PROPERTIES LABELS lint)
      endforeach()
      math(EXPR turn "${turn} + 1")
    endif()
  endforeach()
endforeach()
