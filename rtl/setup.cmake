foreach(sub_pixel_bits RANGE 4 8)
  foreach(configuration "4;1;8" "8;2;32" "8;4;16" "16;8;64" "8;16;64")
    list(POP_FRONT configuration tile_size interval block_size)
    halfspace_lint(t${tile_size}_s${sub_pixel_bits}_i${interval} -DHALFSPACE_TILE_SIZE=${tile_size}
                   -DHALFSPACE_SUB_PIXEL_BITS=${sub_pixel_bits} -DHALFSPACE_BLOCK_SIZE=${block_size} -GInterval=${interval})
    halfspace_lint(t${tile_size}_s${sub_pixel_bits}_i${interval}_hi_z -DHALFSPACE_TILE_SIZE=${tile_size}
                   -DHALFSPACE_SUB_PIXEL_BITS=${sub_pixel_bits} -DHALFSPACE_BLOCK_SIZE=${block_size} -GInterval=${interval}
                   -GHiZ=1'b1)
    halfspace_lint(t${tile_size}_s${sub_pixel_bits}_i${interval}_lines -DHALFSPACE_TILE_SIZE=${tile_size}
                   -DHALFSPACE_SUB_PIXEL_BITS=${sub_pixel_bits} -DHALFSPACE_BLOCK_SIZE=${block_size} -GInterval=${interval}
                   -GHiZ=1'b1 -GThinLines=1'b1)
  endforeach()
endforeach()
# Squares: pixels, uncertainty, sub-pixel bits, interpolator
foreach(configuration "1;0;8;1" "1;1;8;0" "1;128;8;1" "2;1;8;1" "2;8;4;0")
  list(POP_FRONT configuration conservative uncertainty sub_pixel_bits interpolator)
  halfspace_lint(c${conservative}_u${uncertainty}_s${sub_pixel_bits}_z${interpolator} -GConservative=${conservative}
                 -GUncertainty=${uncertainty} -DHALFSPACE_SUB_PIXEL_BITS=${sub_pixel_bits} -GInterpolator=${interpolator})
endforeach()
foreach(samples 2 4 8 16)
  halfspace_lint(samples${samples} -DHALFSPACE_SAMPLES=${samples})
endforeach()
