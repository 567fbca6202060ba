# SPDX-License-Identifier: BSD-3-Clause
# gigaray_check_kernels(TARGET NAME FILES ... [DEFINE_SETS "LANES=16 STAGE=1" "LANES=1" ...])
# Before TARGET is built, clang parses the files joined in order, as the engine joins them at run
# time, once per set of defines (without any: once). Errors and warnings stop the build with the
# kernel file and line. Checked again when a file changes. Does nothing when there is no clang.
#
# The same file is the script that runs clang:
#   cmake -P CheckKernels.cmake CLANG STAMP DEFINE_SETS FILE ...

if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(GIGARAY_CHECK_KERNELS_SCRIPT ${CMAKE_CURRENT_LIST_FILE})
  find_program(GIGARAY_CLANG NAMES clang clang-19 clang-18 clang-17 clang-16 clang-15 clang-14)
  if(NOT GIGARAY_CLANG)
    message(STATUS "No clang: kernels are not parsed at build time")
  endif()

  function(gigaray_check_kernels target name)
    if(NOT GIGARAY_CLANG)
      return()
    endif()
    cmake_parse_arguments(ARG "" "" "FILES;DEFINE_SETS" ${ARGN})
    set(files)
    foreach(file IN LISTS ARG_FILES)
      cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
      list(APPEND files ${file})
    endforeach()
    string(JOIN "," define_sets ${ARG_DEFINE_SETS})
    set(stamp ${CMAKE_CURRENT_BINARY_DIR}/kernel_check/${name}.stamp)
    add_custom_command(OUTPUT ${stamp}
      COMMAND ${CMAKE_COMMAND} -P ${GIGARAY_CHECK_KERNELS_SCRIPT}
              ${GIGARAY_CLANG} ${stamp} "sets:${define_sets}" ${files}
      DEPENDS ${files} ${GIGARAY_CHECK_KERNELS_SCRIPT}
      COMMENT "Parsing kernels ${name}" VERBATIM)
    add_custom_target(${target}_check_${name} DEPENDS ${stamp})
    add_dependencies(${target} ${target}_check_${name})
  endfunction()
  return()
endif()

# Arguments: cmake -P script CLANG STAMP sets:DEFINES,DEFINES FILE ...
set(clang ${CMAKE_ARGV3})
set(stamp ${CMAKE_ARGV4})
string(REGEX REPLACE "^sets:" "" define_sets "${CMAKE_ARGV5}")
string(REPLACE "," ";" define_sets "${define_sets}")
if(NOT define_sets)
  set(define_sets " ")
endif()

cmake_path(REPLACE_EXTENSION stamp LAST_ONLY cl OUTPUT_VARIABLE join)
file(REMOVE ${stamp})
file(WRITE ${join} "")
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(i RANGE 6 ${last})
  # A bracket or semicolon in the text can't survive a CMake list, so the file is never one.
  file(READ ${CMAKE_ARGV${i}} text)
  file(APPEND ${join} "#line 1 \"${CMAKE_ARGV${i}}\"\n${text}\n")
endforeach()

foreach(defines IN LISTS define_sets)
  separate_arguments(flags UNIX_COMMAND "${defines}")
  list(TRANSFORM flags PREPEND "-D")
  # A join holds helpers that not every kernel calls, hence -Wno-unused-function.
  execute_process(
    COMMAND ${clang} -x cl -cl-std=CL1.2 -Xclang -finclude-default-header -fsyntax-only
            -Wall -Werror -Wno-unused-function ${flags} ${join}
    RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    cmake_path(GET join STEM name)
    message(FATAL_ERROR "kernels ${name} with '${defines}' do not parse")
  endif()
endforeach()
file(TOUCH ${stamp})
