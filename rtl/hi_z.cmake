# tile size, block size, parts; bits of a bound, lag, FIFO, blocks of all surfaces, those that a clear marks
foreach(configuration "8;32;1;8;128;12;1024;64" "4;32;1;4;1;4;2;1" "8;32;4;16;1024;16;100;64" "16;64;2;32;3;6;5000;1024"
                      "4;8;4;5;20;4;70;16")
  list(POP_FRONT configuration tile_size block_size z_parts bits lag fifo blocks clear_blocks)
  set(name t${tile_size}_b${block_size}_p${z_parts}_bits${bits}_lag${lag})
  set(arguments -DHALFSPACE_TILE_SIZE=${tile_size} -DHALFSPACE_BLOCK_SIZE=${block_size} -DHALFSPACE_Z_PARTS=${z_parts}
                -GBits=${bits} -GLag=${lag} -GFifoDepth=${fifo} -GMemoryBlocks=${blocks} -GClearBlocks=${clear_blocks})
  halfspace_lint(${name} ${arguments})
  halfspace_lint(${name}_nodfg ${arguments} -fno-dfg)
endforeach()
