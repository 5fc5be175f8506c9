# SPDX-License-Identifier: Apache-2.0
# How vdbounce's own targets are compiled: vdbounce_compile_options(TARGET).
include(CheckIPOSupported)
check_ipo_supported(RESULT VDBOUNCE_IPO_SUPPORTED OUTPUT ignored LANGUAGES CXX)

function(vdbounce_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual)
  # Results must not depend on whether the compiler fuses a multiplication with an addition.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  if(VDBOUNCE_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(VDBOUNCE_IPO_SUPPORTED AND CMAKE_BUILD_TYPE STREQUAL "Release")
    set_target_properties(${target} PROPERTIES INTERPROCEDURAL_OPTIMIZATION ON)
  endif()
endfunction()
