foreach(tile_size 4 8 16)
  foreach(sub_pixel_bits RANGE 4 8)
    foreach(pipe_stages 1 2 3)
      halfspace_lint(t${tile_size}_s${sub_pixel_bits}_p${pipe_stages} -DHALFSPACE_TILE_SIZE=${tile_size}
                     -DHALFSPACE_SUB_PIXEL_BITS=${sub_pixel_bits} -GPipeStages=${pipe_stages})
    endforeach()
  endforeach()
endforeach()
halfspace_lint(samples16 -DHALFSPACE_SAMPLES=16)
