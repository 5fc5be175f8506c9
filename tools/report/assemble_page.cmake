# SPDX-License-Identifier: Apache-2.0
# Puts page.html, its style, its scripts and uPlot together into OUTPUT, a C++ source with the parts of page_parts.h.
# usage: cmake -D PAGE=FOLDER -D "SCRIPTS=FILE;FILE..." -D UPLOT=FOLDER -D OUTPUT=FILE -P assemble_page.cmake
cmake_minimum_required(VERSION 3.25)

file(READ ${PAGE}/page.css page_css)
file(READ ${UPLOT}/LICENSE uplot_license)
file(READ ${UPLOT}/dist/uPlot.min.css uplot_css)
file(READ ${UPLOT}/dist/uPlot.iife.min.js uplot_js)
set(page_js "")
foreach(file IN LISTS SCRIPTS)
  file(READ ${file} text)
  string(APPEND page_js "${text}\n")
endforeach()

# Each of these would end the element or the literal that holds it.
foreach(part uplot_license uplot_js page_js)
  if("${${part}}" MATCHES "</script|<!--|\\)vdb\"")
    message(FATAL_ERROR "${part} holds what would end the script around it")
  endif()
endforeach()

file(READ ${PAGE}/page.html page)
string(CONFIGURE "${page}" page @ONLY)
if(NOT page MATCHES "{{COMMAND}}.*{{RUN}}")
  message(FATAL_ERROR "page.html must hold {{COMMAND}}, then {{RUN}}")
endif()

function(append_literal name text)
  # Compilers need not take string literals beyond 65,536 characters; neighbouring ones are joined.
  set(literal "")
  string(LENGTH "${text}" length)
  set(from 0)
  while(from LESS length)
    string(SUBSTRING "${text}" ${from} 16000 piece)
    string(APPEND literal "\nR\"vdb(${piece})vdb\"")
    math(EXPR from "${from} + 16000")
  endwhile()
  set(source "${source}extern const std::string ${name};\nconst std::string ${name} =${literal};\n" PARENT_SCOPE)
endfunction()

string(FIND "${page}" "{{COMMAND}}" command)
string(FIND "${page}" "{{RUN}}" run)
math(EXPR after_command "${command} + 11")
math(EXPR between "${run} - ${after_command}")
math(EXPR after_run "${run} + 7")
string(SUBSTRING "${page}" 0 ${command} before_command)
string(SUBSTRING "${page}" ${after_command} ${between} before_run)
string(SUBSTRING "${page}" ${after_run} -1 after_run)

set(source "// Made by assemble_page.cmake.\n#include <string>\n\nnamespace vdbounce::report {\n")
append_literal(kPageBeforeCommand "${before_command}")
append_literal(kPageBeforeRun "${before_run}")
append_literal(kPageAfterRun "${after_run}")
string(APPEND source "} // namespace vdbounce::report\n")
file(WRITE ${OUTPUT} "${source}")
