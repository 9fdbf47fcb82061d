# Gives every triangle of FRAME to MODEL of BENCH.
if(NOT EXISTS ${FRAME})
  message("skipped: ${FRAME} does not ship; configure with -DHALFSPACE_FRAMES=FOLDER of captured frames")
  return()
endif()
get_filename_component(name ${FRAME} NAME_WE)
execute_process(COMMAND ${BENCH} --model ${MODEL} --case replay --replay ${FRAME}
                        --failure-wave setup_${MODEL}_${name}.fst COMMAND_ERROR_IS_FATAL ANY)
