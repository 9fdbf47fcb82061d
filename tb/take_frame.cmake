# Runs the command after "--" with OPTION and the file of FRAME, from the first of FOLDERS that has it; says so where none
# has.
include(${CMAKE_CURRENT_LIST_DIR}/command_after.cmake)
foreach(folder ${FOLDERS})
  set(file ${folder}/${FRAME}.ptf.xz)
  if(EXISTS ${file})
    execute_process(COMMAND ${command} ${OPTION} ${file} COMMAND_ERROR_IS_FATAL ANY)
    return()
  endif()
endforeach()
message("skipped: ${FRAME}.ptf.xz is in none of ${FOLDERS}")
