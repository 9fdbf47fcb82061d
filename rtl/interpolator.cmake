# Every precision; sub-pixel precisions and FIFO depths take turns.
set(depths 2 7 31 64)
foreach(bits RANGE 8 24 2)
  math(EXPR sub_pixel_bits "4 + ${bits} / 2 % 5")
  math(EXPR which "${bits} / 2 % 4")
  list(GET depths ${which} fifo_depth)
  halfspace_lint(b${bits}_s${sub_pixel_bits}_f${fifo_depth} -DHALFSPACE_SUB_PIXEL_BITS=${sub_pixel_bits} -GBits=${bits}
                 -GFifoDepth=${fifo_depth})
endforeach()
