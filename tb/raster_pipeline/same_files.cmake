# PROGRAM runs FRAME on CONFIG, verilated (from FOLDER) and by the recurrence, and `halfspace diff` finds no difference.
foreach(fidelity rtl recurrence)
  set(options "")
  if(fidelity STREQUAL rtl)
    set(options --rtl-folder ${FOLDER})
  endif()
  file(REMOVE_RECURSE ${OUT}/${fidelity})
  execute_process(COMMAND ${PROGRAM} run ${FRAME} --config ${CONFIG} --fidelity ${fidelity} ${options} --quads --tiles
                          --stall source:20:3 --stall sink:30:5 --seed 7 --out ${OUT}/${fidelity}
                  COMMAND_ERROR_IS_FATAL ANY)
endforeach()
execute_process(COMMAND ${PROGRAM} diff ${OUT}/rtl ${OUT}/recurrence COMMAND_ERROR_IS_FATAL ANY)
