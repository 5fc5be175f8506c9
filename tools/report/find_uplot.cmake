# SPDX-License-Identifier: Apache-2.0
# Sets VDBOUNCE_UPLOT to the folder of the uPlot that package.json names: one given with -DVDBOUNCE_UPLOT=FOLDER, that of
# `npm ci` run here by hand, or that which npm puts into the build folder now. Where none is to be had, VDBOUNCE_UPLOT
# stays empty and VDBOUNCE_NO_UPLOT says why.
file(READ ${CMAKE_CURRENT_SOURCE_DIR}/package.json text)
string(JSON wanted GET "${text}" dependencies uplot)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS package.json package-lock.json)

# An older one that an earlier build fetched is no reason to go on with it.
function(is_wanted_uplot result folder)
  set(${result} FALSE PARENT_SCOPE)
  if(EXISTS ${folder}/package.json)
    file(READ ${folder}/package.json text)
    string(JSON version GET "${text}" version)
    if(version STREQUAL wanted)
      set(${result} TRUE PARENT_SCOPE)
    endif()
  endif()
endfunction()

set(here ${CMAKE_CURRENT_SOURCE_DIR}/node_modules/uplot)
set(fetched ${CMAKE_CURRENT_BINARY_DIR}/npm/node_modules/uplot)
if(VDBOUNCE_UPLOT)
  return()
endif()
is_wanted_uplot(is_here ${here})
if(is_here)
  set(VDBOUNCE_UPLOT ${here})
  return()
endif()

is_wanted_uplot(is_fetched ${fetched})
if(NOT is_fetched)
  find_program(VDBOUNCE_NPM npm)
  if(NOT VDBOUNCE_NPM)
    set(VDBOUNCE_NO_UPLOT "there is no npm here, which ./dev build installs")
    return()
  endif()
  message(STATUS "Fetching uPlot ${wanted} with npm")
  file(COPY package.json package-lock.json DESTINATION ${CMAKE_CURRENT_BINARY_DIR}/npm)
  # Without a network it is to say so soon: 2 tries of 20 seconds.
  execute_process(COMMAND ${VDBOUNCE_NPM} ci --ignore-scripts --no-audit --no-fund --fetch-retries=1 --fetch-timeout=20000
                  WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/npm
                  RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(code)
    message(STATUS "${output}")
    set(VDBOUNCE_NO_UPLOT "npm could not fetch uPlot ${wanted}; give its unpacked package with -DVDBOUNCE_UPLOT=FOLDER")
    return()
  endif()
endif()
set(VDBOUNCE_UPLOT ${fetched})
