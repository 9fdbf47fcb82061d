# tile size, sub-pixel bits, quads of a beat in and tested, parts; lines, ways, bytes of memory in a cycle; late writes
foreach(configuration "4;8;4;4;1;16;2;16;2" "4;5;1;1;1;1;1;1;1" "8;6;8;2;4;32;1;4;3" "8;8;4;4;1;128;4;64;16"
                      "16;8;8;4;2;64;4;128;64" "16;4;16;16;4;64;16;1024;5")
  list(POP_FRONT configuration tile_size sub_pixel_bits quad_width test_width z_parts lines ways bytes late)
  halfspace_lint(t${tile_size}_s${sub_pixel_bits}_w${quad_width}_v${test_width}_p${z_parts}
                 -DHALFSPACE_TILE_SIZE=${tile_size} -DHALFSPACE_SUB_PIXEL_BITS=${sub_pixel_bits}
                 -DHALFSPACE_QUAD_WIDTH=${quad_width} -DHALFSPACE_TEST_WIDTH=${test_width}
                 -DHALFSPACE_Z_PARTS=${z_parts} -GLines=${lines} -GWays=${ways} -GReadBytes=${bytes}
                 -GWriteBytes=${bytes})
  halfspace_lint(t${tile_size}_s${sub_pixel_bits}_w${quad_width}_v${test_width}_p${z_parts}_hi_z_coded
                 -DHALFSPACE_TILE_SIZE=${tile_size} -DHALFSPACE_SUB_PIXEL_BITS=${sub_pixel_bits}
                 -DHALFSPACE_QUAD_WIDTH=${quad_width} -DHALFSPACE_TEST_WIDTH=${test_width}
                 -DHALFSPACE_Z_PARTS=${z_parts} -GLines=${lines} -GWays=${ways} -GReadBytes=${bytes}
                 -GWriteBytes=${bytes} -GHiZ=1'b1 -GCompression=1'b1 -GLateQueue=${late})
endforeach()

# Squares: pixels, uncertainty, sub-pixel bits, interpolator
foreach(configuration "1;0;8;1" "1;128;8;1" "1;8;4;1" "2;1;8;1" "2;1;8;0")
  list(POP_FRONT configuration conservative uncertainty sub_pixel_bits interpolator)
  halfspace_lint(c${conservative}_u${uncertainty}_s${sub_pixel_bits}_z${interpolator} -GConservative=${conservative}
                 -GUncertainty=${uncertainty} -DHALFSPACE_SUB_PIXEL_BITS=${sub_pixel_bits} -GInterpolator=${interpolator})
endforeach()
halfspace_lint(inner_coverage -GConservative=1 -GUncertainty=1 -GInterpolator=1 -GInnerCoverage=1'b1)
halfspace_lint(inner_coverage_s4_v1 -GConservative=1 -GUncertainty=8 -GInterpolator=1 -GInnerCoverage=1'b1
               -DHALFSPACE_SUB_PIXEL_BITS=4 -DHALFSPACE_QUAD_WIDTH=1 -DHALFSPACE_TEST_WIDTH=1)
foreach(samples 2 4 8 16)
  halfspace_lint(samples${samples} -DHALFSPACE_SAMPLES=${samples})
  halfspace_lint(samples${samples}_barycentric -DHALFSPACE_SAMPLES=${samples} -DHALFSPACE_TILE_SIZE=4 -GInterpolator=1)
endforeach()
