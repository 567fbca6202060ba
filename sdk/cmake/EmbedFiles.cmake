# SPDX-License-Identifier: BSD-3-Clause
# gigaray_embed_files(TARGET NAMESPACE FUNCTION FILES ...)
# Compiles the text of the files into the target, with the function
#   std::string_view NAMESPACE::FUNCTION(std::string_view file_name);
# that gives a file's text by its name without folders, or nothing for an unknown name. The caller
# declares it. Made anew when a file changes. Use once per target.
#
# The same file is the script that writes the source:
#   cmake -P EmbedFiles.cmake OUTPUT NAMESPACE FUNCTION FILE ...

if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(GIGARAY_EMBED_FILES_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

  function(gigaray_embed_files target namespace function)
    cmake_parse_arguments(ARG "" "" "FILES" ${ARGN})
    set(files)
    foreach(file IN LISTS ARG_FILES)
      cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
      list(APPEND files ${file})
    endforeach()
    set(output ${CMAKE_CURRENT_BINARY_DIR}/${target}_${function}.cpp)
    add_custom_command(OUTPUT ${output}
      COMMAND ${CMAKE_COMMAND} -P ${GIGARAY_EMBED_FILES_SCRIPT} ${output} ${namespace} ${function}
        ${files}
      DEPENDS ${files} ${GIGARAY_EMBED_FILES_SCRIPT}
      COMMENT "Embedding files into ${target}" VERBATIM)
    target_sources(${target} PRIVATE ${output})
  endfunction()
  return()
endif()

# Arguments: cmake -P script OUTPUT NAMESPACE FUNCTION FILE ...
set(output ${CMAKE_ARGV3})
set(namespace ${CMAKE_ARGV4})
set(function ${CMAKE_ARGV5})
set(texts "")
set(cases "")
math(EXPR last "${CMAKE_ARGC} - 1")
set(i 6)
while(i LESS_EQUAL last)
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
  math(EXPR i "${i} + 1")
endwhile()
file(WRITE ${output}
  "// Generated from the files that are embedded.\n"
  "#include <string_view>\n\n"
  "namespace {\n${texts}}  // namespace\n\n"
  "namespace ${namespace} {\n"
  "std::string_view ${function}([[maybe_unused]] std::string_view file_name) {\n${cases}"
  "  return {};\n}\n"
  "}  // namespace ${namespace}\n")
