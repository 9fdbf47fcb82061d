# Every part of a tile that a machine can have, the least, 4x2, without a coded size.
foreach(configuration "4;1" "4;2" "8;1" "8;2" "8;4" "16;1" "16;2" "16;4")
  list(POP_FRONT configuration tile_size z_parts)
  halfspace_lint(t${tile_size}_p${z_parts} -DHALFSPACE_TILE_SIZE=${tile_size} -DHALFSPACE_Z_PARTS=${z_parts})
endforeach()
