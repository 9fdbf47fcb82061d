foreach(sub_pixel_bits RANGE 4 8)
  foreach(configuration "4;1;8;1" "8;2;32;0" "8;4;16;1" "16;8;64;1" "8;16;32;1")
    list(POP_FRONT configuration tile_size interval block_size block_level)
    halfspace_lint(t${tile_size}_s${sub_pixel_bits}_i${interval} -DHALFSPACE_TILE_SIZE=${tile_size}
                   -DHALFSPACE_SUB_PIXEL_BITS=${sub_pixel_bits} -GInterval=${interval} -GBlockSize=${block_size}
                   -GBlockLevel=1'b${block_level})
  endforeach()
endforeach()
