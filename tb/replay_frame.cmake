# Records the tile jobs of FRAME with PROGRAM and replays them with BENCH on each of MODELS (a list).
if(NOT EXISTS ${FRAME})
  message("skipped: ${FRAME} does not ship; configure with -DHALFSPACE_FRAMES=FOLDER of captured frames")
  return()
endif()
get_filename_component(name ${FRAME} NAME_WE)
execute_process(COMMAND ${PROGRAM} run ${FRAME} --tile-jobs ${name}.jobs COMMAND_ERROR_IS_FATAL ANY)
foreach(model ${MODELS})
  execute_process(COMMAND ${BENCH} --model ${model} --case replay --replay ${name}.jobs
                          --failure-wave ${model}_${name}.fst COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(REMOVE ${name}.jobs)
