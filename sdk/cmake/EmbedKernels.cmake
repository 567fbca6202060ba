# SPDX-License-Identifier: BSD-3-Clause
# gigaray_embed_kernels(TARGET NAMESPACE FILES ...)
# Compiles the text of the files into the target, with the function
#   std::string_view NAMESPACE::kernel_source(std::string_view file_name);
# that gives a file's text by its name without folders and aborts for an unknown name. The caller
# declares it. Made anew when a file changes. Use once per target and namespace.
#
# The same file is the script that writes the source:
#   cmake -P EmbedKernels.cmake OUTPUT NAMESPACE FILE ...

if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(GIGARAY_EMBED_KERNELS_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

  function(gigaray_embed_kernels target namespace)
    cmake_parse_arguments(ARG "" "" "FILES" ${ARGN})
    set(files)
    foreach(file IN LISTS ARG_FILES)
      cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
      list(APPEND files ${file})
    endforeach()
    set(output ${CMAKE_CURRENT_BINARY_DIR}/${target}_kernel_source.cpp)
    add_custom_command(OUTPUT ${output}
      COMMAND ${CMAKE_COMMAND} -P ${GIGARAY_EMBED_KERNELS_SCRIPT} ${output} ${namespace} ${files}
      DEPENDS ${files} ${GIGARAY_EMBED_KERNELS_SCRIPT}
      COMMENT "Embedding kernels into ${target}" VERBATIM)
    target_sources(${target} PRIVATE ${output})
  endfunction()
  return()
endif()

# Arguments: cmake -P script OUTPUT NAMESPACE FILE ...
set(output ${CMAKE_ARGV3})
set(namespace ${CMAKE_ARGV4})
set(texts "")
set(cases "")
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(i RANGE 5 ${last})
  set(file ${CMAKE_ARGV${i}})
  cmake_path(GET file FILENAME name)
  # Bytes, not a string literal: no limit of length and nothing to escape.
  file(READ ${file} bytes HEX)
  string(REGEX REPLACE "(................................)" "\\1\n" bytes "${bytes}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(APPEND texts "constexpr unsigned char kText${i}[] = {\n${bytes}0};\n")
  string(APPEND cases
    "  if (file_name == \"${name}\")\n"
    "    return {reinterpret_cast<const char*>(kText${i}), sizeof kText${i} - 1};\n")
endforeach()
file(WRITE ${output}
  "// Generated from the kernel files.\n"
  "#include <string_view>\n\n#include \"gigaray/core/error.h\"\n\n"
  "namespace {\n${texts}}  // namespace\n\n"
  "namespace ${namespace} {\n"
  "std::string_view kernel_source(std::string_view file_name) {\n${cases}"
  "  GIGARAY_CHECK(!\"a kernel file that is embedded\");\n  return {};\n}\n"
  "}  // namespace ${namespace}\n")
