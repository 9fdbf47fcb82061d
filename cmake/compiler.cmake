# Compiler settings of our own targets: halfspace_compile_options(TARGET).
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

# The presets set CMAKE_UNITY_BUILD: files of a target are compiled eight at a time, since headers and templates take most
# of the compiler's time. Names of their own must differ too.
if(HALFSPACE_SANITIZE)
  # AddressSanitizer sees null pointers and ends of objects too; checks of them cost a third of the compiler's time.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize=null,object-size,vptr -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  add_compile_definitions(HWY_COMPILE_ONLY_STATIC)  # lanes for one processor
endif()
if(HALFSPACE_COVERAGE)
  add_compile_options(--coverage -fprofile-update=atomic)
  add_link_options(--coverage)
endif()

function(halfspace_compile_options target)
  # Cuts and snapping must not depend on the target's instructions: no fused multiply-add behind the source's back.
  # lrint without errno is one instruction.
  target_compile_options(${target} PRIVATE -ffp-contract=off -fno-math-errno)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic $<$<BOOL:${HALFSPACE_WERROR}>:-Werror>)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)  # false alarms in std::string, GCC bug 105651
  endif()
endfunction()
