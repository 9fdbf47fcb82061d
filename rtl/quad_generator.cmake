# quad_generator: lint for every width of the packets.
halfspace_rtl_unit(quad_generator)

set(depths 2 3 4 64)
set(parts 1 2 2 1)
set(count 0)
foreach(tile_size 4 8 16)
  foreach(quad_width 1 2 4 8 16)
    math(EXPR quads "${tile_size} * ${tile_size} / 4")
    if(quad_width GREATER quads)
      continue()
    endif()
    math(EXPR which "${count} % 4")
    math(EXPR count "${count} + 1")
    list(GET depths ${which} fifo_depth)
    list(GET parts ${which} z_parts)
    set(test "lint: quad_generator t${tile_size}_w${quad_width}_p${z_parts}_f${fifo_depth}")
    add_test(NAME ${test}
             COMMAND ${VERILATOR_BIN} --lint-only -Wall --assert --top-module quad_generator
                     -DHALFSPACE_TILE_SIZE=${tile_size} -DHALFSPACE_QUAD_WIDTH=${quad_width}
                     -DHALFSPACE_Z_PARTS=${z_parts} -GFifoDepth=${fifo_depth} ${quad_generator_sources}
                     ${rtl_dir}/handshake_checker.sv ${PROJECT_SOURCE_DIR}/tb/quad_generator/quad_generator_bind.sv)
    set_tests_properties(${test} PROPERTIES LABELS lint)
  endforeach()
endforeach()
